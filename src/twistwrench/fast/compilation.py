"""`compile`: a program for a robot and a question."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any, Literal, Protocol, get_args

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from straightline.llvm import NATIVE, available, default_backend

from ..algorithms.floating_base import HeldRows, as_frames, as_held
from ..algorithms.kinematics import Reference
from ..arrays import Array, as_count, as_flag, as_names, check_choice, check_kind
from ..errors import check_known
from ..model import Model, check_arrays, check_model
from .derivatives import second_derivatives
from .digits import NUMBERS, RUNNING, WIDE, DigitsProgram, wide_type, with_digits
from .program import Program
from .quantities import Quantity, chosen, quantities
from .quantity import STATE

__all__ = ["compile"]

FREE = ("IA",)
"""What belongs to the free model, and would be another thing with contacts; with its derivatives."""


class SceneLike(Protocol):
    """What is compiled of a `Scene`, which is in a later room."""

    @property
    @abstractmethod
    def model(self) -> Model: ...

    @property
    @abstractmethod
    def contacts(self) -> tuple[Any, ...]: ...

    @abstractmethod
    def _quantities(self, dtype: np.dtype[Any], frames: tuple[str, ...], reference: Any, /) -> dict[str, Quantity]: ...


def compile(
    model: Model | SceneLike,
    want: str | Iterable[str],
    *,
    dtype: DTypeLike = np.float64,
    contacts: Iterable[str | HeldRows] | None = None,
    frames: Iterable[str] = (),
    reference: Reference = "local",
    given: Mapping[str, ArrayLike] | None = None,
    backend: str | None = None,
    threads: int = 1,
    bound: bool | Literal["running"] = False,
) -> Program | DigitsProgram:
    """Return a program that computes the wanted quantities of this model, and nothing else.

    Parameters
    ----------
    model : Model or Scene
        For a scene, its smallest model is compiled, with its wrenches and its contacts, which hold it: "qdd" and
        "lambda" are those of `contact_forward_dynamics`, λ in the order of the rows of `constraint_jacobian`, "v_plus"
        and "impulse" those of `impact`. I^A is refused, which would be another one.
    want : str or iterable of str
        Names of functions, symbols of `quantities.SYMBOLS`, or derivatives by an argument, ``dtau_dq``, also twice,
        ``dtau_dq_dv``. For one name the program returns an array; for several it returns `Results`, and what they have
        in common is computed once.
    dtype : dtype_like
        A floating-point type (float32 and float64 can be machine code), or one with more digits: "double-double" has
        32 (``straightline.DoubleDouble``, pairs of hi and lo), "quad" 34, and "mpmath" as many as ``mpmath.mp.dps``.
        Doubles are rounded to it; complex numbers and long doubles are refused where it cannot hold them.
    contacts : iterable of str or Contact, optional
        The frames of J_c, or contacts of any kind; `model.feet` unless given. Not for a scene, which has its own.
    frames : iterable of str
        The frames of placements, Jacobians, J̇ v, IA and subtrees; these results have one more axis for the frames.
    reference : {"local", "world", "local_world_aligned"}
        For Jacobians and J̇ v: see `twistwrench.frame_jacobian`.
    given : mapping of str to array_like
        Arguments that are the same in every state: ``{"v": np.zeros(nv)}``. They become constants of the program.
    backend : {"llvm", "numpy"}, optional
        By default LLVM if it is installed and has the number type, otherwise NumPy.
    threads : int
        The number of parts into which a batch is divided.
    bound : bool or "running"
        Whether the program also returns a proved bound of each entry's error: ``value, bound = program(…)``. It is for
        the arguments as the program has them, in float32 rounded ones. With True it is hardly larger than the error,
        since the same is computed with 32 digits, and a state takes some fourteen times as long; with "running" some
        four times, and the bound, for which each operation is assumed to round as badly as it can, is some ten to a
        thousand times the error.

    Returns
    -------
    Program or DigitsProgram

    Raises
    ------
    NameNotFound
        If there is no such quantity, frame, reference or argument; the message lists those that exist.
    ImportError
        If a package that is asked for is not installed.
    ShapeError, TypeError, ValueError
        If an option is not one of those above; for I^A of a scene with contacts.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> program = tw.compile(model, "rnea")
    >>> program(model.standing(), np.zeros(18), np.zeros(18))[5].round(3)
    np.float64(157.794)

    Operations that the result does not need are not in the program:

    >>> held = tw.compile(model, "rnea", given={"v": np.zeros(18), "a": np.zeros(18)})
    >>> program.operations.total(), held.operations.total(), held.arguments
    (2533, 590, ('q', 'f_ext'))

    Several quantities at once share common work:

    >>> both = tw.compile(model, ["M", "h"])
    >>> both(np.tile(model.standing(), (1000, 1)), np.zeros((1000, 18)))
    Results(M: (1000, 18, 18), h: (1000, 18))
    """
    number = dtype if isinstance(dtype, str) and dtype in NUMBERS else None
    own = _number_type(np.float64 if number else dtype)
    options: dict[str, Any] = {
        "dtype": own,
        "contacts": None if contacts is None else as_frames(contacts),
        "frames": as_names(frames, "frames", "frame names", ordered=True),
        "reference": reference,
        "given": given,
        "backend": _backend(backend, wide_type(number) if number in WIDE else own),
        "threads": as_count(threads, "threads", 1),
    }
    asked = want if isinstance(want, str) else as_names(want, "want", "quantities")
    return with_digits(_program(model, asked, **options), number, _kind_of_bound(bound))


def _program(
    model: Any,
    asked: str | tuple[str, ...],
    *,
    dtype: np.dtype[Any],
    contacts: tuple[str | HeldRows, ...] | None,
    frames: tuple[str, ...],
    reference: Reference,
    given: Mapping[str, ArrayLike] | None,
    **how: Any,
) -> Program:
    """Return a program in numbers of NumPy, of a model or a scene."""
    remake = partial(_program, model, asked, dtype=dtype, contacts=contacts, frames=frames, reference=reference)
    check_known("reference", reference, get_args(Reference))
    of_scene = getattr(model, "_quantities", None)
    if of_scene is not None and contacts is not None:
        raise ValueError(f"contacts: a scene has its own, got {list(contacts)}; tw.Scene(..., contacts=) sets them")
    body = model if of_scene is None else model.model
    check_model(body)
    held = as_held(body, body.feet if contacts is None else contacts) if of_scene is None else ()
    for frame in frames:
        body.frame(frame)
    known = of_scene(dtype, frames, reference) if of_scene else quantities(body, dtype, held, frames, reference)
    names = (asked,) if isinstance(asked, str) else asked
    wanted = chosen(known | second_derivatives(body, known, names), names)
    if of_scene is not None and model.contacts:
        _refuse_free(wanted)
    given = _checked(body, given)
    return Program(
        body,
        wanted,
        single=isinstance(asked, str),
        given=given,
        dtype=dtype,
        remake=partial(remake, given=given, **how),
        **how,
    )


def _refuse_free(wanted: Iterable[Quantity]) -> None:
    """Raise ValueError for what a model has only where it is free, in a scene whose contacts hold it."""
    for symbol in (quantity.symbol for quantity in wanted):
        if symbol in FREE or symbol.startswith(tuple(f"d{free}_d" for free in FREE)):
            hint = "tw.compile(scene.model, …) has that of the free robot"
            raise ValueError(f"{symbol}: expected a scene without contacts, which a program would ignore here; {hint}")


def _kind_of_bound(bound: object) -> bool | str:
    """Return whether there is to be a bound, and which."""
    if isinstance(bound, str):
        check_choice(bound, "bound", (RUNNING,))
        return bound
    return as_flag(bound, "bound")


def _number_type(dtype: DTypeLike) -> np.dtype[Any]:
    """Return a floating-point type."""
    try:
        found = np.dtype(dtype)
    except (TypeError, ValueError, SyntaxError):
        found = None
    if dtype is None or found is None or found.kind not in "fc":
        raise TypeError(f"dtype: expected a floating-point type, got {dtype!r}")
    return found


def _checked(model: Model, given: Mapping[str, ArrayLike] | None) -> dict[str, Array]:
    """Return the arguments that are the same for every state, each of one state."""
    if given is None:
        return {}
    check_kind(given, "given", Mapping, "values of arguments by their names")
    for name in given:
        check_known("argument", name, STATE)
    checked = dict(zip(given, check_arrays(model, **given)))
    for name, x in checked.items():
        if x.dtype.kind == "c":
            raise ValueError(f"given[{name!r}]: expected real numbers, got {x.dtype}")
        if x.ndim != (2 if name == "f_ext" else 1):
            raise ValueError(f"given[{name!r}]: expected the values for one state, got shape {x.shape}")
    return checked


def _backend(asked: str | None, dtype: np.dtype[Any]) -> str:
    """Return what runs the program: LLVM where it is there and has the number type, unless something else is asked."""
    if asked is None:
        return default_backend(dtype)
    check_choice(asked, "backend", ("llvm", "numpy"))
    if asked == "llvm" and not available():
        raise ImportError('backend: "llvm" needs llvmlite: pip install "twistwrench[compile]"')
    if asked == "llvm" and dtype not in NATIVE:
        raise TypeError(f'dtype: LLVM has float32 and float64, got {dtype}; backend="numpy" has it')
    return asked
