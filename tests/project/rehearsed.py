"""Run pytest on one copy of the package after another, each in a fork of this process.

What the tests import besides the package (NumPy, pytest, hypothesis, Pinocchio) is imported once, here: it takes longer
than most tests that notice a fault. A line of stdin is a list in JSON: the folder of the copy, a file for what pytest
prints, and pytest's arguments. The answer, a line of stdout, is the exit code.
"""

import contextlib
import json
import os
import sys
import traceback

import hypothesis.extra.numpy  # noqa: F401
import lxml.etree  # noqa: F401
import mpmath  # noqa: F401
import numpy  # noqa: F401
import pytest

with contextlib.suppress(ImportError):
    import pinocchio  # noqa: F401


def run(folder: str, printed: str, arguments: list[str]) -> int:
    """Run pytest in a child, for which the package lies in `folder`."""
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    file = os.open(printed, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.dup2(file, 1)
    os.dup2(file, 2)
    os.environ["PYTHONPATH"] = folder  # for what the tests start themselves
    os.environ["HYPOTHESIS_STORAGE_DIRECTORY"] = f"{folder}/hypothesis"
    sys.path.insert(0, folder)
    code = 70  # should pytest itself break
    try:
        code = int(pytest.main(arguments))
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    os._exit(code)


if __name__ == "__main__":
    for line in sys.stdin:
        print(run(*json.loads(line)), flush=True)
