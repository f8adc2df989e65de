"""docs/everyday.md: the same code in both languages, and it holds."""

import re

import pytest

from ..pages import blocks, numbered, page, run

START, PARTS = numbered("everyday")


def test_both_languages_have_the_same_code():
    texts = [page("everyday", language).read_text(encoding="utf-8") for language in ("", ".zh-CN")]
    english, chinese = ([re.sub(r" *#.*", "", block).strip() for block in blocks(t, 0, len(t))] for t in texts)
    assert english == chinese


@pytest.mark.parametrize("part", PARTS, ids=lambda part: part.heading[1])
def test_each_answer_holds_after_the_first_block_alone(part, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the page writes a URDF
    assert part.blocks
    assert all("assert" in block for block in part.blocks)
    run(page("everyday"), [*START, *part.blocks])
