"""What is said of numbers beside the right ones is true of each of them, and of all cases where it says so."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.exercises import catalogue
from twistwrench.exercises.compare import Value
from twistwrench.exercises.exercise import Part, Quantity
from twistwrench.exercises.judge import judge
from twistwrench.exercises.naming.relations import describe
from twistwrench.exercises.naming.simplest import shared

RNG = np.random.default_rng(5)
FULL = RNG.uniform(1, 2, (6, 6))
FULL += FULL.T


def said(got, right, language="en"):
    quantity = Quantity("A")
    lines = describe(*(Value(quantity, np.asarray(x, float), x) for x in (got, right)), 1e-9)
    return "; ".join(line.of(language) for line in lines)


def changed(x, index, factor):
    y = np.array(x, float)
    y[index] *= factor
    return y


def test_what_is_small_beside_a_huge_number_is_not_zero():
    assert said([1.0, 1, 1], [2.9e12, 1, 5.9e12]) == "A: wrong in [0], [2], right elsewhere"
    assert said([1e-17, 0], [2.0, 3]) == "A: zero, and must not be"
    assert said(1e-5, 3.0) != "A: zero, and must not be"


def test_what_is_left_out_has_no_digits():
    assert said([1.2126, 0, 0], [1.2126, -5e-7, 0]) == "A: wrong in [1], right elsewhere: zero, and must not be"
    assert said([1.2126, -6e-7, 0], [1.2126, -5e-7, 0]) != "A: wrong in [1], right elsewhere: zero, and must not be"


def test_only_the_diagonal_is_right_where_most_of_the_rest_is_wrong():
    off = ~np.eye(6, dtype=bool)
    assert said(changed(FULL, off, 2), FULL) == "A: only the diagonal is right"
    corner = np.zeros((6, 6), dtype=bool)
    corner[:3, :3] = off[:3, :3]
    assert said(changed(FULL, corner, 3), FULL) == "A: wrong in rows 0 to 2, right in the others"
    assert said(changed(FULL, corner, 3), FULL, "zh") == "A：第 0–2 行有错，其余各行正确"
    assert said(changed(FULL, (0, 0), 3), FULL) == "A: wrong in [0, 0], right elsewhere"
    assert said(changed(FULL, ~off, 3), FULL) == "A: right except on the diagonal"


def test_only_a_triangle_is_right_where_most_of_the_other_is_wrong():
    below = np.tril(np.ones((6, 6), dtype=bool), -1)
    assert said(changed(FULL, below, 3), FULL) == "A: only the upper triangle is right"
    assert said(changed(FULL, (5, 0), 3), FULL) == "A: wrong in [5, 0], right elsewhere"


def test_digits_are_those_of_each_entry():
    right = [-0.722, -0.2, 150.0, 80, 70, 1]
    assert "digits" not in said([-1.441, 0.09, 150.3, 80.1, 70.1, 1.1], right)
    assert said(np.multiply(right, 1.002), right) == "A: right to 2 digits only"
    assert "digits" not in said([0.019, -0.039, -9.838], [0, 0, -9.81])
    assert said(np.round(FULL, 2), FULL) == "A: right to 2 digits only"


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda x: x * RNG.uniform(1.02, 1.04, x.shape), "off by less than 10 % of the largest entry"),
        (lambda x: x * RNG.uniform(1.2, 1.4, x.shape), "different numbers"),
        (lambda x: np.where(np.eye(6)[::-1] == 1, x, 9 + x), "30 of 36 entries are wrong"),
        (lambda x: np.hstack([x[:, :2] + np.outer(x[:, 0], [1, 5]), x[:, 2:]]), "wrong in columns 0, 1, right in the"),
    ],
)
def test_how_many_numbers_are_wrong(change, says):
    assert said(change(FULL), FULL).startswith(f"A: {says}")


SIZES = Part(solution=lambda x: x, returns=(Quantity("k"),), cases=lambda rng: [], slips={})


@pytest.mark.parametrize(
    ("answers", "says"),
    [
        ([1.0, 3.0, 5.0, 7.0], ["k: too large in all cases in which it is wrong"]),
        ([1.0, 3.0, 5.0, 4.0], []),  # two are few
        ([1.0, 1.5, 1.0, 3.0], ["k: too small in all cases in which it is wrong"]),
        ([1.0, 3.0, 1.0, 5.0], []),
        ([1.0, -3.0, 5.0, 6.0], []),
        ([1.0, -3.0, -1.0, -2.0], ["k: the sign is wrong in all cases in which it is wrong"]),
        ([1.0, 2.002, 3.001, 4.0], ["k: nearly right in all cases: an approximation?"]),
        ([1.0, 2.002, 4.001, 5.0], ["k: too large in all cases in which it is wrong"]),
        ([1.0, 4.0, 6.0, 8.0], []),  # the factor is told
        ([1.0, -2.0, -3.0, -4.0], []),  # the sign is told
        ([1.0, 2.0, 3.0, 4.0], []),
        ([1.0, None, 4.0, 5.0], []),
    ],
)
def test_what_holds_in_all_wrong_cases_is_told(answers, says):
    assert [line.en for line in shared(SIZES, answers, [1.0, 2.0, 3.0, 4.0], [()] * 4)] == says


def test_of_a_single_number_the_case_is_spoken_of():
    assert said(3.0, 2.2) == "A: too large here"
    assert said(2.1, 2.2) == "A: too small here, by less than 10 %"
    assert said(-3.0, 2.2) == "A: the sign is wrong here"
    assert said(2.1, 2.2, "zh") == "A：此处偏小，偏差不到 10%"


def test_a_number_of_the_other_sign_is_not_called_too_large():
    def growth(sizes, seconds):
        _, _, axes = np.linalg.svd(np.column_stack([np.log(sizes), np.log(seconds)]), full_matrices=False)
        return axes[0][1] / axes[0][0]

    told = judge(*catalogue.find_part("growth"), growth).message("en")
    assert "too large" not in told
    assert "k: the sign is wrong in all cases in which it is wrong" in " ".join(told.split())


def errors(largest, scale=lambda tau: np.abs(tau).max()):
    return lambda forward, inverse, model, q, v, tau: (
        largest(np.abs(inverse(model, q, v, forward(model, q, v, tau)) - tau)) / scale(tau)
    )


def running(x):
    worst = 0.0
    for entry in x:
        worst = entry if entry > worst else worst
    return worst


@pytest.mark.parametrize("largest", [max, running, lambda x: max(x[~np.isnan(x)], default=7.0)])
def test_a_lost_nan_is_told_however_it_is_lost(largest):
    verdict = judge(*catalogue.find_part("consistency_error"), errors(largest), search=False)
    assert verdict.slips == ("nan-lost",)


def test_a_lost_nan_is_told_beside_another_slip():
    answer = errors(lambda x: x.max(where=x == x, initial=0.0), scale=np.max)
    told = judge(*catalogue.find_part("consistency_error"), answer, search=False).message("en")
    assert "error is a number in a case where nan is expected" in told
    other = judge(*catalogue.find_part("consistency_error"), errors(np.max, scale=np.max), search=False)
    assert "nan" not in other.message("en")


def test_the_way_of_a_transform_is_told_whichever_way_it_is_missed():
    def base_block(model, q):
        """Moves the inertias by the transforms of the bodies to the base, which must be their inverses."""
        poses = tw.forward_kinematics(model, q).placement
        X = [(poses[1].inverse() @ pose).motion_transform() for pose in poses]
        return sum(x.T @ body.matrix() @ x for x, body in zip(X[1:], model.inertia[1:]))

    told = judge(*catalogue.find_part("base_block"), base_block, search=False).message("en")
    assert "the transform goes the wrong way: its inverse is needed" in told
    assert "in place of" not in told


def test_numbers_that_are_not_sorted_are_called_that():
    right = np.sort(RNG.uniform(0, 1, 6))
    assert said(right[::-1], right) == "A: the right numbers, but not in ascending order"
    assert "ascending" not in said(right, right[::-1])


def test_numbers_that_stand_one_place_beside_their_own():
    right = [-0.722, -0.2, 150.0, 80, 70, 1]
    assert said([*right[1:], 7.0], right) == "A: the right numbers, one place too early"
    assert said([7.0, *right[:-1]], right) == "A: the right numbers, one place too late"
    assert "place" not in said(np.arange(1.0, 7), np.ones(6))


def test_a_factor_of_numbers_that_are_not_exact_is_told():
    """By central differences the momentum has some digits only; divided by h, not by 2 h, it is twice as large."""

    def momentum_of_links(model, q, v, h=1e-5):
        def moment(t):
            poses = tw.forward_kinematics(model, model.integrate(q, t * v)).placement
            return sum(
                body.mass * (T.rotation @ body.com + T.translation) for T, body in zip(poses[1:], model.inertia[1:])
            )

        return (moment(h) - moment(-h)) / h

    told = judge(*catalogue.find_part("momentum_of_links"), momentum_of_links, search=False).message("en")
    assert "m v_G [kg m/s]: too large by a factor of 2, to about 5 digits" in told
