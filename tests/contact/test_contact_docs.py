"""docs/contacts.md: its blocks run, and both languages have the same ones."""

from __future__ import annotations

import re

import pytest

from ..pages import blocks, names_author_and_licence, page, run


def sources(language: str = "") -> list[str]:
    text = page("contacts", language).read_text(encoding="utf-8")
    return blocks(text, 0, len(text))


@pytest.mark.slow
def test_every_block_of_the_page_runs():
    assert len(sources()) == 13
    run(page("contacts"), sources())


def test_both_languages_have_the_same_code_and_name_author_and_licence():
    assert [b.strip("\n") for b in sources()] == [b.strip("\n") for b in sources(".zh-CN")]
    for language in ("", ".zh-CN"):
        assert names_author_and_licence(page("contacts", language))


def test_no_line_of_code_is_too_long_and_every_block_but_the_first_asserts():
    for block in sources():
        assert max(map(len, block.splitlines())) <= 120
    assert all(re.search(r"^assert ", block, re.MULTILINE) for block in sources()[1:])
