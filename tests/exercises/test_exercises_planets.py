"""Gravity that is 9.81 m/s² whatever the robot's is: it is named, alone and beside another slip."""

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.exercises import catalogue
from twistwrench.exercises.cases import MOON, special_cases
from twistwrench.exercises.changes.planets import earthbound, earthly_results, on_earth
from twistwrench.exercises.judge import judge

EVERY_PLANET = "gravity is 9.81 m/s² in your answer on every planet"


def message(name, function):
    verdict = judge(*catalogue.find_part(name), function)
    assert verdict.state == "wrong"
    return " ".join(verdict.message("en").split())


def foot_wrench(model, q, foot, g=9.81):
    R = tw.frame_placement(model, q, foot).rotation
    return np.r_[np.zeros(3), R.T @ np.array([0, 0, model.mass * g / 4])]


def base_wrench_at_rest(model, q):
    R, p = tw.forward_kinematics(model, q).placement[1].rotation, q[:3]
    f = R.T @ np.array([0, 0, 9.81 * model.mass])
    return np.r_[np.cross(R.T @ tw.center_of_mass(model, q) - p, f), f]


def about_the_base(model, q, forces):
    levers = [tw.frame_placement(model, q, foot).translation - q[:3] for foot in model.feet]
    weight = np.array([0, 0, -9.81 * model.mass])
    return np.r_[np.cross(levers, forces).sum(0), forces.sum(0) + weight]


def fall_in_motion(model, q, v):
    """The acceleration of the base is that of the point which passes the world's origin."""
    T = tw.forward_kinematics(model, q).placement[1]
    a = tw.motion_transform(T.rotation, T.translation) @ tw.aba(model, q, v, np.zeros(model.nv))[:6]
    return a[3:], np.array([0, 0, -9.81])


def test_it_is_named_where_nothing_else_is_wrong():
    assert EVERY_PLANET in message("foot_wrench", foot_wrench).replace("Gravity", "gravity")


def test_another_number_is_another_slip():
    assert EVERY_PLANET not in message("foot_wrench", lambda *arguments: foot_wrench(*arguments, g=9.7))


def test_it_is_named_beside_a_change_and_beside_a_slip():
    said = message("base_wrench_at_rest", base_wrench_at_rest)
    assert "On other planets it is then still wrong: gravity is 9.81" in said
    said = message("net_wrench", about_the_base)
    assert "about the base's origin" in said
    assert f"Besides, {EVERY_PLANET}" in said


def test_of_two_results_it_is_named_in_the_one_that_has_it():
    said = message("fall_in_motion", fall_in_motion)
    assert "In a of the centre of mass gravity is 9.81 m/s² on every planet" in said
    assert "right where v = 0: look at what you do with v. On other planets it is wrong even then" in said
    assert "no right solution known here" not in said  # of a line, which may be right: what to look at is known
    part = catalogue.find_part("fall_in_motion")[1]
    assert earthly_results(part, fall_in_motion) == [1]
    assert earthly_results(part, part.solution) == []


def test_a_robot_without_gravity_is_on_no_other_planet():
    """One of the two robots is weightless: on the earth it is weightless as well."""
    part = catalogue.find_part("gravity_two_ways")[1]
    assert not earthbound(part, part.slips["gravity-twice"], part.solution)
    for arguments in special_cases(part, 0):
        assert not (on_earth(arguments) or arguments)[1].gravity.any()


@pytest.mark.parametrize("name", ["foot_wrench", "net_wrench", "fall_in_motion", "weight_wrenches"])
def test_a_solution_is_not_bound_to_the_earth(name):
    part = catalogue.find_part(name)[1]
    assert not earthbound(part, part.solution, part.solution)
    elsewhere = [c for c in special_cases(part, 0) if on_earth(c) is not None]
    assert elsewhere
    for arguments in elsewhere:
        assert arguments[0].gravity[2] == MOON[2]
        np.testing.assert_array_equal(on_earth(arguments)[0].gravity, [0, 0, -9.81])
