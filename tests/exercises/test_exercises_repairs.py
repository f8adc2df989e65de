"""The change that makes the student's own function right: it is found, it is true, and it stops."""

import importlib.util
import itertools
import linecache
import signal

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.cli import main
from twistwrench.exercises import catalogue, mine, start
from twistwrench.exercises import judge as judging
from twistwrench.exercises.calls import tried
from twistwrench.exercises.changes.repairs import guarded, repairs
from twistwrench.exercises.folder.workbook import Workbook
from twistwrench.exercises.judge import judge
from twistwrench.exercises.naming import wrong_answer
from twistwrench.exercises.notebook.cells import check

from ..sampling import sampled

RNEA = """\
def tree_rnea(parent, S, I, X, qd, qdd, a0):
    V, A, F, tau = [np.zeros(6)], [a0], [np.zeros(6)], {}
    for i in range(1, len(parent)):
        vJ = S[i] @ qd[i]
        V.append(X[i] @ V[parent[i]] + vJ)
        A.append(X[i] @ A[parent[i]] + S[i] @ qdd[i] + tw.cross_motion(V[i]) @ vJ)
        F.append(I[i] @ A[i] + tw.cross_force(V[i]) @ I[i] @ V[i])
    for i in range(len(parent) - 1, 0, -1):
        tau[i] = S[i].T @ F[i]
        F[parent[i]] = F[parent[i]] + X[i].T @ F[i]
    return np.concatenate([tau[i] for i in sorted(tau)])
"""


@pytest.fixture
def written(tmp_path):
    """Return a function from a text as if it stood in a student's file, below ten other lines."""

    def function(text):
        path = tmp_path / f"answer_{len(list(tmp_path.iterdir()))}.py"
        path.write_text("\n" * 10 + text, encoding="utf-8")
        names = {"np": np, "tw": tw}
        exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), names)
        return next(x for name, x in names.items() if callable(x) and name not in ("np", "tw", "__builtins__"))

    yield function
    linecache.clearcache()


def message(function, name, language="en"):
    return " ".join(judge(*catalogue.find_part(name), function).message(language).split())


@pytest.mark.parametrize(
    ("right", "wrong", "says"),
    [
        ("X[i] @ A[parent[i]]", "X[i] @ V[parent[i]]", "line 16, change `V[parent[i]]` to `A[parent[i]]`"),
        ("vJ = S[i] @ qd[i]", "vJ = 2 * S[i] @ qd[i]", "line 14, take out `2 *`"),
        ("I[i] @ A[i] +", "I[i].T @ V[i] +", "line 17, change `V[i]` to `A[i]`"),
    ],
)
def test_a_slip_in_a_way_of_ones_own_is_found_at_its_line(written, right, wrong, says):
    assert RNEA.count(right) == 1
    assert judge(*catalogue.find_part("tree_rnea"), written(RNEA)).state == "done"
    assert says in message(written(RNEA.replace(right, wrong)), "tree_rnea")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("def act(R, p, x):\n    return (R @ x + p)[:2]\n", "x_A has the shape (2,); it must be (3,)"),
        ("def act(R, p, x):\n    y = R * x\n    return y + p\n", "change `R * x` to `R @ x`"),
        ("def act(R, p, x):\n    return np.r_[R @ x + p, 1.0]\n", "return `x[:3]` where `x` is returned"),
        ("def skew(w):\n    W = -tw.skew(w).T\n    W += tw.skew(w)\n    return W\n", "take out `"),
    ],
)
def test_what_must_stand_there_is_reported(written, text, says):
    name = text.partition("(")[0].removeprefix("def ")
    assert says in message(written(text), name)


def test_an_error_is_explained_too(written):
    text = "def accelerated(M, h, S, J_c, tau, forces):\n    return np.linalg.solve(M, S.T @ tau + J_c @ forces - h)\n"
    said = message(written(text), "accelerated")
    assert "It stopped with ValueError" in said
    assert "change `J_c @ forces` to `J_c.T @ forces`" in said
    assert "把 `J_c @ forces` 改为 `J_c.T @ forces`" in message(written(text), "accelerated", "zh")


def test_a_change_that_is_reported_makes_the_function_right(written):
    """Put the change into the text: the function then passes on other cases than those of the search."""
    wrong = RNEA.replace("X[i].T @ F[i]", "X[i] @ F[i]")
    exercise, part = catalogue.find_part("tree_rnea")
    function, cases = written(wrong), part.cases(np.random.default_rng(5))
    right = [part.solution(*case) for case in cases]
    (found,) = repairs(part, function, right, [function(*case) for case in cases], cases, until=np.inf)
    assert found.edit.line == 20
    lines = wrong.split("\n")
    lines[9] = lines[9].replace(found.edit.right, found.edit.wrong)
    assert lines[9].endswith("X[i].T @ F[i]")
    assert judge(exercise, part, written("\n".join(lines)), seed=77).state == "done"


def test_a_loop_that_a_change_makes_endless_is_given_up(written):
    text = "def count(kinds):\n    k = 0\n    while k < len(kinds):\n        k += 1\n    return k, k\n"
    safe = guarded(written(text.replace("k += 1", "k += 0")))
    with pytest.raises(RuntimeError):
        safe(["revolute"])
    assert "not yet right" in message(written(text), "count")


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this system does not count the time of a process")
def test_a_change_that_sends_an_unchanged_function_round_for_ever_is_given_up():
    _, part = catalogue.find_part("count")
    assert tried(part, lambda kinds: next(n for n in itertools.count() if n < 0), (["revolute"],)) is None
    assert tried(part, part.solution, (["revolute"],)) == (1, 1), "the alarm is off again"


def test_what_a_function_writes_into_a_result_does_not_reach_the_next_try(written):
    text = """\
def momentum_rate(model, q, v, a):
    fk, p_G, rate = tw.forward_kinematics(model, q, v, a), tw.center_of_mass(model, q), np.zeros(6)
    for body, T, V, A in zip(model.inertia, fk.placement, fk.twist, fk.acceleration):
        A[:] = body.matrix() @ A + tw.cross_force(V) @ body.matrix() @ V
        rate += tw.force_transform(T.rotation, T.translation - p_G) @ A
    rate[3:] += 2 * model.mass * model.gravity
    return rate
"""
    assert "take out `rate[3:] += 2 * model.mass * model.gravity`" in message(written(text), "momentum_rate")


# ---------------------------------------------------------------- a language, a package


def test_the_language_that_was_asked_for_once_is_remembered(tmp_path, capsys, monkeypatch):
    start(tmp_path, language="en")
    monkeypatch.chdir(tmp_path)
    assert main(["exercises", "hint", "49.3.1", "--language", "zh"]) == 0
    assert Workbook(tmp_path).language == "zh"
    capsys.readouterr()
    main(["exercises", "hint", "49.3.1"])
    assert "提示" in capsys.readouterr().out
    main(["exercises", "list"])
    assert "编程" in capsys.readouterr().out


def test_check_remembers_the_language(monkeypatch):
    monkeypatch.setattr("twistwrench.exercises.notebook.cells._ASKED", {})

    def act(R, p, x):
        return R @ x + p

    assert "正确" in repr(check("49.0.2", act, language="zh"))
    assert "正确" in repr(check("49.0.2", act))
    assert "right" in repr(check("49.0.2", act, language="en"))


def test_an_exercise_whose_package_is_missing_is_to_do(monkeypatch):
    monkeypatch.setattr(judging, "find_spec", lambda name: None)
    exercise, part = catalogue.find_part("map_from_pinocchio")
    verdict = judge(exercise, part, part.solution)
    assert verdict.state == "to do"
    assert "pip install pin" in verdict.message("en")
    assert importlib.util.find_spec("numpy")


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            "def center_of_pressure(F):\n    return np.array([-F[3:][1], F[3:][0]]) / F[:3][2]\n",
            "exchange `F[:3]` and `F[3:]`",
        ),
        (
            "def growth(sizes, seconds):\n    log = np.log\n    return np.polyfit(log(sizes), seconds, 1)[0]\n",
            "to `np.polyfit(log(sizes), log(seconds), 1)`",
        ),
        (
            "def on_all_rows(tau):\n    out = np.zeros(18)\n    out[6 : 6 + len(tau)] = tau[:12]\n    return out\n",
            "the sizes of one robot are written into the function",
        ),
        (
            "def on_all_rows(tau):\n    out = np.zeros(6 + len(tau), int)\n    out[6:] = tau\n    return out\n",
            "the numbers are cut to whole ones",
        ),
        ("def selection(nv):\n    S = np.eye(nv)[6:]\n    return S[::-1]\n", "take out `[::-1]`"),
        (
            "def sole_wrench(points, forces):\n    for p, f in zip(points, forces):\n        tau = np.cross(p, f)\n"
            "    return np.r_[tau, forces.sum(0)]\n",
            "add `tau = np.cross(p, f)` up: += in place of =",
        ),
    ],
)
def test_a_general_slip_is_told_in_the_words_of_the_own_line(written, text, says):
    assert says in message(written(text), text.partition("(")[0].removeprefix("def "))


def test_a_slip_with_a_name_is_shown_in_the_own_line_too(written):
    text = "def sole_wrench(points, forces):\n    return np.r_[np.cross(forces, points).sum(0), forces.sum(0)]\n"
    said = message(written(text), "sole_wrench")
    assert "the factors of the cross product are exchanged" in said
    assert "this would make it right: line 12, change `np.cross(forces, points)` to `np.cross(points, forces)`" in said


def test_of_two_slips_with_the_same_numbers_the_source_tells_which(written):
    head = "def carried_wrenches(parent, T, F):\n    out, transforms = F.copy(), mine('transforms_of')\n"
    loop = "    for i in range(len(parent) - 1, 0, -1):\n        out[parent[i]] += {} @ out[i]\n    return out\n"
    names = {}
    for way in ("transforms(T[i])[0].T", "np.linalg.inv(transforms(T[i])[1])"):
        function = written((head + loop).format(way))
        function.__globals__["mine"] = mine
        names[way] = message(function, "carried_wrenches")
    transposed, inverted = names.values()
    assert "Xᵀ taken for X*" in transposed
    assert "the transform goes the wrong way" not in transposed
    assert "the transform goes the wrong way" in inverted
    assert "Xᵀ taken for X*" not in inverted


def test_what_only_copies_an_array_has_no_sign_and_is_not_left_out(written):
    text = "def chapter_order(I):\n    J = I.copy()\n    J[:3, :3], J[3:, 3:] = I[3:, 3:], I[:3, :3]\n    return J\n"
    said = message(written(text), "chapter_order")
    assert "only the two blocks on the diagonal are exchanged" in said
    assert "copy" not in said


def test_the_difference_of_two_wrenches_is_a_wrench():
    solution = catalogue.find_part("SpatialVector")[1].solution

    class SpatialVector(solution):
        def __sub__(self, other):
            return type(self)("twist", (solution.__sub__(self, other)).vector)

    assert "(F − G).kind" in message(SpatialVector, "SpatialVector")


@pytest.mark.parametrize(
    ("name", "text", "says"),
    sampled(
        [
            (
                "arc",
                """\
def arc(omega_z, v_x):
    c, s = np.cos(omega_z), np.sin(omega_z)
    r = v_x * omega_z
    return np.array([[c, s, 0, r * s], [-s, c, 0, r * (1 - c)], [0, 0, 1, 0], [0, 0, 0, 1]])
""",
                [
                    "change `-s` to `s`",
                    "change `[c, s, 0, r * s]` to `[c, -s, 0, r * s]`",
                    "and line 13, change `v_x * omega_z` to `v_x / omega_z`",
                    "With these changes",
                ],
            ),
            (
                "adjoint",
                """\
def adjoint(T):
    R, p = T[:3, :3], T[:3, 3]
    return np.block([[R, tw.skew(p) @ R], [np.zeros((3, 3)), R.T]])
""",
                ["to `[[R, np.zeros((3, 3))], [tw.skew(p) @ R, R.T]]`; and line 13, change `R.T` to `R`"],
            ),
            (
                "cross_operators",
                """\
def cross_operators(V):
    W, U, Z = tw.skew(V[:3]), tw.skew(V[3:]), np.zeros((3, 3))
    C = np.block([[W, U], [Z, W]])
    return C, C.T
""",
                [
                    "For V×, this slip gives what you have",
                    "Your V×* is your V× transposed",
                ],
            ),
        ],
        1,
        several=True,
    ),
)
def test_two_slips_are_found_one_after_the_other(written, monkeypatch, name, text, says):
    for share in wrong_answer.SHARES:
        monkeypatch.setitem(wrong_answer.SHARES, share, 60.0)  # how fast the machine is decides nothing here
    said = message(written(text), name)
    assert all(sentence in said for sentence in says)


def test_a_forgotten_argument_is_what_must_stand_there(written):
    always = """\
def foot_wrench(model, q, foot):
    R = tw.frame_placement(model, q, "FR_foot").rotation
    return np.concatenate([np.zeros(3), -model.mass / 4 * R.T @ model.gravity])
"""
    assert "to `tw.frame_placement(model, q, foot)`" in message(written(always), "foot_wrench")


def test_of_two_changes_that_do_the_same_neither_is_claimed(written):
    turned = """\
def arc(omega_z, v_x):
    R = tw.exp3(np.array([0, 0, omega_z]))
    r, T = v_x / omega_z, np.eye(4)
    T[:3, :3], T[:3, 3] = R, R @ np.array([r * np.sin(omega_z), r * (1 - np.cos(omega_z)), 0])
    return T
"""
    said = message(written(turned), "arc")
    assert "One of these changes would make it right" in said
    assert "take out `R @`" in said


def test_in_which_two_of_several_places_is_reported(written):
    six = "def base_rows(M, h, J_c, qdd, forces):\n    return M[:6, :6] @ qdd[:6] + M[:6, 6:12] @ qdd[6:12]"
    said = message(written(six + " + h[:6] - J_c[:, :6].T @ forces\n"), "base_rows")
    assert "line 12, change `M[:6, 6:12]` to `M[:6, 6:]`; and line 12, change `qdd[6:12]` to `qdd[6:]`" in said


def test_a_sign_of_several_lines_is_not_that_of_one(written):
    found = message(
        written(
            "def base_pose(q):\n"
            "    x, y, z, a, b, c, w = q[:7]\n"
            "    one = [1 - 2 * (b * b + c * c), 2 * (a * b + c * w), 2 * (a * c - b * w), x]\n"
            "    two = [2 * (a * b - c * w), 1 - 2 * (a * a + c * c), 2 * (b * c + a * w), y]\n"
            "    three = [2 * (a * c + b * w), 2 * (b * c - a * w), 1 - 2 * (a * a + b * b), z]\n"
            "    return np.array([one, two, three, [0, 0, 0, 1]])\n"
        ),
        "base_pose",
    )
    assert "right: change the sign of `w`, wherever it stands" in found
