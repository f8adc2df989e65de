"""Machine code on disk: the next process finds it, and nothing goes wrong where it cannot."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from straightline import llvm, objects
from straightline.line import Line
from straightline.number import Tape, numbers

pytestmark = pytest.mark.skipif(not llvm.available(), reason="llvmlite is not installed")

DOUBLE = np.dtype(float)


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Keep the code of these tests in a folder of theirs."""
    monkeypatch.setenv(objects.VARIABLE, str(tmp_path / "kept"))
    return tmp_path / "kept"


def cubes(factor=1):
    tape = Tape()
    x = numbers(tape, "x", 1)[0]
    return Line.of(tape, {"x": (1,)}, {"y": np.array([factor * x * x * x], object)})


def result(line=None, width=1, dtype=DOUBLE):
    """Return what a line makes of 3.0, as in a new process."""
    llvm.ENGINES.clear()
    y = np.empty((width, 1), dtype)
    llvm.MachineCode(line or cubes(), dtype, width).run([np.full((width, 1), 3.0, dtype), y])
    return y[0, 0]


@pytest.fixture
def compilations(monkeypatch):
    """Count what is compiled."""
    texts, compiled = [], llvm.compiled
    monkeypatch.setattr(llvm, "compiled", lambda text: texts.append(text) or compiled(text))
    return texts


def test_what_was_compiled_once_is_not_compiled_again(compilations, own_folder):
    assert result() == result() == 27
    assert len(compilations) == 1
    assert len([*own_folder.iterdir()]) == 1


PROCESS = """
import sys
sys.path[:0] = sys.argv[1:]
import numpy as np
from straightline import BackEnd, llvm, straight_line
compiled, calls = llvm.compiled, []
llvm.compiled = lambda text: calls.append(text) or compiled(text)
line = straight_line(lambda x: x[0].sin() * x[1] / x[0], x=(2,))
found = BackEnd(line, np.dtype(float), "llvm").results({"x": np.ones((1, 2))}, (1,))["y"]
print(len(calls), float(found[0]))
"""


def test_another_process_finds_it(own_folder):
    command = [sys.executable, "-c", PROCESS, *sys.path]
    printed = [subprocess.run(command, capture_output=True, text=True, check=True).stdout.split() for _ in range(2)]
    assert [calls for calls, _ in printed] == ["1", "0"]
    assert printed[0][1] == printed[1][1]
    assert len([*own_folder.iterdir()]) == 1


def test_whatever_the_code_depends_on_is_in_its_name(monkeypatch):
    import llvmlite
    import llvmlite.binding

    names = [llvm.key_of(cubes(), "double", 1), llvm.key_of(cubes(), "double", 1)]
    assert names[0] == names[1]
    names += [llvm.key_of(cubes(2), "double", 1), llvm.key_of(cubes(), "float", 1), llvm.key_of(cubes(), "double", 2)]
    with monkeypatch.context() as other:
        other.setattr(llvmlite, "__version__", "0.0")
        names.append(llvm.key_of(cubes(), "double", 1))
    with monkeypatch.context() as other:
        other.setattr(llvmlite.binding, "get_host_cpu_features", lambda: {"avx2": True})
        names.append(llvm.key_of(cubes(), "double", 1))
    with monkeypatch.context() as other:
        other.setattr(sys, "version", "3.0")
        names.append(llvm.key_of(cubes(), "double", 1))
    with monkeypatch.context() as other:
        other.setattr(objects, "own_source", lambda: b"another version of this package")
        names.append(llvm.key_of(cubes(), "double", 1))
    assert len({*names}) == len(names) - 1


@pytest.mark.parametrize("damage", [lambda x: x[:-9], lambda x: b"", lambda x: x[:40] + b"?" + x[41:]])
def test_a_damaged_file_is_discarded(damage, compilations, own_folder):
    assert result() == 27
    (file,) = own_folder.iterdir()
    right = file.read_bytes()
    file.write_bytes(damage(right))
    assert objects.fetch(file.name) is None
    assert not file.exists()
    assert result() == 27
    assert len(compilations) == 2
    assert file.read_bytes() == right


def test_a_file_with_another_name_is_not_taken(own_folder):
    objects.keep("one", b"code")
    os.rename(own_folder / "one", own_folder / "other")
    assert objects.fetch("other") is None


def test_many_writers_and_readers_never_see_half_of_it(own_folder):
    content = [bytes([k]) * 200_000 for k in range(8)]

    def write_and_read(k):
        for _ in range(10):
            objects.keep("same", content[k])
            assert objects.fetch("same") in content
        return True

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(write_and_read, range(8)))
    assert [file.name for file in own_folder.iterdir()] == ["same"]


def test_it_goes_on_where_nothing_can_be_written(tmp_path, monkeypatch, compilations):
    (tmp_path / "file").write_text("not a folder")
    for place in (tmp_path / "file" / "kept", "off", "relative/folder"):
        monkeypatch.setenv(objects.VARIABLE, str(place))
        assert objects.folder() is None
        assert result() == 27
    assert len(compilations) == 3
    monkeypatch.delenv(objects.VARIABLE)
    for name in ("HOME", "XDG_CACHE_HOME", "LOCALAPPDATA", "USERPROFILE"):
        monkeypatch.setenv(name, str(tmp_path / "file"))
    assert result() == 27
    assert len(compilations) == 4
    assert not os.path.exists("relative")


def test_a_disk_that_refuses_is_no_error(monkeypatch, own_folder, compilations):
    def refuse(*_):
        raise PermissionError("read-only")

    monkeypatch.setattr(os, "replace", refuse)
    assert result() == 27
    assert [*own_folder.iterdir()] == []
    monkeypatch.undo()


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="Windows has no such permissions")
def test_a_folder_that_others_can_write_to_is_not_trusted(own_folder):
    own_folder.mkdir()
    own_folder.chmod(0o777)
    assert objects.folder() is None
    own_folder.chmod(0o700)
    assert objects.folder() == str(own_folder)


def test_what_was_not_used_for_longest_makes_room(monkeypatch, own_folder):
    monkeypatch.setattr(objects, "MOST", 3500)
    for k, name in enumerate("abc"):
        objects.keep(name, bytes(1000))
        os.utime(own_folder / name, (k, k))
    assert objects.fetch("a")  # used just now
    objects.keep("d", bytes(1000))
    assert sorted(file.name for file in own_folder.iterdir()) == ["a", "c", "d"]


def test_importing_the_package_looks_at_no_disk():
    text = "import sys; sys.path[:0] = sys.argv[1:]; import twistwrench; print('straightline.objects' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", text, *sys.path], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
