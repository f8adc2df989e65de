"""The scripts that make the numbers and the pictures of the documents still find what they import and call."""

import importlib.util
import os
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = sorted([*(ROOT / "benchmarks").glob("*.py"), *(ROOT / "docs/pictures").glob("*.py")])


def script(path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Import a script; what it sets in the environment ends with the test."""
    monkeypatch.setattr(os, "environ", os.environ.copy())
    monkeypatch.syspath_prepend(str(path.parent))
    spec = importlib.util.spec_from_file_location(f"script_{path.stem}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)  # dataclasses look themselves up there
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_a_script_finds_what_it_imports(path, monkeypatch):
    try:
        script(path, monkeypatch)
    except ModuleNotFoundError as missing:
        if (missing.name or "").startswith("twistwrench"):
            raise
        pytest.skip(f"{missing.name} is not installed")
