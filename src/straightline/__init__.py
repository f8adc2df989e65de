"""NumPy code as a straight line of operations, and what runs it: machine code, NumPy, Python, C, pairs of doubles.

A function that only adds, multiplies, divides and takes sines, cosines, roots and angles does the same for every
argument; of two numbers that are both computed it may choose one. It is called once, with numbers that have no value
and remember what is done to them. What they remember is a `Line`: operations one after the other, without a loop and
without a jump, from which all is left out that is zero, or there already, or not needed. A line is data. It can be
counted, differentiated, written as text, run for a million arguments at once, or rewritten into one that has 32 digits
and a proved bound of its error. Nothing in this package knows what a line computes.

>>> import numpy as np
>>> def turned(x, angle):
...     c, s = np.cos(angle), np.sin(angle)
...     R = np.array([[c, -s], [s, c]])
...     return R @ x, (R @ R.mT)[0, 0]  # a rotation: the last one is cos² + sin²
>>> line = straight_line(turned, x=(2,), angle=())
>>> dict(line.operations), line.nodes[line.outputs["y1"][1][0]]
({'cos': 1, 'sin': 1, 'mul': 4, 'sub': 1, 'add': 1}, ('const', Fraction(1, 1)))

As text, and for many arguments at once, by NumPy, or by "llvm" where llvmlite is installed:

>>> print(python_source(line, "turned"))
from math import cos, sin
<BLANKLINE>
<BLANKLINE>
def turned(x, angle):
    t_1 = cos(angle)
    t_2 = sin(angle)
    t_3 = x[0] * t_1 - x[1] * t_2
    t_4 = x[0] * t_2 + x[1] * t_1
    return [t_3, t_4], 1.0
<BLANKLINE>
>>> x, angle = np.random.default_rng(0).standard_normal((2, 1000, 2)), np.linspace(0, 3, 1000)
>>> found = BackEnd(line, np.dtype(np.float64), "numpy").results({"x": x[0], "angle": angle}, (1000,))
>>> bool(np.allclose(found["y0"][:, 0], np.cos(angle) * x[0, :, 0] - np.sin(angle) * x[0, :, 1]))
True

With 32 digits, as a pair of doubles, and how far that can be off at most:

>>> pairs = double_double(line, fma=False, bound=True)
>>> exact = BackEnd(pairs, np.dtype(np.float64), "numpy").results({"x": x[0, :1], "angle": angle[:1]}, (1,))
>>> sorted(exact), bool((exact["y0.bound"] < 1e-28).all())
(['y0', 'y0.bound', 'y0.lo', 'y1', 'y1.bound', 'y1.lo'], True)

Or in doubles, where the bound goes along beside each number:

>>> running = with_running_bound(line, np.dtype(np.float64), fma=False)
>>> found = BackEnd(running, np.dtype(np.float64), "numpy").results({"x": x[0, :1], "angle": angle[:1]}, (1,))
>>> sorted(found), bool((found["y0.bound"] < 1e-14).all())
(['y0', 'y0.bound', 'y1', 'y1.bound'], True)

Each file imports only from those above it in this table, and none from anything but NumPy and, where it is there,
llvmlite.

=============  ===============================================================================================
file           what it holds
=============  ===============================================================================================
number         `Number`, which only remembers what is done to it, and the `Tape` it writes on
line           `Line`: the operations that a question needs, one after the other
sine           sin and cos as arithmetic, for many angles at once
arctangent     atan2 as arithmetic, for many points at once
instructions   LLVM's language: arithmetic, and the way in and out of memory
objects        machine code on disk, for the next process
llvm           machine code, by LLVM
source         a line as text: Python and C, with names and comments if the tape took notes
rows           a line as text for JAX: rows of like operations, in one loop
pairs          arithmetic with pairs of doubles, sin and cos
double_double  a line rewritten into pairs, with bounds
running        a line with a bound beside each number, in the same numbers
packs          operations that NumPy can do in one call
registers      NumPy, for every number type
fingerprints   what is the same number for all arguments, computed once
recorder       `straight_line`: from a function to its line
tangent        derivatives of what is on a tape
outputs        arrays of the caller that are to be filled
extension      a line as a function of the interpreter, by the memory of CPython's and NumPy's objects; can be left out
ufunc          a line as a function of NumPy's: any leading axes and strides
backend        `BackEnd`: which of them runs a line, or plain Python's floats
=============  ===============================================================================================
"""

from .backend import BackEnd
from .double_double import DoubleDouble, double_double
from .line import Line
from .number import Number, Tape, numbers
from .recorder import straight_line
from .rows import jax_source
from .running import with_running_bound
from .source import c_source, python_source

__all__ = [
    "BackEnd",
    "DoubleDouble",
    "Line",
    "Number",
    "Tape",
    "c_source",
    "double_double",
    "jax_source",
    "numbers",
    "python_source",
    "straight_line",
    "with_running_bound",
]
