"""docs/which.md: the same code in both languages, and its assertions hold."""

from __future__ import annotations

import re

from ..pages import blocks, page, run

ENGLISH, CHINESE = (page("which", language).read_text(encoding="utf-8") for language in ("", ".zh-CN"))


def test_both_languages_have_the_same_code_and_it_runs():
    code = [[re.sub(r"#.*", "", block).strip() for block in blocks(text, 0, len(text))] for text in (ENGLISH, CHINESE)]
    assert code[0] == code[1]
    assert len(code[0]) == 2
    run(page("which"), blocks(ENGLISH, 0, len(ENGLISH)))
