"""The README runs, prints what its comments say, and is the same in both languages; the table of files is complete."""

import contextlib
import io
import re
import runpy
from pathlib import Path

import pytest

import twistwrench as tw
from twistwrench import algorithms, spatial

from .test_companion import headings
from .test_house import ORDER, section

ROOT = Path(__file__).parents[2]
ENGLISH, CHINESE = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "README.zh-CN.md"))
LANGUAGES = ("", ".zh-CN")
FILES, CHINESE_FILES = ((ROOT / f"docs/contributing{x}.md").read_text(encoding="utf-8") for x in LANGUAGES)


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


SITE = [ROOT / "docs/website/text" / name for name in ("index.md", "index.zh-CN.md")]
FIGURE = r"(?<![\w.])\d+(?:\.\d+)?(?:e-\d+)?(?![\w.])"


@pytest.mark.parametrize("page", [ROOT / "README.md", ROOT / "README.zh-CN.md", *SITE], ids=lambda page: page.name)
def test_every_number_in_a_comment_is_what_its_line_prints(page):
    (code,) = blocks(page.read_text(encoding="utf-8"), "python")
    printed, names = io.StringIO(), {}
    with contextlib.redirect_stdout(printed):
        exec(code, names)
    lines, checked = iter(printed.getvalue().splitlines()), 0
    for line in code.splitlines():
        call, _, comment = line.partition("#")
        claims = [float(x) for x in re.findall(FIGURE, re.sub(r"49\.\d+[:：]", "", comment))]
        if not call.startswith("print"):
            assert claims in ([], [12])  # the joints of Go2
            assert names["model"].nv - 6 == 12
            continue
        found = [abs(float(x)) for x in re.findall(r"\d[\d.]*(?:e-\d+)?", next(lines))]
        assert len(found) == len(claims), line
        for one, claim in zip(found, claims, strict=True):
            assert one < claim if claim < 1e-9 else one == pytest.approx(claim, abs=0.05), line
            checked += 1
    assert next(lines, None) is None
    assert checked == (4 if page in SITE else 9)


def test_the_fifteen_lines_are_fifteen():
    (code,) = blocks(ENGLISH, "python")
    assert sum(bool(line.strip()) for line in code.splitlines()) == 15


def test_both_languages_hold_the_same_commands_and_code():
    assert blocks(ENGLISH, "sh") == blocks(CHINESE, "sh")
    assert len(blocks(ENGLISH, "sh")) >= 2
    code, twin = ([re.sub(r" *#.*", "", block) for block in blocks(text, "python")] for text in (ENGLISH, CHINESE))
    assert code == twin


def rows(text):
    table = re.findall(r"^\| (?:49\.\d+)? ?\|(.*)\|(.*)\|.*\|$", text, re.MULTILINE)
    return [(re.findall(r"`([\w./]+)`", files), re.findall(r"`(\w+)`", names)) for files, names in table]


def test_the_map_of_the_chapter_names_files_and_functions_that_exist():
    assert rows(FILES) == rows(CHINESE_FILES)
    assert len(rows(FILES)) == 43
    for files, names in rows(FILES):
        assert files
        for file in files:
            assert any((ROOT / package / file).exists() for package in ("src/twistwrench", "src")), file
        for name in names:
            assert hasattr(tw, name), name


def test_the_map_of_the_chapter_has_every_room_after_those_that_it_imports_from():
    rooms = list(dict.fromkeys(section(file) for files, _ in rows(FILES) for file in files))
    assert rooms == [room for room in ORDER if room not in ("__init__", "__main__")]


def test_the_sections_are_those_of_the_rooms_own_tables():
    tables = f"{algorithms.__doc__}\n{spatial.__doc__}"
    ours = dict(re.findall(r"^(\w+) +(49\.\d+)", tables, re.MULTILINE))
    said = re.findall(r"^\| (49\.\d+) \|([^|]*)\|", FILES, re.MULTILINE)
    for number, files in said:
        for file in re.findall(r"`(?:spatial|algorithms)/(\w+)\.py`", files):
            assert ours.get(file, number) == number


def test_the_numbers_of_robots_are_right():
    own = [robot for robot in tw.robots() if robot.source == "models"]
    others = [robot for robot in tw.robots() if robot.source != "models"]
    assert (len(own), len(others)) == (6, 68)
    assert "six robots" in ENGLISH
    assert "the 68 of" in ENGLISH


def days(file):
    """What a table of days has of exercises, by the day."""
    table = re.findall(r"^\| (\d+) \|(.*)\|$", (ROOT / file).read_text(encoding="utf-8"), re.MULTILINE)
    return {int(day): re.findall(r"49\.\d+\.\d+(?:–\d)?|project\.\d", cells) for day, cells in table}


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_days_are_those_of_the_plan(language):
    plan = days(f"docs/companion{language}.md")
    assert list(plan) == list(range(1, 15))
    assert days(f"README{language}.md") == plan


@pytest.mark.parametrize("page", [f"README{language}.md" for language in LANGUAGES])
def test_every_link_leads_to_a_file_and_to_a_heading_of_it(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    links = re.findall(r"""(?:\]\(|src(?:set)?=")(?!https?:)([^)#"]*)(?:#([^)"]*))?""", text)
    assert len(links) > 30
    for target, anchor in links:
        assert (ROOT / target).exists(), target
        assert not anchor or anchor in headings(ROOT / target), (target, anchor)


def test_the_first_picture_shows_a_line_of_the_package_and_the_weight_of_the_robot():
    pytest.importorskip("matplotlib", reason="matplotlib is not installed: the picture is not drawn")
    door = runpy.run_path(str(ROOT / "docs/pictures/door.py"), run_name="door")
    weight = f"{tw.load('go2').mass * 9.81:.1f}"
    for inks in door["INKS"].values():
        figure = door["draw"](*inks)
        said = [text.get_text() for text in figure.texts]
        assert said[:2] == [r"$F_{\lambda(i)} \leftarrow F_{\lambda(i)} + X_i^T F_i$", "F[p] = F[p] + X[i].mT @ F[i]"]
        assert said[7] == weight
        assert figure.axes[0].texts[0].get_text().strip() == f"{weight} N"
    assert f"{weight} N" in ENGLISH
    assert f"{weight} N" in CHINESE
