"""Robots of other projects, made here from the figures that they publish: the mechanisms of test_published.py."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import twistwrench as tw


def moved(*p):
    return tw.SE3(np.eye(3), p)


def one(com, inertia=(1.0, 1.0, 1.0)):
    """RBDL's `Body(1., com, inertia)`."""
    return tw.SpatialInertia(1.0, com, np.diag(inertia))


def rbdl_tree(*links):
    """Links (parent, axis, origin in the parent, body) with a hinge each; gravity along −y, as in RBDL's tests."""
    builder = tw.Builder("rbdl", gravity=[0, -9.81, 0])
    for k, (parent, axis, origin, body) in enumerate(links, 1):
        builder.link(f"b{k}", parent=f"b{parent}" if parent else "base_link", joint=tw.Revolute(axis),
                     placement=moved(*origin), inertia=body)  # fmt: skip
    return builder.build(physical=False)  # some of its bodies are at the limit of what can exist


def six_axes():
    """A body that slides along x, y, z and turns about z, y, x: RBDL's old floating base, massless in between."""
    builder, parent = tw.Builder("six axes", gravity=[0, -9.81, 0]), "base_link"
    joints = [tw.Prismatic("x"), tw.Prismatic("y"), tw.Prismatic("z"), *map(tw.Revolute, "zyx")]
    for k, joint in enumerate(joints):
        builder.link(f"b{k}", parent=parent, joint=joint, inertia=one([0, 1.0, 0]) if k == 5 else None)
        parent = f"b{k}"
    builder.link("point", parent=parent, placement=moved(-1.9, -1.8, 0.0))
    builder.link("near", parent=parent, placement=moved(1.0, 0.0, 0.0))
    return builder.build(physical=False)


def ur5():
    """The three links of a UR5 in Modern Robotics, chapter 8: M01 … M34, G1 … G3 and Slist as printed."""
    home = [moved(0, 0, 0.089159)]
    turned = np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]])
    for step in (tw.SE3(turned, [0.28, 0.13585, 0]), moved(0, -0.1197, 0.395), moved(0, 0, 0.14225)):
        home.append(home[-1] @ step)
    screws = [[1, 0, 1, 0, 1, 0], [0, 1, 0, -0.089, 0, 0], [0, 1, 0, -0.089, 0, 0.425]]
    figures = [(3.7, 0.010267, 0.00666), (8.393, 0.22689, 0.0151074), (2.275, 0.0494433, 0.004095)]
    builder, parent, before = tw.Builder("UR5, three links", gravity=[0, 0, -9.8]), "base_link", moved(0, 0, 0)
    for k, (S, (mass, across, along), T) in enumerate(zip(np.array(screws, float), figures, home[:3], strict=True)):
        axis = S[:3]
        length = np.linalg.norm(axis)  # of the first axis √2, as printed: its angle counts in units of 1/√2
        joint_at = moved(*(np.cross(axis, S[3:]) / length**2))
        inertia = tw.SpatialInertia(mass, np.zeros(3), np.diag([across, across, along]))
        builder.link(f"l{k + 1}", parent=parent, joint=tw.Revolute(axis), placement=before.inverse() @ joint_at,
                     inertia=inertia.transform(joint_at.inverse() @ T))  # fmt: skip
        parent, before = f"l{k + 1}", joint_at
    builder.link("tip", parent=parent, placement=before.inverse() @ home[3])
    return builder.build()


PUMA = [  # d, a, α, m, r, diagonal of I, Jm, G (Corke & Armstrong-Hélouvry 1994, standard Denavit-Hartenberg)
    (0.672, 0.0, np.pi / 2, 0.0, [0, 0, 0], [0, 0, 0], 200e-6, -62.6111),
    (0.0, 0.4318, 0.0, 17.4, [-0.3638, 0.006, 0.2275], [0.13, 0.524, 0.539], 200e-6, 107.815),
    (0.15005, 0.0203, -np.pi / 2, 4.8, [-0.0203, -0.0141, 0.070], [0.066, 0.086, 0.0125], 200e-6, -53.7063),
    (0.4318, 0.0, np.pi / 2, 0.82, [0, 0.019, 0], [1.8e-3, 1.3e-3, 1.8e-3], 33e-6, 76.0364),
    (0.0, 0.0, -np.pi / 2, 0.34, [0, 0, 0], [0.3e-3, 0.4e-3, 0.3e-3], 33e-6, 71.923),
    (0.0, 0.0, 0.0, 0.09, [0, 0, 0.032], [0.15e-3, 0.15e-3, 0.04e-3], 33e-6, 76.686),
]


def puma():
    """The Puma 560 of the Robotics Toolbox, its rotors in the armature; link 1 has 0.35 kg m² about its axis alone."""
    builder, parent, place = tw.Builder("Puma 560"), "base_link", moved(0, 0, 0)
    for k, (d, a, alpha, m, r, inertia, Jm, G) in enumerate(PUMA, 1):
        own = tw.SE3(tw.exp3([alpha, 0, 0]), [a, 0, d])  # from the joint's frame to the link's
        body = tw.SpatialInertia(m, r, np.diag(inertia)).transform(own) if m else None
        builder.link(f"l{k}", parent=parent, joint=tw.Revolute("z"), placement=place, inertia=body,
                     armature=G**2 * Jm + (0.35 if k == 1 else 0))  # fmt: skip
        parent, place = f"l{k}", own
    builder.link("hand", parent=parent, placement=place)
    return builder.build(physical=False)  # 0.0125 + 0.066 < 0.086: link 3 as published cannot exist


def simple_humanoid():
    """The humanoid of example-robot-data with its waist where Pinocchio's own file had it, 0.176 m lower."""
    model = tw.load("simple_humanoid", base="floating")
    waist = model.joint_id("WAIST_P")
    place = [moved(0, 0, 0) if i == waist else T for i, T in enumerate(model.placement)]
    return replace(model, placement=tuple(place), gravity=np.array([0, 0, -9.8]))


def babyboot():
    """Kane's babyboot as Drake has it from MotionGenesis: a rod that swings, and a plate that turns about the rod."""
    builder, g_cm2 = tw.Builder("babyboot"), 1e-7
    rod = tw.SpatialInertia(0.01, [0, 0, -0.075], np.diag([50, 50, 50]) * g_cm2)
    plate = tw.SpatialInertia(0.1, [0, 0, -0.2], np.diag([2500, 500, 2000]) * g_cm2)
    builder.link("rod", parent="base_link", joint=tw.Revolute("x"), inertia=rod)
    builder.link("sheet", parent="rod", joint=tw.Revolute("z"), inertia=plate)
    return builder.build()
