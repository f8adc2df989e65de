"""Examples in docstrings that run Pinocchio are skipped, with a reason, where it is not installed."""

import importlib.util
from pathlib import Path

import pytest

BRIDGE = Path(__file__).parent / "src" / "twistwrench" / "bridge"
RUN_PINOCCHIO = [(BRIDGE / name).resolve(strict=True) for name in ("objects.py", "model.py")]  # must exist


def pytest_collection_modifyitems(items):
    """Mark the doctests of the modules above."""
    if importlib.util.find_spec("pinocchio") is None:
        skip = pytest.mark.skip(reason="Pinocchio is not installed: its examples are skipped")
        for item in items:
            if item.path in RUN_PINOCCHIO:
                item.add_marker(skip)
