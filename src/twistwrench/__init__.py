"""Spatial vector algebra and floating-base dynamics, to be read beside the chapter it follows.

Every 6-D quantity is (angular, linear): twists (ω, v), wrenches (τ, f). Arrays in, arrays out, with
any number of leading batch axes; float32, float64, longdouble and their complex twins are kept.

The public names are those of `twistwrench._names`; the sections that hold them are imported when the
first of them is used.

>>> import twistwrench as tw
>>> tw.skew([1, 2, 3])
array([[ 0., -3.,  2.],
       [ 3.,  0., -1.],
       [-2.,  1.,  0.]])
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

# The one eager import: the sub-package has the name of its function, which must be bound after it.
from .robots import load as load
from .robots import robots as robots

__version__ = "0.1.0"

if TYPE_CHECKING:
    from ._names import *
else:

    def __getattr__(name: str) -> Any:
        names = import_module("._names", __name__)
        if name != "__all__" and name not in names.__all__:
            message = f"module {__name__!r} has no attribute {name!r}"
            raise AttributeError(message, name=name, obj=import_module(__name__))  # with both, Python names the nearest
        value = globals()[name] = getattr(names, name)
        return value

    def __dir__() -> list[str]:
        return [*import_module("._names", __name__).__all__, "__version__"]
