"""The stepper of an algorithm's page, and its values on Go2: what each body received and passed on, from `tw.trace`."""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.tracing.printing import html as table_of
from twistwrench.tracing.stepper import stepper

STEPPED = {"forward_kinematics": ("v", "a"), "rnea": ("v", "a"), "aba": ("v", "tau"), "crba": (), "centroidal_map": ()}
"""The algorithms that can be gone through, by the call, and what each takes besides q."""

STEP = {
    "en": "Every line in the order in which it runs, with the numbers that it gives. Turn the base: what is seen from "
    "the bodies' frames changes only where gravity is in it; raise a leg, and the inertias change.",
    "zh": "按运行的顺序列出每一行和它给出的数值。试着转动基座：用刚体坐标系表示的量，只有含重力的才会改变；"
    "抬起一条腿，惯量就变了。",
}
ATTITUDES = {
    ("level", "水平"): (0.0, 0.0, 0.0),
    ("nose up by 30°", "抬头 30°"): (0.0, -np.pi / 6, 0.0),
    ("lying on its left side", "左侧卧"): (-np.pi / 2, 0.0, 0.0),
    ("upside down", "四脚朝天"): (np.pi, 0.0, 0.0),
}
"""How the base of Go2 is turned: a rotation vector, rad."""

RAISED, PENDULUM = ("level, left front leg raised", "水平，抬起左前腿"), ("Double pendulum", "双摆")

CODE = {
    "rnea": 't = tw.trace(model, "rnea", q, v, a)',
    "aba": 'tau = tw.rnea(model, q, v, a)\nt = tw.trace(model, "aba", q, v, tau=tau)',
    "crba": 't = tw.trace(model, "crba", q)',
}
MOTION = """import numpy as np
import twistwrench as tw

model = tw.load("go2")
q = model.standing()
v, a = np.zeros((2, model.nv))
v[2], v[3], a[3] = 0.6, 0.8, 2.0  # {}
v[7:9], a[7:9] = (-5.0, 4.0), (30.0, 90.0)  # {}
"""
COMMENTS = {
    "en": ("turns left at 0.6 rad/s, walks at 0.8 m/s, and speeds up", "the thigh and the calf of its left front leg"),
    "zh": ("以 0.6 rad/s 左转、0.8 m/s 前进，并且正在加速", "左前腿的大腿和小腿"),
}
TITLE = {"en": "The values, on a Go2", "zh": "Go2 上的数值"}
TREE = {
    "en": "A standing Go2 that is about to walk. As a tree, with what each body passes on to its parent:",
    "zh": "一台站立着、正要迈步的 Go2。画成树，写明每个刚体传给父连杆的量：",
}
TABLE = {
    "en": "And as a table, body by body: what it had of its own, what its children passed on to it, the sum, and what "
    "it passed on to its parent (→), in the parent's frame.",
    "zh": "再列成表，逐个刚体：自身的部分，各子连杆传来的部分，两者之和，以及传给父连杆的量（→，用父坐标系表示）。",
}
OPEN = {"en": "All the numbers", "zh": "全部数值"}
CAPTION = {"en": "{} of Go2, (angular, linear)", "zh": "Go2 的 {}，（角，线）"}
CHINESE = {
    ": its own": "：自身",
    "+ from ": "+ 来自 ",
    "→ to ": "→ 传给 ",
    ", diag.": "，对角元素",
    "F in ": "F，坐标系 ",
    ", on ": "，父连杆 ",
}


def step_through(said: dict[str, Any], language: str) -> str:
    """Return the head of a page, in which the reader goes from line to line."""
    page = stepper(dict(_traces(said["call"], language)), language, playing=True)
    return f"```{{raw}} html\n{page}\n```\n\n{STEP[language]}"


def _traces(call: str, language: str) -> Iterator[tuple[str, Any]]:
    """Yield Go2 in each attitude and with a leg raised, and a double pendulum, by the page's names for them."""
    which, names = ("en", "zh").index(language), {}
    exec(MOTION.format(*COMMENTS[language]), names)
    go2, standing, v, a = (names[name] for name in ("model", "q", "v", "a"))
    given = {"v": v, "a": a, "tau": tw.rnea(go2, standing, v, a)}
    raised = standing.copy()
    raised[8:10] += 0.6, -0.5  # the thigh and the calf
    turned = {label[which]: standing.copy() for label in ATTITUDES}
    for q, rotation in zip(turned.values(), ATTITUDES.values()):
        q[3:7] = go2.integrate(standing, [*rotation, *np.zeros(go2.nv - 3)])[3:7]
    for label, q in (turned | {RAISED[which]: raised}).items():
        yield f"Go2, {label}" if language == "en" else f"Go2，{label}", _trace(go2, call, q, given)
    given = {"v": [1.0, -2.0], "a": [0.5, 3.0], "tau": [2.0, -1.0]}
    yield PENDULUM[which], _trace(tw.load("double_pendulum"), call, [0.3, 0.6], given)


def _trace(model: Any, call: str, q: Any, given: dict[str, Any]) -> Any:
    algorithm = "ccrba" if call == "centroidal_map" else call
    return tw.trace(model, algorithm, q, **{name: given[name] for name in STEPPED[call]})


def section(said: dict[str, Any], language: str) -> str:
    """Return the section of an algorithm's page that shows the values; empty where there is no trace of it."""
    if said["call"] not in CODE:
        return ""
    code = MOTION.format(*COMMENTS[language]) + CODE[said["call"]] + "\nprint(t.tree())"
    printed, names = io.StringIO(), {}
    with contextlib.redirect_stdout(printed):
        exec(code, names)
    parts = [f"## {TITLE[language]}", TREE[language], f"```python\n{code}\n```", f"```text\n{printed.getvalue()}```"]
    table = f"<details><summary>{OPEN[language]}</summary>\n{_table(names['t'], language)}\n</details>"
    return "\n\n".join([*parts, TABLE[language], f"```{{raw}} html\n{table}\n```"])


def _table(trace: Any, language: str) -> str:
    """Return a trace's table, in the words of the page, and such that a narrow window scrolls it."""
    html = table_of(trace)
    caption = f"<caption>{CAPTION[language].format(trace.algorithm)}</caption>"
    html = re.sub("<caption>.*?</caption>", caption, html, flags=re.DOTALL)
    for word, own in CHINESE.items() if language == "zh" else ():
        html = html.replace(word, own)
    html = html.replace("<table>", '<table class="table numbers">')
    return f'<div class="pst-scrollable-table-container">{html}</div>'
