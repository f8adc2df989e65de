"""A class of students who are odd, unlucky or hostile: each hands in a right `act`, and a `skew` that does harm."""

import os

from twistwrench.exercises import start
from twistwrench.exercises.chapter import COURSE

from .test_exercises_isolation import write

__all__ = ["BODIES", "FILES", "RIGHT", "ROOMS", "hand_in"]

RIGHT = "return R @ x + p"
RIGHT_SKEW = "return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])"

ODD = """
class Odd:
    def __init__(self, what):
        self.what = what
    def __array__(self, *given, **named):
        raise RuntimeError("Can't call numpy() on Tensor that requires grad.")
class Whole(Odd):
    def __getattr__(self, name):
        raise ZeroDivisionError(name)
    def __len__(self):
        raise ZeroDivisionError
    def __eq__(self, other):
        raise ZeroDivisionError
    __hash__ = None
class Classless:
    @property
    def __class__(self):
        raise ZeroDivisionError
class Ordered:
    def matrix(self, order):
        return order
class Property:
    @property
    def matrix(self):
        raise ZeroDivisionError
class Said(str):
    def __eq__(self, other):
        raise ZeroDivisionError
    def strip(self):
        raise ZeroDivisionError
    __hash__ = None
class Silent(Exception):
    def __str__(self):
        raise ZeroDivisionError
    __repr__ = __str__
class Array(np.ndarray):
    def __array_finalize__(self, other):
        raise ZeroDivisionError
class Items(list):
    def __iter__(self):
        raise ZeroDivisionError
"""
"""Classes whose objects raise an error wherever they are touched."""

LOOP = "while True:\n    pass"
DEAF = """\
import signal
for n in range(1, 32):
    try:
        signal.signal(n, signal.SIG_IGN)
    except (OSError, ValueError):
        pass
"""
UNWATCHED = "import faulthandler\nfaulthandler.cancel_dump_traceback_later()\n"
SLEEP = "import subprocess\nsubprocess.Popen(['sleep', '4712'], start_new_session=True)\n"
TWICE = "import subprocess\nsubprocess.run(['sh', '-c', 'setsid sleep 4712 >/dev/null 2>&1 &'])\n"
WRITES = """\
import os
for fd in range(3, 20):
    try:
        os.write(fd, WHAT)
    except OSError:
        pass
"""
PICKLE = """b'cposix\\nsystem\\n(S"touch MARKED"\\ntR.'"""

BODIES = {
    "tensor": "return Odd(w)",
    "tensors": "return [[Odd(w)] * 3] * 3",
    "attributes": "return Whole(w)",
    "class": "return Classless()",
    "matrix of an order": "return Ordered()",
    "matrix that raises": "return Property()",
    "text": "return Said('x')",
    "large": "return [[10**400] * 3] * 3",
    "one large": "return 10**400",
    "in itself": "a = []\na.append(a)\nreturn a",
    "deep": "a = 1.0\nfor _ in range(5000):\n    a = [a]\nreturn a",
    "wide": "a = []\nfor _ in range(50):\n    a = [a] * 50\nreturn a",
    "objects": "return np.array([Odd(w)] * 9, object).reshape(3, 3)",
    "subclass": "return np.eye(3).view(Array)",
    "list that raises": "return Items([1, 2, 3])",
    "generator": "return (x for x in w)",
    "silent error": "raise Silent",
    "surrogate": r"raise ValueError('\ud800 \x00 \x1b[2J')",
    "no error of Python": "raise BaseException('no')",
    "interrupt": "raise KeyboardInterrupt",
    "exit": "import os\nos._exit(0)",
    "crash": "import ctypes\nctypes.string_at(0)",
    "stopped": "import os, signal\nos.kill(os.getpid(), signal.SIGSTOP)\n" + RIGHT_SKEW,
    "group stopped": "import os, signal\nos.killpg(0, signal.SIGSTOP)\n" + RIGHT_SKEW,
    "unwatched": UNWATCHED + LOOP,
    "deaf": DEAF + UNWATCHED + LOOP,
    "swallowing": "while True:\n    try:\n        x = 1\n    except BaseException:\n        pass",
    "stays": SLEEP + "return tw.skew(w) + 1",
    "stays apart": TWICE + "return tw.skew(w) + 1",
    "stays and exits": SLEEP + "import os\nos._exit(0)",
    "garbage": WRITES.replace("WHAT", "b'garbage' * 3000") + "return tw.skew(w) + 1",
    "a pickle": WRITES.replace("WHAT", PICKLE) + "return tw.skew(w) + 1",
    "endless garbage": "while True:\n    " + WRITES.replace("\n", "\n    ").replace("WHAT", "b'x' * 60000"),
    "closed": "import os\nos.closerange(3, 100)\n" + RIGHT_SKEW,
    "own json": WRITES.replace("WHAT", "b'[\"answer\", [true, []]]\\n'") + "return tw.skew(w) + 1",
    "memory": "return np.ones((10**6, 10**6))",
    "recursion": "return skew(w)",
    "forks": "import os\nwhile os.fork():\n    pass",
    "threads": "import threading\nthreading.Thread(target=lambda: max(iter(int, 1))).start()\nreturn tw.skew(w) + 1",
}
"""By its kind, what stands in `skew`."""

FILES = {
    "names that raise": lambda file, text: file.write_text(text + "\ndef __getattr__(name):\n    raise RuntimeError\n"),
    "a pipe": lambda file, text: (file.unlink(), os.mkfifo(file)),
    "zeros": lambda file, text: (file.unlink(), file.symlink_to("/dev/zero")),
    "a folder": lambda file, text: (file.unlink(), file.mkdir()),
    "nothing there": lambda file, text: (file.unlink(), file.symlink_to("nowhere")),
    "much": lambda file, text: file.write_bytes(text.encode() + b"#" * 2_000_000),
    "no text": lambda file, text: file.write_bytes(bytes(range(256)) * 10),
    "deep": lambda file, text: file.write_text(text + "\nx = " + "(" * 5000 + ")" * 5000 + "\n"),
    "forgets": lambda file, text: file.write_text(text + "\nimport sys\nsys.modules.clear()\n"),
    "patches": lambda file, text: file.write_text(text + "\nimport json\njson.dumps = lambda *x: 1 / 0\n"),
}
"""By its kind, what is done to the file; its text comes with a right `act`."""

ROOMS = {
    "hints are a list": '{"hints": []}',
    "hints are a word": '{"hints": {"49.0.1": "many", "49.0.2": -3}}',
    "solutions are null": '{"solutions": null, "compared": 7, "language": []}',
    "deep": "[" * 100_000,
    "a list": "[1, 2]",
    "no text": "\x00",
}
"""By its kind, what stands in the hidden file; both functions are right."""


def hand_in(room, *, bodies=BODIES, files=FILES, rooms=ROOMS):
    """Write the class into a folder: a folder for each kind."""
    for kind, body in bodies.items():
        start(room / f"body, {kind}", language="en")
        filled = body.replace("MARKED", str(room / "was here"))
        write(room / f"body, {kind}", "49.0", {"act": RIGHT, "skew": filled}, more=ODD)
    for kind, change in files.items():
        start(room / f"file, {kind}", language="en")
        write(room / f"file, {kind}", "49.0", {"act": RIGHT, "skew": RIGHT_SKEW})
        file = room / f"file, {kind}" / "ex_49_0.py"
        change(file, file.read_text(encoding="utf-8"))
    for kind, text in rooms.items():
        start(room / f"room, {kind}", language="en")
        write(room / f"room, {kind}", "49.0", {"act": RIGHT, "skew": RIGHT_SKEW})
        (room / f"room, {kind}" / COURSE.state_file).write_text(text, encoding="utf-8")
