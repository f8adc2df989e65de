"""`misstep` knows no robot, and each of its files only those above it in the table."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2] / "src" / "misstep"
FILES = sorted(path.relative_to(ROOT).as_posix() for path in ROOT.rglob("*.py"))


def tree(file):
    return ast.parse((ROOT / file).read_text(encoding="utf-8"))


def imports(file):
    """Yield the modules that a file imports when it runs: of misstep from its root, of others as they are named."""
    waiting = [tree(file)]
    while waiting:
        node = waiting.pop()
        waiting += [
            x for x in ast.iter_child_nodes(node) if "TYPE_CHECKING" not in ast.unparse(getattr(x, "test", x))[:13]
        ]
        if isinstance(node, ast.Import):
            yield from ([alias.name] for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = [*(["misstep"] if node.level else []), *(node.module or "").split(".")]
            yield from ([*module, alias.name] for alias in node.names)


@pytest.mark.parametrize("file", FILES)
def test_nothing_of_twistwrench_is_imported_or_named(file):
    assert not [x for x in imports(file) if ".".join(x).startswith("twistwrench")]
    assert "twistwrench" not in (ROOT / file).read_text(encoding="utf-8")


def test_the_table_has_all_files_in_the_order_of_their_imports():
    docstring = ast.get_docstring(tree("__init__.py")) or ""
    table = re.findall(r"^(\w+) +", docstring.split("==\n")[2], flags=re.MULTILINE)
    names = [file.removesuffix(".py") for file in FILES if file != "__init__.py"]
    assert sorted(names) == sorted(table)
    later = [
        (name, read)
        for name in names
        for read in imports(f"{name}.py")
        if read[0] == "misstep" and len(read) > 1 and table.index(read[1]) > table.index(name)
    ]
    assert later == []
