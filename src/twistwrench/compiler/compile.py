"""`compile`: a program for a robot and a question."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike, DTypeLike

from ..algorithms.kinematics import Reference
from ..arrays import as_count, as_names
from ..model import Model, check_model
from .llvm import NATIVE, available
from .program import Program
from .quantities import chosen, quantities

__all__ = ["compile"]


def compile(
    model: Model,
    want: str | Iterable[str],
    *,
    dtype: DTypeLike = np.float64,
    contacts: Iterable[str] | None = None,
    frames: Iterable[str] = (),
    reference: Reference = "local",
    given: Mapping[str, ArrayLike] | None = None,
    backend: str | None = None,
    threads: int = 1,
) -> Program:
    """Return a program for this model and this question, and nothing else in it.

    Parameters
    ----------
    model : Model
    want : str or iterable of str
        Functions or symbols of `quantities.SYMBOLS`: of one name the program returns an array, of several `Results`,
        which share their work.
    dtype : dtype_like
        float32 and float64 have machine code; every floating-point type has NumPy.
    contacts : iterable of str, optional
        The frames of J_c; `model.feet` unless given.
    frames : iterable of str
        The frames of placements, Jacobians and J̇ v: an axis before their own.
    reference : {"local", "world", "local_world_aligned"}
        Of Jacobians and J̇ v: see `twistwrench.frame_jacobian`.
    given : mapping of str to array_like
        Arguments with the same value for every state, which need not be computed with: ``{"v": np.zeros(nv)}``.
    backend : {"llvm", "numpy"}, optional
        LLVM where it is installed and has the number type, unless given.
    threads : int
        Into how many parts a batch is divided.

    Returns
    -------
    Program

    Raises
    ------
    NameNotFound
        If there is no such quantity or frame.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> program = compile(model, "gravity")
    >>> program.arguments, program(model.standing())[5].round(3)
    (('q',), np.float64(157.794))
    """
    check_model(model)
    dtype = np.dtype(dtype)
    contacts = as_names(model.feet if contacts is None else contacts, "contacts", "frame names", ordered=True)
    frames = as_names(frames, "frames", "frame names", ordered=True)
    single = isinstance(want, str)
    names = (want,) if isinstance(want, str) else as_names(want, "want", "quantities")
    if backend is None:
        backend = "llvm" if dtype in NATIVE and available() else "numpy"
    values = {name: np.asarray(x) for name, x in (given or {}).items()}
    known = quantities(model, dtype, contacts, frames, reference)
    return Program(model, chosen(known, names), single, values, dtype, backend, as_count(threads, "threads", 1))
