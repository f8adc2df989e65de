"""What a page is looked for by, where its title does not say so: `errata` finds "Where the chapter is wrong" first.

Sphinx's search knows entries of an index, and counts one that is the whole query above every title. Here they are.
"""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms import SphinxTransform

__all__ = ["KEYWORDS", "Keywords"]

KEYWORDS = {
    "errata": ("errata", "erratum", "corrections", "勘误", "勘误表", "更正"),
    "chapter/exercises": ("exercises", "练习", "习题"),
    "chapter/49_02_twist": ("twist", "exponential map", "指数映射"),
    "chapter/49_03_pluecker": ("adjoint", "plucker", "plücker transform", "伴随", "plücker 变换"),
    "chapter/49_04_wrench": ("wrench", "x*", "force transform", "力变换矩阵"),
    "chapter/49_05_inertia": ("spatial inertia", "空间惯量"),
    "chapter/49_06_rnea": ("rnea", "inverse dynamics", "newton-euler", "逆动力学"),
    "chapter/49_07_aba": ("aba", "forward dynamics", "articulated-body inertia", "正向动力学", "铰接体惯量"),
    "chapter/49_08_crba": (
        "crba",
        "mass matrix",
        "inertia matrix",
        "composite-rigid-body inertia",
        "质量矩阵",
        "复合刚体惯量",
    ),
    "chapter/49_09_floating_base": ("floating base", "浮动基座"),
    "chapter/49_10_centroidal": ("centroidal momentum", "centre of mass", "center of mass", "质心动量", "质心"),
    "api/algorithms/kinematics": ("jacobian", "frame jacobian", "jacobian frame", "雅可比", "雅可比矩阵"),
    "conventions": ("conventions", "notation", "约定", "记号"),
    "traps": (
        "questions",
        "faq",
        "external force",
        "fext",
        "f_ext",
        "local_world_aligned",
        "quaternion order",
        "free-flyer",
        "armature",
        "damping",
        "contact force",
        "常见问题",
        "外力",
        "四元数",
        "转子惯量",
        "阻尼",
        "接触力",
    ),
    "glossary": ("glossary", "词汇表", "术语"),
    "hands/translate": ("convert", "conversion", "换算", "转换"),
    "hands/field": ("screw", "screw axis", "螺旋", "螺旋轴", "螺距"),
    "hands/feet": ("friction cone", "support polygon", "摩擦锥", "支撑多边形"),
}
"""By the page's name, in small letters and in both languages: a Chinese page is looked for in English, too."""


class Keywords(SphinxTransform):
    """Add to a page the entries of the index that it is looked for by."""

    default_priority = 800  # before the index is collected

    def apply(self, **given: Any) -> None:
        """Put them behind the first heading, to which they lead."""
        words = KEYWORDS.get(self.env.docname, ())
        first = next(self.document.findall(nodes.section), None)
        if words and first is not None:
            entries = [("single", word, first["ids"][0], "main", None) for word in words]
            first.insert(1, addnodes.index(entries=entries))
