"""What the texts of the exercises rule out."""

from misstep.rules import Rules

__all__ = ["FORBIDDEN", "RULES"]

M = (
    *("crba", "crba_terms", "mass_matrix", "dynamics", "inverse_mass_matrix", "solve_mass_matrix"),
    *("ltl", "ltdl", "operational_space_inertia"),
)
A_G = ("centroidal_map", "centroidal_momentum", "centroidal_terms", "dynamics")
RNEA = ("rnea", "rnea_terms", "inverse_dynamics")

TRANSFORMS = ("motion_transform", "force_transform", "SE3")

FORBIDDEN: dict[str, tuple[str, ...]] = {
    "skew": ("skew",),
    "adjoint": TRANSFORMS,
    "twist_matrix": ("hat",),
    "arc": ("exp6",),
    "translation_transforms": TRANSFORMS,
    "rotation_transform": TRANSFORMS,
    "plucker": TRANSFORMS,
    "spatial_inertia": ("SpatialInertia",),
    "link_inertia": ("SpatialInertia",),
    "base_inertia": ("SpatialInertia",),
    "base_wrench_at_rest": (*RNEA, "gravity", "nonlinear_effects", "dynamics"),
    "mass_matrix_by_rnea": (*M, "kinetic_energy"),
    "base_block": (*M, *RNEA),
    "center_of_pressure": ("center_of_pressure",),
    "selection": ("selection_matrix",),
    "on_all_rows": ("selection_matrix",),
    "momentum_of_links": A_G,
    "own_centroidal_map": A_G,
    "transforms_of": TRANSFORMS,
    "cross_operators": ("cross_motion", "cross_force"),
    "map_from_pinocchio": ("from_pinocchio_model", *A_G),
    "jacobian_from_pinocchio": ("from_pinocchio_model", "frame_jacobian", "dynamics"),
    "acceleration_from_pinocchio": ("from_pinocchio_model", "aba", "aba_terms", "crba", *RNEA, "dynamics"),
}
"""What the text of an exercise forbids, by the function that the student writes: names of the package."""

ROOMS = ("twistwrench", "twistwrench.fast", "twistwrench.bridge", "twistwrench.newton_euler_3d")
"""Where these names are looked up."""

SYMBOLS = {"crba": "M", "rnea": "tau", "aba": "qdd", "centroidal_map": "A_G", "gravity": "g", "nonlinear_effects": "h"}
"""What some of them compute, as `tw.compile` names it."""

COMPUTED = {"about_center_of_mass": 1}
"""Which argument a result is computed from, though its value does not depend on it, by the name of the function."""

RULES = Rules(
    "twistwrench", "tw", ROOMS, FORBIDDEN, SYMBOLS, COMPUTED, (f"{__package__}.items.", f"{__package__}.chapter")
)
