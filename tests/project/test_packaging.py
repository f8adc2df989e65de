"""What comes with the package, what importing it costs, and the names that others rely on."""

import inspect
import re
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

import twistwrench as tw

ROOT = Path(__file__).resolve().parents[2]
MODELS = sorted(path.name for path in (ROOT / "models").glob("*.urdf"))

FUNCTIONS = {
    "load": "source base",
    "robots": "",
    "skew": "w",
    "unskew": "M",
    "hat": "V",
    "vee": "M",
    "exp3": "w",
    "log3": "R",
    "exp6": "V",
    "log6": "T",
    "SE3": "rotation translation",
    "motion_transform": "R p",
    "force_transform": "R p",
    "cross_motion": "V",
    "cross_force": "V",
    "Twist": "vector frame",
    "Wrench": "vector frame",
    "screw": "x",
    "SpatialInertia": "mass com inertia_at_com",
    "forward_kinematics": "model q v a",
    "frame_placement": "model q frame",
    "frame_jacobian": "model q frame reference",
    "frame_bias_acceleration": "model q v frame reference",
    "rnea": "model q v a f_ext",
    "aba": "model q v tau f_ext",
    "crba": "model q",
    "nonlinear_effects": "model q v",
    "gravity": "model q",
    "coriolis_matrix": "model q v",
    "selection_matrix": "model",
    "contact_jacobian": "model q contacts",
    "center_of_mass": "model q",
    "centroidal_map": "model q",
    "centroidal_momentum": "model q v",
    "centroidal_momentum_rate": "model q v a",
    "kinetic_energy": "model q v",
    "potential_energy": "model q",
    "dynamics": "model q v contacts want",
    "ModelError": None,
    "ShapeError": None,
    "SingularError": None,
    "newton_euler_3d": None,
    "bridge": None,
}
"""The names that others rely on, and the arguments that each takes."""

MEMBERS = {
    "Model": """nq nv name joint_names frame_names parent inertia gravity
        neutral random_configuration integrate difference normalize standing""",
    "SE3": "rotation translation inverse act motion_transform force_transform __matmul__",
    "SpatialInertia": "mass com inertia_at_com matrix transform kinetic_energy momentum __add__",
    "Screw": "axis point pitch magnitude",
    "Dynamics": "M h J_c A_G",
}


# ---------------------------------------------------------------- names


def test_the_names_that_others_rely_on_are_there():
    assert set(FUNCTIONS) <= set(tw.__all__)
    assert {*tw.__all__, "plot", "exercises"} <= set(dir(tw))


@pytest.mark.one_case
@pytest.mark.parametrize(
    "room",
    [
        "bridge",
        "contact",
        "exercises",
        "fast",
        "loading",
        "model",
        "motions",
        "plot",
        "scene",
        "simulation",
        "validate",
    ],
)
def test_the_namespaces_exist_before_anything_else_is_touched(room):
    script = f"import twistwrench as tw; assert {room!r} in dir(tw); print(tw.{room}.__name__)"
    assert python(script) == f"twistwrench.{room}"


@pytest.mark.parametrize("name", [name for name, arguments in FUNCTIONS.items() if arguments is not None])
def test_functions_take_the_arguments_that_others_pass(name):
    signature = list(inspect.signature(getattr(tw, name)).parameters)
    wanted = FUNCTIONS[name].split()
    assert [argument for argument in signature if argument in wanted] == wanted


@pytest.mark.parametrize("name", MEMBERS)
def test_classes_have_the_members_that_others_use(name):
    cls = getattr(tw, name)
    members = {*dir(cls), *getattr(cls, "__dataclass_fields__", ())}
    assert set(MEMBERS[name].split()) <= members


@pytest.mark.parametrize("name", ["ModelError", "ShapeError", "SingularError", "FrameError", "NameNotFound"])
def test_every_error_is_a_value_error(name):
    assert issubclass(getattr(tw, name), ValueError)


def test_every_conversion_of_the_bridge_goes_both_ways():
    there = {name.removeprefix("to_") for name in tw.bridge.__all__ if name.startswith("to_pinocchio_")}
    back = {name.removeprefix("from_") for name in tw.bridge.__all__ if name.startswith("from_pinocchio_")}
    assert there == back
    assert there


@pytest.mark.parametrize(
    ("room", "names"),
    [
        ("contact", "ContactDynamics ContactForces Impact StanceMargins"),
        ("model", "Reduction Rerooting ScrewAxes"),
        ("simulation", "Simulation"),
    ],
)
def test_what_nobody_constructs_stands_in_its_room(room, names):
    assert set(names.split()) <= set(getattr(tw, room).__all__)
    assert not set(names.split()) & set(dir(tw))


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'fourward_kinematics'"):
        _ = tw.fourward_kinematics


def test_names_are_what_type_checkers_see():
    """They read the list of names; at run time each is found in the section that defines it."""
    for name in tw.__all__:
        value = getattr(tw, name)
        assert value.__name__.startswith("twistwrench.") or value.__name__ == name
        assert getattr(value, "__module__", "twistwrench.").startswith("twistwrench.")


# ---------------------------------------------------------------- what importing costs

HEAVY = ("yourdfpy", "trimesh", "lxml", "tqdm", "mpmath", "gmpy2", "pinocchio", "matplotlib", "scipy", "hypothesis")


def python(code: str, *, executable: str | Path = sys.executable, cwd: Path | None = None) -> str:
    """Run code in a fresh interpreter and return what it printed."""
    run = subprocess.run([executable, "-c", code], capture_output=True, text=True, cwd=cwd, check=False)
    assert run.returncode == 0, run.stderr
    return run.stdout.strip()


@pytest.mark.one_case
@pytest.mark.parametrize("use", ["", "[getattr(tw, name) for name in tw.__all__]; tw.robots()"])
def test_importing_leaves_the_heavy_packages_alone(use):
    loaded = python(f"import sys, twistwrench as tw; {use}\nprint(*sys.modules)").split()
    assert not {name.split(".")[0] for name in loaded} & set(HEAVY)


def test_importing_loads_only_what_finds_the_names():
    """Not even NumPy, which the first function that is asked for imports."""
    code = "import sys; before = {*sys.modules}; import twistwrench; print(*{*sys.modules} - before)"
    loaded = {name.split(".")[0] for name in python(code).split()}
    assert loaded - sys.stdlib_module_names == {"twistwrench", "lazy_loader"}


BARE = """
import sys

class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {optional}:
            raise ModuleNotFoundError(name)

sys.meta_path.insert(0, Refuse())
import numpy as np, twistwrench as tw
for robot in tw.robots():
    if robot.source == "models":
        model = tw.load(robot.name)
        rest = np.zeros(model.nv)
        q = model.neutral()
        error = tw.aba(model, q, rest, tw.rnea(model, q, rest, rest + 1)) - 1
        print(robot.name, np.abs(error).max() < 1e-9, tw.fast.crba(model, q).shape)
"""


@pytest.mark.slow
def test_numpy_lxml_and_tqdm_are_enough_to_compute_with_the_robots_that_come_along():
    optional = {*HEAVY, "viser", "daqp", "dask", "jax", "PIL"} - {"lxml", "tqdm"}
    lines = python(BARE.replace("{optional}", repr(optional))).splitlines()
    assert len(lines) == len(MODELS)
    assert all(line.split()[1] == "True" for line in lines)


# ---------------------------------------------------------------- what comes with it


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Build the source archive, and the wheel from what it unpacks to; no network."""
    pytest.importorskip("hatchling", reason="hatchling is not installed: nothing can be built")
    out = tmp_path_factory.mktemp("built")
    build = [sys.executable, "-m", "hatchling", "build", "-d", str(out), "-t"]
    subprocess.run([*build, "sdist"], cwd=ROOT, check=True, capture_output=True)
    (archive,) = out.glob("*.tar.gz")
    with tarfile.open(archive) as tar:
        tar.extractall(out / "unpacked", filter="data")
    (source,) = (out / "unpacked").iterdir()
    subprocess.run([*build, "wheel"], cwd=source, check=True, capture_output=True)
    (wheel,) = out.glob("*.whl")
    return source, wheel


@pytest.mark.slow
def test_the_source_archive_holds_what_a_reader_needs(built):
    source, _ = built
    names = {path.relative_to(source).as_posix() for path in source.rglob("*") if path.is_file()}
    wanted = {
        "README.md",
        "LICENSE",
        "CHANGELOG.md",
        "CITATION.cff",
        "pyproject.toml",
        ".ci/run",
        "tests/project/test_house.py",
    }
    assert wanted | {f"models/{name}" for name in MODELS} <= names
    assert not [name for name in names if "__pycache__" in name or ".venv" in name or "_cache" in name]


@pytest.mark.slow
def test_the_wheel_holds_every_section_and_every_robot_and_nothing_else(built):
    names = set(zipfile.ZipFile(built[1]).namelist())
    inside = {name for name in names if ".dist-info/" not in name}
    sections = {
        path.relative_to(ROOT / "src").as_posix()
        for kind in ("*.py", "*.pyi", "*.md", "*.toml", "*.csv", "*.html")
        for path in (ROOT / "src").rglob(kind)
    }
    robots = {f"twistwrench/models/{path.name}" for path in (ROOT / "models").iterdir() if path.is_file()}
    typed = {f"{package}/py.typed" for package in ("misstep", "straightline", "twistwrench")}
    assert inside == sections | robots | typed
    assert len(MODELS) >= 6
    assert any(name.endswith(".dist-info/licenses/LICENSE") for name in names)


@pytest.fixture
def fresh(tmp_path):
    """Make a virtual environment that sees the packages of this one, but not this checkout."""
    import venv

    folder = tmp_path / "venv"
    venv.create(folder)
    (site,) = [*folder.glob("lib/python*/site-packages"), *folder.glob("Lib/site-packages")]
    (site / "others.pth").write_text(str(Path(pytest.__file__).parents[1]) + "\n")
    (executable,) = [*folder.glob("bin/python"), *folder.glob("Scripts/python.exe")]
    return executable


LOAD = "import twistwrench as tw; print(tw.load('go2').nv, tw.rnea.__module__, tw.robots.__module__, tw.__path__[0])"


def install(executable: Path, *what: str) -> None:
    pip = [sys.executable, "-m", "pip", "--python", str(executable), "install", "--no-deps", "--no-index", "--quiet"]
    run = subprocess.run([*pip, *what], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr


@pytest.mark.slow
def test_an_installed_wheel_brings_its_robots(built, fresh, tmp_path):
    install(fresh, str(built[1]))
    nv, *_, folder = python(LOAD, executable=fresh, cwd=tmp_path).split()
    assert nv == "18"
    assert Path(folder).is_relative_to(fresh.parents[1])


@pytest.mark.slow
def test_an_editable_install_finds_the_robots_of_the_checkout(built, fresh, tmp_path):
    source, _ = built
    install(fresh, "--no-build-isolation", "--editable", str(source))
    nv, *_, folder = python(LOAD, executable=fresh, cwd=tmp_path).split()
    assert nv == "18"
    assert Path(folder) == source / "src" / "twistwrench"


def test_the_citation_names_this_version_and_the_chapter():
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(rf"^version: {re.escape(tw.__version__)}$", citation, re.MULTILINE)
    for word in ("Chapter 49", "Robotics Tutorial", "Pengfei", "Guo", "CC-BY-4.0"):
        assert word in citation


def test_the_readme_gives_the_two_commands():
    blocks = re.findall(
        r"^```sh\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )
    assert "twistwrench validate go2" in blocks[0]
    assert "pytest" in blocks[1]
