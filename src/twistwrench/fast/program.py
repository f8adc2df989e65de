"""A compiled program: called with arrays as the textbook's functions are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from math import prod
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from straightline.backend import BackEnd
from straightline.line import Line
from straightline.outputs import check_outputs, finish, targets
from straightline.source import c_source, python_source

from ..arrays import Array
from ..errors import ShapeError
from ..model import Model
from .anchors import step
from .quantity import ARGUMENTS, Quantity, by_the_textbook, checked, shapes, shapes_by_the_textbook
from .recording import ALARM, record

__all__ = ["Program", "Results"]

NOTHING: Mapping[str, Array] = {}


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
        return f"Results({', '.join(f'{name}: {np.shape(x)}' for name, x in vars(self).items())})"


class Program:
    """What `twistwrench.compile` returns: call it with arrays like any function of the package.

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
    one_state : callable, optional
        What answers for one state, once one was asked for, where each 0.1 µs counts: see `straightline.extension`.

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
        self._one = [self._shapes[name] for name in self._plain]
        self._codes: dict[tuple[str, ...], BackEnd] = {}
        self.one_state: Callable[..., Any] | None = None

    def run_by(self, backend: str) -> None:
        """Let another back end run the program, without recording it again."""
        self.backend = backend
        for code in self._codes.values():
            code.name = backend

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

        Each value has the name of the chapter's step that it belongs to, and of its body. Nothing is checked.

        Parameters
        ----------
        functions : str
            The module of cos, sin and sqrt: "math", "mpmath", "sympy", "jax.numpy", "torch".

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
        if out is None and not named:
            one = self.one_state
            if one is None and self.backend == "llvm" and [getattr(x, "shape", None) for x in args] == self._one:
                one = self.one_state = self._code(self._plain).one_state(self.single)
            found = one(*args) if one else None
            if found is not None:
                return found if self.single else Results(**dict(zip((x.symbol for x in self.quantities), found)))
        states = self._states(self._bound(args, named))
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
            unsure = ~(code.results(states, batch, self.threads, rows)[ALARM].real <= 1)
        if unsure.any():
            by_the_textbook(self.model, self.quantities, self.given | states, filled, unsure)
        return self.packed(finish(given, filled))

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
