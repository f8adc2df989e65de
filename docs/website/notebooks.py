"""The notebooks with their outputs: each is run once, and again when its code or ours has changed.

Both languages are run: the words of figures and of what is printed are in the language of the page. A result is kept
under the hash of what it depends on: the code cells, the package's source, its robots, and the versions of what draws
and computes. (jupyter-cache looks at the code cells alone, and would show old numbers.)
"""

from __future__ import annotations

import hashlib
import importlib.util
import itertools
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from importlib.metadata import version
from pathlib import Path
from types import ModuleType

import nbformat

from . import figures
from .pages import ROOT, write


def builder() -> ModuleType:
    """Return notebooks/build.py, which knows the notebooks and their order."""
    return _script("build")


def _script(name: str) -> ModuleType:
    """Return a script of notebooks/."""
    spec = importlib.util.spec_from_file_location(f"notebooks_{name}", ROOT / "notebooks" / f"{name}.py")
    if spec is None or spec.loader is None:
        raise ImportError(f"notebooks/{name}.py cannot be imported")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def names() -> list[str]:
    """Return the names of the notebooks, in the chapter's order."""
    build = builder()
    return [build.target(source, "en").stem for source in build.sources()]


def common_key() -> str:
    """Return a hash of everything but the notebook that an output depends on."""
    digest = hashlib.sha256(sys.version.encode())
    for package in ("numpy", "matplotlib", "nbclient", "ipykernel"):
        digest.update(version(package).encode())
    for path in sorted([*(ROOT / "src").rglob("*.py"), *(ROOT / "models").glob("*.urdf")]):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def key(notebook: nbformat.NotebookNode, common: str) -> str:
    """Return the hash under which the result of a notebook is kept."""
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    return hashlib.sha256("\0".join([common, *code]).encode()).hexdigest()[:32]


def execute(path: Path, result: Path) -> Path:
    """Run a notebook in an empty folder and keep the outputs of its code cells."""
    whole = result.with_name(f"{path.parent.name}-{result.name}")
    nbformat.write(_script("execute").run(path), whole)
    whole.replace(result)  # a reader finds all of it or nothing
    return result


def kept(path: Path, cache: Path, common: str) -> Path:
    """Return where the result of a notebook is kept, or will be."""
    return cache / f"{path.stem}-{key(nbformat.read(path, as_version=4), common)}.ipynb"


def run_before(path: Path, cache: Path) -> Path | None:
    """Return the last result of a notebook with the same code, whatever the package was then."""

    def code(file: Path) -> list[str]:
        return [cell.source for cell in nbformat.read(file, as_version=4).cells if cell.cell_type == "code"]

    there = sorted(cache.glob(f"{path.stem}-*.ipynb"), key=lambda file: file.stat().st_mtime, reverse=True)
    return next((file for file in there if code(file) == code(path)), None)


def write_notebooks(out: dict[str, Path], cache: Path, draft: bool = False) -> None:
    """Write the notebooks with their outputs into the trees of the languages; a draft takes those of `run_before`."""
    cache.mkdir(parents=True, exist_ok=True)
    common = common_key()
    waiting, results = {}, {}
    for language, name in itertools.product(out, names()):
        path = ROOT / "notebooks" / language / f"{name}.ipynb"
        results[path] = (run_before(path, cache) if draft else None) or kept(path, cache, common)
        if not results[path].exists():
            waiting[path] = results[path]
    with ProcessPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        list(pool.map(execute, waiting, waiting.values()))
    for path, result in results.items():
        done = with_outputs(nbformat.read(path, as_version=4), nbformat.read(result, as_version=4))
        write(out[path.parent.name] / "chapter" / path.name, nbformat.writes(figures.with_words(linked(done))))


def linked(notebook: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Make links of the names by which a notebook calls pages that only the site has."""
    for cell in notebook.cells:
        for name, link in cell.metadata.get("site", {}).items():
            cell.source = cell.source.replace(name, link)
    return notebook


def with_outputs(notebook: nbformat.NotebookNode, done: nbformat.NotebookNode) -> nbformat.NotebookNode:
    """Give a notebook the outputs of another with the same code cells, whose text may have changed since."""
    ours, theirs = ([c for c in n.cells if c.cell_type == "code"] for n in (notebook, done))
    if [c.source for c in ours] != [c.source for c in theirs]:
        raise ValueError("the outputs belong to a notebook with different code")
    for cell, other in zip(ours, theirs, strict=True):
        cell.outputs, cell.execution_count = other.outputs, other.execution_count
    return notebook
