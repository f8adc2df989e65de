"""The chapter as a course: its sections, its exercises, and what is about robots."""

from __future__ import annotations

from misstep.course import Course
from misstep.text import Text

from ..errors import NameNotFound
from .domains import DOMAINS, special_cases
from .field import FIELD
from .forbidden import RULES

__all__ = ["COURSE"]

SECTIONS = {
    "49.0": Text("Before you start", "前置自测"),
    "49.1": Text("Why six dimensions", "为什么需要空间向量"),
    "49.2": Text("Twists", "Twist（空间速度）"),
    "49.3": Text("Change of frame", "Plücker 变换"),
    "49.4": Text("Wrenches", "Wrench（空间力）"),
    "49.5": Text("Spatial inertia", "空间惯量"),
    "49.6": Text("Inverse dynamics: RNEA", "逆动力学：RNEA"),
    "49.7": Text("Forward dynamics: ABA", "正向动力学：ABA"),
    "49.8": Text("Mass matrix: CRBA", "质量矩阵：CRBA"),
    "49.9": Text("The floating base", "浮动基座方程"),
    "49.10": Text("Centroidal momentum", "质心动量"),
    "49.11": Text("Everything at once", "综合实操"),
    "project": Text("The project", "累积项目"),
}

OPENING = Text(
    '''"""{title}.

Replace each `...` by your answer and run `python -m pytest {file}` in this folder. Twists are (ω, v),
wrenches (τ, f), units SI. A function must not change its arguments: work on copies. They may be whole numbers, as
in `np.array([1, 0, 0])`; a robot may have joints of any kind, or none, and links without mass. It may call what the
package has, unless the text rules it out.
`twistwrench exercises hint {first}` gives a hint, and the next one when asked again.

After the exercises of Chapter 49 of the Robotics Tutorial by Pengfei Guo (CC BY 4.0), in other words.
"""

import numpy as np

import twistwrench as tw
from twistwrench.exercises import mine
''',
    '''"""{title}。

把每个 `...` 换成你的答案，然后在本目录运行 `python -m pytest {file}`。twist 为 (ω, v)，wrench 为 (τ, f)，
使用国际单位。函数不得修改传入的参数，请在副本上计算；参数可能是整数，例如 `np.array([1, 0, 0])`；
机器人的关节可以是任何类型，也可以没有关节，可以有质量为零的连杆。
除题目禁止的以外，可以调用本包的函数。
`twistwrench exercises hint {first}` 给出一条提示，再次运行给出下一条。

改写自 Robotics Tutorial 第 49 章的练习，作者 Pengfei Guo(CC BY 4.0)。
"""

import numpy as np

import twistwrench as tw
from twistwrench.exercises import mine
''',
)
"""How a student's file begins."""


def title(section: str) -> Text:
    """Return the title of a section as it stands in the student's file."""
    name = SECTIONS[section]
    if section == "project":
        return Text(f"{name.en} at the end of the chapter", f"章末的{name.zh}")
    return Text(f"Section {section}: {name.en}", f"{section} 节：{name.zh}")


COURSE = Course(
    module=__name__,
    items=f"{__package__}.items",
    sections=SECTIONS,
    field=FIELD,
    domains=DOMAINS,
    model="model",
    special_cases=special_cases,
    rules=RULES,
    alias="tw",
    command="twistwrench exercises",
    call="tw.exercises",
    plugin=f"{__package__}.checking",
    state_file=".twistwrench.json",
    opening=OPENING,
    title_of=title,
    unknown=NameNotFound,
)
