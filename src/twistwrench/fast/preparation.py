"""Programs made ahead, so that no call of a control loop is the one that compiles."""

from __future__ import annotations

from importlib import import_module
from inspect import Parameter, signature
from typing import Any

import numpy as np
from numpy.typing import DTypeLike

from ..arrays import Array, as_flag
from ..errors import check_known
from ..model import Model, check_model

__all__ = ["prepare"]

MANY = 64  # states that are enough for the machine code of many
CONFIGURATIONS = ("q", "q0", "q1")
VELOCITIES = ("v", "a", "tau", "v_dt")
STATE = CONFIGURATIONS + VELOCITIES
"""Arguments that `prepare` has itself, by the names that they have in all functions."""


def prepare(
    model: Model,
    *names: str,
    dtype: DTypeLike = np.float64,
    batch: bool = True,
    f_ext: bool = False,
    **options: Any,
) -> None:
    """Make the programs of some functions of `twistwrench.fast` ahead: their first call is then as quick as the next.

    Without it the first call of a question makes its program, some tenths of a second.

    Parameters
    ----------
    model : Model
    *names : str
        Names of functions of this module.
    dtype : dtype_like
        The number type of the arrays that they will be called with.
    batch : bool
        Whether they will also be called with many states at once, for which there is machine code of its own.
    f_ext : bool
        Whether they will also be called with wrenches from outside, where they take them.
    **options
        What the functions are asked besides, as in their own calls: ``contacts=``, ``want=``.

    Raises
    ------
    NameNotFound
        If there is no such function; the message lists those that exist.
    TypeError
        If no name is given, if none of the functions takes an option, or if one needs an option that is not given.
    SingularError, ValueError
        As the functions, in the neutral configuration.

    Examples
    --------
    >>> import numpy as np
    >>> import twistwrench as tw
    >>> model = tw.load("cart_pole")
    >>> tw.fast.prepare(model, "rnea", "dynamics", contacts=["pole"])
    >>> tw.fast.rnea(model, np.zeros(2), np.zeros(2), np.ones(2)).round(3)
    array([1.15 , 0.083])
    """
    check_model(model)
    room = import_module(__package__)
    known = [name for name in room.__all__ if name != prepare.__name__]
    if not names:
        raise TypeError(f"names: expected names of functions, got none; there are {', '.join(known)}")
    for name in names:
        check_known("function", name, known)
    taken = {name: signature(getattr(room, name)).parameters for name in names}
    for option in options:
        if not any(option in parameters for parameters in taken.values()):
            raise TypeError(f"{option}: expected an option of {', '.join(names)}")
    with_wrenches = as_flag(f_ext, "f_ext")
    for axes in [(), (MANY,)] if as_flag(batch, "batch") else [()]:
        for name, parameters in taken.items():
            function = getattr(room, name)
            own = {option: x for option, x in options.items() if option in parameters}
            missing = [x for x, p in parameters.items() if p.default is Parameter.empty and x not in {*STATE, *own}]
            if missing != ["model"]:
                raise TypeError(f"{', '.join(missing[1:])}: expected as an option, which {name} needs")
            state = _state(model, axes, np.dtype(dtype))
            asked = {x: state[x] for x in parameters if x in STATE}
            function(model, **asked, **own)
            if with_wrenches and "f_ext" in parameters:
                function(model, **asked, **own, f_ext=np.zeros((*axes, model.nbodies, 6), dtype))


def _state(model: Model, axes: tuple[int, ...], dtype: np.dtype[Any]) -> dict[str, Array]:
    """Return arguments with these leading axes: the neutral configuration, at rest."""
    q, rest = model.neutral().astype(dtype), np.zeros((*axes, model.nv), dtype)
    still = np.broadcast_to(q, (*axes, model.nq)).copy()
    return dict.fromkeys(CONFIGURATIONS, still) | dict.fromkeys(VELOCITIES, rest)
