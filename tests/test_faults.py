"""The test-suite is tested: each fault of faults.py, put in on purpose, must be noticed.

A copy of the package gets one wrong line, and the tests of physics and those against an outside oracle
run on it, not the ones that compare the package with itself or its examples. One of them must fail.
"""

import ast
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from .faults import FAULTS, Fault

ROOT = Path(__file__).parents[1]
# Closed forms and invariants first: they are quick, and need no Pinocchio.
PHYSICS_AND_ORACLES = [
    "test_physics.py",
    "test_textbook.py",
    "test_floating_base.py",
    "test_joint.py",
    "test_random_trees.py",
    "test_rotation.py",
    "test_exponential.py",
    "test_plucker.py",
    "test_inertia.py",
    "test_urdf.py",
    "test_simulation.py",
    "test_newton_euler_3d.py",
    "test_contact_dynamics.py",
    "test_contact_impacts.py",
    "test_contact_friction.py",
    "test_reduction.py",
    "test_scene.py",
    "test_templates.py",
    "test_motions.py",
    "test_accuracy.py",
    "test_extremes.py",
    "test_terms.py",
]
TESTED_BY = {"digits": "accuracy", "fast": "extremes"}
"""Sections whose tests go by another name."""


def run_on_copy(folder: Path, fault: Fault | None) -> subprocess.CompletedProcess[str]:
    package = folder / "twistwrench"
    shutil.copytree(ROOT / "src/twistwrench", package)  # with its __pycache__: but for one file it is still true
    shutil.copytree(ROOT / "models", package / "models", dirs_exist_ok=True)
    if fault:
        file = package / fault.file
        file.write_text(file.read_text(encoding="utf-8").replace(fault.right, fault.wrong), encoding="utf-8")
    section = fault.file.split("/")[0].removesuffix(".py") if fault else ""
    nearest_first = sorted(PHYSICS_AND_ORACLES, key=lambda name: TESTED_BY.get(section, section) not in name)
    first = run_tests(folder, nearest_first[:3])  # most faults need no more
    return first if first.returncode else run_tests(folder, nearest_first[3:])


def run_tests(folder: Path, names: list[str]) -> subprocess.CompletedProcess[str]:
    tests = [str(ROOT / "tests" / name) for name in names]
    options = ["-x", "-q", "-m", "not slow", "-p", "no:cacheprovider", "-p", "no:xdist"]
    options += ["--hypothesis-profile=no_shrinking"]  # that it fails is all that is asked
    return subprocess.run(
        [sys.executable, "-m", "pytest", "-o", "addopts=--import-mode=importlib", *options, *tests],
        cwd=ROOT,
        env=os.environ | {"PYTHONPATH": str(folder), "HYPOTHESIS_STORAGE_DIRECTORY": str(folder / "hypothesis")},
        capture_output=True,
        text=True,
        check=False,
    )


def test_each_fault_changes_one_line_of_the_source():
    for fault in FAULTS:
        text = (ROOT / "src/twistwrench" / fault.file).read_text(encoding="utf-8")
        assert text.count(fault.right) == 1, f"{fault.slip}: found {text.count(fault.right)} times in {fault.file}"
        assert fault.wrong != fault.right, fault.slip
    assert len({fault.slip for fault in FAULTS}) == len(FAULTS) >= 30


def test_a_fault_is_a_slip_and_no_misspelling():
    """A line with a name that its file does not know would be noticed by any test."""
    for fault in FAULTS:
        text = (ROOT / "src/twistwrench" / fault.file).read_text(encoding="utf-8")
        if fault.right in [line.strip() for line in text.splitlines()]:
            used = {node.id for node in ast.walk(ast.parse(textwrap.dedent(fault.wrong))) if isinstance(node, ast.Name)}
            assert used <= set(re.findall(r"\w+", text)), fault.slip


@pytest.mark.slow
def test_the_copy_without_a_fault_passes(tmp_path):
    run = run_on_copy(tmp_path, None)
    assert run.returncode == 0, run.stdout


@pytest.mark.slow
@pytest.mark.parametrize("fault", FAULTS, ids=lambda fault: f"{fault.file}: {fault.slip}")
def test_fault_is_noticed(fault, tmp_path):
    run = run_on_copy(tmp_path, fault)
    assert run.returncode == 1, f"nothing noticed {fault.slip!r}\n{run.stdout[-2000:]}{run.stderr[-2000:]}"
