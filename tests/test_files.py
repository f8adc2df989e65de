"""Files are written whole or not at all: the old one stays good, links stay links, and an error names its file."""

import errno
import os
import subprocess
import sys

import pytest

from twistwrench.cli import main
from twistwrench.files import errors_name, replacing, write_text
from twistwrench.options import check_writable

POSIX = pytest.mark.skipif(os.name != "posix", reason="links and devices are those of POSIX")


def write_half(path, error):
    """Write into the new file, and fail."""
    with replacing(path) as beside:
        assert beside.suffix == path.suffix  # by which matplotlib tells the format
        beside.write_text("half of")
        raise error


def test_what_was_there_survives_a_full_disk(tmp_path):
    path = tmp_path / "found.json"
    path.write_text("good")
    with pytest.raises(OSError, match=r"found\.json: No space left on device"):
        write_half(path, OSError(errno.ENOSPC, "No space left on device"))
    assert path.read_text() == "good"
    assert [file.name for file in tmp_path.iterdir()] == ["found.json"]


def test_an_interrupt_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "picture.png"
    path.write_bytes(b"good")
    with pytest.raises(KeyboardInterrupt):
        write_half(path, KeyboardInterrupt())
    assert path.read_bytes() == b"good"
    assert len(list(tmp_path.iterdir())) == 1


@POSIX
def test_a_link_stays_a_link_and_the_file_it_leads_to_is_written(tmp_path):
    for name, there in (("dangling", False), ("whole", True)):
        link, target = tmp_path / f"{name}.json", tmp_path / "elsewhere" / name
        target.parent.mkdir(exist_ok=True)
        if there:
            target.write_text("old")
            target.chmod(0o640)
        link.symlink_to(target)
        check_writable("--json", link)
        assert link.is_symlink()
        assert target.exists() == there
        write_text(link, "new")
        assert link.is_symlink()
        assert target.read_text() == "new"
        assert not there or target.stat().st_mode & 0o777 == 0o640


@POSIX
def test_a_dangling_link_given_as_json_is_not_destroyed(tmp_path, capsys):
    link, target = tmp_path / "link.json", tmp_path / "real.json"
    link.symlink_to(target)
    assert main(["validate", "pendulum", "--states", "1", "--truths", "1", "--json", str(link)]) == 0
    assert link.is_symlink()
    assert target.read_text().startswith("{")


@POSIX
def test_a_device_is_written_itself(tmp_path):
    with replacing(os.devnull) as beside:
        assert str(beside) == os.devnull
    write_text(os.devnull, "gone")
    assert os.path.exists(os.devnull)


@POSIX
@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write everything")
def test_a_file_that_may_not_be_written_is_not_replaced(tmp_path):
    path = tmp_path / "found.json"
    path.write_text("good")
    path.chmod(0o400)
    with pytest.raises(OSError, match=r"found\.json: Permission denied"):
        write_text(path, "new")
    assert path.read_text() == "good"


def test_an_error_without_a_file_gets_its_name(tmp_path):
    with pytest.raises(OSError, match=r"^cells\.jsonl: No space left on device$"), errors_name("cells.jsonl"):
        raise OSError(errno.ENOSPC, "No space left on device")
    with pytest.raises(OSError, match="nowhere"):
        write_text(tmp_path / "nowhere" / "x.json", "{}")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full here")
def test_a_full_disk_behind_stdout_is_said():
    command = [sys.executable, "-m", "twistwrench", "robots"]
    with open("/dev/full", "w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, timeout=60, check=False)
    assert done.returncode == 2
    assert done.stderr == "twistwrench: what is printed goes to a file on a full disk\n"
