"""docs/control.md: the same code in both languages, and it does what the page says."""

from __future__ import annotations

import re

import pytest

from ..pages import blocks, page, run

ENGLISH, CHINESE = (page("control", language).read_text(encoding="utf-8") for language in ("", ".zh-CN"))


def test_both_languages_have_the_same_code():
    code = [[re.sub(r"#.*", "", block).strip() for block in blocks(text, 0, len(text))] for text in (ENGLISH, CHINESE)]
    assert code[0] == code[1]
    assert len(code[0]) == 6


@pytest.mark.slow(one_in=3)
def test_the_code_of_the_page_runs(capsys):
    """Its assertions hold, and what it prints is what the text says of it."""
    run(page("control"), blocks(ENGLISH, 0, len(ENGLISH)))
    said = capsys.readouterr().out
    assert "from t = 0 s the motor of joint 'pivot' gives 31.42 N m or N; it can 20" in said
    assert "no contact pulls or leaves its cone" in said
