"""The formulas of the tables become TeX, and the rows of the map become cards that lead on."""

import re
import sys
import unicodedata
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from website import pages, typeset  # noqa: E402

prose = pytest.importorskip("website.prose", reason="Sphinx is not installed: no formula is looked for in a text")

WORDS = re.compile(r"\b(?:over|tetrahedra|const|getDynamics)\b")
"""What the map's column of formulas says in words."""


def formulas(language):
    text = (ROOT / "docs" / f"map{pages.SUFFIX[language]}.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    return [row[1] for row in rows if row[2].startswith("`") and row[1]]


@pytest.mark.parametrize(
    ("text", "tex"),
    [
        ("v_P = v_O + ω × r_PO", r"v_{P} = v_{O} + \omega \times r_{P O}"),
        ("V̇_i = ⁱX_λ(i) V̇_λ(i)", r"\dot{V}_{i} = {}^{i} X_{\lambda (i)} \dot{V}_{\lambda (i)}"),
        ("⁰T_λ(i) ^λ(i)T_i", r"{}^{0} T_{\lambda (i)} {}^{\lambda (i)} T_{i}"),
        ("[ω]× = log R", r"[\omega]_{\times} = \log R"),
        ("D[w]×²", r"D [w]_{\times}^{2}"),
        ("R = e^[ω]×", r"R = e^{[\omega]_\times}"),
        ("e^([V]∧ t)", r"e^{[V]^{\wedge} t}"),
        ("V×* = −(V×)ᵀ", r"V {\times}^{*} = - (V {\times})^{\mathsf{T}}"),
        ("V ×* Î V", r"V \times^{*} \hat{I} V"),
        ("ᴳX*_iᵀ", r"{}^{G} X_{i}^{*\mathsf{T}}"),
        ("X⁻ᵀ = [R, [p]×R; 0, R]", r"X^{-\mathsf{T}} = \begin{bmatrix} R & [p]_{\times} R \\ 0 & R \end{bmatrix}"),
        ("J_c,bᵀ λ", r"J_{c , b}^{\mathsf{T}} \lambda"),
        ("Σ = ½ tr(I) 1 − I", r"\Sigma = \tfrac12 \operatorname{tr} (I) 1 - I"),
        ("m = Σ m_i", r"m = \sum m_{i}"),
        ("√(f_x² + f_y²) ≤ μ f_z", r"\sqrt{f_{x}^{2} + f_{y}^{2}} \le \mu f_{z}"),
        ("v' = 2e-12 R^-1", r"v^{\prime} = 2 \cdot 10^{-12} R^{- 1}"),
        ("[[R, [p]×R], [0, R]]", r"\begin{bmatrix} R & [p]_{\times} R \\ 0 & R \end{bmatrix}"),
        ("[u, [u, v]]", "[u , [u , v]]"),
        ("p_i^A += F_ext", r"p_{i}^{A} \mathrel{{+}{=}} F_{\mathrm{ext}}"),
    ],
)
def test_a_formula_in_tex(text, tex):
    assert typeset.tex(text) == tex


@pytest.mark.parametrize("text", ["Σ over tetrahedra", "data.liMi[i]", "`x` = 1", "(a, b", "x̆", "质量", ""])
def test_what_is_not_a_formula_stays_text(text):
    assert typeset.tex(text) is None


@pytest.mark.parametrize("language", pages.LANGUAGES)
def test_every_formula_of_the_map_is_read(language):
    found = formulas(language)
    assert len(found) > 150
    assert [text for text in found if typeset.tex(text) is None and not WORDS.search(text)] == []
    assert not any(ord(letter) > 127 for text in found for letter in typeset.tex(text) or "")


def set_in(text):
    """The text with each formula that is found between brackets of its own."""
    text, out, at = typeset.apart(text), "", 0
    for start, end, _ in prose.found(text):
        out, at = f"{out}{text[at:start]}⟦{text[start:end]}⟧", end
    return unicodedata.normalize("NFC", out + text[at:])


@pytest.mark.parametrize(
    "said",
    [
        "the equation ⟦M q̈ + h = τ⟧ of a robot",
        "⟦ω × I ω⟧ is there; only ⟦ω × m v⟧, comes from the axes",
        "Prove that ⟦X_AC = X_AB X_BC⟧. First check it",
        "in the order ⟦(v, ω)⟧, and stores ⟦(x, y, z, qw)⟧.",
        "at ⟦c = (0, 0, 0.1)⟧ m, with ⟦ω_z = 0.5⟧ rad/s",
        "frames ⟦A⟧ and ⟦B⟧: from ⟦B⟧ to ⟦A⟧",
        "2. 49.1 ⟦nq = nv⟧ is not about the base",
        "⟦A_G a + Ȧ_G v⟧: with ⟦τ⟧ a robot, and ⟦v⟧ and ⟦a⟧ are its rates",
        "证明 ⟦X_AC = X_AB X_BC⟧：⟦M⟧ 是质量矩阵，⟦ω = 0⟧ 时",
        "it takes ⟦O(N²)⟧, in ⟦SE(3)⟧, with ⟦0 < h < ∞⟧ and ⟦v ≠ 0⟧",
        "⟦V×⟧ and ⟦V×* = −(V×)ᵀ⟧, not ⟦X[i]⟧",
        "is up to 7.277 kg, 157.79 N, 54.3 rad/s² or 0.2 N m",
        "A Go2 is a 6 × 6 matrix; an array (..., n, 6)",
        "and SE3.action, J. Robotics, FR_foot, C in Python, oMi · c_i, data.M",
        "49.3 ⟦X*⟧ of wrenches",
        "what the torque = nothing, and Σ over tetrahedra",
        "it has 1198 (2234), up to 2e-14",
    ],
)
def test_formulas_are_found_in_a_sentence_and_nothing_else_is(said):
    assert set_in(re.sub("[⟦⟧]", "", said)) == said


def test_the_cells_of_the_tables_are_formulas():
    for cell in ("V̇_i", "J_c,bᵀ λ", "D[w]×²", "√(f_x² + f_y²) ≤ μ f_z", "λ(i)", "a"):
        assert set_in(cell) == f"⟦{cell}⟧"


def test_lines_that_follow_each_other_are_one_text():
    docutils = pytest.importorskip("docutils.nodes")
    words = [docutils.Text(part) for part in ("with M q̈ + h", "\n", "= 0.5 m, and a", "\n", "turn")]
    made = prose._nodes("".join(words))
    assert [node.astext() for node in made] == ["with ", r"M \ddot{q} + h = 0.5", "\u00a0", "m, and a turn"]


@pytest.mark.parametrize("language", pages.LANGUAGES)
def test_each_row_of_the_map_is_a_card_that_leads_on(language):
    pytest.importorskip("sphinx", reason="Sphinx is not installed: the site is not checked")
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed: the notebooks are not named")
    from website import cards

    assert nbformat
    text = (ROOT / "docs" / f"map{pages.SUFFIX[language]}.md").read_text(encoding="utf-8")
    page = cards.in_place_of_tables(text, language)
    assert page.count("\n- **") == len(re.findall(r"^\|[^|]*\|[^|]*\| `", text, re.MULTILINE)) > 150
    assert "\n|" not in page
    assert page.count("chapter/49_") == 11
    for file, number, quoted in re.findall(r'_modules/twistwrench/([\w/]+)\.html#L(\d+)">``(.*?)``</a>', page):
        lines = (ROOT / "src" / "twistwrench" / f"{file}.py").read_text(encoding="utf-8").splitlines()
        assert lines[int(number) - 1].strip() == quoted
    assert "Σ over tetrahedra" in page or language == "zh"
