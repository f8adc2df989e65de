"""Put the results of speed.py as tables into README.md and README.zh-CN.md: `python benchmarks/tables.py`."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
PAGES = (HERE / "README.md", HERE / "README.zh-CN.md")

Row = dict[str, str]


def rows(study: str) -> list[Row]:
    """Read the rows of a study; none where it was not run."""
    path = HERE / "results" / f"{study}.csv"
    if not path.exists():
        return []
    with path.open() as file:
        return list(csv.DictReader(file))


def table(cells: Iterable[tuple[str, str, str]]) -> str:
    """Return a table from (line, column, text), in the order in which lines and columns come first."""
    text = {(line, column): cell for line, column, cell in cells}
    lines, columns = (list(dict.fromkeys(key[k] for key in text)) for k in (0, 1))
    head = ["| | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    body = [f"| {line} | " + " | ".join(text.get((line, column), "") for column in columns) + " |" for line in lines]
    return "\n".join(head + body)


def ratio(r: Row) -> str:
    """Return median and quartiles."""
    return f"{number(r['ratio'])} ({number(r['ratio_q1'])} … {number(r['ratio_q3'])})"


def number(text: str) -> str:
    """Return three digits."""
    value = float(text)
    return f"{value:.3g}" if value < 1000 else f"{round(value, -int(np.log10(value)) + 2):.0f}"


def slope(found: list[Row]) -> float:
    """Fit the power of the number of links with which the time grows."""
    if len(found) < 2:
        return float("nan")
    x, y = (np.log([float(r[key]) for r in found]) for key in ("links", "us"))
    return float(np.polyfit(x, y, 1)[0])


def growth(quantity: str, batch: str, first: int, last: int) -> float:
    """Return the slope between two numbers of links."""
    found = [r for r in rows("links") if (r["way"], r["quantity"], r["batch"]) == ("fast", quantity, batch)]
    return slope([r for r in found if first <= int(r["links"]) <= last])


RANGES = {"program, 20 to 80 links": (20, 80), "textbook, 100 to 1000 links": (100, 1000)}
"""Between which numbers of links the growth is fitted: `tw.fast` is a program there, or the textbook."""


def tables() -> dict[str, str]:
    """Return all tables by name."""
    batches = [r for r in rows("batch") if int(r["batch"]) >= 100]
    return {
        "one": table((r["quantity"], f"`{WAYS[r['way']]}`", f"{number(r['us'])} µs, {ratio(r)}") for r in rows("one")),
        "batch": table((r["quantity"], f"{r['dtype']}, {int(r['batch']):,}", ratio(r)) for r in batches),
        "registers": table((r["quantity"], f"{r['bits']} bits", ratio(r)) for r in rows("registers")),
        "links": table(
            (q, f"{name}, batch {b}", f"{growth(q, b, *ends):.2f}")
            for q in ("rnea", "aba", "A_G")
            for name, ends in RANGES.items()
            for b in ("1", "100")
        ),
        "calls": calls(),
        "peers": table((peer(r), f"{int(r['batch']):,}", ratio(r)) for r in rows("peers")),
    }


def calls() -> str:
    """Return the ways to call, one a line: … stands for what a line above it has."""
    lines = ["| how it is called | a state | × | Pinocchio | ours / its |", "|---|---|---|---|---|"]
    for r in rows("calls"):
        theirs = f"{number(r['us_pin'])} µs | {number(r['ratio_pin'])}" if r["us_pin"] else "|"
        lines.append(f"| {r['how']} | {number(r['us'])} µs | {number(r['ratio'])} | {theirs} |")
    return "\n".join(lines)


def peer(r: Row) -> str:
    """Return the name of a line: with a date if it was not measured in the last run."""
    newest = max(other["date"] for other in rows("peers"))
    return f"{r['way']}, {r['quantity']}" + f" ({r['date']})" * (r["date"] != newest)


WAYS = {"fast": "tw.fast", "textbook": "tw"}


CHINESE = {
    "how it is called": "怎样调用",
    "a state": "每个状态",
    "ours / its": "本包 / Pinocchio",
    "a tuple": "元组",
    "a list": "列表",
    "a set": "集合",
    "left out": "不给",
    "three arrays": "三个数组",
    "by name": "按名称",
    "one batch axis, of length 1": "一个长度为 1 的批量维",
    "every second entry of an array": "数组中隔一项取一项",
    "lists": "列表",
    "the textbook": "教科书写法",
    "in a loop": "逐个循环",
    "in the air": "悬空",
    "state in a call": "个状态一次调用",
    "states in a call": "个状态一次调用",
    "all feet": "所有的脚",
    "joints in a chain, a joint": "个关节的链，每个关节",
    "an arm": "机械臂",
    "compiled": "编译",
    "machine code on disk": "机器码已在磁盘上",
    "function": "函数",
    "number type": "数值类型",
    "in a call": "一次调用",
    "error": "误差",
    "time": "时间",
    "state": "个状态",
    "states": "个状态",
    "digits": "位",
    "after 1 s": "（1 s 后）",
    "links": "个连杆",
    "power": "幂次",
    "bits": "位",
    "batch": "批量",
    "program": "程序",
    "textbook": "教科书写法",
    "fast": "`tw.fast`",
    "pinocchio": "Pinocchio",
    "moment of ḣ_G": "ḣ_G 的力矩",
    "20 to 80": "20 到 80",
    "100 to 1000": "100 到 1000",
    "answers asked for": "所求的答案",
    "raised an error": "报错",
    "a NaN, an infinity, a warning, a number where none is right": "NaN、无穷、警告，或没有正确答案却给出了数字",
    "error above 2 × Pinocchio's + 4 ε": "误差大于 2 × Pinocchio 的误差 + 4 ε",
    "Pinocchio's above 2 × this + 4 ε": "Pinocchio 的误差大于 2 × 本包的误差 + 4 ε",
    "less than a tenth of Pinocchio's": "误差不到 Pinocchio 的十分之一",
    "above 2 ×": "大于 2 ×",
    "below ½ ×": "小于 ½ ×",
    "median": "中位数",
    "cells, median": "各格的中位数",
    "cells, largest": "各格的最大值",
    "centroidal map": "质心映射",
    "steered": "按给定运动",
    "pushed": "任意力矩",
    "all rules": "全部规则",
    "no fingerprints": "不用指纹",
    "0 and 1 kept": "保留 0 和 1",
    "nothing shared": "不共用",
    "signs kept": "保留符号",
    "no zero in S": "S 中没有零",
    "no zero in X": "X 中没有零",
    "no zero in I": "I 中没有零",
    "whole robot": "整个机器人",
    "some joints held": "锁住部分关节",
    "no gravity": "没有重力",
    "fixed base": "固定基座",
    "trot": "小跑",
    "walk": "步行",
    "new states below the promise": "不超过承诺的新状态",
    "proved": "经证明",
    "chain of 12": "12 节链",
    "differences of 1 ms": "差分，1 ms",
    "differences of 10 ms": "差分，10 ms",
    "Euler, 1 ms": "显式欧拉法，1 ms",
    "semi-implicit Euler, 1 ms": "半隐式欧拉法，1 ms",
    "g = 9.8 for 9.81": "g 取 9.8 而不是 9.81",
    "trunk 5 % heavier": "躯干重 5 %",
    "joints that move least, held": "锁住动得最少的关节",
    "rigid body, massless legs": "单刚体，腿无质量",
    "pendulum, massless legs": "倒立摆，腿无质量",
    "base pitched by 1°": "基座俯仰 1°",
    "base (v, ω) for (ω, v)": "基座的 (ω, v) 写成 (v, ω)",
    "base velocity in the world's axes": "基座速度取在世界坐标轴中",
}
"""Heads and names of lines, for the pages in Chinese. What is quoted as code stays."""
_PHRASES = "|".join(map(re.escape, sorted(CHINESE, key=len, reverse=True)))
_SPOKEN = re.compile(rf"`[^`]*`|(?<![A-Za-z])({_PHRASES})(?![A-Za-z])")
_HAN = r"[\u4e00-\u9fff]"


def in_chinese(made: str) -> str:
    """Return a table with Chinese heads and names of lines."""
    said = _SPOKEN.sub(lambda found: CHINESE[found[1]] if found[1] else found[0], made)
    said = re.sub(rf"(?<={_HAN}), |, (?={_HAN})", "，", said)
    return re.sub(rf"(?<={_HAN}): ", "：", said).replace(" （", "（")


def fill(page: str, made: Mapping[str, str]) -> str:
    """Return a page with these tables made anew, each after a line ``<!-- table: NAME -->``; in the page's language."""
    speak = in_chinese if re.match(rf"# .*{_HAN}", page) else str

    def anew(found: re.Match[str]) -> str:
        return f"{found[1]}{speak(made[found[2]])}\n" if found[2] in made else found[0]

    return re.sub(r"(<!-- table: (\w+) -->\n)(\|.*\n)*", anew, page)


def write(pages: Iterable[Path], made: Mapping[str, str]) -> None:
    """Write pages with their tables made anew."""
    for page in pages:
        page.write_text(fill(page.read_text(encoding="utf-8"), made), encoding="utf-8")


def write_each(pages: Mapping[str, Path], made: Callable[[str], Mapping[str, str]]) -> None:
    """Write pages with the tables of their languages, where these are made one by one."""
    for language, page in pages.items():
        write([page], made(language))


if __name__ == "__main__":
    write(PAGES, tables())
