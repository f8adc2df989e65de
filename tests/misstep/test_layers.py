"""`misstep` knows no robot, and each of its files only those above it in the table."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2] / "src" / "misstep"
FILES = sorted(path.relative_to(ROOT).as_posix() for path in ROOT.rglob("*.py"))
ROOMS = ("", "folder", "processes", "notebook", "grading")


def tree(file):
    return ast.parse((ROOT / file).read_text(encoding="utf-8"))


def imports(file):
    """Yield the modules that a file imports when it runs: of misstep from its root, of others as they are named."""
    package = file.split("/")[:-1]
    waiting = [tree(file)]
    while waiting:
        node = waiting.pop()
        waiting += [
            x for x in ast.iter_child_nodes(node) if "TYPE_CHECKING" not in ast.unparse(getattr(x, "test", x))[:13]
        ]
        if isinstance(node, ast.Import):
            yield from ([alias.name] for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = ["misstep", *package[: len(package) + 1 - node.level]] if node.level else []
            module = [*base, *(node.module or "").split(".")]
            yield from ([*module, alias.name] for alias in node.names)


@pytest.mark.parametrize("file", FILES)
def test_nothing_of_twistwrench_is_imported_or_named(file):
    assert not [x for x in imports(file) if ".".join(x).startswith("twistwrench")]
    assert "twistwrench" not in (ROOT / file).read_text(encoding="utf-8")


@pytest.mark.parametrize("room", ROOMS)
def test_the_table_of_a_room_has_all_files_in_the_order_of_their_imports(room):
    docstring = ast.get_docstring(tree(f"{room}/__init__.py".lstrip("/"))) or ""
    table = re.findall(r"^(\w+) +", docstring.split("==\n")[2], flags=re.MULTILINE)
    depth = len([x for x in room.split("/") if x])
    inside = [file for file in FILES if file.startswith(room) and file != f"{room}/__init__.py".lstrip("/")]
    names = {file.split("/")[depth].removesuffix(".py") for file in inside} - {"__init__"}
    assert sorted(names) == sorted(table)
    path = ["misstep", *[x for x in room.split("/") if x]]
    later = [
        (file, read)
        for file in inside
        for read in imports(file)
        if read[: len(path)] == path and len(read) > len(path) and read[len(path)] in table
        if table.index(read[len(path)]) > table.index(file.split("/")[depth].removesuffix(".py"))
    ]
    assert later == []
