"""The values of a step-through on Go2: what each body received and passed on, from `tw.trace`."""

from __future__ import annotations

import contextlib
import io
import re
from typing import Any

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
    "zh": "一台站立着、正要迈步的 Go2。画成树，写明每个刚体传给父刚体的量：",
}
TABLE = {
    "en": "And as a table, body by body: what it had of its own, what its children passed on to it, the sum, and what "
    "it passed on to its parent (→), in the parent's frame.",
    "zh": "再列成表，逐个刚体：自身的部分，各子刚体传来的部分，两者之和，以及传给父刚体的量（→，用父坐标系表示）。",
}
OPEN = {"en": "All the numbers", "zh": "全部数值"}
CAPTION = {"en": "{} of Go2, (angular, linear)", "zh": "Go2 的 {}，（角，线）"}
CHINESE = {
    ": its own": "：自身",
    "+ from ": "+ 来自 ",
    "→ to ": "→ 传给 ",
    ", diag.": "，对角元素",
    "F in ": "F，坐标系 ",
    ", on ": "，父刚体 ",
}


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
    html = trace._repr_html_()
    caption = f"<caption>{CAPTION[language].format(trace.algorithm)}</caption>"
    html = re.sub("<caption>.*?</caption>", caption, html, flags=re.DOTALL)
    for word, own in CHINESE.items() if language == "zh" else ():
        html = html.replace(word, own)
    html = html.replace("<table>", '<table class="table numbers">')
    return f'<div class="pst-scrollable-table-container">{html}</div>'
