"""MuJoCo's equality constraints against loops and couplings: MuJoCo's are soft, and ours are their limit.

MuJoCo lets a constraint yield by R = (1 − d)/d times the inertia that it feels; d, the impedance, is below 1. With
time constants far longer than the motion (`solref`), what it asks of the acceleration is J q̈ + J̇ v = 0, as here.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import twistwrench as tw

mujoco = pytest.importorskip("mujoco", reason="MuJoCo is not installed: its equality constraints are not asked")

LINK = """<body name="{name}" pos="{pos}"><joint name="{name}_joint" type="{type}" axis="{axis}"/>
  <inertial pos="0.1 0.05 -0.2" mass="{mass}" diaginertia="0.02 0.03 0.025"/>{inside}</body>"""
ANCHOR = '<site name="anchor" pos="0.1 -0.05 -0.3"/>'
EQUALITIES = {
    "connect": '<connect body1="b" body2="d" anchor="0.1 -0.05 -0.3" {}/>',
    "weld": '<weld body1="g" body2="h" {}/>',
    "joint": '<joint joint1="b_joint" joint2="c_joint" polycoef="0 -2.5 0 0 0" {}/>',
    "joint, locked": '<joint joint1="b_joint" {}/>',
}
IMPEDANCES = [0.9, 0.99, 0.999, 0.9999]


def link(name, mass, pos="0 0 -0.4", type="hinge", axis="0 1 0", inside=""):
    return LINK.format(name=name, mass=mass, pos=pos, type=type, axis=axis, inside=inside)


def robot(equality="", d=0.9999):
    """Two arms of a moving base, held together."""
    how = f'solref="-1e-9 -1e-9" solimp="{d} {d} 0.001 0.5 2"'
    hand = link("e", 0.4, axis="0 0 1", inside=link("g", 0.3, "0.1 0 -0.3", axis="1 0 0"))
    other = link("f", 0.2, axis="1 0 0", inside=link("h", 0.5, "0 0.1 -0.3", axis="0 0 1"))
    arms = link("a", 1.3, "0.2 0 0", axis="1 0 0.2", inside=link("b", 0.7, inside=ANCHOR + hand))
    arms += link("c", 0.9, "-0.2 0 0", inside=link("d", 0.6, axis="0.3 1 0", inside=other))
    base = link("base", 3.0, "0 0 1", "slide", "0 0 1", link("turn", 2.0, "0 0 0", inside=arms))
    text = f"""<mujoco><option iterations="300" tolerance="0" solver="Newton" cone="elliptic" jacobian="dense">
      <flag contact="disable"/></option><worldbody>{base}</worldbody>
      <equality>{EQUALITIES[equality].format(how) if equality else ""}</equality></mujoco>"""
    return mujoco.MjModel.from_xml_string(text)


CONTACTS = {
    "connect": tw.LoopClosure("anchor", "d"),
    "weld": tw.LoopClosure("g", "h", welded=True),
    "joint": tw.Coupling("b_joint", {"c_joint": -2.5}),
    "joint, locked": tw.Coupling("b_joint", {}),
}


@pytest.mark.one_case
@pytest.mark.parametrize("equality", EQUALITIES)
def test_in_the_limit_of_a_stiff_constraint_the_acceleration_is_ours(equality):
    """The difference shrinks with 1 − d, and a straight line through the two stiffest ends at our acceleration.

    0.9999 is the largest impedance that MuJoCo takes. A weld, whose turns it measures by other units, yields most.
    """
    model, contacts = tw.bridge.from_mujoco_model(robot()), [CONTACTS[equality]]
    rng = np.random.default_rng(4)
    q, v, tau = rng.standard_normal((3, model.nv)) * [[0.1], [1], [1]]
    anchors = tw.contact_placements(model, model.neutral(), contacts)  # where MuJoCo holds it
    q, v = tw.project_state(model, q, v, contacts, anchors)
    exact = tw.contact_forward_dynamics(model, q, v, tau, contacts)
    assert exact.redundant == 0
    found = []
    for d in IMPEDANCES:
        there = robot(equality, d)
        data = mujoco.MjData(there)
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q, v, tau
        mujoco.mj_forward(there, data)
        found.append(data.qacc.copy())
    R = [(1 - d) / d for d in IMPEDANCES]
    straight = (R[-2] * found[-1] - R[-1] * found[-2]) / (R[-2] - R[-1])
    off = [np.abs(qdd - exact.qdd).max() / np.abs(exact.qdd).max() for qdd in (*found, straight)]
    assert all(later < before / 7 for before, later in itertools.pairwise(off[:-1]))
    assert off[-2] < (5e-3 if equality == "weld" else 1e-5)
    assert off[-1] < off[-2] / 10
