"""Figures with Chinese words, on machines with and without a Chinese font."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

__all__ = ["chinese", "word"]

FONTS = (
    *("Noto Sans CJK SC", "Noto Sans SC", "Source Han Sans SC", "Microsoft YaHei", "PingFang SC", "Heiti SC", "SimHei"),
    *("WenQuanYi Micro Hei", "WenQuanYi Zen Hei", "Droid Sans Fallback", "Arial Unicode MS"),
)
"""Fonts that have Chinese characters, on Linux, Windows and macOS."""
BLANK = "twistwrench blank"
LATIN = "DejaVu Sans"
WIDE = (*range(0x2E80, 0x3100), *range(0x4E00, 0xA000), *range(0xFF00, 0xFF61))
"""The characters as wide as they are high: radicals, punctuation, Han, full-width forms."""
WORDS = {
    "centre of mass": "质心",
    "velocity": "速度",
    "full colour: ±{:.2g}, half: ±{:.2g}": "全色：±{:.2g}，半色：±{:.2g}",
    "grey: in both orders; orange: in M = L Lᵀ alone": "灰：两种顺序都有；橙：只在 M = L Lᵀ 中有",
    "force of the ground": "地面的力",
    "support polygon": "支撑多边形",
    "the choice": "选中的",
    "exact enough": "足够精确",
    "  + torques": "  + 力矩",
    "time [µs per state]": "时间 [每个状态 µs]",
    "{}: largest errors of {}": "{}：{} 的最大误差",
}
"""What the functions of this folder, and `Costs.plot`, write by themselves."""


def chinese() -> None:
    """Let figures have Chinese words: in a notebook as SVG, whose text the reader's browser draws.

    The layout needs the width of each character. Without a Chinese font it comes from a font of blanks, so a figure
    that is saved as PNG on such a machine has gaps where its Chinese words should be. The fonts are matplotlib's
    settings: `matplotlib.rcdefaults` makes figures English again.
    """
    import matplotlib
    from matplotlib import font_manager

    installed = set(font_manager.get_font_names())
    own = next((name for name in FONTS if name in installed), BLANK)
    if own == BLANK and BLANK not in installed:
        font_manager.fontManager.addfont(_blank_font(Path(matplotlib.get_cachedir()) / "blank.ttf"))
    matplotlib.rcParams.update({"font.family": [LATIN, own], "svg.fonttype": "none"})
    if "ipykernel" in sys.modules:
        from matplotlib_inline import backend_inline

        show: Any = backend_inline
        show.set_matplotlib_formats("svg")


def word(english: str) -> str:
    """Return a word in the language of the figures: those of `WORDS` have a Chinese one."""
    from matplotlib import rcParams

    family = rcParams["font.family"]
    return WORDS.get(english, english) if family[0] == LATIN and {*family[1:]} & {*FONTS, BLANK} else english


def _blank_font(path: Path) -> Path:
    """Write a font whose characters are blank, and each as wide as it is high."""
    from fontTools.fontBuilder import FontBuilder
    from fontTools.ttLib.tables._g_l_y_f import Glyph

    names = [".notdef", "blank"]
    font = FontBuilder(1000, isTTF=True)
    font.setupGlyphOrder(names)
    font.setupCharacterMap(dict.fromkeys(WIDE, "blank"))
    font.setupGlyf({name: Glyph() for name in names})
    font.setupHorizontalMetrics(dict.fromkeys(names, (1000, 0)))
    font.setupHorizontalHeader(ascent=880, descent=-120)
    font.setupNameTable({"familyName": BLANK, "styleName": "Regular"})
    font.setupOS2()
    font.setupPost()
    font.save(path)
    return path
