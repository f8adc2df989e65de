"""Wrong answers that somebody has written: most are named, none passes. They are counted; no sentence is looked at."""

import json
from pathlib import Path

import numpy as np
import pytest

import twistwrench as tw
from misstep.judge import judge
from twistwrench.exercises import mine
from twistwrench.exercises.chapter import COURSE

from ..sampling import drawn

FILES = ("answers_of_strangers.jsonl", "wrong_answers.jsonl")
"""Answers that somebody wrote who did not know the engine, and those that tests of the engine had."""

WRITTEN = {
    name: [json.loads(line) for line in Path(__file__).with_name(name).read_text(encoding="utf-8").splitlines()]
    for name in FILES
}
NAMED = ("slip", "line", "reference", "structure")
LEAST = 0.84
"""The share that must be named."""


def verdict(folder, answer):
    exercise, part = COURSE.find_part(answer["part"])
    code = answer["code"]
    if f"def {part.name}(" not in code and f"class {part.name}" not in code:
        code = f"def {part.name}({part.arguments}):\n" + "\n".join("    " + line for line in code.split("\n"))
    path = folder / "answer.py"
    uses = "".join(f"{name} = mine({name!r})\n" for name in exercise.uses)
    path.write_text(uses + code + "\n", encoding="utf-8")
    names = {"np": np, "tw": tw, "mine": mine, "__file__": str(path)}
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), names)
    return judge(exercise, part, names[part.name])


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("every", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_most_wrong_answers_are_named_none_passes_and_right_ones_do(tmp_path, name, every):
    """The plain run takes every sixtieth answer, the slow one an eighth, drawn, or all with TWISTWRENCH_DRAW=all."""
    written = WRITTEN[name]
    answers = drawn(written, len(written) // 8) if every else written[::60]
    found = [(answer, verdict(tmp_path, answer)) for answer in answers]
    wrong = [x for answer, x in found if not answer.get("right")]
    assert [answer for answer, x in found if (x.state == "done") != bool(answer.get("right"))] == []
    named = sum(x.how in NAMED for x in wrong) / len(wrong)
    assert named >= (LEAST if len(found) == len(written) else 0.5)  # a few answers may all be hard
