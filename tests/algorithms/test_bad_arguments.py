"""Names, lists and results: a string is no list, an iterator is one, and what comes back says what it is."""

from __future__ import annotations

import numpy as np
import pytest

import twistwrench as tw

from ..robots import shared

GO2 = shared("go2")
STAND, REST = GO2.standing(), np.zeros(18)


@pytest.mark.parametrize("name", [None, 3, ["FR_foot"]], ids=str)
def test_name_that_is_no_string_is_refused(name):
    for function in (
        lambda: tw.frame_placement(GO2, STAND, name),
        lambda: tw.frame_jacobian(GO2, STAND, name),
        lambda: tw.contact_jacobian(GO2, STAND, [name]),
        lambda: GO2.joint_id(name),
        lambda: tw.frame_jacobian(GO2, STAND, "FR_foot", name),
        lambda: tw.dynamics(GO2, STAND, REST, want=[name]),
    ):
        with pytest.raises(tw.NameNotFound, match="expected a name, got"):
            function()


def test_string_is_no_list_of_names():
    for want in ("Mh", "A_G", "M"):
        with pytest.raises(ValueError, match=f"want: expected a sequence of quantities, got the string '{want}'"):
            tw.dynamics(GO2, STAND, REST, want=want)
    with pytest.raises(ValueError, match="contacts: expected a sequence of frame names, got the string 'FR_foot'"):
        tw.dynamics(GO2, STAND, REST, contacts="FR_foot", want=["M"])


def test_names_may_come_from_an_iterator():
    feet = tw.static_equilibrium(GO2, STAND)
    again = tw.static_equilibrium(GO2, STAND, (name for name in GO2.feet))
    assert (again.forces == feet.forces).all()
    assert (tw.contact_jacobian(GO2, STAND, iter(GO2.feet)) == tw.contact_jacobian(GO2, STAND, GO2.feet)).all()
    d = tw.dynamics(GO2, STAND, REST, contacts=iter(GO2.feet), want=iter(["J_c"]))
    assert d.J_c.shape == (12, 18)
    assert d.M is None


def test_robot_without_feet_has_a_contact_jacobian_without_rows():
    arm = tw.chain(3)
    assert tw.dynamics(arm, np.zeros(3), np.zeros(3)).J_c.shape == (0, 3)


def test_equilibrium_says_which_force_is_whose():
    held = tw.static_equilibrium(GO2, STAND)
    assert held.contacts == GO2.feet
    assert all(foot in repr(held) for foot in GO2.feet)


def test_kinematics_is_shown_in_one_line():
    assert repr(tw.forward_kinematics(GO2, STAND)) == "<Kinematics: 14 placements>"
    moving = tw.forward_kinematics(GO2, np.stack([STAND] * 2), REST, REST)
    assert repr(moving) == "<Kinematics of a batch (2,): 14 placements, twist, acceleration>"


def test_wrench_that_is_not_a_number_is_no_wrench_on_the_world():
    for function in (tw.rnea, tw.aba, tw.joint_wrenches):
        with pytest.raises(ValueError, match=r"f_ext: expected finite numbers, got nan at index \(0, 0\)"):
            function(GO2, STAND, REST, REST, np.full((14, 6), np.nan))


def test_a_set_of_contacts_has_no_order_and_is_refused():
    """Rows of J, h and λ come in the order of the contacts; that of a set changes from run to run."""
    names, contacts = set(GO2.feet), {tw.PointContact(foot, 0.6) for foot in GO2.feet}
    for function in (
        lambda: tw.contact_jacobian(GO2, STAND, names),
        lambda: tw.dynamics(GO2, STAND, REST, contacts=frozenset(names)),
        lambda: tw.fast.dynamics(GO2, STAND, REST, contacts=names),
        lambda: tw.static_equilibrium(GO2, STAND, names),
        lambda: tw.constraint_jacobian(GO2, STAND, contacts),
        lambda: tw.contact_forward_dynamics(GO2, STAND, REST, REST, contacts),
        lambda: tw.stance_margins(GO2, STAND, contacts),
        lambda: tw.project_state(GO2, STAND, REST, contacts, {}),
        lambda: tw.simulate(GO2, STAND, REST, dt=0.01, steps=1, contacts=contacts),
        lambda: tw.Scene(GO2, contacts=contacts),
    ):
        with pytest.raises(
            TypeError, match=r"contacts: expected a sequence of (contacts|frame names), got a (frozen)?set"
        ):
            function()
    assert tw.dynamics(GO2, STAND, REST, want={"M", "h"}).M.shape == (18, 18)  # where order does not count
    in_order = tw.contact_jacobian(GO2, STAND, dict.fromkeys(GO2.feet))  # a dict has one
    assert (in_order == tw.contact_jacobian(GO2, STAND, GO2.feet)).all()
