"""A compiled program: called with arrays as the textbook's functions are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from math import prod
from operator import is_
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from straightline.backend import BackEnd
from straightline.line import Line
from straightline.outputs import check_outputs, finish, separate, targets
from straightline.rows import jax_source
from straightline.source import c_source, python_source
from straightline.ufunc import ArrayFunction

from ..arrays import Array
from ..errors import ShapeError
from ..model import Model
from .anchors import step
from .quantity import ARGUMENTS, Quantity, by_the_textbook, checked, shapes, shapes_by_the_textbook
from .recording import ALARM, record

__all__ = ["Program", "Results"]

NOTHING: Mapping[str, Array] = {}

NONE_YET: Mapping[int, None] = dict.fromkeys(range(1 + len(ARGUMENTS)))  # by the number of arguments

LARGE = 2**16
"""Bytes: smaller arrays of the caller are filled by a copy, quicker than to ask what they share memory with."""


def check_held(dtype: np.dtype[Any], given: Mapping[str, Any], checked: Mapping[str, Array]) -> None:
    """Raise ValueError for arguments of a number type that a program cannot hold; `checked` has their common one."""
    got = np.result_type(dtype, *checked.values())
    if holds(dtype, got):
        return
    name = next((name for name, x in given.items() if not holds(dtype, np.asarray(x).dtype)), ", ".join(given))
    kind = "real numbers" if dtype.kind != got.kind else f"numbers that {dtype} holds"
    came = next(iter(checked.values())).dtype
    raise ValueError(f"{name}: expected {kind}, got {came}; tw.compile(..., dtype={got.name!r}) takes them")


def holds(dtype: np.dtype[Any], given: np.dtype[Any]) -> bool:
    """Return whether a program takes numbers of a type: it may round doubles, which all constants are, no others.

    Examples
    --------
    >>> holds(np.dtype("float32"), np.dtype("float64")), holds(np.dtype("float64"), np.dtype("complex64"))
    (True, False)
    """
    if given.kind not in "fc":
        return True
    digits = max(np.finfo(dtype).nmant, np.finfo(np.float64).nmant)
    return np.finfo(given).nmant <= digits and (dtype.kind == "c" or given.kind != "c")


class Results(SimpleNamespace):
    """Several quantities, as attributes by their symbols."""

    def __repr__(self) -> str:
        shapes = {name: np.shape(getattr(x, "hi", x)) for name, x in vars(self).items()}  # of pairs, too
        return f"Results({', '.join(f'{name}: {shape}' for name, shape in shapes.items())})"


class Program:
    """Straight-line program from `twistwrench.compile`: call it with arrays like any function of the package.

    TypeError is raised where it is called without one of its arguments, or with others.

    Parameters
    ----------
    model : Model
    quantities : tuple of Quantity
    single : bool
        Whether the result is one array; else it is `Results`.
    dtype : dtype
    backend : {"llvm", "numpy", "textbook"}
        With "textbook" there is no line: the textbook's functions take all states, some at a time.
    given : mapping of str to ndarray
        Arguments that are the same for every state.
    threads : int
    remake : callable, optional
        Makes the program anew, from what can be pickled.

    Attributes
    ----------
    arguments : tuple of str
        The names of the program's arguments, in their order.
    alone : dict
        What answers for one state, once one was asked for, by the number of arguments: with f_ext, the last, there is
        one more. See `straightline.extension`.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> program = tw.compile(tw.load("pendulum"), "gravity")
    >>> program([np.pi / 2]), program([[0.0], [np.pi / 2]]).shape, program.operations
    (array([9.81]), (2, 1), Counter({'sin': 1, 'mul': 1}))
    """

    def __init__(
        self,
        model: Model,
        quantities: Sequence[Quantity],
        *,
        single: bool,
        dtype: np.dtype[Any],
        backend: str,
        given: Mapping[str, Array] = NOTHING,
        threads: int = 1,
        remake: Callable[[], Program] | None = None,
    ) -> None:
        self.model, self.quantities, self.single, self.given = model, tuple(quantities), single, dict(given)
        self._remake = remake
        self.dtype, self.backend, self.threads = dtype, backend, threads
        needed = {name for quantity in quantities for name in quantity.arguments} - set(given)
        self.arguments = tuple(name for name in ARGUMENTS if name in needed)
        self._plain = tuple(name for name in self.arguments if name != "f_ext")
        self._shapes = {name: shapes(model)[name] for name in self.arguments}
        self._symbols = [quantity.symbol for quantity in quantities]
        self._codes: dict[tuple[str, ...], BackEnd] = {}
        self.alone: dict[int, Callable[..., Any] | None] = {**NONE_YET}
        self._functions: dict[int, ArrayFunction | None] = {}

    def run_by(self, backend: str) -> None:
        """Let another back end run the program, without recording it again."""
        self.backend = backend
        self.alone = {**NONE_YET}
        self._functions.clear()
        for code in self._codes.values():
            code.name = backend

    @property
    def one_state(self) -> Callable[..., Any] | None:
        """What answers for one state without f_ext, once one was asked for."""
        return self.alone[len(self._plain)]

    @property
    def operations(self) -> Counter[str]:
        """How many operations a state takes, by kind, without those that watch the state."""
        return self.line.operations

    @property
    def line(self) -> Line:
        """The straight line, for states without wrenches from outside."""
        return self._code(self._plain).line.without(ALARM)

    def source(self, functions: str = "math") -> str:
        """Return the straight line as a Python function: for floats, or any numbers with + − × ÷, cos, sin and sqrt.

        Each value has the name of the chapter's step that it belongs to, and of its body; results are nested lists.
        For JAX the same operations are rows of a table that one loop goes through, which compiles in a second however
        many there are; results are arrays. The function is for one state; `jax.vmap` makes it one for many. Nothing is
        checked but, by JAX, the number of entries.

        Parameters
        ----------
        functions : str
            The module of cos, sin and sqrt: "math", "mpmath", "sympy", "casadi", "torch", "jax.numpy".

        Examples
        --------
        >>> import twistwrench as tw
        >>> print(tw.compile(tw.load("pendulum"), "gravity").source())
        from math import sin
        <BLANKLINE>
        <BLANKLINE>
        def g(q):
            # 49.3 T_J: tree constant, then joint
            T_J_1 = sin(q[0])
            # 49.6 A: acceleration, body 1
            A1_1 = T_J_1 * 9.81
            return [A1_1]
        <BLANKLINE>
        """
        if functions == "jax.numpy":
            return jax_source(self.line, self._name)
        return python_source(self._noted(), self._name, functions)

    def c(self) -> str:
        """Return the straight line as a function in C99: pointers to the arguments, then to the results, in doubles."""
        return c_source(self._noted(), self._name)

    @property
    def _name(self) -> str:
        """The name of the function in the texts."""
        return self.quantities[0].symbol if self.single else "program"

    def _noted(self) -> Line:
        """Return the line with the steps of the chapter."""
        return self._recorded(self._plain, step).without(ALARM)

    def _recorded(self, names: tuple[str, ...], note: Callable[[], Any] | None = None) -> Line:
        shapes = {name: self._shapes[name] for name in names}
        return record(self.model, self.quantities, shapes, self.given, self.dtype, note)

    def _code(self, names: tuple[str, ...]) -> BackEnd:
        """Return the line for states with these arguments, and what runs it: made once."""
        if names not in self._codes:
            self._codes[names] = BackEnd(self._recorded(names), self.dtype, self.backend)
        return self._codes[names]

    def __call__(self, *args: ArrayLike | None, out: Any = None, **named: ArrayLike | None) -> Any:
        """Return the quantities in a state, or in many.

        Parameters
        ----------
        *args, **named : array_like
            The arguments of the program, `arguments`, in this order or by name: q (..., nq), v, a and tau (..., nv),
            f_ext (..., nbodies, 6), which may be left out.
        out : ndarray, or mapping of str to ndarray, optional
            To be filled.

        Returns
        -------
        ndarray or Results

        Raises
        ------
        ShapeError, SingularError, ValueError
            As the textbook's functions; or for complex numbers and long doubles that the program's type cannot hold.
        TypeError
            If an argument is missing, is not one of the program's, or is a `DoubleDouble`.
        """
        if named:
            args = tuple(self._bound(args, named).values())
        found = self.results(args, out)
        if found is None:
            return self._general(args, out)
        return found if self.single else Results(**dict(zip(self._symbols, found)))

    def results(self, args: Sequence[Any], out: Any = None) -> Any:
        """Return the only result, or a tuple of all; None for what takes the general way, as each first call does.

        Here is what a control loop calls: arrays of the program's number type with any leading axes and strides, in
        ordinary states, and an `out` that NumPy could fill as well. Nothing is looked at twice.
        """
        alone = self.alone.get(len(args))
        found = alone(*args) if alone else None
        if out is None:
            return self._of_arrays(args) if found is None else found
        if not self.single:
            return self._into(args, out, found)
        if found is None or type(out) is not np.ndarray or out.shape != found.shape or not out.flags.carray:
            return self._into(args, {self._symbols[0]: out}, found)
        if out.dtype != found.dtype:
            return None
        out[...] = found
        return out

    def _into(self, args: Sequence[Any], out: Any, found: Any) -> Any:
        """Return the results as `results` does, of which some, by their symbols, are written to arrays of the caller.

        What was found already are those of one state.
        """
        if type(out) is not dict:
            return None
        if found is None:
            if sum(getattr(x, "nbytes", 0) for x in out.values()) > LARGE:
                return self._filled(args, out)
            found = self._of_arrays(args)
            if found is None:
                return None
        by_symbol = {self._symbols[0]: found} if self.single else dict(zip(self._symbols, found))
        for name, x in out.items():
            if type(x) is not np.ndarray or x.shape != by_symbol[name].shape or x.dtype != self.dtype:
                return None
            if not x.flags.carray:
                return None
        if len(out) > 1 and not separate([*out.values()]):
            return None
        for name, x in out.items():
            x[...] = by_symbol[name]
        by_symbol.update(out)
        return x if self.single else tuple(by_symbol.values())

    def _of_arrays(self, args: Sequence[Any], out: Sequence[Array | None] | None = None) -> Any:
        """Return the results as `results` does, or None; `out` is known to fit."""
        function = self._functions.get(len(args))
        if function is None:
            return None
        for x in args:
            if type(x) is not np.ndarray or x.dtype != self.dtype:
                return None
        try:
            found = function.call(*args) if out is None else function.call(*args, out=(*out, None))
            alarm: Any = found[-1]
            worst = alarm.item(alarm.argmax()) if type(alarm) is np.ndarray else alarm
        except ValueError:  # the shapes do not fit, or there are no states
            return None
        if not worst <= 1:  # an entry that is not beside the last one is an alarm, too
            pieces = [np.asarray(x, order="C") for x in args]
            if all(map(is_, pieces, args)):
                return None
            return self.results(pieces) if out is None else self._of_arrays(pieces, out)
        return found[0] if self.single else found[:-1]

    def _filled(self, args: Sequence[Any], out: Mapping[str, Array]) -> Any:
        """Return the results as `results` does, computed where they are wanted: in arrays that share nothing."""
        names = self.arguments[: len(args)]
        code, arrays = self._codes.get(names), [*out.values()]
        if code is None or not all(type(x) is np.ndarray for x in (*args, *arrays)):
            return None
        if not all(x.flags.carray for x in arrays) or not all(separate([x, *arrays]) for x in args):
            return None
        try:
            batch = np.broadcast_shapes(*(x.shape[: x.ndim - len(self._shapes[name])] for name, x in zip(names, args)))
        except ValueError:
            return None
        shapes = {name: (*batch, *shape) for name, (shape, _) in code.line.outputs.items()}
        if not all(x.shape == shapes[name] and x.dtype == self.dtype for name, x in out.items()):
            return None
        return self._of_arrays(args, [out.get(name) for name in self._symbols])

    def _general(self, args: Sequence[Any], out: Any) -> Any:
        """Return the quantities as `__call__` does, whatever the arguments are."""
        states = self._states(self._bound(args, {}))
        batch = self.batch(states)
        code = None if self.backend == "textbook" else self._code(tuple(states))
        if code is None:
            tails = shapes_by_the_textbook(self.quantities, states, self._shapes)
        else:
            tails = {name: shape for name, (shape, _) in code.line.outputs.items() if name != ALARM}
        given = {} if out is None else {next(iter(tails)): out} if self.single else dict(out)
        check_outputs(given, batch, tails, self.dtype, ShapeError)
        rows = targets(given, [*states.values()], prod(batch), tails, self.dtype)
        filled = {name: x.reshape(batch + tails[name]) for name, x in rows.items()}
        unsure = np.ones(batch, bool)
        if code is not None:
            try:
                unsure = ~(code.results(states, batch, self.threads, rows)[ALARM].real <= 1)
                self._remember(code, states, batch)
            except OverflowError:  # a constant is beyond the largest double: the textbook says what is wrong
                pass
        if unsure.any():
            by_the_textbook(self.model, self.quantities, self.given | states, filled, unsure)
        return self.packed(finish(given, filled))

    def _remember(self, code: BackEnd, states: Mapping[str, Array], batch: tuple[int, ...]) -> None:
        """Remember what answers the next calls of this kind: see `results`."""
        count = len(states)
        if tuple(states) != self.arguments[:count]:
            return
        if batch == () and self.alone[count] is None:
            self.alone[count] = code.one_state(self.single)
        if self.threads == 1 and count not in self._functions:
            self._functions[count] = code.array_function()
        if len(batch) > 1 and not all(x.flags.c_contiguous for x in states.values()):
            code.code(1)  # NumPy may take only a few of the states at a time

    def _bound(self, args: Sequence[ArrayLike | None], named: Mapping[str, ArrayLike | None]) -> dict[str, ArrayLike]:
        """Return the arguments by name."""
        expected = ", ".join(self.arguments) or "no arguments"
        if len(args) > len(self.arguments):
            raise TypeError(f"expected {expected}, got {len(args)} arguments")
        bound = dict(zip(self.arguments, args))
        for name, x in named.items():
            if name not in self.arguments or name in bound:
                raise TypeError(f"expected {expected}, got {name!r}{' twice' if name in bound else ''}")
            bound[name] = x
        missing = [name for name in self._plain if bound.get(name) is None]
        if missing:
            raise TypeError(f"expected {expected}: {', '.join(missing)} missing")
        return {name: x for name in self.arguments if (x := bound.get(name)) is not None}

    def packed(self, results: Mapping[str, Any]) -> Any:
        """Return one result as it is, several as `Results`."""
        return next(iter(results.values())) if self.single else Results(**results)

    def _states(self, bound: Mapping[str, Any]) -> dict[str, Array]:
        """Return the arguments as arrays of one batch shape, in the program's number type."""
        tails = {name: self._shapes[name] for name in bound}
        # the alarm adds squares, and those of complex numbers may cancel
        if self.dtype.kind != "c" and all(type(x) is np.ndarray and x.dtype == self.dtype for x in bound.values()):
            parts = {name: np.shape(x)[np.ndim(x) - len(tails[name]) :] for name, x in bound.items()}
            if parts == tails and len({np.shape(x)[: np.ndim(x) - len(tails[name])] for name, x in bound.items()}) <= 1:
                return dict(bound)
        states = checked(self.model, bound)
        check_held(self.dtype, bound, states)
        return {name: x.astype(self.dtype, copy=False) for name, x in states.items()}

    def batch(self, states: Mapping[str, Array]) -> tuple[int, ...]:
        """Return the batch axes of arguments that have been checked."""
        return next((x.shape[: x.ndim - len(self._shapes[name])] for name, x in states.items()), ())

    def __reduce__(self) -> tuple[Callable[[], Program], tuple[()]]:
        if self._remake is None:
            raise TypeError(f"{self!r} belongs to its model, which makes it anew after pickling")
        return self._remake, ()

    def __repr__(self) -> str:
        what = ", ".join(quantity.symbol for quantity in self.quantities)
        total = self.operations.total()
        return f"<Program {what} of {self.model.name!r}: {total} operations, {self.dtype}, {self.backend}>"
