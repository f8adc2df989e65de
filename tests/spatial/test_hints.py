"""The hints of the algebra's errors: each one, followed to the letter, works and gives what was meant."""

import re

import numpy as np
import pytest

import twistwrench as tw

R, p = tw.exp3([0.3, -0.2, 0.1]), np.array([1.0, 2.0, 3.0])
V, F = tw.Twist([1, 2, 3, 4, 5, 6], frame="base"), tw.Wrench([6, 5, 4, 3, 2, 1], frame="base")
I = tw.SpatialInertia(2.0, [0, 0, 0.1], np.diag([0.3, 0.2, 0.4]))
T, X, A, x = tw.SE3(R, p), tw.motion_transform(R, p), np.ones(6), np.ones(6)
M = T.matrix()
rounded = R.round(7)


def test_the_first_formula_of_the_chapter_just_works_and_keeps_its_type():
    h = I @ V
    assert isinstance(h, tw.Wrench)
    assert h.frame == "base"
    np.testing.assert_array_equal(h.vector, I.momentum(V))
    np.testing.assert_allclose(h.vector, I.matrix() @ V.vector, rtol=1e-15)
    assert (h @ V) / 2 == pytest.approx(I.kinetic_energy(V), rel=1e-15)
    with pytest.raises(tw.FrameError, match=r"F\[base\] · V\[world\]"):
        _ = h @ V.transform(T, frame="world")


HINTS = [
    # what was written, what the message says to write instead, what that gives
    ("T @ V", "V.transform(T)", X @ V.vector),
    ("T @ F", "F.transform(T)", T.force_transform() @ F.vector),
    ("T @ I", "I.transform(T)", I.transform(T)),
    ("T @ x", "T.motion_transform() @ x", X @ x),
    ("T @ x", "T.force_transform() @ x", T.force_transform() @ x),
    ("T @ p", "T.act(x)", R @ p + p),
    ("M @ T", "T.matrix()", M),
    ("V @ T", "V.transform(T)", X @ V.vector),
    ("I @ T", "I.transform(T)", I.transform(T)),
    ("X @ V", "V.transform(T)", X @ V.vector),
    ("X @ V", "V.vector", V.vector),
    ("X @ F", "F.vector", F.vector),
    ("V @ V", "V.vector", V.vector),
    ("I @ x", "I.momentum(V)", I.momentum(x)),
    ("I @ X", "I.matrix()", I.matrix()),
    ("I @ F", "expected a Twist", None),
    ("X @ I", "I.matrix()", I.matrix()),
    ("F @ x", ".power()", F.power(x)),
    ("V + F", "wrench @ twist", F @ V),
    ("V + F", "inertia @ twist", I @ V),
    ("V + x", "Twist(array)", tw.Twist(x)),
    ("x - F", "Wrench(array)", tw.Wrench(x)),
    ("tw.Twist(F)", ".vector", F.vector),
    ("tw.Twist(p, p)", "np.concatenate([angular, linear], axis=-1)", np.r_[p, p]),
    ("V.transform(M)", "SE3.from_matrix", T),
    ("I.transform(M)", "SE3.from_matrix", T),
    ("tw.SE3(rounded, p)", "nearest_rotation(rotation)", tw.nearest_rotation(rounded)),
    ("tw.log3(rounded)", "nearest_rotation(R)", tw.nearest_rotation(rounded)),
]
FOLLOWED = {
    "T.act(x)": "T.act(p)",
    "I.momentum(V)": "I.momentum(x)",
    "expected a Twist": "None",
    ".power()": "F.power(x)",
    "wrench @ twist": "F @ V",
    "inertia @ twist": "I @ V",
    "Twist(array)": "tw.Twist(x)",
    "Wrench(array)": "tw.Wrench(x)",
    ".vector": "F.vector",
    "np.concatenate([angular, linear], axis=-1)": "np.concatenate([p, p], axis=-1)",
    "SE3.from_matrix": "tw.SE3.from_matrix(M)",
    "nearest_rotation(rotation)": "tw.nearest_rotation(rounded)",
    "nearest_rotation(R)": "tw.nearest_rotation(rounded)",
}
"""What the letters of a hint stand for here, where they are not the names above."""


@pytest.mark.parametrize(("written", "hint", "gives"), HINTS, ids=[f"{w}: {h}" for w, h, _ in HINTS])
def test_every_hint_leads_somewhere_that_works(written, hint, gives):
    with pytest.raises((TypeError, tw.ShapeError), match=re.escape(hint)):
        eval(written)
    got = eval(FOLLOWED.get(hint, hint))
    if isinstance(gives, np.ndarray) and isinstance(got, tw.Twist | tw.Wrench):
        got = got.vector
    if isinstance(gives, np.ndarray):
        np.testing.assert_allclose(got, gives, rtol=1e-14)
    elif isinstance(gives, tw.SE3):
        np.testing.assert_allclose(got.matrix(), gives.matrix(), rtol=1e-14, atol=1e-15)
    else:
        assert got == gives


def test_a_hint_that_would_not_work_is_not_given():
    for bad in (2 * R, R @ np.diag([1, 1, -1.0]), np.stack([R, 3 * R])):
        with pytest.raises(tw.ShapeError) as error:
            tw.log3(bad)
        assert "nearest" not in str(error.value)
