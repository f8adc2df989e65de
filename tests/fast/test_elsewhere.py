"""docs/elsewhere.md: the same code in both languages, and it holds in each library that is installed."""

import re

import pytest

from ..pages import cut, page, run

HEADING = re.compile(r"^## (.+)$", re.MULTILINE)
START, (DERIVATIVE, *LIBRARIES) = cut(page("elsewhere"), HEADING)


def test_both_languages_have_the_same_code():
    def code(language):
        start, parts = cut(page("elsewhere", language), HEADING)
        return [re.sub(r" *#.*", "", block).strip() for block in [*start, *(b for part in parts for b in part.blocks)]]

    assert code("") == code(".zh-CN")


@pytest.mark.parametrize("part", LIBRARIES, ids=lambda part: part.heading[1])
def test_a_program_computes_and_differentiates_in(part):
    pytest.importorskip(part.heading[1].lower())
    assert sum(block.count("\nassert ") for block in part.blocks) >= 2
    run(page("elsewhere"), [*START, *DERIVATIVE.blocks, *part.blocks])
