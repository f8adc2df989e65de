"""For the tests and for the examples in docstrings: what is not installed is skipped, what was checked is forgotten."""

import importlib.util
import sys
from pathlib import Path

import pytest

BRIDGE = Path(__file__).parent / "src" / "twistwrench" / "bridge"
RUN = {"objects.py": "pinocchio", "model.py": "pinocchio", "mujoco.py": "mujoco"}
NEEDS = {(BRIDGE / file).resolve(strict=True): package for file, package in RUN.items()}  # must exist


def pytest_collection_modifyitems(items):
    """Mark the doctests of the modules above."""
    for item in items:
        package = NEEDS.get(item.path)
        if package is not None and importlib.util.find_spec(package) is None:
            item.add_marker(pytest.mark.skip(reason=f"{package} is not installed: its examples are skipped"))


@pytest.fixture(autouse=True)
def _nothing_was_checked():
    """Forget what earlier tests have checked in this process, on which hints depend."""
    chapter = sys.modules.get("twistwrench.exercises.chapter")
    if chapter is not None:
        session = chapter.COURSE.session
        session.language = None
        session.verdicts.clear()
        session.hints.clear()
