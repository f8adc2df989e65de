"""docs/everyday.md: the same code in both languages, and it holds."""

import re

from ..pages import blocks, numbered, page, run

START, PARTS = numbered("everyday")


def test_both_languages_have_the_same_code():
    texts = [page("everyday", language).read_text(encoding="utf-8") for language in ("", ".zh-CN")]
    english, chinese = ([re.sub(r" *#.*", "", block).strip() for block in blocks(t, 0, len(t))] for t in texts)
    assert english == chinese


def test_the_answers_hold(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the page writes a URDF
    assert all("assert" in block for part in PARTS for block in part.blocks)
    run(page("everyday"), [*START, *(block for part in PARTS for block in part.blocks)])
