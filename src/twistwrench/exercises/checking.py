"""The pytest plugin that a student's folder names in its pytest.ini."""

import pytest

from misstep.plugin import (
    configure,
    pytest_addoption,
    pytest_collect_file,
    pytest_pycollect_makemodule,
    pytest_terminal_summary,
    pytest_unconfigure,
)

from .chapter import COURSE

__all__ = [
    "pytest_addoption",
    "pytest_collect_file",
    "pytest_configure",
    "pytest_pycollect_makemodule",
    "pytest_terminal_summary",
    "pytest_unconfigure",
]


def pytest_configure(config: pytest.Config) -> None:
    """Check the chapter's exercises."""
    configure(config, COURSE)
