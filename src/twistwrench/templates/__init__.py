"""Reduced models of a walking robot: what each leaves out, in numbers (49.10).

===============  ===================================  ===============================================
name             ḣ_G = (k̇_G, l̇_G)                     what it assumes
===============  ===================================  ===============================================
``point_mass``   (0, m p̈_G)                           constant angular momentum
``lipm``         (0, m p̈_G along the ground)          and constant height
``srbm_frozen``  (R (I₀ ω̇ + ω × I₀ ω), m p̈_G)         joints without momentum, constant inertia
``srbm``         (R (I ω̇ + ω × I ω), m p̈_G), I(q)     joints without momentum
``centroidal``   A_G a + Ȧ_G v                        nothing; no torques
``full``         base rows of RNEA                    nothing
===============  ===================================  ===============================================

Each is made from a model and a configuration, predicts ḣ_G of any batch of states (q, v, a), and reports how far that
is from the full model. A template of your own: a class with ``name``, ``assumes``, ``read`` and ``law``, and its line
in `TEMPLATES`.

>>> import numpy as np
>>> import twistwrench as tw
>>> from twistwrench.templates import TEMPLATES
>>> model, rng = tw.load("go2"), np.random.default_rng(0)
>>> v, a = rng.standard_normal((2, 100, model.nv))
>>> for name, template in TEMPLATES.items():
...     residual = template.of(model, model.standing()).residual(model.standing(), v, a)
...     print(f"{name:12} {residual.relative.max():.1e}")
point_mass   6.8e-02
lipm         4.9e-01
srbm_frozen  2.5e-02
srbm         2.5e-02
centroidal   3.1e-16
full         0.0e+00
"""

from .reduced import Centroidal, FrozenRigidBody, Full, LinearPendulum, PointMass, RigidBody
from .template import Residual, Template

__all__ = [
    "TEMPLATES",
    "Centroidal",
    "FrozenRigidBody",
    "Full",
    "LinearPendulum",
    "PointMass",
    "Residual",
    "RigidBody",
    "Template",
]

TEMPLATES: dict[str, type[Template]] = {
    template.name: template for template in (PointMass, LinearPendulum, FrozenRigidBody, RigidBody, Centroidal, Full)
}
"""Every template by its name, from the simplest to the full model."""
