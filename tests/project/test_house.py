"""The rules of the house, read off the source: which section may know which, and how it is documented."""

import ast
import re
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest

from misstep.domains import Domain

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "twistwrench"
PACKAGES = ("straightline",)  # that know no robot: each counts as a room here
TEXT = {
    p.relative_to(root).as_posix(): p.read_text(encoding="utf-8")
    for root, below in ((SOURCE, SOURCE), *((ROOT / "src", ROOT / "src" / package) for package in PACKAGES))
    for p in sorted(below.rglob("*.py"))
}
TREES = {name: ast.parse(text) for name, text in TEXT.items()}

ORDER = [
    *("errors", "tables", "arrays", "newton_euler_3d", "spatial", "model", "algorithms"),
    *("straightline", "fast", "error_bounds", "identification", "tracing", "loading", "plot"),
    *("files", "stopping", "options", "timing", "contact", "simulation", "motions", "templates", "scene"),
    *("bridge", "viewing", "__init__", "validate", "step_choice", "advice", "exercises", "cli", "__main__"),
]
"""The rooms, the chapter's first. A room imports from earlier ones only."""

BOOK = ORDER[: ORDER.index("straightline")]

WITH_TABLE = ("arrays", "spatial", "model", "algorithms", "straightline", "fast", "exercises")
"""The rooms whose `__init__` has a table of their files: there each file imports only from those above it."""

Function = ast.FunctionDef | ast.AsyncFunctionDef


def section(file: str) -> str:
    """Return the room that a file belongs to."""
    return file.split("/")[0].removesuffix(".py")


def table(room: str) -> list[str]:
    """Return the files of a room in the order of the table in its `__init__`."""
    docstring = ast.get_docstring(TREES[f"{room}/__init__.py"]) or ""
    return re.findall(r"^(\w+) +", docstring.split("==\n")[2], flags=re.MULTILINE)


def imports(file: str) -> Iterator[tuple[str, list[str]]]:
    """Yield place and module of every import of our own that is made when the code runs, ``["model", "link"]``."""
    package = [*([] if section(file) in PACKAGES else ["twistwrench"]), *Path(file).parts[:-1]]
    for node in at_run_time(TREES[file]):
        if isinstance(node, ast.Import):
            targets = [alias.name.split(".") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) + 1 - node.level] if node.level else []
            module = [*base, *(node.module.split(".") if node.module else [])]
            targets = [
                [*module, a.name] if module == ["twistwrench"] or is_file(below([*module, a.name])) else module
                for a in node.names
            ]
        else:
            continue
        for target in targets:
            if target[0] in ("twistwrench", *PACKAGES):
                yield f"{file}:{node.lineno}", below(target) or ["__init__"]


def below(module: list[str]) -> list[str]:
    """Return the room of a module and what follows."""
    return module[1:] if module[0] == "twistwrench" else module


def is_file(module: list[str]) -> bool:
    """Whether a module is a file or a folder."""
    return any("/".join(module) + end in TREES for end in (".py", "/__init__.py"))


def at_run_time(node: ast.AST) -> Iterator[ast.AST]:
    """Walk a tree without what is there for type checkers only."""
    yield node
    for child in ast.iter_child_nodes(node):
        if not (isinstance(child, ast.If) and ast.unparse(child.test) == "TYPE_CHECKING"):
            yield from at_run_time(child)


def functions(file: str) -> Iterator[tuple[str, Function, ast.ClassDef | None]]:
    """Yield every function with its place, and with the class that it is a method of."""
    for node in ast.walk(TREES[file]):
        for child in ast.iter_child_nodes(node):
            if isinstance(child, Function):
                yield f"{file}:{child.lineno} {child.name}", child, node if isinstance(node, ast.ClassDef) else None


def code(function: Function) -> list[ast.stmt]:
    """Return the statements of a function without its docstring."""
    return function.body[1:] if ast.get_docstring(function) is not None else function.body


def arguments(function: Function) -> list[str]:
    """Return the names of a function's arguments."""
    a = function.args
    every = [*a.posonlyargs, *a.args, *a.kwonlyargs, *([a.vararg] if a.vararg else []), *([a.kwarg] if a.kwarg else [])]
    return [arg.arg for arg in every if arg.arg not in ("self", "cls")]


def abstract(function: Function) -> bool:
    return any(isinstance(d, ast.Name) and d.id in ("abstractmethod", "overload") for d in function.decorator_list)


def offered(file: str) -> set[str]:
    """Return what a file offers: its ``__all__``."""
    for node in TREES[file].body:
        if (
            isinstance(node, ast.Assign)
            and ast.unparse(node.targets[0]) == "__all__"
            and isinstance(node.value, ast.List)
        ):
            return set(ast.literal_eval(node.value))
    return set()


# ---------------------------------------------------------------- who may know whom


def test_every_file_belongs_to_a_room():
    assert sorted({section(file) for file in TREES} - set(ORDER)) == []


def test_imports_point_to_earlier_rooms():
    later = [
        f"{place} imports {'.'.join(read)}"
        for file in TREES
        for place, read in imports(file)
        if read[0] != section(file) and read[0] not in ORDER[: ORDER.index(section(file))]
    ]
    assert later == []


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_that_knows_no_robot_imports_itself_alone(package):
    names = [
        name
        for file, tree in TREES.items()
        if section(file) == package
        for node in ast.walk(tree)
        for name in ([a.name for a in node.names] if isinstance(node, ast.Import) else [getattr(node, "module", None)])
        if isinstance(node, ast.Import) or (isinstance(node, ast.ImportFrom) and not node.level)
    ]
    others = {name.split(".")[0] for name in names} - sys.stdlib_module_names
    assert others <= {"numpy", "llvmlite", "mpmath", package}
    assert all(read[0] == package for file in TREES if section(file) == package for _, read in imports(file))


def test_the_book_knows_none_of_its_tools():
    reads = {read[0] for file in TREES if section(file) in BOOK for _, read in imports(file)}
    assert reads <= {*BOOK}


def files_of(room: str) -> list[str]:
    """Return the files of a room, those of its sub-rooms among them."""
    return [file for file in TREES if file.startswith(f"{room}/") and file != f"{room}/__init__.py"]


def part(file: str, room: str) -> str:
    """Return the file or sub-room of a room that a file belongs to."""
    return file.removeprefix(f"{room}/").split("/")[0].removesuffix(".py")


@pytest.mark.parametrize("room", WITH_TABLE)
def test_the_table_of_a_room_names_all_its_files(room):
    assert sorted(table(room)) == sorted({part(file, room) for file in files_of(room)})


@pytest.mark.parametrize("room", WITH_TABLE)
def test_in_a_room_with_a_table_imports_point_to_earlier_files(room):
    order, path = table(room), room.split("/")
    later = [
        f"{place} imports {'.'.join(read)}"
        for file in files_of(room)
        for place, read in imports(file)
        if read[: len(path)] == path
        if len(read) == len(path)
        or order.index(read[len(path)]) > order.index(part(file, room))
        or (read[len(path)] == part(file, room) and f"{room}/{part(file, room)}.py" == file)
    ]
    assert later == []


def test_the_docstring_of_a_room_names_no_file_that_is_gone():
    defined = {
        node.name for tree in TREES.values() for node in ast.walk(tree) if isinstance(node, Function | ast.ClassDef)
    }
    gone = [
        f"{file}: {name}"
        for file, tree in TREES.items()
        if file.endswith("/__init__.py")
        for name in re.findall(r"(?<!`)`([a-z]\w*)`(?!`)", ast.get_docstring(tree) or "")
        if not any(f"{Path(file).parent.as_posix()}/{name}{end}" in TREES for end in (".py", "/__init__.py"))
        if name not in defined
    ]
    assert gone == []


def test_the_slow_obvious_way_shares_no_spatial_algebra():
    reads = {read[0] for file in TREES if section(file) == "newton_euler_3d" for _, read in imports(file)}
    assert reads <= {"errors", "arrays", "newton_euler_3d"}


def swaps_order(node: ast.AST) -> bool:
    """Whether an expression puts entries 3 to 5 of something before its entries 0 to 2."""
    if isinstance(node, ast.Call) and re.fullmatch(r"np\.roll\(.+,-?3(,.*)?\)", ast.unparse(node).replace(" ", "")):
        return True
    if not isinstance(node, ast.List | ast.Tuple):
        return False
    parts = [ast.unparse(part).replace(" ", "") for part in node.elts]
    if parts == list("345012"):
        return True
    halves = [re.fullmatch(r"(.+)\[(.*,)?(0?:3|3:6?)\]", part) for part in parts]
    return any(
        a and b and a[1] == b[1] and a[2] == b[2] and a[3][0] == "3" and b[3][0] != "3" for a, b in pairwise(halves)
    )


@pytest.mark.parametrize(
    ("expression", "swaps"),
    [
        ("np.concatenate([V[..., 3:], V[..., :3]], axis=-1)", True),
        ("np.concatenate((V[3:6], V[0:3]))", True),
        ("np.stack([V[..., 3:6], V[..., 0:3]])", True),
        ("V[..., [3, 4, 5, 0, 1, 2]]", True),
        ("np.roll(V, 3, axis=-1)", True),
        ("np.concatenate([V[..., :3], V[..., 3:]])", False),
        ("np.concatenate([q[..., 3:], p[..., :3]])", False),
        ("np.roll(V, 1)", False),
    ],
)
def test_a_swap_of_order_is_recognised(expression, swaps):
    assert any(map(swaps_order, ast.walk(ast.parse(expression)))) == swaps


def test_only_the_bridge_swaps_order():
    swaps = [
        f"{file}:{node.lineno} {ast.unparse(node)}"
        for file, tree in TREES.items()
        if section(file) != "bridge"
        for node in ast.walk(tree)
        if swaps_order(node)
    ]
    assert swaps == []


# ---------------------------------------------------------------- how the code is written


def names(function: Function) -> set[str]:
    """Return the names in the code of a function."""
    return {node.id for statement in code(function) for node in ast.walk(statement) if isinstance(node, ast.Name)}


def test_no_argument_is_accepted_and_unused():
    """A method that fills in an abstract one, or one of a domain, has its signature from there."""
    fixed = {function.name for file in TREES for _, function, owner in functions(file) if owner and abstract(function)}
    fixed |= {*vars(Domain)}
    unused = [
        f"{place}({argument})"
        for file in TREES
        for place, function, owner in functions(file)
        if not abstract(function) and not (owner and (function.name in fixed or function.name.startswith("__")))
        for argument in {*arguments(function)} - names(function)
    ]
    assert unused == []


def forbidden(node: ast.AST) -> str:
    """Say what is wrong with a piece of code, or nothing."""
    if isinstance(node, ast.Assert):
        return "an assert is gone under python -O"
    if isinstance(node, ast.ExceptHandler) and node.type is None:
        return "a bare except hides what it did not expect"
    if isinstance(node, ast.Attribute) and node.attr == "T":
        return ".T turns the batch axes round as well: .mT"
    if isinstance(node, ast.Attribute) and re.search(r"\.(vecdot|vecmat|vdot|conj|conjugate)$", ast.unparse(node)):
        return "a conjugate ends complex-step derivatives"
    if isinstance(node, ast.Attribute) and re.search(r"random\.(seed|rand\w*|normal|uniform)$", ast.unparse(node)):
        return "randomness comes in as rng="
    if isinstance(node, ast.Global):
        return "no global state"
    return ""


@pytest.mark.parametrize(
    "line",
    ["assert x", "try: f()\nexcept: pass", "A.T @ x", "np.vecdot(a, b)", "x.conj()", "np.random.seed(0)", "global x"],
)
def test_what_is_forbidden_is_recognised(line):
    assert any(map(forbidden, ast.walk(ast.parse(line))))


def test_nothing_forbidden_stands_in_the_source():
    found = [
        f"{file}:{getattr(node, 'lineno', 0)}: {why}"
        for file, tree in TREES.items()
        for node in ast.walk(tree)
        if (why := forbidden(node))
    ]
    assert found == []


# ---------------------------------------------------------------- how it is documented


def interface() -> Iterator[tuple[str, ast.ClassDef | Function]]:
    """Yield place and node of every function and class that `twistwrench` and six of its folders offer."""
    for node in ast.walk(ast.parse((SOURCE / "__init__.pyi").read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield from offered_nodes(node.module.replace(".", "/"), {alias.name for alias in node.names})
    for folder in ("bridge", "contact", "fast", "newton_euler_3d", "simulation", "tracing"):
        yield from offered_nodes(folder, offered(f"{folder}/__init__.py"))


def offered_nodes(of: str, names: set[str]) -> Iterator[tuple[str, ast.ClassDef | Function]]:
    for file, tree in TREES.items():
        if file.startswith((f"{of}/", f"{of}.py")):
            for node in tree.body:
                if isinstance(node, Function | ast.ClassDef) and node.name in names:
                    yield f"{file}:{node.lineno} {node.name}", node


INTERFACE = dict(interface())


def headings(docstring: str) -> dict[str, str]:
    """Split a numpydoc docstring at its underlined headings."""
    parts = re.split(r"^(\w[\w ]*)\n-{3,}\n", docstring, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def test_the_whole_interface_is_looked_at():
    classes = sum(isinstance(node, ast.ClassDef) for node in INTERFACE.values())
    assert classes > 15
    assert len(INTERFACE) - classes > 70


def test_everything_offered_has_a_docstring():
    """Private helpers may go without; what a section offers to the others may not."""
    bare = [
        f"{file}:{node.lineno} {node.name}"
        for file, tree in TREES.items()
        for top in tree.body
        if isinstance(top, Function | ast.ClassDef) and top.name in offered(file)
        for node in [top, *(top.body if isinstance(top, ast.ClassDef) else [])]
        if isinstance(node, Function | ast.ClassDef) and (node is top or not node.name.startswith("_"))
        if not ast.get_docstring(node)
    ]
    assert bare == []


def test_every_argument_and_every_result_is_described():
    missing = []
    for place, node in INTERFACE.items():
        parts = headings(ast.get_docstring(node) or "")
        if isinstance(node, Function):
            described = parts.get("Parameters", "")
            missing += [f"{place}: {a}" for a in arguments(node) if not re.search(rf"(?<!\w){a}\b", described)]
            if node.returns is not None and ast.unparse(node.returns) != "None" and "Returns" not in parts:
                missing.append(f"{place}: Returns")
    assert missing == []


def test_every_error_that_is_raised_is_documented():
    """By the function, or by the class whose method it is; an operator's TypeError is the language's."""
    silent, made = [], {"unknown_name": "NameNotFound", "no_model": "TypeError"}
    for place, node in INTERFACE.items():
        methods = [n for n in ast.walk(node) if isinstance(n, Function)]
        for function in [f for f in methods if not f.name.startswith("__") or f.name == "__init__"]:
            raises = [n.exc for n in ast.walk(function) if isinstance(n, ast.Raise) and n.exc is not None]
            names = {ast.unparse(exc.func if isinstance(exc, ast.Call) else exc) for exc in raises}
            names = {made.get(name, name) for name in names} - {"NotImplementedError"}
            said = (ast.get_docstring(node) or "") + (ast.get_docstring(function) or "")
            silent += [f"{place}: {function.name} raises {name}" for name in names if name not in said]
    assert silent == []


def test_everything_in_the_interface_shows_an_example():
    """Errors and the containers that a function returns are shown where they come from."""
    shown = {
        place: bool(re.search(r"^ *>>> ", ast.get_docstring(node) or "", re.MULTILINE))
        for place, node in INTERFACE.items()
        if isinstance(node, Function) or (ast.get_docstring(node) or "").find("Parameters") > 0
    }
    assert [place for place, has in shown.items() if not has] == []


def test_examples_are_run():
    """They are collected from src by the plain `pytest`; this notices when they are there no more."""
    assert sum(text.count(">>> ") for text in TEXT.values()) > 300
    config = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert re.search(r'testpaths = \[.*"src".*\]', config)
    assert "--doctest-modules" in config


MACHINE = re.compile(r"(?<![\w.*/<}\]-])/(work|root|home|Users|tmp|opt)/\w+|\.\./shared")


def test_a_path_of_a_machine_is_recognised():
    assert MACHINE.search("see " + "/".join(["", "home", "someone", "robots"]))
    assert not MACHINE.search("docs/home/index.md, https://example.org/home/page and a/b")


def test_no_path_of_a_machine_stands_in_the_repository():
    patterns = (
        "*.md",
        "*.toml",
        "*.cff",
        ".ci/*",
        "docs/**/*.md",
        "models/*",
        "notebooks/*",
        "src/**/*.py",
        "tests/**/*.py",
    )
    files = [path for pattern in patterns for path in ROOT.glob(pattern) if path.is_file()]
    found = {path.name: m[0] for path in files if (m := MACHINE.search(path.read_text(encoding="utf-8")))}
    assert found == {}
