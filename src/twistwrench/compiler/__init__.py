"""One source, every speed: the recursions of the chapter as straight lines, and what runs them.

Each file imports only from those above it in this table.

=============  ===============================================================================================
file           what it holds
=============  ===============================================================================================
number         `Number`, which only remembers what is done to it, and the `Tape` it writes on
line           `Line`: the operations that a question needs, one after the other
sine           sin and cos as arithmetic, for many angles at once
instructions   LLVM's language: arithmetic, and the way in and out of memory
llvm           machine code, by LLVM
source         a line as text: Python, annotated with the chapter's steps, and C
pairs          arithmetic with pairs of doubles, sin and cos
packs          the same operation in several limbs
registers      NumPy, for every number type
fingerprints   what is the same number in every state, computed once
tangent        the derivatives of what is on a tape, and steps along v from q
backend        which of them runs a line, or plain Python's floats
double_double  a line rewritten into pairs, with bounds
watch          what a program watches, so that the textbook can take the states that raise the alarm
quantity       `Quantity`: what it depends on, and how it is computed; by the textbook, for some states
derivatives    derivatives of all quantities, and the regressor
quantities     what can be compiled: the textbook's functions
recording      from quantities to a line
outputs        arrays of the caller that are to be filled
extension      a program for one state as a function of the interpreter
program        `Program`, which is called as the textbook's functions are
digits         programs in pairs of doubles, in quadruple precision, in mpmath's numbers; and with a bound
compilation    `compile`
=============  ===============================================================================================
"""

from .compilation import compile
from .double_double import DoubleDouble
from .program import Program, Results

__all__ = ["DoubleDouble", "Program", "Results", "compile"]
