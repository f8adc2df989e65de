"""The formulas of the tables become TeX, and the rows of the map become cards that lead on."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from website import pages, typeset  # noqa: E402

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


def test_cells_that_are_formulas_and_no_others_are_set():
    row = "| mass matrix | M | `M` | no | 9.81 m/s² up | M q̈ + h = τ |"
    said = r"| mass matrix | $M$ | `M` | no | 9.81 m/s² up | $M \ddot{q} + h = \tau$ |"
    assert typeset.in_tables(f"M a = τ\n{row}\n") == f"M a = τ\n{said}\n"


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
