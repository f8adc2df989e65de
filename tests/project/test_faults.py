"""The test-suite is tested: each fault of faults.py, put in on purpose, must be noticed.

A copy of the package gets one wrong line, and the tests of physics and those against an outside oracle
run on it, not the ones that compare the package with itself or its examples. One of them must fail.
"""

import ast
import json
import re
import shutil
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from ..faults import FAULTS, Fault
from ..sampling import sampled

ROOT = Path(__file__).parents[2]
# Closed forms and invariants first: they are quick, and need no Pinocchio.
PHYSICS_AND_ORACLES = [
    "algorithms/test_kinematics.py",
    "algorithms/test_points.py",
    "algorithms/test_rnea.py",
    "algorithms/test_aba.py",
    "algorithms/test_crba.py",
    "algorithms/test_coriolis.py",
    "algorithms/test_energy.py",
    "algorithms/test_floating_base.py",
    "algorithms/test_centroidal.py",
    "algorithms/test_factorization.py",
    "algorithms/test_inverse_mass.py",
    "algorithms/test_delassus.py",
    "algorithms/test_momentum_rate.py",
    "algorithms/test_subtree.py",
    "algorithms/test_every_algorithm.py",
    "model/test_joint.py",
    "model/test_manifold.py",
    "algorithms/test_random_trees.py",
    "spatial/test_rotation.py",
    "spatial/test_roll_pitch_yaw.py",
    "spatial/test_exponential.py",
    "spatial/test_jacobians.py",
    "spatial/test_plucker.py",
    "spatial/test_inertia.py",
    "spatial/test_ten_numbers.py",
    "spatial/test_screws.py",
    "model/test_serial.py",
    "spatial/test_shapes.py",
    "loading/test_urdf.py",
    "simulation/test_simulation.py",
    "simulation/test_ground.py",
    "simulation/test_standing_program.py",
    "newton_euler_3d/test_newton_euler_3d.py",
    "contact/test_contact_programs.py",
    "contact/test_contact_dynamics.py",
    "contact/test_contact_impacts.py",
    "contact/test_contact_friction.py",
    "contact/test_loops.py",
    "contact/test_distances.py",
    "model/test_reduction.py",
    "scene/test_scene.py",
    "templates/test_templates.py",
    "motions/test_motions.py",
    "test_accuracy.py",
    "study/test_extremes.py",
    "algorithms/test_terms.py",
]
TESTED_BY = {
    "cross": "inertia",
    "formulas": "aba",
    "tree": "kinematics",
    "joints": "joint",
    "error_bounds": "accuracy",
    "_vector": "screws",
    "wrench": "screws",
    "relative": "loops",
    "closures": "distances",
    "articulated": "inverse_mass",
    "cones": "ground",
    "coulomb": "ground",
    "stepping": "ground",
    "sticking": "standing",
    "programs": "contact_programs",
}
"""Files and folders of the source whose tests go by another name."""


def distance(test: str, file: str) -> int:
    """Return 0 where tests have the name of a file of the source, 1 where that of its folder, and so on outward."""
    *folders, stem = Path(file).with_suffix("").parts
    names = [TESTED_BY.get(name, name) for name in (stem, *reversed(folders))]
    words = Path(test).with_suffix("").parts  # of a file of tests, and of its folder where it lies in one
    near = (k for k, name in enumerate(names) if any(w == name or w.startswith(f"test_{name}") for w in words))
    return min(near, default=len(names))


def nearest(file: str) -> list[str]:
    """Return the files of tests, those nearest to a file of the source first."""
    return sorted(PHYSICS_AND_ORACLES, key=lambda test: distance(test, file))


def copy(folder: Path, fault: Fault | None) -> list[str]:
    """Put a copy of the package into a folder, with a fault, and return the tests that might notice it."""
    package = folder / "twistwrench"
    shutil.copytree(ROOT / "src/twistwrench", package)  # with its __pycache__: but for one file it is still true
    shutil.copytree(ROOT / "models", package / "models", dirs_exist_ok=True)
    if fault is None:
        return PHYSICS_AND_ORACLES[:10]  # all of them pass where the source lies
    file = package / fault.file
    file.write_text(file.read_text(encoding="utf-8").replace(fault.right, fault.wrong), encoding="utf-8")
    return nearest(fault.file)


@pytest.fixture(scope="module")
def run_tests() -> Iterator[Callable[[Path, list[str]], tuple[int, str]]]:
    """Run files of tests on the copy in a folder; the exit code, and what pytest printed."""
    command = [sys.executable, "-P", str(ROOT / "tests/project/rehearsed.py")]
    options = ["-o", "addopts=--import-mode=importlib", "-x", "-q", "-m", "not slow"]
    options += ["-p", "no:cacheprovider", "-p", "no:xdist"]
    options += ["--hypothesis-profile=no_shrinking"]  # that it fails is all that is asked
    options += ["-W", "ignore:Module already imported"]  # hypothesis, before pytest began
    with subprocess.Popen(command, cwd=ROOT, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as rehearsed:

        def run(folder: Path, names: list[str]) -> tuple[int, str]:
            printed = folder / "printed.txt"
            tests = [str(ROOT / "tests" / name) for name in names]
            print(json.dumps([str(folder), str(printed), options + tests]), file=rehearsed.stdin, flush=True)
            return int(rehearsed.stdout.readline()), printed.read_text(encoding="utf-8")

        yield run
        rehearsed.stdin.close()


def test_each_fault_changes_one_line_of_the_source():
    for fault in FAULTS:
        text = (ROOT / "src/twistwrench" / fault.file).read_text(encoding="utf-8")
        assert text.count(fault.right) == 1, f"{fault.slip}: found {text.count(fault.right)} times in {fault.file}"
        assert fault.wrong != fault.right, fault.slip
    assert len({fault.slip for fault in FAULTS}) == len(FAULTS) >= 30


@pytest.mark.parametrize("name", PHYSICS_AND_ORACLES)
def test_the_tests_that_should_notice_are_there(name):
    assert (ROOT / "tests" / name).is_file()  # else pytest ends before the first test, which notices nothing


def test_a_fault_is_a_slip_and_no_misspelling():
    """A line with a name that its file does not know would be noticed by any test."""
    for fault in FAULTS:
        text = (ROOT / "src/twistwrench" / fault.file).read_text(encoding="utf-8")
        if fault.right in [line.strip() for line in text.splitlines()]:
            used = {node.id for node in ast.walk(ast.parse(textwrap.dedent(fault.wrong))) if isinstance(node, ast.Name)}
            assert used <= set(re.findall(r"\w+", text)), fault.slip


@pytest.mark.parametrize("file", sorted({fault.file for fault in FAULTS}))
def test_a_fault_meets_the_tests_of_its_own_file_first(file):
    assert distance(nearest(file)[0], file) < len(Path(file).parts), f"{file}: which of the tests are its own?"


@pytest.mark.parametrize(
    ("file", "tests"),
    [
        ("algorithms/rnea.py", "test_rnea"),
        ("algorithms/aba.py", "test_aba"),
        ("algorithms/crba.py", "test_crba"),
        ("algorithms/centroidal.py", "test_centroidal"),
        ("contact/forward.py", "test_contact_"),
    ],
)
def test_the_tests_of_an_algorithm_bear_its_name(file, tests):
    assert Path(nearest(file)[0]).stem.startswith(tests)


@pytest.mark.slow
def test_the_copy_without_a_fault_passes(tmp_path, run_tests):
    code, printed = run_tests(tmp_path, copy(tmp_path, None))
    assert code == 0, printed


@pytest.mark.parametrize("fault", sampled(FAULTS, 0, draw=3), ids=lambda fault: f"{fault.file}: {fault.slip}")
def test_fault_is_noticed(fault, tmp_path, run_tests):
    tests = copy(tmp_path, fault)
    code, printed = run_tests(tmp_path, tests[:3])  # most faults need no more
    if code == 0:
        code, printed = run_tests(tmp_path, tests[3:])
    assert code == 1, f"nothing noticed {fault.slip!r}\n{printed[-2000:]}"
