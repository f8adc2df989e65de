"""Spatial vector algebra and floating-base dynamics, to be read beside the chapter it follows.

Every 6-D quantity is (angular, linear): twists (ω, v), wrenches (τ, f). Arrays in, arrays out, with
any number of leading batch axes; float32, float64, longdouble and their complex twins are kept.

The public names are listed in `__init__.pyi`; the file that holds a name is imported when the name is first used.

>>> import twistwrench as tw
>>> tw.skew([1, 2, 3])
array([[ 0., -3.,  2.],
       [ 3.,  0., -1.],
       [-2.,  1.,  0.]])
"""

from importlib import import_module
from typing import Any

import lazy_loader

__version__ = "1.0.0"

_ROOMS = ("contact", "loading", "model", "scene", "simulation", "validate")
"""Namespaces that need no import of their own, beside those in `__all__`; most of their names are here as well."""

_load, _, _names = lazy_loader.attach_stub(__name__, __file__)
__all__ = [name for name in _names if name not in _ROOMS]


def __getattr__(name: str) -> Any:
    if name in _names:
        return _load(name)
    message = f"module {__name__!r} has no attribute {name!r}"
    raise AttributeError(message, name=name, obj=import_module(__name__))  # with both, Python names the nearest


def __dir__() -> list[str]:
    return [*_names, "__version__"]
