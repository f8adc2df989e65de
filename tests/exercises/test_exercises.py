"""The exercises: references pass, every slip is named, and a student's path through a folder works."""

import ast
import importlib.resources
import inspect
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from functools import cache, wraps
from itertools import combinations
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import twistwrench as tw
from misstep import skeletons
from misstep.compare import agree
from misstep.judge import judge
from misstep.progress import Row, Status
from misstep.text import Text, read
from misstep.workbook import Workbook
from twistwrench.algorithms.aba import articulated_body
from twistwrench.algorithms.crba import composite_rigid_body
from twistwrench.algorithms.kinematics import motion, placements
from twistwrench.algorithms.rnea import newton_euler
from twistwrench.cli import main
from twistwrench.errors import NameNotFound
from twistwrench.exercises import checking, hint, mine, slips, solution, start, status
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.layouts import JACOBIAN
from twistwrench.exercises.slips import SLIPS
from twistwrench.exercises.wrong import faulty, swap

from ..sampling import sampled

HERE = [COURSE.exercise(number) for number in COURSE.numbers]
PARTS = [pytest.param(e, part, id=f"{e.id.replace('.', '_')}-{part.name}") for e in HERE for part in e.parts]
SEEDS = (0, 1, 2)
CELLS = [
    pytest.param(e, part, slip, SEEDS[k % len(SEEDS)], id=f"{e.id.replace('.', '_')}-{part.name}-{slip}")
    for k, (e, part, slip) in enumerate((e, part, slip) for e in HERE for part in e.parts for slip in part.slips)
]
DATA = [file for room in ("items", "slips") for file in sorted(Path(slips.__file__).parents[1].glob(f"{room}/*.toml"))]

CHAPTER = {
    *("49.0.1", "49.0.2", "49.0.3", "49.0.4", "49.0.5"),
    *("49.1.1", "49.1.2", "49.2.1", "49.2.2", "49.3.1", "49.3.2", "49.3.3", "49.4.1", "49.4.2", "49.4.3"),
    *("49.5.1", "49.5.2", "49.5.3", "49.6.1", "49.6.2", "49.6.3", "49.7.1", "49.7.2", "49.8.1", "49.8.2"),
    *("49.9.1", "49.9.2", "49.9.3", "49.10.1", "49.10.2", "49.10.3", "49.11.1", "49.11.2", "49.11.3", "49.11.4"),
    *("project.1", "project.2", "project.3", "project.4"),
}


# ---------------------------------------------------------------- what there is


@pytest.mark.parametrize("number", sorted(CHAPTER))
def test_every_exercise_of_the_chapter_is_there(number):
    assert COURSE.exercise(number).id == number


def test_each_file_is_an_exercise_in_the_order_of_its_number():
    files = importlib.resources.files("twistwrench.exercises.items").iterdir()
    found = {file.name for file in files if file.name.startswith("ex_") and file.name.endswith(".py")}
    assert found == {f"ex_{number.replace('.', '_')}.py" for number in COURSE.numbers}
    assert set(COURSE.numbers) >= CHAPTER
    ranks = [(list(COURSE.sections).index(n.rpartition(".")[0]), int(n.rpartition(".")[2])) for n in COURSE.numbers]
    assert ranks == sorted(ranks)


def test_functions_have_names_of_their_own():
    names = [part.name for e in HERE for part in e.parts]
    assert sorted(names) == sorted(set(names))


def texts(e):
    yield from (e.title, e.text, *([e.answer] if e.answer else []))
    for part in e.parts:
        yield from (
            part.doc,
            *part.hints,
            *(p.text for p in part.properties),
            *part.reasons.values(),
            *part.titles.values(),
        )


@pytest.mark.parametrize("e", HERE, ids=lambda e: e.id)
def test_every_text_is_there_in_both_languages(e):
    assert all(t.en.strip() and t.zh.strip() for t in texts(e))
    for t in (e.title, e.text, *([e.answer] if e.answer else []), *(x for part in e.parts for x in part.hints)):
        assert not any("\u4e00" <= c <= "\u9fff" for c in t.en), t.en
        assert any("\u4e00" <= c <= "\u9fff" for c in t.zh), t.zh
    assert all(part.hints for part in e.parts)
    assert e.parts
    assert e.answer is not None or e.kind in ("code", "number")
    for part in e.parts:
        assert {*part.reasons, *part.titles} <= set(part.slips)


def test_the_catalogue_of_slips():
    assert len(SLIPS) >= 40
    for slip in SLIPS.values():
        assert all(isinstance(t, Text) and t.en and t.zh for t in (slip.title, slip.why, slip.kind))
        assert slip.section in COURSE.sections
    titles = [s.title.en for s in SLIPS.values()]
    assert len(titles) == len(set(titles))


def test_no_two_files_define_one_slip():
    keys = [key for name in slips.FILES for key in read("twistwrench.exercises.slips", name)]
    assert sorted(keys) == sorted(SLIPS)
    assert sorted(file.stem for file in DATA if file.parent.name == "slips") == sorted((*slips.FILES, "kinds"))
    assert {slip.kind for slip in SLIPS.values()} == set(slips.KINDS.values())


def leaves(table, path=""):
    """Yield every text of a data file with where it stands, as "count.reasons.base-missing.en"."""
    for key, entry in table.items() if isinstance(table, dict) else enumerate(table):
        where = f"{path}.{key}".lstrip(".")
        if isinstance(entry, str):
            yield where, entry
        else:
            yield from leaves(entry, where)


@pytest.mark.parametrize("file", DATA, ids=lambda file: file.stem)
def test_a_data_file_holds_what_is_used_and_nothing_else(file):
    found = dict(leaves(read(f"twistwrench.exercises.{file.parent.name}", file.stem)))
    places = [where.rpartition(".") for where in found]
    assert {where for where, _, language in places if language == "en"} == {
        where for where, _, language in places if language == "zh"
    }
    assert {language for _, _, language in places} <= {"en", "zh", "section", "kind"}
    if file.parent.name == "items" and file.stem != "shared":
        owners = {e.id: e for e in HERE if f"ex_{e.id.replace('.', '_')}" == file.stem}
        own = {part.name: part for e in HERE for part in e.parts if part.solution.__module__.endswith(f".{file.stem}")}
        for where in found:
            first, _, rest = where.partition(".")
            kind = rest.split(".")[0]
            assert (first in own and kind in ("doc", "hints", "reasons", "titles", "properties")) or (
                owners and first in ("title", "text", "answer")
            ), where
        assert all(len(part.properties) == len(part.residuals) for part in own.values())


def test_a_fault_must_find_its_line():
    with pytest.raises(ValueError, match="swap: expected 'k < 4' once in its source, found it 0 times"):
        faulty(swap, ("k < 4", "k < 5"))([1.0] * 6)


def test_a_fault_may_be_in_the_listing_that_the_reference_calls():
    part = COURSE.find_part("tree_rnea")[1]
    *lists, qd, qdd, a0 = part.cases(np.random.default_rng(49))[0]
    wrong = faulty(part.solution, ("-tree.gravity", "tree.gravity"), of=newton_euler)
    assert wrong.__name__ == "tree_rnea"
    np.testing.assert_array_equal(wrong(*lists, qd, qdd, a0), part.solution(*lists, qd, qdd, -a0))
    with pytest.raises(ValueError, match="newton_euler: expected 'D_inv' once in its source, found it 0 times"):
        faulty(part.solution, ("D_inv", "D"), of=newton_euler)(*lists, qd, qdd, a0)


LISTED = {
    "body_placements": placements,
    "tree_rnea": newton_euler,
    "tree_energy": motion,
    "tree_crba": composite_rigid_body,
    "tree_aba": articulated_body,
}


@pytest.mark.parametrize("name", LISTED)
def test_no_algorithm_is_written_again(name):
    e, part = COURSE.find_part(name)
    assert LISTED[name] in part.beside
    assert not any(isinstance(node, ast.For) for node in ast.walk(ast.parse(inspect.getsource(part.solution))))
    last = inspect.getsource(LISTED[name]).rstrip().splitlines()[-1]
    shown = solution(e.id, language="en")
    assert shown.count(f"def {LISTED[name].__name__}(") == 1  # once, with its comments
    assert last in shown
    assert shown.index(last) < shown.index(f"def {name}(")


def test_every_slip_of_the_catalogue_occurs_somewhere():
    missing = set(SLIPS) - {slip for e in HERE for part in e.parts for slip in part.slips}
    assert missing == set()


# ---------------------------------------------------------------- references and slips


@cache
def settled(name, seed):
    """Return a part whose cases are drawn once, and whose reference and slips answer each of them once."""
    part = COURSE.find_part(name)[1]
    if part.call is not None:
        return part
    cases = list(part.cases(np.random.default_rng([seed, 49])))

    def remembering(function):
        known = {}

        @wraps(function)
        def answer(*arguments):
            key = tuple(map(id, arguments))
            if key not in known and any(key == tuple(map(id, case)) for case in cases):
                known[key] = function(*arguments)
            return known[key] if key in known else function(*arguments)

        return answer

    slips = {slip: remembering(wrong) for slip, wrong in part.slips.items()}
    return replace(part, solution=remembering(part.solution), slips=slips, cases=lambda rng: cases)


@pytest.mark.parametrize(("e", "part"), sampled(PARTS, 30, several=True))
def test_the_reference_passes(e, part):
    for seed in SEEDS:
        assert judge(e, settled(part.name, seed), part.solution).state == "done"


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_the_reference_has_the_properties(e, part):
    for seed in SEEDS:
        for arguments in part.cases(np.random.default_rng(seed)):
            answer = part.value(part.solution, arguments)
            for item in part.properties:
                residual = np.asarray(item.residual(answer, *arguments), complex)
                np.testing.assert_allclose(residual, 0, atol=1e-8, err_msg=item.text.en)


def bare(text):
    """Return a text without blanks, as a line may be broken anywhere."""
    return "".join(text.split())


@pytest.mark.parametrize(("e", "part", "slip", "seed"), sampled(CELLS, 45, several=True, draw=15))
def test_a_slip_is_named(e, part, slip, seed):
    verdict = judge(e, settled(part.name, seed), part.slips[slip])
    assert verdict.state == "wrong"
    assert slip in verdict.slips
    for language in ("en", "zh"):
        message = verdict.message(language, level=2)
        assert bare(part.titles.get(slip, SLIPS[slip].title).of(language)) in bare(message)
        if slip in part.reasons:
            assert bare(part.reasons[slip].of(language)) in bare(message)
        assert len(message.splitlines()) <= 20


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_slips_can_be_told_apart(e, part):
    """Two that give the same answer must be declared, and what is declared must be so."""
    cases = list(part.cases(np.random.default_rng(7)))
    answers = {slip: [part.value(wrong, c) for c in cases] for slip, wrong in part.slips.items()}
    for one, other in combinations(answers, 2):
        same = all(agree(part, a, b, c) for a, b, c in zip(answers[one], answers[other], cases, strict=True))
        assert same == any({one, other} <= group for group in part.alike), (one, other)


@pytest.mark.parametrize(("e", "part"), PARTS)
def test_what_is_not_begun_is_to_do(e, part):
    def untouched(*arguments):
        return ...

    def raising(*arguments):
        raise NotImplementedError

    if part.call is None:
        assert judge(e, part, untouched).state == judge(e, part, raising).state == "to do"


def test_the_twist_of_the_foot_is_pinocchios():
    pin = pytest.importorskip("pinocchio", reason="Pinocchio is not installed: the comparison with it is skipped")
    model = tw.load("go2")
    theirs = tw.bridge.to_pinocchio_model(model)
    data, frame = theirs.createData(), theirs.getFrameId("FR_foot")
    q = model.random_configuration(rng=np.random.default_rng(3))
    v = np.zeros(theirs.nv)
    v[5] = 0.5  # Pinocchio's order: the base's ω_z comes sixth
    pin.forwardKinematics(theirs, data, q, v)
    V = pin.getFrameVelocity(theirs, data, frame, pin.LOCAL)
    ours = COURSE.find_part("foot_twist")[1].solution(model, q, 0.5)
    np.testing.assert_allclose(ours, [*V.angular, *V.linear], atol=1e-14)


# ---------------------------------------------------------------- a student's path


def pytest_in(folder, *arguments):
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-W", "error", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300, check=False)


def write_solutions(folder, language):
    for section in COURSE.sections:
        if COURSE.of_section(section):
            (folder / COURSE.file_name(section)).write_text(
                skeletons.solved(COURSE, section, language), encoding="utf-8"
            )


@pytest.mark.slow
@pytest.mark.parametrize("language", sampled(["en", "zh"], 1))
def test_a_fresh_folder_is_all_to_do(tmp_path, language):
    new, kept = start(tmp_path / "mine", language=language)
    assert not kept
    assert {p.name for p in new} >= {"pytest.ini", "ex_49_3.py"}
    found = status(tmp_path / "mine")
    assert (found.done, found.total) == (0, len(HERE))
    assert {s for row in found.rows for s in row.states.values()} == {"to do"}


def test_start_touches_nothing_that_is_there(tmp_path):
    (tmp_path / "ex_49_3.py").write_text("mine = 1\n")
    new, kept = start(tmp_path, language="en")
    assert [p.name for p in kept] == ["ex_49_3.py"]
    assert (tmp_path / "ex_49_3.py").read_text() == "mine = 1\n"
    again, kept = start(tmp_path)
    assert not again
    assert len(kept) == len(new) + 1


@pytest.mark.slow(draw=1)
@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_solutions_give_everything(tmp_path, language):
    start(tmp_path, language=language)
    write_solutions(tmp_path, language)
    found = status(tmp_path)
    assert {n: s for row in found.rows for n, s in row.states.items() if s != "done"} == {}
    assert "100 %" in str(found)


@pytest.mark.slow(one_in=3)
def test_a_path_through_pytest(tmp_path):
    start(tmp_path, language="en")
    fresh = pytest_in(tmp_path, "-rs").stdout
    assert "failed" not in fresh
    assert "to do: 49.3.1 translation_transforms" in fresh
    assert "Next: 49.0.1" in fresh

    file = tmp_path / "ex_49_3.py"
    written = file.read_text(encoding="utf-8")
    file.write_text(written.replace("return ...", "return np.eye(6), np.eye(6), np.eye(6)", 1), encoding="utf-8")
    assert "Next:" not in pytest_in(tmp_path, "--collect-only", "ex_49_3.py").stdout
    failed = pytest_in(tmp_path, "-k", "49_3", "--level", "2")
    assert failed.returncode == 1
    assert "the coupling term is missing." in failed.stdout
    assert "Traceback" not in failed.stdout
    assert "1 failed, 5 skipped" in failed.stdout

    write_solutions(tmp_path, "en")
    passed = pytest_in(tmp_path, "-m", "s49_3")
    assert "6 passed" in passed.stdout
    assert "49.3.3: your functions are right. To compare with your own words, the model answer:" in passed.stdout
    assert set(Workbook(COURSE, tmp_path).state["compared"]) >= {"49.3.2", "49.3.3"}
    assert main(["exercises", "status", str(tmp_path)]) == 0


def test_a_section_is_meant_by_its_number():
    """`-k 49_1` is section 49.1, and not 49.10 and 49.11 too."""
    config = SimpleNamespace(stash={}, option=SimpleNamespace(keyword="49_1 or 49_3_2"))
    config.addinivalue_line = lambda name, line: None
    checking.pytest_configure(config)
    assert config.option.keyword == "49_1_ or 49_3_2"


@pytest.mark.parametrize(
    ("language", "said"), [("en", "  1 done, 1 wrong, 1 to do"), ("zh", "  1 完成、1 有误、1 未做")]
)
def test_a_line_of_the_table_is_punctuated_in_its_language(language, said):
    states = {"49.3.1": "done", "49.3.2": "wrong", "49.3.3": "to do"}
    assert str(Status(COURSE, (Row("49.3", states),), language)).splitlines()[0].endswith(said)


@pytest.mark.slow
def test_what_is_missing_of_an_exercise_that_is_begun_is_named(tmp_path):
    """Its function can be right, and the words not yet written: "Next" alone would puzzle."""
    start(tmp_path, language="en")
    assert "is still missing" not in str(status(tmp_path))
    file = tmp_path / "ex_49_0.py"
    file.write_text(skeletons.solved(COURSE, "49.0", "en") + "\nanswer_49_0_3 = ...\n", encoding="utf-8")
    found = status(tmp_path)
    assert "Next: 49.0.3 The adjoint, in ex_49_0.py: answer_49_0_3 is still missing" in str(found)
    file.write_text("answer_49_0_3 = (\n", encoding="utf-8")
    said = str(status(tmp_path, language="zh"))
    assert "无法读取，先改好：ex_49_0.py" in said
    assert "49.0.1" not in said


def test_hints_and_solutions_show_as_they_read():
    for said in (hint("49.3.1", language="en"), solution("49.3.1", language="en")):
        assert repr(said) == str(said)
        assert "\n" in said


def test_an_exercise_is_found_by_its_number_or_a_function():
    """A student sees the name of the function before him, and not always the number."""
    first, second = hint("skew", language="en"), hint("49.0.1", language="en")
    assert first.partition(":")[0] == second.partition(":")[0] == "49.0.1 skew"
    assert solution("tree_aba", language="en") == solution(COURSE.find_part("tree_aba")[0].id, language="en")
    with pytest.raises(NameNotFound, match="did you mean 'rows_of_foot'"):
        hint("rows_of_fot")
    with pytest.raises(NameNotFound, match=r"unknown exercise 'project.9'"):
        hint("project.9")


def test_hints_come_one_at_a_time(tmp_path, no_other_process):
    start(tmp_path, language="en")
    first, second = hint("49.3.1", tmp_path), hint("49.3.1", tmp_path)
    assert "hint 1 of 2" in first
    assert "hint 2 of 2" in second
    assert hint("49.3.1", tmp_path, again=True) == second
    assert "提示 1/2" in hint("49.3.1", tmp_path, every=True, language="zh")
    assert "--dir" not in first


def test_a_hint_that_nobody_remembers_says_so(tmp_path):
    """Elsewhere than in the folder of the answers the first hint comes every time."""
    assert hint("49.3.1", tmp_path, language="en").endswith("--all shows all.")
    assert hint("49.3.1", tmp_path, language="zh").endswith("--all 显示全部提示。")


def test_a_model_answer_waits_for_the_attempt(tmp_path, no_other_process):
    start(tmp_path, language="en")
    model = COURSE.exercise("49.3.2").answer.en.split()[:4]
    assert " ".join(model) not in solution("49.3.2", tmp_path)
    file = tmp_path / "ex_49_3.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("answer_49_3_2 = ...", 'answer_49_3_2 = "Where p is zero."'), encoding="utf-8")
    assert " ".join(model) in solution("49.3.2", tmp_path)


# ---------------------------------------------------------------- messages where no slip fits


def message(name, function, language="en"):
    verdict = judge(*COURSE.find_part(name), function)
    assert verdict.state == "wrong"
    return " ".join(verdict.message(language, level=3).split())


def spoilt(change):
    """Return X and X* with one block of X changed by hand, and another so that it is no known slip."""

    def function(R, p):
        X, X_star = COURSE.find_part("plucker")[1].solution(R, p)
        X[3:, :3] = change(X[3:, :3])
        X[:3, 3:] = 7
        return X, X_star

    return function


@pytest.mark.one_case
@pytest.mark.parametrize(
    ("change", "en", "zh"),
    sampled(
        [
            (lambda B: -B, "the sign is wrong", "符号相反"),
            (lambda B: 0 * B, "zero, and must not be", "为零，不应为零"),
            (lambda B: 0 * B + 1, "different numbers", "数值不同"),
            (lambda B: B.mT, "transposed", "被转置"),
            (lambda B: -B.mT, "transposed, and the sign is wrong", "被转置且符号相反"),
            (lambda B: B + 1e-5, "right to ", "只有 "),
            (lambda B: B + np.outer([1, 0, 0], [0, 0, 1]), "wrong in [3, 2], right elsewhere", "错在 [3, 2]"),
        ],
        2,
        several=True,
    ),
)
def test_a_block_that_is_off_is_named_and_how(change, en, zh):
    said = message("plucker", spoilt(change))
    assert f"X, the block of rows v, columns ω: {en}" in said
    assert "the rest of X is right" in said
    assert "X*, the" not in said
    assert f"X，v 行、ω 列的块：{zh}" in message("plucker", spoilt(change), "zh")


@pytest.mark.parametrize(
    ("name", "function", "says"),
    [
        ("skew", lambda w: None, "It returned None. Is the `return` missing?"),
        ("skew", lambda w: np.zeros((4, 4)), "has the shape (4, 4); it must be (3, 3)"),
        ("skew", lambda w: np.full((3, 3), np.nan), "entries that are not finite numbers"),
        ("skew", lambda w: "a matrix", "must be numbers, not str"),
        ("skew", lambda w: [[1], [2, 3]], "must be an array, not a list"),
        ("sole_holds", lambda *arguments: 1.0, "must be True or False, not float"),
        ("time_per_call", lambda task, calls, clock: f"{clock()} s", "must be numbers, not str"),
        ("skew", lambda w: 1 / 0, "It stopped with ZeroDivisionError: division by zero"),
        ("skew", lambda w: sys.exit(), "It stopped with SystemExit"),
        ("skew", lambda w: w.sort() or np.zeros((3, 3)), "It changes its argument `w`"),
        ("plucker", lambda R, p: np.eye(6), "It must return 2 things: X, X*. It returned ndarray."),
        ("plucker", lambda R, p: (np.eye(6),) * 3, "It returned 3."),
        ("plucker", lambda R: R, "It stopped with TypeError"),
        ("skew", lambda w: -1.7 * reference("skew")(w), "[w]×: 6 of 9 numbers are wrong"),
    ],
)
def test_what_cannot_be_compared_is_said(name, function, says):
    assert says in message(name, function)


def reference(name):
    return COURSE.find_part(name)[1].solution


def test_a_truth_value_and_a_word_that_are_wrong_are_told():
    assert re.search("holds: is (True|False)", message("sole_holds", lambda F, d_x, d_y: bool(F[4] > 0)))

    class Renamed(reference("SpatialVector")):
        name = "screw"

        def __add__(self, other):
            return Renamed(self.name, super().__add__(other).vector)

    assert "(F + G).kind: screw, where a different text is expected" in message("SpatialVector", Renamed)
    Renamed.name = 1.0
    assert "(F + G).kind must be a string, not float" in message("SpatialVector", Renamed)


def test_an_answer_may_be_a_placement_of_ours():
    pose = COURSE.find_part("base_pose")
    base = tw.load("go2")
    assert judge(*pose, lambda q: tw.forward_kinematics(base, q).placement[1]).state == "done"
    assert judge(*pose, lambda q: tw.forward_kinematics(base, q).placement[1].inverse()).state == "wrong"


def test_only_blocks_that_an_array_has_are_named():
    names = [name.en for name, _ in JACOBIAN.blocks((6, 6))]  # of a base alone
    assert names == ["the block of rows ω, columns of the base", "the block of rows v, columns of the base"]


def test_a_name_of_no_function_suggests_one():
    with pytest.raises(NameNotFound, match="unknown function of an exercise 'skwe'; did you mean 'skew'"):
        mine("skwe")


def test_a_class_is_judged_by_what_it_does():
    class SpatialVector:
        def __init__(self, kind, vector):
            self.kind, self.vector = kind, vector

        def __add__(self, other):
            return SpatialVector(self.kind, self.vector + other.vector)

        def __sub__(self, other):
            return SpatialVector(self.kind, self.vector - other.vector)

        def power(self, other):
            return self.vector @ other.vector

    said = message("SpatialVector", SpatialVector)
    assert "In the error of V ± F: a twist and a wrench can be added, or subtracted." in said
    assert "the power of two quantities of the same kind raises no error." in said

    class Unfinished(SpatialVector):
        def __add__(self, other):
            return ...

    assert judge(*COURSE.find_part("SpatialVector"), Unfinished).state == "to do"


def test_power_is_asked_for_both_ways_and_the_error_is_the_one_that_was_asked_for():
    class OneWay(reference("SpatialVector")):
        def power(self, other):
            if self.kind == "twist":
                raise TypeError("ask the wrench")
            return super().power(other)

    class OtherWay(reference("SpatialVector")):
        def power(self, other):
            if self.kind == "wrench":
                raise TypeError("ask the twist")
            return super().power(other)

    class OtherError(reference("SpatialVector")):
        def power(self, other):
            if self.kind == other.kind:
                raise ValueError("of one kind")
            return super().power(other)

    assert "only one of wrench.power(twist) and twist.power(wrench) works" in message("SpatialVector", OneWay)
    assert "F.power(V) must be numbers, not str" in message("SpatialVector", OtherWay)
    assert "TypeError is expected" in message("SpatialVector", OtherError)


def test_an_explanation_does_not_tell_to_do_what_was_done():
    """Three that did: where the operation is undone, or the order is Pinocchio's, the sign that is right is another."""
    slips = {name: COURSE.find_part(name)[1].slips for name in ("whole_robot", "pinocchio_inertia")}
    assert "I_c = I_O + m [c]×²" in message("whole_robot", slips["whole_robot"]["parallel-axis-sign"])
    assert "top right block is +m [c]×" in message("whole_robot", slips["whole_robot"]["com-sign"])
    assert "−m [c]× is top right" in message("pinocchio_inertia", slips["pinocchio_inertia"]["com-sign"])
    said = message("pinocchio_linear_momentum", lambda A_G, v: A_G[:3] @ np.r_[v[3:6], v[:3], v[6:]])
    assert "Pinocchio's (v, ω): exchange nothing" in said


def test_different_slips_in_different_things_are_told_apart():
    plucker = COURSE.find_part("plucker")[1]

    def function(R, p):
        return plucker.slips["coupling-sign"](R, p)[0], plucker.slips["coupling-dropped"](R, p)[1]

    said = message("plucker", function)
    assert "In X: the coupling term has the wrong sign." in said
    assert "In X*: the coupling term is missing." in said


def test_a_broken_property_is_told_where_no_slip_fits():
    assert "the power FᵀV is the same in both frames" in message("plucker", spoilt(lambda B: 2 * B))


# ---------------------------------------------------------------- one exercise uses another


@pytest.mark.slow
def test_later_exercises_run_on_the_reference_until_the_earlier_one_is_right(tmp_path):
    start(tmp_path, language="en")
    exercise, part = COURSE.find_part("translation_transforms")
    file = tmp_path / "ex_49_3.py"
    text = file.read_text(encoding="utf-8")
    body = "X = np.eye(6)\n    X[3:, :3] = skew(p)\n    return X, np.linalg.inv(X), np.linalg.inv(X).T"
    file.write_text(text.replace("return ...", body, 1), encoding="utf-8")
    unfinished = Workbook(COURSE, tmp_path)
    assert unfinished.verdict(exercise, part).state == "done"
    assert unfinished.borrowed == {"skew"}
    assert re.search("^On the reference until yours is right: .*skew", str(status(tmp_path)), re.MULTILINE)

    earlier = tmp_path / "ex_49_0.py"
    wrong = earlier.read_text(encoding="utf-8").replace("return ...", "return np.zeros((3, 3))", 1)
    earlier.write_text(wrong, encoding="utf-8")
    assert Workbook(COURSE, tmp_path).verdict(exercise, part).state == "done"

    right = wrong.replace("return np.zeros((3, 3))", "print('mine'); return np.cross(w, np.eye(3)).T", 1)
    earlier.write_text(right, encoding="utf-8")
    finished = Workbook(COURSE, tmp_path)
    assert finished.verdict(exercise, part).state == "done"
    assert finished.borrowed == set()


def test_files_may_import_each_other_and_folders_do_not_mix(tmp_path, monkeypatch):
    for k, folder in enumerate(("a", "b")):
        start(tmp_path / folder, language="en")
        (tmp_path / folder / "helper.py").write_text(f"number = {k}\n")
        text = "import colorsys\nfrom helper import number\n\ndef sizes():\n    return number\n"
        (tmp_path / folder / "ex_49_1.py").write_text(text)
        monkeypatch.delitem(sys.modules, "colorsys", raising=False)
        module = Workbook(COURSE, tmp_path / folder).module("49.1")
        assert module.sizes() == k
        assert "helper" not in sys.modules
        assert sys.modules["colorsys"] is module.colorsys  # what is not the student's stays


def test_an_answer_in_a_word_is_too_short(tmp_path):
    start(tmp_path, language="en")
    file = tmp_path / "ex_49_3.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("answer_49_3_2 = ...", 'answer_49_3_2 = "p"'), encoding="utf-8")
    verdict = Workbook(COURSE, tmp_path).verdict_in_words(COURSE.exercise("49.3.2"))
    assert verdict.state == "wrong"
    assert "answer_49_3_2 is very short" in verdict.message("en")


def test_a_file_that_cannot_be_read_says_where(tmp_path):
    start(tmp_path, language="en")
    (tmp_path / "ex_49_1.py").write_text("def sizes():\n    return (\n")
    said = Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("sizes")).message("en")
    assert "ex_49_1.py, line 2 cannot be read: SyntaxError" in said
    said = Workbook(COURSE, tmp_path, language="zh").verdict(*COURSE.find_part("sizes")).message("zh")
    assert "ex_49_1.py 第 2 行无法读取：SyntaxError" in said
    (tmp_path / "ex_49_1.py").write_text("import sys\nsys.exit(0)\n")
    assert "cannot be read: SystemExit: 0" in Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("sizes")).message(
        "en"
    )
    (tmp_path / "ex_49_1.py").write_text("")
    assert "no function sizes in ex_49_1.py" in Workbook(COURSE, tmp_path).verdict(*COURSE.find_part("sizes")).message(
        "en"
    )


@pytest.mark.slow
def test_a_file_that_cannot_be_read_is_told_the_same_where_it_is_named(tmp_path):
    """`python -m pytest ex_49_1.py`, as its first lines say: pytest would read it as a module of its own, and trace."""
    start(tmp_path, language="en")
    (tmp_path / "ex_49_1.py").write_text("def sizes():\n    retrun 3\n")
    run = pytest_in(tmp_path, "ex_49_1.py")
    assert run.returncode == 1
    assert run.stdout.count("ex_49_1.py, line 2 cannot be read: SyntaxError: invalid syntax") == 1
    assert "1 failed" in run.stdout
    assert "To mend first, since it cannot be read: ex_49_1.py" in run.stdout
    assert "Next:" not in run.stdout
    assert "collecting" not in run.stdout


def test_status_in_the_wrong_folder_says_where_the_exercises_are(tmp_path, capsys, monkeypatch):
    start(tmp_path / "my answers", language="en")
    (tmp_path / "my answers" / "notes").mkdir()
    for folder, other in ((tmp_path, "my answers"), (tmp_path / "my answers" / "notes", "..")):
        monkeypatch.chdir(folder)
        assert main(["exercises", "status"]) == 2
        quoted = shlex.quote(other)
        assert (
            f".: no exercises here; there are some in {other}: twistwrench exercises status {quoted}\n"
            in capsys.readouterr().err
        )


def test_commands_refuse_what_they_cannot_do(tmp_path, capsys):
    assert main(["exercises", "status", str(tmp_path)]) == 2
    assert "no exercises here; name the folder that they are in" in capsys.readouterr().err
    assert main(["exercises", "hint", "49.3.9"]) == 2
    assert "did you mean '49.3.3'" in capsys.readouterr().err
    assert main(["exercises", "solution", "49.3.1"]) == 1
    assert "--yes" in capsys.readouterr().out
    assert main(["exercises", "solution", "49.3.1", "--yes"]) == 0
    assert "def translation_transforms(p):" in capsys.readouterr().out
    assert main(["exercises", "list", "--language", "zh"]) == 0
    assert "纯平移" in capsys.readouterr().out


def test_a_hint_is_printed(tmp_path, capsys, no_other_process):
    start(tmp_path, language="en")
    assert main(["exercises", "hint", "49.3.1", "--dir", str(tmp_path)]) == 0
    assert capsys.readouterr().out.strip()


@pytest.mark.parametrize(("answer", "status"), [("y", 0), ("", 1)])
def test_a_solution_is_shown_to_who_is_sure(answer, status, monkeypatch, capsys):
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    monkeypatch.setattr("builtins.input", lambda question: answer)
    assert main(["exercises", "solution", "49.3.1"]) == status
    assert ("def translation_transforms(p):" in capsys.readouterr().out) == (status == 0)
