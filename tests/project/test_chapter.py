"""docs/chapter: the listing runs, and the ten patches apply to a Markdown source; with a copy of the chapter, to that.

`CHAPTER_49=chapter.md python -m pytest tests/project/test_chapter.py` names a copy; none belongs to this repository.
"""

import os
import re
import runpy
import shutil
import subprocess
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.model.tree import tree_terms

from ..pages import DOCS
from ..robots import shared
from .test_errata import CHINESE, ENGLISH, ENTRIES

CHAPTER = DOCS / "chapter"
LISTING = {
    11: "pin.neutral()",
    13: "SE3.action",
    22: "Inertia.matrix()",
    23: "body 0",
    35: "crba",
    43: "randomConfiguration",
    52: "`h_G[3:]`",
    53: "`J_full[3:, :]`",
    54: "getFrameJacobian",
    55: "rnea",
    58: "Static equilibrium",
}
"""The entries that the comments of the listing name."""


def test_the_mended_listing_passes_its_tests(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the listing is written for it")
    monkeypatch.setattr("sys.argv", ["listing_49_11.py"])
    runpy.run_path(str(CHAPTER / "listing_49_11.py"), run_name="__main__")
    assert re.search(r"7 rank of J_c +12", capsys.readouterr().out)


def test_the_listing_names_the_entries_that_it_mends() -> None:
    numbers = re.findall(r"# .*\[(\d+)\]$", (CHAPTER / "listing_49_11.py").read_text(encoding="utf-8"), re.MULTILINE)
    assert {int(k) for k in numbers} == set(LISTING)
    assert [k for k, words in LISTING.items() if words not in ENTRIES[k - 1].title] == []


# ---------------------------------------------------------------- the patches


@pytest.fixture(scope="module")
def own() -> dict[str, Any]:
    return runpy.run_path(str(CHAPTER / "mend.py"), run_name="mend")


def test_every_entry_has_a_correction_and_stands_in_one_of_ten_patches(own: dict[str, Any]) -> None:
    named = {correction.entry for correction in own["corrections"]()}
    assert named == {entry.title for entry in ENTRIES}
    assert sorted(title for patch in own["patches"]() for title in patch.entries) == sorted(named)
    assert len(own["patches"]()) == 10
    for path in (ENGLISH, CHINESE):
        assert re.search(rf"{len(own['corrections']())} (passages|处)", path.read_text(encoding="utf-8"))


MARKDOWN = r"""
每个连杆的 body twist
存储在 `data.v[i]` 中:

> 上面代码中 `J[3:, :]` 取的是
> 角速度行——对于点接触应改用 `J[:3, :]`。

> 要求:pip install pinocchio numpy
> matplotlib

其中 ${}^G\hat{I}_i$ 是连杆 $i$ 的空间惯量变换到**质心坐标系**后的结果,$J_i$ 是连杆 $i$ 的 body Jacobian。

```python
for link_id in [1, 3, 5]:
    I_manual[:3, :3] = Ic - m_link * cx @ cx
    I_manual[:3, 3:] = m_link * cx
    I_manual[3:, :3] = -m_link * cx
    I_manual[3:, 3:] = m_link * np.eye(3)
    I_pin = inertia.matrix()
```

    for i = 1 to N:
        IC[i] = I_hat[i]
"""
"""A line of each kind that a Markdown source may have: code, bold, formulas, quotes, line ends, indentation."""

MENDED = r"""
每个关节所带刚体的 body twist 存储在 `data.v[i]` 中(data.v[0] 是 universe,data.v[1] 是基座):

> 若写成`J[3:, :]`,取到的是角速度行;上面的代码正确地用 `J[:3, :]`。

> 要求:pip install pin numpy matplotlib
> (装过 pinocchio 这个包的,先 pip uninstall pinocchio)

其中 ${}^G\hat{I}_i$ 是连杆 $i$ 的空间惯量变换到质心坐标系后的结果,$J_i$ 也必须变换到质心坐标系。

```python
for link_id in [1, 3, 5]:
    I_manual[:3, :3] = m_link * np.eye(3) # Pinocchio 的顺序 (v, ω)
    I_manual[:3, 3:] = -m_link * cx
    I_manual[3:, :3] = m_link * cx
    I_manual[3:, 3:] = Ic - m_link * cx @ cx
    I_pin = inertia.matrix()
```

    for i = 1 to N:
        X[i] = X_J(q[i]) * X_tree[i]
        IC[i] = I_hat[i]
"""


def test_a_markdown_source_is_mended_with_its_marks_and_its_indentation(own: dict[str, Any]) -> None:
    assert own["mend"](MARKDOWN, own["corrections"]())[0] == MENDED


CODE_LINE = r"#|[\w\[\], :.()+*-]+ (=|\+=|@) |return |while |print\(|assert |pin\.rnea"
CALL = r"(?<![\w$\\{.`])((?:pin|data|model|np|v|q)\.[\w.]+(?:\[\w\]|<\d>\(\)\.norm\(\))?)"


def as_markdown(passage: str) -> str:
    """A passage as a source may have it: indented code, or a paragraph with `$`, backticks, bold and a line end."""
    if re.match(CODE_LINE, passage):
        return textwrap.indent(passage, "        ")
    text = re.sub(CALL, r"`\1`", re.sub(r"\\[()]", "$", passage))
    text = re.sub(r"^([\u4e00-\u9fff]{2})(?=[\u4e00-\u9fff])", r"**\1**", text)
    return text if "|" in text else re.sub(r"(?<=[\u4e00-\u9fff])(?=[A-Z$`])", "\n  ", text, count=1)


def bare(text: str) -> str:
    """A text without the marks in which a Markdown source and the text of a page differ."""
    return re.sub(r"\\[()]|\s|[`$]|\*\*", "", text)


def test_every_passage_is_found_in_a_markdown_source(own: dict[str, Any]) -> None:
    passages = {c.find: c for c in own["corrections"]()}  # a chapter that consists of the passages alone
    source = "\n\n".join(as_markdown(find) for find, c in passages.items() for _ in range(c.times))
    counts = {mark: source.count(mark) for mark in ("$", "`", "**", "\n        ", "\n  ")}
    assert min(counts.values()) > 10, counts
    assert sum(passage not in source for passage in passages) > 80  # not as it stands in corrections.toml
    new, missed = own["mend"](source, own["corrections"]())
    assert [correction.find for correction in missed] == []
    assert [c.replace for c in own["corrections"]() if bare(c.replace) not in bare(new)] == []
    assert [new.count(mark) % 2 for mark in "`$"] == [source.count(mark) % 2 for mark in "`$"]
    assert r"\(" not in new


def test_the_patches_are_made_in_order_and_what_is_not_found_is_reported(
    own: dict[str, Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    chapter = tmp_path / "chapter.md"
    chapter.write_text(MARKDOWN, encoding="utf-8")
    assert own["main"]([str(chapter), str(tmp_path / "patches")]) == 1
    missed = capsys.readouterr().err.splitlines()
    assert len(missed) == len(own["corrections"]()) - 6
    made = sorted((tmp_path / "patches").iterdir())
    assert [path.stem for path in made] == [f"{k:02}-{patch.name}" for k, patch in enumerate(own["patches"](), 1)]
    lines = [path.read_text(encoding="utf-8").splitlines() for path in made]
    assert [text[0] for text in lines] == [patch.title for patch in own["patches"]()]
    assert "+        X[i] = X_J(q[i]) * X_tree[i]" in lines[2]  # ABA and CRBA
    assert "+    I_manual[3:, 3:] = Ic - m_link * cx @ cx" in lines[3]  # the order (v, ω)


@pytest.mark.parametrize(
    ("end", "between"), [("\n", ""), ("\r\n", ""), ("\n", "\x0c\u2028")], ids=["unix", "windows", "page"]
)
def test_the_patches_apply_to_a_chapter_with_any_line_ends(
    own: dict[str, Any], tmp_path: Path, end: str, between: str
) -> None:
    patch = shutil.which("patch")
    if patch is None:
        pytest.skip("patch is not installed: the patches are not applied")
    chapter, source = tmp_path / "chapter.md", MARKDOWN.replace("\n\n", f"{between}\n\n").replace("\n", end)
    chapter.write_bytes(source.encode())
    own["main"]([str(chapter), str(tmp_path / "patches")])
    for made in sorted((tmp_path / "patches").iterdir()):
        if "@@" in made.read_text(encoding="utf-8"):
            subprocess.run([patch, str(chapter), str(made)], check=True, capture_output=True)
    assert chapter.read_bytes().decode() == MENDED.replace("\n\n", f"{between}\n\n").replace("\n", end)


# ---------------------------------------------------------------- with a copy of the chapter


@pytest.fixture(scope="module")
def mended_chapter(own: dict[str, Any]) -> str:
    """The chapter with all corrections."""
    if "CHAPTER_49" not in os.environ:
        pytest.skip("CHAPTER_49 does not name a copy of the chapter: its pseudocode is not run")
    chapter = Path(os.environ["CHAPTER_49"]).read_text(encoding="utf-8")
    new, missed = own["mend"](chapter, own["corrections"]())
    assert missed == []
    return str(new)


def pseudocode(chapter: str, name: str) -> str:
    """Return an algorithm of the chapter as Python, for a floating base, with a column for each vector."""
    found = re.search(rf"Algorithm: {name}\(.*?\n( *)return \w+", chapter, re.DOTALL)
    assert found
    indented, depth, lines = re.search(r"^ +\w", found[0], re.MULTILINE), 0, []
    for raw in found[0].splitlines()[:-1]:
        if re.search("Algorithm:|──|Input:|Output:", raw):
            continue
        if re.match(r"# Pass|# Backward|a\[0\]|M\[0, 0\]", raw):
            depth = 0  # the text of a page has lost the indentation
        line = re.sub(r"= .* 或 (.+) \(浮动基座\)", r"= \1", raw).replace(
            "a[0] = -g (", "a[0] = a_base - g_spatial # ("
        )
        line = (
            re.sub(r"#.*", "", line).replace("1 to N:", "range(1, N + 1):").replace("N downto 1:", "range(N, 0, -1):")
        )
        line = re.sub(r"\bi = range", "i in range", line)
        line = re.sub(
            r"(\w+\[\w\]) ×(\*?) ", lambda cross: f"cross{cross[2]}({cross[1]}) @ ".replace("*", "_force"), line
        )
        if line.strip():
            lines.append(line.rstrip() if indented else "    " * depth + line.strip())
            depth += line.rstrip().endswith(":")
    return textwrap.dedent("\n".join(lines)).replace("^T", ".T").replace(" * ", " @ ")


@pytest.mark.parametrize("name", ["RNEA", "ABA", "CRBA"])
def test_the_mended_pseudocode_is_right_for_a_floating_base(mended_chapter: str, name: str) -> None:
    go2, rng = shared("go2"), np.random.default_rng(49)
    q, (v, a) = go2.random_configuration(rng=rng), rng.standard_normal((2, go2.nv))
    tree, f_ext = tree_terms(go2, q), np.concatenate([np.zeros((1, 6)), rng.standard_normal((13, 6))])
    tau = np.concatenate([np.zeros(6), rng.standard_normal(12)])
    columns = [[None, *np.reshape(x[6:], (12, 1, 1))] for x in (v, a, tau)]
    names: dict[str, Any] = {
        "N": 12,  # their link i is our body i + 1: link 0 is the base
        "parent": [k - 1 for k in tree.parent[1:]],
        "X_tree": tree.X[1:],
        "X_J": lambda _: np.eye(6),
        "S": [np.eye(6), *tree.S[2:]],
        "I_hat": np.array(tree.I[1:]),
        "F_ext": f_ext[1:, :, None],
        "q": range(13),
        "V_base": v[:6, None],
        "a_base": a[:6, None],
        "g_spatial": np.r_[0, 0, 0, tw.forward_kinematics(go2, q).placement[1].rotation.T @ go2.gravity][:, None],
        "solve": np.linalg.solve,
        "cross": lambda V: tw.cross_motion(V[:, 0]),
        "cross_force": lambda V: tw.cross_force(V[:, 0]),
        "M": {},
    }
    names |= {key: [np.zeros((6, 1))] * 13 for key in ("V", "a", "c", "pA", "F", "U", "D", "u", "X", "IA", "IC")}
    names |= dict(zip(("q_dot", "q_ddot", "tau"), columns, strict=True))
    exec(pseudocode(mended_chapter, name), names)
    if name == "CRBA":
        wanted, found = tw.crba(go2, q), np.zeros((18, 18))
        place = [slice(0, 6), *(slice(k, k + 1) for k in range(6, 18))]
        for (i, j), block in names["M"].items():
            found[place[i], place[j]] = block
    else:
        wanted = tw.rnea(go2, q, v, a, f_ext) if name == "RNEA" else tw.aba(go2, q, v, tau, f_ext)
        base = names["F"][0] if name == "RNEA" else names["a"][0] + names["g_spatial"]
        joints = names["tau" if name == "RNEA" else "q_ddot"][1:]
        found = np.concatenate([base[:, 0], [x.item() for x in joints]])
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-11 * np.abs(wanted).max())


FIRST = re.compile(r'import pinocchio as pin$|"""$|# Pinocchio 中查看 Plucker 变换|twist = data\.v')
AFTER = re.compile(r"练习|⚠|RNEA 的计算|质量矩阵的结构|代码-数学对应|CMM 与简化|验证|本章|Pinocchio 的")


def listings(chapter: str) -> list[str]:
    """Return the listings of the chapter in Python, from its fences or from the text of a page without indentation."""
    fenced = re.findall(r"^```python\n(.*?)^```", chapter, re.DOTALL | re.MULTILINE)
    found: list[list[str]] = []
    inside = in_loop = False
    for line in [] if fenced else chapter.splitlines():
        if not inside and FIRST.match(line):
            inside, in_loop = True, False
            found.append([])
        elif inside and AFTER.match(line):
            inside = False
        if inside:
            if re.match(r"# ===|t_\w+ = ", line) or (line.startswith("print(") and "J_c[" in found[-1][-1]):
                in_loop = False
            found[-1].append("    " * in_loop + line)
            in_loop |= line.startswith("for ") and line.endswith(":")
    return fenced or ["\n".join(lines) for lines in found]


def test_the_mended_listings_run(mended_chapter: str, capsys: pytest.CaptureFixture[str]) -> None:
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the listings are written for it")
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: a listing draws").use("Agg")
    urdf = next(str(robot.path) for robot in tw.robots() if robot.name == "go2")
    names: dict[str, Any] = {"pin": pin, "np": np}
    for listing in listings(mended_chapter):
        exec(listing.replace('"go2.urdf"', repr(urdf)), names)
    printed = capsys.readouterr().out
    errors = [float(x) for x in re.findall(r"error(?::| =) ([\d.e+-]+)", printed)]
    assert len(errors) == 13
    assert max(errors) < 1e-10
    assert re.findall(r"rank: (\d+)|definite: (\w+)", printed) == [("", "True"), ("12", "")]
