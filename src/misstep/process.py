"""The process that runs a student's code, as it is seen from outside: asked, watched by a clock, and ended.

It answers in lines of JSON, of which only plain values are made: nothing that it sends is ever run.
"""

from __future__ import annotations

import os
import queue
import secrets
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from contextlib import suppress
from pathlib import Path
from typing import IO, Any, cast

from .signals import without_interrupts
from .verdict import as_json, from_json

__all__ = ["Died", "Process"]

PROGRAM = "import sys; sys.path[:] = {path!r}; from misstep.worker import main; main()"
MARK = "MISSTEP_WORKER"  # a variable of the environment that all have which such a process starts
SLACK_S = 5.0  # how much later than its own clock that of the other process may be
MAX_CALLS = 30  # time limits of calls that an answer may take, with all of its cases and the search for what is wrong
MIN_ANSWER_S = 60.0  # what an answer may take in any case
MAX_MESSAGE_BYTES = 16_000_000  # a verdict has some thousands
MAX_ROUNDS = 20  # in which what was started is looked for: it may start more in the meantime
POLL_S = 0.5


class Died(Exception):
    """The process ended, or was ended: at which function of the student's and which call of it, late, and where."""

    def __init__(self, at: str | None, call: int, late: bool, trace: str) -> None:
        super().__init__()
        self.at, self.call, self.late, self.trace = at, call, late or "Timeout (" in trace, trace


class Process:
    """A process that answers questions, one at a time. It is first told its task; what it prints goes to a file."""

    def __init__(self, task: dict[str, Any], limit: float, printed: IO[Any] | None) -> None:
        self._limit, self._word = limit, secrets.token_hex(16)
        handle, trace = tempfile.mkstemp(prefix="misstep-", suffix=".trace")
        os.close(handle)
        self._trace = Path(trace)
        with without_interrupts():
            self._process = subprocess.Popen(
                [sys.executable, "-u", "-c", PROGRAM.format(path=sys.path)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL if printed is None else printed,
                env=os.environ | {MARK: self._word},
                creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
                process_group=0 if os.name == "posix" else None,
            )
        self._requests, self._replies = cast("tuple[IO[bytes], IO[bytes]]", (self._process.stdin, self._process.stdout))
        self._heard: queue.SimpleQueue[Any] = queue.SimpleQueue()
        threading.Thread(target=self._listen, daemon=True).start()
        self._send([self._word, limit, trace, [*task.items()]])

    def _listen(self) -> None:
        """Read what the process tells; a line without its word is of the student's code, and is dropped."""
        with suppress(OSError, ValueError), self._replies:
            while line := self._replies.readline(MAX_MESSAGE_BYTES):
                _, word, text = line.rpartition(self._word.encode())
                if word:
                    with suppress(ValueError):
                        self._heard.put(from_json(text))
        self._heard.put(None)

    def _send(self, message: Any) -> None:
        with suppress(OSError, ValueError):  # the process has ended: there will be no answer
            self._requests.write(as_json(message).encode() + b"\n")
            self._requests.flush()

    def ask(self, *question: Any) -> Any:
        """Return the answer to a question; it raises `Died` where the process ends before, or takes too long."""
        begun: list[str] = []
        calls: Counter[str] = Counter()
        end, due = time.monotonic() + max(MIN_ANSWER_S, MAX_CALLS * self._limit), float("inf")
        self._send(question)
        while True:
            left = min(end, due) - time.monotonic()
            try:
                message = self._heard.get(timeout=min(max(left, 0), POLL_S))
            except queue.Empty:
                if left > 0 and self._process.poll() is None:
                    continue
                message = None
            match message:
                case ("answer", answer):
                    return answer
                case ("begin", str(name)):
                    begun.append(name)
                    calls[name] += 1
                case ("end",) if begun:
                    begun.pop()
                case None:
                    late = self._process.poll() is None and left <= 0
                    trace, at = self.close(), begun[-1] if begun else None
                    raise Died(at, calls[at or ""] - 1, late, trace)
            due = time.monotonic() + self._limit + SLACK_S if begun else float("inf")

    def close(self) -> str:
        """End it and all that it has started; return where it was.

        It exits when its input is closed, unless it still runs something.
        """
        with suppress(OSError):
            self._requests.close()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(POLL_S)
        if os.name == "posix":
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()
        self._process.wait()
        for _ in range(MAX_ROUNDS):
            if not (started := _marked(self._word)):
                break
            for pid in started:
                with suppress(ProcessLookupError, PermissionError):
                    os.kill(pid, signal.SIGKILL)
            time.sleep(0.01)
        try:
            with self._trace.open(encoding="utf-8", errors="replace") as file:
                return file.read(MAX_MESSAGE_BYTES)
        except OSError:
            return ""
        finally:
            with suppress(OSError):
                self._trace.unlink()


def _marked(word: str) -> list[int]:
    """Return the living processes with a word in their environment, where the system shows it.

    A process that has left its group and lost its parent is found by nothing else.
    """
    found = []
    for place in Path("/proc").glob("[0-9]*") if sys.platform == "linux" else ():
        with suppress(OSError):
            if f"{MARK}={word}".encode() in (place / "environ").read_bytes():
                found.append(int(place.name))
    return found
