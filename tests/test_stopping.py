"""Long commands stop when they are told to, soon, with the exit status of the signal, and keep what was finished."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest

from twistwrench.stopping import Stopped, handle_signals, without_interrupts

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals and processes are those of POSIX")

SOON = 5
"""Seconds; it is less than one here, and this machine may be busy."""

SWEEP = ["validate", "--all", "--jobs", "2", "--states", "1", "--truths", "1"]


def started(*arguments):
    """Start a command in a process group of its own, as a shell does."""
    command = [sys.executable, "-m", "twistwrench", *arguments]
    return subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def working(group):
    """Return the processes of a group that have not ended."""
    found = subprocess.run(["ps", "-eo", "pgid=,stat="], capture_output=True, text=True, check=True).stdout
    return [line for line in found.splitlines() if line.split()[0] == str(group) and "Z" not in line.split()[1]]


def is_stopped(process):
    """Wait for a process; return its exit status, and what it wrote to stderr. Nothing of it may go on."""
    before = time.monotonic()
    try:
        error = process.communicate(timeout=30)[1]
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    assert time.monotonic() - before < SOON
    until = time.monotonic() + SOON
    while working(process.pid) and time.monotonic() < until:
        time.sleep(0.1)
    assert working(process.pid) == []
    return process.returncode, error


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "group", "status"),
    [(signal.SIGINT, True, 130), (signal.SIGTERM, True, 143), (signal.SIGTERM, False, 143)],
)
def test_a_sweep_is_stopped_and_keeps_what_was_finished(tmp_path, number, group, status):
    old = tmp_path / "found.json"
    old.write_text("of a whole run")
    process = started(*SWEEP, "--json", str(old))
    for _ in range(2):  # the header and a robot
        process.stdout.readline()
    (os.killpg if group else os.kill)(process.pid, number)
    code, error = is_stopped(process)
    assert code == status
    assert "Traceback" not in error
    assert "what was finished is in" in error
    assert old.read_text() == "of a whole run"
    part = json.loads((tmp_path / "found.json.part").read_text(encoding="utf-8"))
    assert part["interrupted"]
    assert not part["passed"]
    assert part["reports"]


@pytest.mark.slow
def test_a_sweep_that_is_killed_leaves_no_processes_behind():
    process = started(*SWEEP)
    for _ in range(2):
        process.stdout.readline()
    process.kill()
    assert is_stopped(process)[0] == -signal.SIGKILL


@pytest.mark.slow
def test_a_sweep_that_nobody_reads_stops():
    """As in `twistwrench validate --all | head -2`: it must not wait for the next line it prints."""
    process = started(*SWEEP, "--states", "20", "--truths", "20")
    process.stdout.readline()  # the header; the first robot takes longer than this test waits
    process.stdout.close()
    before = time.monotonic()
    assert process.wait(30) == 141
    assert time.monotonic() - before < SOON
    assert process.stderr.read() == ""
    process.stderr.close()


@pytest.mark.slow
def test_a_sweep_that_meets_the_closed_pipe_while_it_prints_is_quiet():
    process = started(*SWEEP)
    for _ in range(3):
        process.stdout.readline()
    process.stdout.close()
    assert process.wait(30) == 141
    assert process.stderr.read() == ""
    process.stderr.close()


def test_a_signal_ends_the_work_and_is_as_before_afterwards():
    def terminated():
        with handle_signals():
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(SOON)

    with pytest.raises(Stopped) as stopped:
        terminated()
    assert stopped.value.status == 143
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_processes_that_are_started_without_interrupts_do_not_get_them():
    script = "import os, signal; os.kill(os.getpid(), signal.SIGINT); print('still there')"
    with without_interrupts():
        child = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (child.returncode, child.stdout) == (0, "still there\n")
    assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_that_a_library_swallows_comes_again(number):
    """As where C code asks Python for a number: mpmath's went on with a NaN, and the viewer with its page."""
    swallowed, tidied = [], []

    def interrupted():
        with handle_signals():
            try:
                os.kill(os.getpid(), number)
                time.sleep(SOON)
            except BaseException as error:
                swallowed.append(error)
            try:
                time.sleep(SOON)
            finally:
                time.sleep(1)  # while it is tidied up it is not raised again
                tidied.append(True)

    default = signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL
    outer = signal.signal(number, default)  # a job in the background ignores Ctrl-C
    try:
        with pytest.raises(Stopped) as stopped:
            interrupted()
        assert signal.getsignal(number) is default
    finally:
        signal.signal(number, outer)
    assert stopped.value.status == 128 + number
    assert (len(swallowed), tidied) == (1, [True])
    assert signal.getitimer(signal.ITIMER_REAL) == (0, 0)


def test_an_interrupt_while_the_package_is_imported_is_no_trace():
    script = (
        "import builtins, sys; from twistwrench.__main__ import run; whole = builtins.__import__\n"
        "def interrupted(name, *others):\n"
        "    if name == 'cli': raise KeyboardInterrupt\n"
        "    return whole(name, *others)\n"
        "builtins.__import__ = interrupted; sys.exit(run())"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (130, "")
