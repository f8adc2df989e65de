"""Examples in docstrings that run Pinocchio or MuJoCo are skipped, with a reason, where it is not installed."""

import importlib.util
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
