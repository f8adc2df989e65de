"""Formulas in running text: where in a sentence one begins and ends, so that it is set as the formulas of tables are.

A formula is set whole or not at all. It consists of what typeset.py reads, and it says by a sign, an index or a mark
that it is one: `M q̈ + h = τ`, `J_c`, `(ω, v)`. A letter alone is a symbol, except where it is a word or a unit.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from itertools import groupby
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms.post_transforms import SphinxPostTransform

from . import typeset
from .units import UNITS

START = re.compile(r"(?:^|(?<=[\s(\[“\"—:：（，。、；！？《》「」]|[\u4e00-\u9fff]))(?<!\w[\[(])(?![\s.,;:)\]])")
"""A formula begins a text or a word, or follows an opening bracket or a Chinese letter."""
SHAPE = re.compile(r"\(\.\.\.[^)]*\)")
"""Of an array, (..., n, 6): no formula."""
END = re.compile(r"$|[\s)\]”\"—，。、；：！？（）《》「」]|[\u4e00-\u9fff]|[.,;:!?](?=$|[\s)”\"])|-(?=[a-z]{3})")
"""It ends where a word does."""
REST = re.compile(r"(?P<number>(?!))?(?P<below>(?!))?(?P<word>(?!))?[)\],;\s]")
NOT_YET = re.compile(
    r"49\.[\d.]+\s|(?<![a-z,] )A\s+(?=[A-Za-z]|$)|a\s+(?=[A-Za-z0-9]|$)(?!(?:and|or|is|are)\b)|(?<=do )I\b"
    rf"|[_≠]|[{re.escape(''.join('=+−×·<>≤≥≈→←/'))}] "
)
"""A section's number, an article, or a sign between two things: no formula begins with it."""
RELATION = set("=+−×·<>≤≥≈≠→←⊕⊖⊥-/Σ∂∫√")
"""Signs that join what stands before them to what follows."""
SIGN = re.compile(
    r"[=_⊕⊖∂∫√Σ≤≥≈≠ᵀ⁻^‖∧]|[\u0300-\u036f]|\b[ᴬᴮᴳᵂⁱʲ]|[α-ωΑ-Ω]|\S ?× ?\S|\w×|\S ?[+−·] ?\S|\S [<>] \S"
    r"|^[+−]|^n[qv]$|\w\*|\w[₀-₉²]|[A-Za-z)][(\[]\w"
)
"""What makes a formula of a run of letters."""
LIST = re.compile(r"\((?:[A-Za-z]|q[w-z])(?:, (?:[A-Za-z]|q[w-z]))+\)|[A-Za-z]")
NAME = re.compile(r"[JRD]\.\s*[A-Z]")
"""An initial, or a journal."""
LANGUAGE = re.compile(r"CasADi|Python|LLVM|C\+\+|generate|生成")
"""Beside these, C is the language."""
WORD = re.compile(r"[A-Za-z]{2,}(?![\u0300-\u036f])")
CALLED = {"RNEA", "ABA", "CRBA", "axis", "vec", "min", "max", "tan", "Ad", "diag", "blkdiag", "det", "tr"}
CALLED |= {"SE", "SO", "se", "so"}
"""Words that belong to a formula only with the bracket that follows."""
UNIT = re.compile(rf"[ \u00a0](?:{UNITS}|m/s|rad/s|kg)(?![^\W\d_])")
ONLY_UNITS = re.compile(r"[Nms]|[NmsJWK](?:[²³]|(?:[ ·/]|⁻¹)[NmsJWK]?[²³]?)+")
KEPT = (nodes.FixedTextElement, nodes.literal, nodes.raw, nodes.math, nodes.comment)
KEPT += (addnodes.literal_strong, addnodes.literal_emphasis, addnodes.desc_signature)
NUMBERS = re.compile(r"[\d\s.×·/+−=<>≤≥≈…(),-]*")


def found(text: str) -> list[tuple[int, int, str]]:
    """Return where in a text, in NFD, the formulas begin and end, and each as TeX."""
    formulas, at = [], 0
    for place in START.finditer(text):
        start = place.end()
        if shape := SHAPE.match(text, start):
            at = shape.end()
        if start < at or NOT_YET.match(text, start) or not (end := _end(text, start)):
            continue
        if NOT_YET.match(text, end - 1) and text[end - 2] == " " and text[end - 3] not in RELATION:
            end -= 2  # with τ a robot
        at = end
        if _is_one(text[start:end], text[:start], text[end:]) and (read := typeset.tex(text[start:end])):
            formulas.append((start, end, read))
    return formulas


def _end(text: str, start: int) -> int:
    """Return where the longest formula from a place on ends; 0 where none does, or a sign in it joins it to a word."""
    at, depth, end, sign = start, 0, 0, ""
    while token := (typeset.TOKEN.match(text, at) or REST.match(text, at)):
        word = WORD.match(text, at)
        closes = token[0] in (")", "]")
        if (word and not _fits(text, word, token)) or (not depth and (closes or token[0] in ",;")):
            break
        if token["number"] and text[at - 1 : at] == " " and sign and sign not in RELATION and sign[-1] not in ",;([":
            break  # J_c 12: a symbol and a number
        if not depth and token[0] == "-" and text[at - 1 : at + 2] != " - ":
            break  # x-axis: a hyphen
        depth += token[0][-1] in "(["
        depth -= closes
        crossed = token[0] == "×" and text[at - 1 : at] not in ("", " ")  # V×, a matrix
        at, sign = token.end(), "" if crossed else token[0].strip() or sign
        if not depth and token[0].strip() and sign not in RELATION and END.match(text, at):
            end = at
            if (token["number"] or (closes and text[at - 2].isdigit())) and UNIT.match(text, at):
                break
    return 0 if sign in RELATION and not depth else end


def _fits(text: str, word: re.Match[str], token: re.Match[str]) -> bool:
    """Return whether letters that follow each other are one word of the notation."""
    if token["below"]:
        return True
    if not token["word"] or token.end() < word.end():
        return False
    return token[0] not in CALLED or text[token.end() : token.end() + 1] in ("(", "_")


def _is_one(formula: str, before: str, after: str) -> bool:
    """Return whether a run that can be read as a formula is one."""
    if NUMBERS.fullmatch(formula) or " * " in formula or ONLY_UNITS.fullmatch(formula):
        return False
    if re.search(r"(?<![A-Za-z_^(])[A-Za-z]\d|[A-Za-z]{2}_|\d[A-Za-z_]", formula):
        return False
    if re.search(r"[^\s(] [=+−×·<>≤≥/] $", before) or (re.search(r"\d\s$", before) and UNIT.match(" " + formula)):
        return False  # what a word is joined to, or a unit
    alone = LIST.fullmatch(formula)
    if alone and len(formula) == 1 and (before or after):
        return not NAME.match(formula + after) and not (formula == "C" and LANGUAGE.search(before[-40:] + after[:40]))
    return bool(alone or SIGN.search(formula))


class FormulasAreSet(SphinxPostTransform):
    """Set the formulas wherever a page speaks; code, names and signatures stay as they are written."""

    default_priority = 880  # before words get their links and numbers their units

    def run(self, **_: Any) -> None:
        """Go through the words of a page; those of lines that follow each other belong together."""
        for parent in {text.parent: None for text in self.document.findall(nodes.Text)}:
            if any(isinstance(node, KEPT) for node in _upward(parent)):
                continue
            runs = [[*run] for _, run in groupby(parent.children, lambda child: isinstance(child, nodes.Text))]
            parent.children = []
            for run in runs:
                parent.extend(_nodes("".join(map(_text, run))) if isinstance(run[0], nodes.Text) else run)


def _text(node: nodes.Node) -> str:
    return node.astext()  # not str(node), which has the escapes of the source


def _upward(node: nodes.Node | None) -> Iterator[nodes.Node]:
    while node:
        yield node
        node = node.parent


def _nodes(text: str) -> list[nodes.Node]:
    """Return words and formulas as nodes; a unit stays on the line of its number."""
    words, at, pieces = typeset.apart(text).replace("\n", " "), 0, list[nodes.Node]()
    if not (formulas := found(words)):
        return [nodes.Text(text)]
    for start, end, tex in formulas:
        pieces += [_words(words[at:start]), nodes.math(tex, tex)]
        at = end + 1 if UNIT.match(words, end) else end
        pieces += [_words("\u00a0" * (at - end))]
    return [piece for piece in (*pieces, _words(words[at:])) if piece.astext()]


def _words(text: str) -> nodes.Text:
    return nodes.Text(unicodedata.normalize("NFC", text))


def connect(app: Any) -> None:
    """Do so in every page."""
    app.add_post_transform(FormulasAreSet)
