"""Running a page in the page: the runtime's files beside the site, and what the pages say of it.

The files come as scripts with their content in base64: a page that is read from the file system may load a script, but
not fetch a file. One folder serves both languages. Where the runtime was not gathered (`python docs/runtime.py`), the
pages have no buttons, and say how to get them.
"""

from __future__ import annotations

import base64
import gzip
import io
import json
import shutil
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import runtime

from .pages import ROOT, write

RUN = Path(__file__).resolve().parent / "run"
GROUPS = ("base", "matplotlib", "sympy")
"""Those of `runtime.GROUPS` that pages use."""
EXERCISES = "chapter/exercises"
LICENCE = f"""Pyodide {runtime.VERSION}, under the Mozilla Public License 2.0; its source is where the npm package says.
The other packages carry their licences inside.
"""

SAY = {
    "en": {
        "runs": "This page runs in your browser: change a cell, and run it. Python is loaded with the first click"
        " ({size} MB), and what you change stays in this browser.",
        "not here": "This copy of the site was built without Python in the page: <code>python docs/runtime.py</code>"
        " gets it, and <code>python docs/build.py</code> then adds the buttons.",
        "notebook": "Download this notebook",
        "answer": "Answer here",
    },
    "zh": {
        "runs": "本页可在浏览器中运行：改动单元，然后运行。第一次点击时载入 Python（{size} MB），"
        "所作改动保存在此浏览器中。",
        "not here": "本站点构建时未带页内 Python：先运行 <code>python docs/runtime.py</code>，再运行"
        " <code>python docs/build.py</code>，页面上就有按钮。",
        "notebook": "下载本笔记本",
        "answer": "在此作答",
    },
}


def package() -> bytes:
    """Return this package and the classroom as a ZIP file, to be unpacked where packages are."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for folder, name in ((ROOT / "src", ""), (ROOT / "models", "twistwrench/models/"), (RUN, "")):
            for path in sorted(folder.rglob("*")):
                if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".js":
                    info = zipfile.ZipInfo(name + path.relative_to(folder).as_posix())
                    packed.writestr(info, path.read_bytes(), zipfile.ZIP_DEFLATED)
    return content.getvalue()


def files() -> Iterator[tuple[str, str, bytes]]:
    """Yield the group, the name and the content of each file of the runtime."""
    yield "worker", "worker.js", (RUN / "worker.js").read_bytes()
    for name in runtime.CORE[:3]:
        yield "core", f"{name}.gz", gzip.compress((runtime.FOLDER / name).read_bytes(), mtime=0)
    yield "core", runtime.CORE[3], (runtime.FOLDER / runtime.CORE[3]).read_bytes()
    info = json.loads((runtime.FOLDER / runtime.CORE[4]).read_text(encoding="utf-8"))["info"]
    yield "core", "lock.json", json.dumps({"info": info, "packages": {}}).encode()
    yield "base", "twistwrench.zip", package()
    for group in GROUPS:
        for wheel in runtime.wheels(runtime.FOLDER, group):
            yield group, wheel.name, wheel.read_bytes()


def write_runtime(html: Path) -> None:
    """Write the runtime beside the pages of both languages, or take it away where it was not gathered."""
    target = html / "runtime"
    if not runtime.is_complete():
        shutil.rmtree(target, ignore_errors=True)
        return
    sizes: dict[str, list[tuple[str, int]]] = {}
    for group, name, content in files():
        text = base64.b64encode(content).decode()
        write(target / f"{name}.js", f'twistwrenchFile("{name}","{text}");\n')
        sizes.setdefault(group, []).append((name, len(text)))
    write(target / "groups.js", f"twistwrenchGroups({json.dumps(sizes)});\n")
    write(target / "licence.txt", LICENCE)


def write_downloads(html: Path, languages: Sequence[str], names: list[str]) -> None:
    """Write the notebooks, as they are kept, where the pages' links lead."""
    for language in languages:
        for name in names:
            source = ROOT / "notebooks" / language / f"{name}.ipynb"
            write(html / language / "chapter" / f"{name}.ipynb", source.read_text(encoding="utf-8"))


def connect(app: Any, language: str, notebooks: list[str]) -> None:
    """Add the bar, and the script behind it, to the pages that have something to run."""
    here, said = runtime.is_complete(), SAY[language]
    sizes = [(group, len(content) * 4 / 3) for group, _, content in files()] if here else []  # in base64

    def add(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
        folder, _, name = page.rpartition("/")
        is_notebook = folder == "chapter" and name in notebooks
        if not (page == EXERCISES or is_notebook):
            return
        wanted = ("core", "base", "matplotlib")[: 3 if is_notebook else 2]
        size = sum(size for group, size in sizes if group in wanted) / 1e6
        text = said["runs"].format(size=f"{size:.0f}") if here else said["not here"]
        link = f'<a href="{name}.ipynb" download>{said["notebook"]}</a>' if is_notebook else ""
        bar = f'<div class="run-note"><p>{text} {link}</p><div class="run-bar{" waits" * here}"></div></div>'
        context["body"] = context["body"].replace("</h1>", f"</h1>\n{bar}", 1)
        if here:
            app.add_js_file("run.js")

    app.connect("html-page-context", add)
