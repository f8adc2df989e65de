"""Formulas as they stand in Markdown, V_i = ⁱX_λ(i) V_λ(i) + S_i q̇_i, as TeX; what it cannot read stays as it is.

The notation: a letter is a symbol; `_i`, `_λ(i)`, `_c,b` and ₀ stand below it, ᵀ, ⁻¹, * and `^A` above; ᴬ before a
letter is the frame in which it is told; dots and hats stand on it; × behind it without a blank makes a matrix of it.
A semicolon between brackets begins the next row of a matrix.
"""

from __future__ import annotations

import re
import unicodedata

__all__ = ["TOKEN", "apart", "tex"]

GREEK = {
    letter: "\\" + (name.lower() if letter.islower() else name.capitalize()).replace("amda", "ambda")
    for letter in "αβγεηθκλμνξπρστφχψωΓΔΘΛΞΠΣΦΨΩ"
    if (name := unicodedata.name(letter).split()[-1])
}
SIGNS = {"−": "-", "×": r"\times", "·": r"\cdot", "⊕": r"\oplus", "⊖": r"\ominus", "⊥": r"\perp", "‖": r"\Vert"}
SIGNS |= {"→": r"\to", "←": r"\leftarrow", "≤": r"\le", "≥": r"\ge", "≠": r"\ne", "≈": r"\approx", "…": r"\dots"}
SIGNS |= {"½": r"\tfrac12", "∞": r"\infty", "∂": r"\partial", "∫": r"\int"} | {sign: sign for sign in "=+-/,<>"}
MARKS = {"\u0307": "dot", "\u0308": "ddot", "\u0302": "hat", "\u0303": "tilde", "\u0304": "bar"}
ABOVE = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ᵀᴬᴮᴳᵂᵃᵇᶜⁱʲᵏⁿᵖˢ", "0123456789-+TABGWabcijknps", strict=True))
RAISED = ABOVE | {"∧": r"\wedge", "∨": r"\vee", "'": r"\prime", "’": r"\prime"}
BELOW = dict(zip("₀₁₂₃₄₅₆₇₈₉ᵢⱼₖₙ", "0123456789ijkn", strict=True))
WORDS = {
    word: rf"\operatorname{{{word}}}" for word in ("diag", "vec", "tr", "blkdiag", "axis", "RNEA", "ABA", "CRBA", "Ad")
}
WORDS |= {word: rf"\{word}" for word in ("exp", "log", "sin", "cos", "tan", "det", "min", "max")}
WORDS |= {f"{kind}{axis}": f"{kind}_{axis}" for kind in "RT" for axis in "xyz"}  # a turn, a shift, along an axis
WORDS |= {f"d{x}": rf"\mathrm{{d}}{x}" for x in "mtw"} | {"d/dt": r"\tfrac{\mathrm{d}}{\mathrm{d}t}"}
WORDS |= {"SE": r"\mathrm{SE}", "SO": r"\mathrm{SO}", "se": r"\mathfrak{se}", "so": r"\mathfrak{so}"}
WORDS |= {f"q{part}": f"q_{part}" for part in "wxyz"} | {"mg": "m g"}
WORDS |= {"nq": "n_q", "nv": "n_v", "...": r"\dots", "+=": "\\mathrel{{+}{=}}", "−=": "\\mathrel{{-}{=}}"}

LETTER = r"[A-Za-z\u0370-\u03ff]"
TOKEN = re.compile(
    rf"(?P<word>{'|'.join(sorted(map(re.escape, WORDS), key=len, reverse=True))})(?![A-Za-z\u0300-\u036f])"
    rf"|(?P<plain>[A-Za-z]{{3,}})|(?P<total>Σ(?= [^=]))|(?P<letter>{LETTER})(?P<mark>[\u0300-\u036f]?)"
    rf"|(?P<open>[√^]?[(\[])|_(?P<below>λ\(\w\)|{LETTER}+(?:,[a-z])?|[0-9]+)|(?P<lowered>[{''.join(BELOW)}]+)"
    rf"|\^(?P<above>λ\(\w\)|-?[0-9]+|{LETTER})|(?P<raised>[{''.join(ABOVE)}]+|\*|[∧∨]|['’])"
    rf"|(?P<cross>×)|(?P<number>[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?)|(?P<sign>[{re.escape(''.join(SIGNS))}])| +"
)
ROW = r"\[.*,.*\]"


class Unread(ValueError):
    """Not in the notation."""


def tex(text: str) -> str | None:
    """Return a formula as TeX, or None where it is not in the notation."""
    try:
        return _read(apart(text.strip())) or None
    except Unread:
        return None


def apart(text: str) -> str:
    """Return a text with its marks apart from their letters; ≠ stays one sign."""
    return unicodedata.normalize("NFD", text).replace("=\u0338", "≠")


class Symbol:
    """What stands on the line, with what stands below and above it."""

    def __init__(self, base: str) -> None:
        self.base, self.below, self.above = base, "", ""

    def __str__(self) -> str:
        below, above = (f"{sign}{{{text}}}" if text else "" for sign, text in (("_", self.below), ("^", self.above)))
        return f"{self.base}{below}{above}"


def _read(text: str) -> str:
    """Return a formula, or a part of one, as TeX."""
    symbols, at, last = [], 0, " "
    while at < len(text):
        token = TOKEN.match(text, at)
        if not token or token["plain"]:
            raise Unread(text[at:])
        attached, at = bool(symbols) and last not in " =+-−/,", token.end()
        if token["open"]:
            end = _closing(text, at)
            symbols.append(_bracket(token["open"], text[at:end]))
            at = end + 1
            if token["open"] == "^[" and text[at : at + 1] == "×":
                symbols[-1], at = Symbol(f"{symbols[-1]}_\\times"), at + 1
            if token["open"][0] == "^":
                power = symbols.pop()
                symbols[-1].above += str(power)
        elif token.lastgroup in ("below", "lowered", "above", "raised"):
            _hang(symbols, token, attached)
        elif token["cross"] and attached:
            _cross(symbols)
        elif token.lastgroup:
            symbols.append(Symbol(_on_the_line(token)))
        last = text[at - 1]
    return " ".join(map(str, symbols))


def _closing(text: str, at: int) -> int:
    """Return where the bracket that was opened before a place is closed."""
    open_ = 1
    for k in range(at, len(text)):
        open_ += (text[k] in "([") - (text[k] in ")]")
        if not open_:
            return k
    raise Unread(text[at:])


def _bracket(kind: str, inside: str) -> Symbol:
    """Return what stands in brackets: a root, a power, a matrix, or a part of a formula."""
    if kind == "[" and re.fullmatch(r"\[.*,.*\]", inside) and all(re.fullmatch(ROW, row) for row in _cut(inside, ",")):
        inside = "; ".join(row[1:-1] for row in _cut(inside, ","))  # [[R, 0], [0, R]], as NumPy writes it
    if kind[-1] == "[" and ";" in inside:
        rows = r" \\ ".join(" & ".join(map(_read, _cut(row, ","))) for row in _cut(inside, ";"))
        return Symbol(rf"\begin{{bmatrix}} {rows} \end{{bmatrix}}")
    if kind == "^(":
        return Symbol(_read(inside))
    if kind[0] == "√":
        return Symbol(rf"\sqrt{{{_read(inside)}}}")
    return Symbol(f"({_read(inside)})" if kind[-1] == "(" else f"[{_read(inside)}]")


def _cut(text: str, sign: str) -> list[str]:
    """Cut a text at a sign, where that stands in no inner brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == sign and not depth:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def _hang(symbols: list[Symbol], token: re.Match[str], attached: bool) -> None:
    """Hang an index or a power on the symbol before it; with none before it, it belongs to the next one."""
    if not attached:
        symbols.append(Symbol("{}"))
    if token["raised"]:
        above = "".join(RAISED.get(letter, letter) for letter in token[0])
        symbols[-1].above += re.sub("T", r"\\mathsf{T}", above) if attached else above
    elif token["above"]:
        symbols[-1].above += _read(token["above"])
    else:
        below = token["below"] or "".join(BELOW[letter] for letter in token["lowered"])
        symbols[-1].below += _read(below) if len(below) < 3 or not below.isalpha() else rf"\mathrm{{{below}}}"


def _cross(symbols: list[Symbol]) -> None:
    """Make the matrix of a cross product: of brackets by an index, of a letter by a × behind it."""
    if symbols[-1].base.endswith("]"):
        symbols[-1].below += r"\times"
    else:
        symbols.append(Symbol(r"{\times}"))


def _on_the_line(token: re.Match[str]) -> str:
    """Return a letter, a number, a word or a sign."""
    if token["letter"]:
        letter = GREEK.get(token["letter"], token["letter"])
        if not letter.isascii() or token["mark"] not in {"", *MARKS}:
            raise Unread(token[0])
        return rf"\{MARKS[token['mark']]}{{{letter}}}" if token["mark"] else letter
    if token["total"]:
        return r"\sum"
    if token["number"] and "e" in token[0]:
        factor, power = token[0].split("e")
        return rf"10^{{{power}}}" if factor == "1" else rf"{factor} \cdot 10^{{{power}}}"
    return WORDS.get(token[0]) or SIGNS.get(token[0]) or token[0]
