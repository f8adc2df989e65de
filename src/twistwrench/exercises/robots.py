"""The robots of the exercises, each loaded once."""

from functools import cache

from ..model import Model
from ..robots import load

__all__ = ["robot"]


@cache
def robot(name: str) -> Model:
    """Return a robot of the catalogue.

    Examples
    --------
    >>> robot("go2").nv
    18
    """
    return load(name)
