"""The field's words: none of the package's former private vocabulary in names, docstrings, comments and messages.

A reader of Featherstone's book should learn no second language here, and who learns here should be able to search
elsewhere.
"""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

import pytest

SOURCE = Path(__file__).resolve().parents[2] / "src" / "twistwrench"
TEXT = {p.relative_to(SOURCE).as_posix(): p.read_text(encoding="utf-8") for p in sorted(SOURCE.rglob("*.py"))}

PROSE = {
    r"\bdoors?\b": "arguments, input validation",
    r"\bbehind\b": "outboard (of a joint), after",
    r"\bbeyond (it|them|(a|the|its|this|that|free|each) \w*joints?|joints?|(a|the|its) bod(y|ies))\b": "outboard of",
    r"\b(feels?|felt)\b": "apparent inertia",
    r"(?<!there )\b(is|are|was|were) (?-i:none)\b": "is not a ..., does not have one",
    r"(?<!there )\bis no (?!(longer|more|larger|other|less) )": "is not a ...",
    r"\bcame\b": "got, given",
    r"\btold\b": "given, reported",
    r"\bsays? (so|it|which|what|why|where|how)\b": "reports, returns, names",
    r"\brefus(e|es|ed|ing|al|als)\b": "raise, reject",
    r"\bcounts? as none\b": "counts as zero",
    r"\bdoubts?\b": "error bound",
    r"\bhand(ed|s|ing)? ?over\b": "convert",
    r"\bpassed_on\b": "propagated bound",
}
"""Of docstrings, comments and messages; each with what the field says."""

FIRST_WORD = {
    r"(Say|Tell)\b": "Return, Report",
    r"Refuse\b": "Raise, Reject",
}
"""Of the first line of a docstring."""

NAMES = {
    "door": "arguments",
    "admit": "arguments",
    "handover": "conversion",
    "doubt": "error bound",
    "felt": "apparent inertia",
    "feels": "apparent inertia",
    "kick": "Coriolis term",
    "seat": "placement",
    "looks": "indices",
    "still": "constant part",
    "touching": "contact rows",
    "doings": "joint terms",
    "came": "got",
    "told": "given",
    "How": "Options",
}
"""Of the parts of names, as they are split at underscores."""

EXCEPT = {
    "felt": "the older name of the public `Accuracy.apparent_inertia`",
    "felt_mass": "public: what a hand feels that pushes a body",
    "seats": "public: places of the bodies in a drawing of the tree",
}
"""Names that stay, and why."""


def prose(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and text of every comment, and of every string that is more than one word."""
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        kind = tokenize.tok_name[token.type]
        if kind == "COMMENT" or (kind in ("STRING", "FSTRING_MIDDLE") and " " in token.string.strip()):
            for k, line in enumerate(without_code(token.string).split("\n")):
                yield token.start[0] + k, line


def without_code(text: str) -> str:
    """Take out what is quoted as code: names in backticks."""
    return re.sub(r"``[^`\n]*``|`[^`\n]*`", "``", text)


def names(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and name of all that a file defines, and of all arguments and variables."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            yield node.lineno, node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.id
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
            yield node.lineno, node.attr
        elif isinstance(node, ast.arg):
            yield node.lineno, node.arg


def old_prose(text: str) -> list[str]:
    """Return the former words in a file's prose, each with its line and the field's word."""
    found = [
        f"{line}: {match[0]!r} -> {better}"
        for line, words in prose(text)
        for pattern, better in PROSE.items()
        if (match := re.search(pattern, words, re.IGNORECASE))
    ]
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef | ast.Module):
            first = (ast.get_docstring(node) or "").split("\n")[0]
            found += [
                f"{getattr(node, 'lineno', 1)}: {match[0]!r} -> {better}"
                for pattern, better in FIRST_WORD.items()
                if (match := re.match(pattern, first))
            ]
    return found


def old_names(text: str) -> list[str]:
    """Return the former words in a file's names, each with its line and the field's word."""
    return [
        f"{line}: {name} -> {NAMES[part]}"
        for line, name in names(text)
        if name not in EXCEPT
        for part in name.strip("_").split("_")
        if part in NAMES
    ]


@pytest.mark.parametrize("file", list(TEXT))
def test_a_file_speaks_the_fields_words(file):
    assert old_prose(TEXT[file]) + old_names(TEXT[file]) == []


@pytest.mark.parametrize(
    "text",
    [
        '"""The check at the door."""',
        "x = 1  # what came",
        'f"nothing behind joint {name}"',
        '"""Say what is wrong."""',
        '"""Refuse a batch."""',
        "came = 1",
        "class How: ...",
        "def f(doubt): ...",
    ],
)
def test_a_former_word_is_found(text):
    assert old_prose(text) + old_names(text) != []


@pytest.mark.parametrize("text", ['"""See `refuse_singular` and ``came``."""', "distance = 1", '"came"'])
def test_other_words_and_names_in_backticks_pass(text):
    assert old_prose(text) + old_names(text) == []
