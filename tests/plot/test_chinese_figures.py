"""Figures with Chinese words: the text is kept as text, as wide as a browser will write it."""

import io
import warnings

import pytest

import twistwrench as tw

from ..robots import shared

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed: no figures")


@pytest.fixture
def in_chinese():
    with matplotlib.rc_context():
        tw.plot.chinese()
        yield


def svg(figure):
    text = io.StringIO()
    figure.savefig(text, format="svg")
    return text.getvalue()


def test_chinese_words_are_text_of_the_right_width_and_no_glyph_is_missing(in_chinese):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(dpi=72)
    label = figure.text(0.1, 0.5, "质心与力矩，二", fontsize=20)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ">质心与力矩，二</text>" in svg(figure)
        width = label.get_window_extent(FigureCanvasAgg(figure).get_renderer()).width
    assert width == pytest.approx(7 * 20, rel=0.05)


def test_what_a_picture_writes_by_itself_is_chinese_too(in_chinese):
    model = shared("go2")
    q = model.standing()
    ax = tw.plot.foot_forces(model, q, tw.static_equilibrium(model, q).forces)
    assert {line.get_label() for line in ax.lines} >= {"质心", "支撑多边形"}
    assert ax.collections[-1].get_label() == "地面的力"


def test_without_it_and_afterwards_the_words_are_english():
    model = shared("go2")
    with matplotlib.rc_context():
        tw.plot.chinese()
    assert "centre of mass" in {line.get_label() for line in tw.plot.robot(model, model.standing()).lines}
