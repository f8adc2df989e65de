"""The student's code in a process of its own: an endless loop is stopped, and its line is reported."""

from __future__ import annotations

import os
import pickle
import re
import secrets
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from os import PathLike
from pathlib import Path
from typing import Any, BinaryIO, cast

from ...stopping import without_interrupts
from .. import catalogue
from ..cases import cases
from ..exercise import Exercise, Part
from ..failing import Case, failing_case
from ..folder.workbook import Workbook
from ..judge import Verdict
from ..words.phrases import say
from ..words.text import Language, Text

__all__ = ["TIME_LIMIT", "CheckFailed", "IsolatedWorkbook", "drawn", "opened"]

TIME_LIMIT = 10.0
"""Seconds for one call of a function, and for reading a file. The longest of the references takes 0.1 s."""

WORKER = "import sys; sys.path[:] = {path!r}; from twistwrench.exercises.processes.worker import main; main()"


def drawn(seed: int | None) -> int:
    """Return a seed for the random cases: a new one each time unless it is given."""
    return secrets.randbelow(10**6) if seed is None else seed


@contextmanager
def opened(
    folder: str | PathLike[str],
    *,
    language: Language | None = None,
    seed: int | None = None,
    time_limit: float = TIME_LIMIT,
    quiet: bool = False,
) -> Iterator[Workbook]:
    """Open a folder that was started before, and close it again.

    Parameters
    ----------
    folder : str or path
    language : {"en", "zh"}, optional
        Of the messages.
    seed : int, optional
        Of the random cases; drawn anew unless given.
    time_limit : float
        Seconds for one call of a student's function; 0 for none, and no other process, as a debugger needs it.
    quiet : bool
        Drop what the other process prints.

    Yields
    ------
    Workbook
    """
    if not time_limit or not sys.executable or sys.platform == "emscripten":
        yield Workbook(folder, language=language, seed=drawn(seed))
        return
    book = IsolatedWorkbook(folder, language=language, seed=drawn(seed), time_limit=time_limit, quiet=quiet)
    try:
        yield book
    finally:
        book.close()


class IsolatedWorkbook(Workbook):
    """A folder whose files are read and judged in another process.

    Parameters
    ----------
    folder : str or path
    language : {"en", "zh"}, optional
        Of the messages.
    seed : int
        Of the random cases.
    time_limit : float
        Seconds for one call of a student's function.
    quiet : bool
        Drop what the other process prints.
    """

    def __init__(
        self,
        folder: str | PathLike[str],
        *,
        language: Language | None = None,
        seed: int = 0,
        time_limit: float = TIME_LIMIT,
        quiet: bool = False,
    ) -> None:
        super().__init__(folder, language=language, seed=seed)
        self._quiet = quiet
        self._time_limit = time_limit
        self._worker: _Worker | None = None
        self._unreadable: dict[str, Text] = {}

    def words(self, exercise: Exercise) -> str | None:
        """Return the student's answer in words, None if it is not written yet."""
        found: str | None = self._ask("words", exercise.id)
        return found

    def _judge(self, exercise: Exercise, part: Part) -> Verdict:
        verdict = self._ask("verdict", part.name) or self._ask("plain verdict", part.name)
        return verdict if isinstance(verdict, Verdict) else _wrong(exercise, part.name, [say("ended")])

    def close(self) -> None:
        """End the other process."""
        if self._worker is not None:
            self._worker.close()
            self._worker = None

    def _ask(self, what: str, name: str) -> Any:
        """Return the answer of the other process. Where it had to stop, note at what, and start a new one."""
        while True:
            if self._worker is None:
                known = self._verdicts, self._unreadable
                self._worker = _Worker(self._quiet, str(self.folder), self.seed, self._time_limit, *known)
            try:
                answer, borrowed = self._worker.ask(what, name)
            except _Died as died:
                self.close()
                if died.at is None:  # not in the student's code
                    return None
                lines = self._explained(died)
                if died.at in map(catalogue.file_name, catalogue.SECTIONS):
                    self._unreadable[died.at] = Text(*("\n".join(line.of(k) for line in lines) for k in ("en", "zh")))
                else:
                    exercise, part = catalogue.find_part(died.at)
                    if exercise.needs and not died.trace.startswith("Timeout"):
                        lines.insert(1, say("ended in", name=exercise.needs.title()))
                    tried = cases(part, self.seed)
                    k = min(died.case, len(tried) - 1)  # further calls look for what is wrong
                    case = failing_case(part, k, self.seed, tried[k])
                    self._verdicts[died.at] = _wrong(exercise, died.at, lines, case)
                if died.at == name:
                    return self._verdicts[name]
            else:
                self.borrowed |= borrowed
                return answer

    def _explained(self, died: _Died) -> list[Text]:
        """Return why the process ended, and at which line of the student's."""
        late = died.trace.startswith("Timeout")
        lines = [say("endless", seconds=f"{self._time_limit:g}") if late else say("ended")]
        for path, number in re.findall(r'File "(.+)", line (\d+) in', died.trace):
            file = self.folder / Path(path).name
            if file.exists():
                lines.append(say("at line", file=file.name, line=number))
                source = file.read_text(encoding="utf-8-sig", errors="replace").splitlines()
                lines += [Text(*("    " + line.strip(),) * 2) for line in source[int(number) - 1 : int(number)]]
                break
        return lines


def _wrong(exercise: Exercise, name: str, lines: list[Text], case: Case | None = None) -> Verdict:
    """Return the verdict on a function that did not give an answer."""
    return Verdict("wrong", (say("head", id=exercise.id, name=name), *lines), (), case)


class CheckFailed(Exception):
    """The check itself raised an error, which is not the student's."""

    def __init__(self, trace: str) -> None:
        super().__init__(f"the check itself failed, and not the answer:\n{trace}")


class _Died(Exception):
    """The other process ended: what it was running, in which of its cases, and where its threads were."""

    def __init__(self, at: str | None, case: int, trace: str) -> None:
        super().__init__()
        self.at, self.case, self.trace = at, case, trace


class _Worker:
    """The other process."""

    def __init__(self, quiet: bool, folder: str, seed: int, limit: float, *known: dict[str, Any]) -> None:
        handle, trace = tempfile.mkstemp(prefix="twistwrench-", suffix=".trace")
        with open(handle, "wb"):
            self._trace = Path(trace)
        with without_interrupts():  # Ctrl-C is for the parent
            self._process = subprocess.Popen(
                [sys.executable, "-u", "-c", WORKER.format(path=sys.path)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL if quiet else None,
                creationflags=getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0),
                process_group=0 if os.name == "posix" else None,  # all that the answers start ends with it
            )
        self._requests, self._replies = cast("tuple[BinaryIO, BinaryIO]", (self._process.stdin, self._process.stdout))
        self._send((folder, seed, limit, trace, *known))

    def _send(self, message: Any) -> None:
        with suppress(OSError):  # the process has ended: there will be no answer
            pickle.dump(message, self._requests)
            self._requests.flush()

    def ask(self, what: str, name: str) -> Any:
        """Return an answer, and follow what the process runs until then."""
        begun: list[str] = []
        calls: Counter[str] = Counter()
        self._send((what, name))
        try:
            while True:
                kind, said = pickle.load(self._replies)
                if kind == "answer":
                    return said
                if kind == "failed":
                    raise CheckFailed(said)
                if kind == "begin":
                    begun.append(said)
                    calls[said] += 1
                else:
                    begun.pop()
        except (EOFError, OSError, pickle.UnpicklingError):
            trace = self._trace.read_text(encoding="utf-8", errors="replace")
            at = begun[-1] if begun else None
            raise _Died(at, calls[at or ""] - 1, trace) from None

    def close(self) -> None:
        """End it: it exits when its input is closed, unless it is still running something."""
        for pipe in (self._requests, self._replies):
            with suppress(OSError):
                pipe.close()
        try:
            self._process.wait(0.5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        if os.name == "posix":
            with suppress(ProcessLookupError, PermissionError):  # what it has started
                os.killpg(self._process.pid, signal.SIGKILL)
        self._trace.unlink(missing_ok=True)
