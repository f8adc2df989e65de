"""Examples in docstrings that run Pinocchio are skipped, with a reason, where it is not installed."""

import importlib.util

import pytest

RUN_PINOCCHIO = ("bridge/objects.py", "bridge/handover.py")


def pytest_collection_modifyitems(items):
    """Mark the doctests of the modules above."""
    if importlib.util.find_spec("pinocchio") is None:
        skip = pytest.mark.skip(reason="Pinocchio is not installed: its examples are skipped")
        for item in items:
            if item.path.as_posix().endswith(RUN_PINOCCHIO):
                item.add_marker(skip)
