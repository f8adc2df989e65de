"""The builder: what is welded is one body, what is moved has Pinocchio's number, what cannot be is refused."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import twistwrench as tw
from twistwrench.model import KINDS

from ..strategies import random_state
from ..truth import textbook


def at(x, y, z, turn=(0.0, 0.0, 0.0)):
    return tw.SE3(tw.exp3(turn), [x, y, z])


def lump(mass, seed=0):
    rng = np.random.default_rng(seed)
    return tw.SpatialInertia(mass, rng.uniform(-0.3, 0.3, 3), mass * np.diag([0.02, 0.03, 0.04]))


def build(links, base="fixed", **options):
    builder = tw.Builder("built", base=base, **options)
    for name, arguments in links:
        builder.link(name, **arguments)
    return builder.build()


def same(one, other, *, frames=()):
    """Whether two models move alike: all quantities in a random state, frames included."""
    assert (one.nq, one.nv, one.parent) == (other.nq, other.nv, other.parent)
    s = random_state(one, rng=0)
    for frame in frames or ("base_link",):
        ours, theirs = textbook(one, s, frame), textbook(other, s, frame)
        for name in ours:
            size = max(1.0, np.abs(theirs[name]).max())
            assert np.abs(ours[name] - theirs[name]).max() <= 1e-12 * size, name
    return True


# ---------------------------------------------------------------- order


def test_bodies_are_numbered_depth_first_and_siblings_by_the_names_of_their_joints():
    z = tw.Revolute("z")
    model = build(
        [
            ("a", {"parent": "base_link", "joint": z, "joint_name": "second"}),
            ("b", {"parent": "base_link", "joint": z, "joint_name": "first"}),
            ("c", {"parent": "a", "joint": z, "joint_name": "joint_9"}),
            ("d", {"parent": "a", "joint": z, "joint_name": "joint_10"}),  # before joint_9, as names go
            ("e", {"parent": "b", "joint": z, "joint_name": "a joint"}),
        ]
    )
    assert model.joint_names == ("universe", "first", "a joint", "second", "joint_10", "joint_9")
    assert model.parent == (-1, 0, 1, 0, 3, 3)
    assert [model.frame(link).body for link in "abcde"] == [3, 1, 5, 4, 2]


def test_order_in_which_links_are_added_does_not_matter():
    links = {
        name: {
            "parent": "base_link",
            "joint": tw.Revolute(axis),
            "inertia": lump(k + 1, k),
            "placement": at(0.1 * k, 0, 0),
        }
        for k, (name, axis) in enumerate([("p", "x"), ("q", "y"), ("r", [1, 2, 3])])
    }
    models = [build([(name, links[name]) for name in order]) for order in itertools.permutations(links)]
    assert all(same(model, models[0], frames=("p", "q", "r")) for model in models[1:])


def test_siblings_on_welded_links_are_sorted_among_those_of_their_own_link():
    # Pinocchio goes through the children of each link of the file, welded or not, before it goes on.
    model = build(
        [
            ("flange", {"parent": "base_link", "joint_name": "m"}),
            ("late", {"parent": "flange", "joint": tw.Revolute("x"), "joint_name": "a"}),
            ("middle", {"parent": "base_link", "joint": tw.Revolute("x"), "joint_name": "k"}),
            ("last", {"parent": "base_link", "joint": tw.Revolute("x"), "joint_name": "z"}),
        ]
    )
    assert model.joint_names == ("universe", "k", "a", "z")


def test_floating_base_is_joint_1():
    model = build(
        [("arm", {"parent": "trunk", "joint": tw.Revolute("x"), "joint_name": "a"})], "floating", root="trunk"
    )
    assert model.joint_names == ("universe", "root_joint", "a")
    assert model.joints[1] == tw.FreeFlyer()
    assert model.base == "floating"
    assert model.frame("trunk").body == 1


# ---------------------------------------------------------------- welding


def test_link_that_is_welded_on_is_one_that_is_held_still():
    links = [
        ("upper", {"parent": "base_link", "joint": tw.Revolute("y"), "inertia": lump(1, 1)}),
        ("middle", {"parent": "upper", "placement": at(0.1, 0.2, -0.5, (0.3, 0, 1)), "inertia": lump(2, 2)}),
        ("lower", {"parent": "middle", "joint": tw.Prismatic([1, 2, 2]), "placement": at(0, 0.3, 0, (0, 1, 0)),
                   "inertia": lump(3, 3)}),
    ]  # fmt: skip
    welded = build(links)
    links[1][1]["joint"] = tw.Spherical()
    jointed = build(links)
    assert (welded.nv, jointed.nv) == (2, 5)
    kept = [0, 4]
    q, v, a = np.random.default_rng(0).standard_normal((3, 2))
    Q, V, A = np.array([q[0], 0, 0, 0, 1, q[1]]), np.zeros(5), np.zeros(5)
    V[kept], A[kept] = v, a
    assert np.allclose(tw.crba(welded, q), tw.crba(jointed, Q)[np.ix_(kept, kept)], rtol=0, atol=1e-14)
    assert np.allclose(tw.rnea(welded, q, v, a), tw.rnea(jointed, Q, V, A)[kept], rtol=0, atol=1e-13)
    for frame in ("upper", "middle", "lower"):
        ours, theirs = tw.frame_placement(welded, q, frame), tw.frame_placement(jointed, Q, frame)
        assert np.allclose(ours.matrix(), theirs.matrix(), rtol=0, atol=1e-15)
    assert np.isclose(welded.mass, 6.0)
    assert welded.nbodies == 3


def test_welds_in_a_row_merge_into_the_body_that_carries_them():
    first, second = at(0.1, 0, 0, (0, 0, 1)), at(0, 0.2, 0, (1, 0, 0))
    model = build(
        [
            ("arm", {"parent": "base_link", "joint": tw.Revolute("z"), "inertia": lump(1, 1)}),
            ("hand", {"parent": "arm", "placement": first, "inertia": lump(2, 2)}),
            ("finger", {"parent": "hand", "placement": second, "inertia": lump(3, 3)}),
        ]
    )
    expected = lump(1, 1) + lump(2, 2).transform(first) + lump(3, 3).transform(first @ second)
    assert np.allclose(model.inertia[1].matrix(), expected.matrix(), rtol=0, atol=1e-15)
    frame = model.frame("finger")
    assert frame.body == 1
    assert np.allclose(frame.placement.matrix(), (first @ second).matrix(), rtol=0, atol=1e-16)


def test_what_is_welded_to_the_world_never_moves_and_does_not_count():
    stand = ("stand", {"parent": "base_link", "placement": at(0, 0, 1), "inertia": lump(50)})
    arm = ("arm", {"parent": "stand", "joint": tw.Revolute("z"), "inertia": lump(1)})
    model = build([stand, arm], root_inertia=lump(70))
    assert model.mass == 1.0
    assert model.inertia[0].mass == 0
    assert model.frame("stand").body == 0
    assert tw.frame_placement(model, [0.3], "stand").translation.tolist() == [0, 0, 1]
    assert tw.frame_placement(model, [0.3], "arm").translation.tolist() == [0, 0, 1]
    assert not tw.frame_jacobian(model, [0.3], "stand", "world").any()


def test_mass_of_the_root_flies_along_with_a_floating_base():
    model = build([("head", {"parent": "base_link", "inertia": lump(2), "placement": at(0, 0, 1)})], "floating",
                  root_inertia=lump(5))  # fmt: skip
    assert model.mass == 7.0
    assert model.frame("head").body == 1


# ---------------------------------------------------------------- frames


def test_link_and_joint_give_one_frame_each_and_share_it_where_they_share_the_name():
    model = build(
        [
            ("arm", {"parent": "base_link", "joint": tw.Revolute("z"), "joint_name": "shoulder"}),
            ("hand", {"parent": "arm", "placement": at(1, 0, 0)}),
        ]
    )
    assert set(model.frame_names) == {"base_link", "shoulder", "arm", "hand"}
    assert (model.frame("shoulder").placement.matrix() == np.eye(4)).all()


def test_link_and_joint_of_one_name_at_different_places_are_told_apart():
    model = build(
        [
            ("elbow", {"parent": "base_link", "joint": tw.Revolute("z"), "joint_name": "shoulder"}),
            ("arm", {"parent": "elbow", "joint": tw.Revolute("z"), "joint_name": "elbow", "placement": at(1, 0, 0)}),
        ]
    )
    assert "elbow" not in model.frame_names
    assert (model.frame("link:elbow").body, model.frame("joint:elbow").body) == (1, 2)
    with pytest.raises(tw.NameNotFound, match="did you mean"):
        model.frame("elbow")


# ---------------------------------------------------------------- options


def test_every_option_arrives_in_the_model():
    builder = tw.Builder("options", gravity=[1, 2, 3])
    builder.link("a", parent="base_link", joint=tw.Planar(), lower=[-1, -2, -1, -1], upper=[1, 2, 1, 1],
                 velocity_limit=[1, 2, 3], effort_limit=[4, 5, 6], armature=[0.1, 0.2, 0.3])  # fmt: skip
    builder.link(
        "b", parent="a", joint=tw.Revolute("x"), lower=-0.5, upper=0.5, velocity_limit=7, effort_limit=8, armature=9
    )
    builder.link("c", parent="b", joint=tw.Prismatic("x"))
    model = builder.build(postures={"up": [0, 0, 1, 0, 0.1, 0]}, feet=["b", "c"])
    assert model.name == "options"
    assert model.gravity.tolist() == [1, 2, 3]
    assert model.lower.tolist() == [-1, -2, -1, -1, -0.5, -np.inf]
    assert model.upper.tolist() == [1, 2, 1, 1, 0.5, np.inf]
    assert model.velocity_limit.tolist() == [1, 2, 3, 7, np.inf]
    assert model.effort_limit.tolist() == [4, 5, 6, 8, np.inf]
    assert model.armature.tolist() == [0.1, 0.2, 0.3, 9, 0]
    assert model.postures["up"].tolist() == [0, 0, 1, 0, 0.1, 0]
    assert model.feet == ("b", "c")
    tilted = np.array([0, 0, 0.1, 0.3, 0.4, 0.5, np.sqrt(0.5)], np.float32)
    flying = tw.Builder("flying", base="floating").build(postures={"tilted": tilted})
    assert abs(np.hypot.reduce(flying.postures["tilted"][3:]) - 1) < 1e-15  # to double precision, as it is kept


def test_model_that_is_built_does_not_change_when_the_builder_goes_on():
    builder = tw.Builder("growing")
    builder.link("a", parent="base_link", joint=tw.Revolute("x"), inertia=lump(1))
    first = builder.build()
    builder.link("b", parent="a", joint=tw.Revolute("x"), inertia=lump(1))
    assert (first.nv, builder.build().nv) == (1, 2)
    assert "b" not in first.frame_names


# ---------------------------------------------------------------- what cannot be


def test_names_that_are_taken_or_unknown_are_refused():
    builder = tw.Builder("names")
    builder.link("arm", parent="base_link", joint=tw.Revolute("x"), joint_name="shoulder")
    with pytest.raises(tw.ModelError, match="link 'arm': the name is taken"):
        builder.link("arm", parent="base_link")
    with pytest.raises(tw.ModelError, match="link 'leg': the joint name 'shoulder' is taken"):
        builder.link("leg", parent="base_link", joint=tw.Revolute("x"), joint_name="shoulder")
    with pytest.raises(tw.NameNotFound, match="unknown parent link 'amr'; did you mean 'arm'"):
        builder.link("hand", parent="amr")
    with pytest.raises(tw.ModelError, match="link 'base_link': the name is taken"):
        builder.link("base_link", parent="arm")


def test_name_of_the_world_is_refused():
    builder = tw.Builder("names")
    for add in (
        lambda: builder.link("universe", parent="base_link"),
        lambda: builder.link("arm", parent="base_link", joint=tw.Revolute("x"), joint_name="universe"),
        lambda: tw.Builder("names", root="universe"),
    ):
        with pytest.raises(tw.ModelError, match="'universe': the name belongs to the world"):
            add()


@pytest.mark.parametrize("name", [3, None, ["arm"]], ids=str)
def test_name_that_is_none_is_refused(name):
    builder = tw.Builder("names")
    with pytest.raises(TypeError, match="link: expected a name, got"):
        builder.link(name, parent="base_link")
    with pytest.raises(tw.NameNotFound, match="parent link: expected a name, got"):
        builder.link("arm", parent=name)
    with pytest.raises(TypeError, match="link: expected a name, got"):
        tw.Builder("names", root=name)


def test_frame_name_that_two_want_is_refused():
    links = [
        ("elbow", {"parent": "base_link", "joint": tw.Revolute("z"), "joint_name": "shoulder"}),
        ("arm", {"parent": "elbow", "joint": tw.Revolute("z"), "joint_name": "elbow", "placement": at(1, 0, 0)}),
        ("link:elbow", {"parent": "arm"}),
    ]
    with pytest.raises(tw.ModelError, match="the frame name 'link:elbow' is taken"):
        build(links)


@pytest.mark.parametrize(
    ("mass", "moments", "message"),
    [
        (1.0, [1, 1, 10], "link 'arm': .*triangle inequality"),
        (1.0, [-1, 1, 1], "link 'arm': .*positive definite"),
        (0.0, [1, 1, -1], "link 'arm': .*positive definite"),
    ],
)
def test_body_that_cannot_exist_is_refused_once_it_is_whole(mass, moments, message):
    builder = tw.Builder("bad")
    builder.link("arm", parent="base_link", joint=tw.Revolute("x"))
    builder.link("hand", parent="arm", inertia=tw.SpatialInertia(mass, [0, 0, 0], np.diag(moments)))
    with pytest.raises(tw.ModelError, match=message):
        builder.build()
    taken = builder.build(physical=False)
    assert taken.mass == mass
    assert [entry.where for entry in taken.report if not entry.warns] == ["link 'arm'"]
    builder.link("ballast", parent="arm", inertia=tw.SpatialInertia(9.0, [0, 0, 0], 9 * np.eye(3)))
    assert builder.build().report == ()
    assert builder.build().mass == mass + 9  # the body is the sum


def test_sum_that_overflows_is_refused():
    far = tw.SE3(np.eye(3), [1e200, 0, 0])
    links = [("arm", {"parent": "base_link", "joint": tw.Revolute("x")}), ("end", {"parent": "arm", "placement": far,
             "inertia": lump(1)})]  # fmt: skip
    with pytest.raises(tw.ModelError, match="joint 'arm': the inertia that it carries, or the way to it, overflows"):
        build(links)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"joint": tw.Spherical}, "link 'arm': joint: expected a joint .*, got the class Spherical"),
        ({"joint": "revolute"}, "link 'arm': joint: expected a joint .*, got str 'revolute'"),
        ({"inertia": 1.0}, "link 'arm': inertia: expected a SpatialInertia, got float"),
        ({"inertia": np.eye(6)}, "link 'arm': inertia: expected a SpatialInertia, got ndarray"),
        ({"placement": np.eye(4)}, "link 'arm': placement: expected an SE3, got ndarray"),
    ],
    ids=["class", "kind", "mass", "matrix", "placement"],
)
def test_argument_of_the_wrong_kind_is_named(arguments, message):
    with pytest.raises(TypeError, match=message):
        tw.Builder("bad").link("arm", **({"parent": "base_link", "joint": tw.Revolute("x")} | arguments))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"placement": tw.SE3(np.eye(3), np.zeros((2, 3)))}, "placement: expected a single one, got a batch"),
        ({"inertia": tw.SpatialInertia([1, 2], np.zeros(3), np.eye(3))}, "inertia: expected a single one, got a batch"),
        ({"placement": tw.SE3(np.eye(3), [1j, 0, 0])}, "placement: expected real numbers"),
        ({"inertia": tw.SpatialInertia(1 + 1j, [0, 0, 0], np.eye(3))}, "inertia: expected real numbers"),
        ({"lower": -1j}, "lower: expected real numbers"),
    ],
    ids=["placements", "inertias", "complex placement", "complex inertia", "complex limit"],
)
def test_batch_and_complex_number_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        tw.Builder("bad").link("arm", **({"parent": "base_link", "joint": tw.Revolute("x")} | arguments))


def test_gravity_is_one_real_vector():
    with pytest.raises(ValueError, match="gravity: expected real numbers, got complex128"):
        tw.Builder("bad", gravity=[0, 0, 1j])
    with pytest.raises(tw.ShapeError, match=r"gravity: expected shape \(3,\), got \(2, 3\)"):
        tw.Builder("bad", gravity=np.zeros((2, 3)))


def test_placement_in_single_precision_becomes_a_rotation_in_double():
    R = tw.exp3(np.array([0.3, -0.8, 0.5], np.float32))
    assert np.abs(R.mT @ R - np.eye(3)).max() > 1e-9
    model = build(
        [("arm", {"parent": "base_link", "joint": tw.Revolute("x"), "placement": tw.SE3(R, np.zeros(3, np.float32))})]
    )
    own = model.placement[1].rotation
    assert np.abs(own.mT @ own - np.eye(3)).max() < 1e-15
    assert np.abs(own - R).max() < 1e-6


def test_builder_says_how_far_it_is():
    builder = tw.Builder("dog", base="floating")
    assert repr(builder) == "<Builder 'dog': floating base, 1 link, 1 joint>"
    builder.link("leg", parent="base_link", joint=tw.Revolute("x"))
    builder.link("foot", parent="leg")
    assert repr(builder) == "<Builder 'dog': floating base, 3 links, 2 joints>"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"lower": 1, "upper": -1}, "joint 'hinge': lower limit .* is above upper limit"),
        ({"lower": [0, 0]}, r"joint 'hinge': lower: expected shape \(\) or \(1,\), got \(2,\)"),
        ({"upper": np.nan}, "joint 'hinge': upper: is not a number"),
        ({"velocity_limit": np.nan}, "joint 'hinge': velocity_limit: is not a number"),
        ({"effort_limit": [1, 2, 3]}, "joint 'hinge': effort_limit: expected shape"),
        ({"armature": -0.1}, "joint 'hinge': armature -0.1 is below zero"),
        ({"armature": np.nan}, "joint 'hinge': armature: is not a number"),
        ({"armature": np.inf}, "joint 'hinge': armature inf is not finite"),
        ({"velocity_limit": -1}, "joint 'hinge': velocity_limit -1 is below zero"),
        ({"effort_limit": -1}, "joint 'hinge': effort_limit -1 is below zero"),
        ({"lower": -np.inf, "upper": -np.inf}, "joint 'hinge': no number lies between"),
        ({"lower": np.inf}, "joint 'hinge': no number lies between"),
        ({"joint": None, "lower": 0.0}, "link 'arm': .* is welded"),
        ({"joint": None, "armature": 0.1}, "link 'arm': .* is welded"),
        ({"joint": None, "lower": -1.0}, "link 'arm': .* is welded"),
        ({"joint": None, "effort_limit": 3.0}, "link 'arm': .* is welded"),
    ],
    ids=str,
)
def test_arguments_that_cannot_be_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        tw.Builder("bad").link(
            "arm", **({"parent": "base_link", "joint": tw.Revolute("x"), "joint_name": "hinge"} | arguments)
        )


def test_bad_base_gravity_feet_and_postures_are_refused():
    with pytest.raises(tw.ModelError, match="base: expected 'fixed' or 'floating', got 'swimming'"):
        tw.Builder("bad", base="swimming")
    with pytest.raises(tw.ShapeError, match="gravity"):
        tw.Builder("bad", gravity=[0, -9.81])
    with pytest.raises(ValueError, match="gravity: expected finite"):
        tw.Builder("bad", gravity=[0, 0, np.nan])
    builder = tw.Builder("bad", base="floating")
    with pytest.raises(tw.NameNotFound, match="foot"):
        builder.build(feet=["foot"])
    with pytest.raises(tw.NameNotFound, match="foot"):
        builder.build(feet=iter(["foot"]))
    with pytest.raises(ValueError, match="feet: expected a sequence of frame names, got the string 'foot'"):
        builder.build(feet="foot")
    with pytest.raises(tw.ShapeError, match=r"posture 'flat': q: .*this looks like nv"):
        builder.build(postures={"flat": np.zeros(6)})
    with pytest.raises(tw.ShapeError, match=r"posture 'flat': expected one configuration, shape \(7,\), got \(1, 7\)"):
        builder.build(postures={"flat": [[0, 0, 0, 0, 0, 0, 1]]})
    with pytest.raises(ValueError, match=r"posture 'flat': q: expected real numbers, got complex128"):
        builder.build(postures={"flat": [1j, 0, 0, 0, 0, 0, 1]})
    with pytest.raises(ValueError, match="quaternion"):
        builder.build(postures={"flat": np.zeros(7)})


# ---------------------------------------------------------------- chain and random_tree


def test_chain_hangs_straight_down_and_grows_as_it_is_told():
    model = tw.chain(4, mass=2.0, length=0.5, mass_ratio=27.0)
    assert np.allclose([inertia.mass for inertia in model.inertia[1:]], [2, 6, 18, 54], rtol=1e-14)
    assert np.allclose(tw.frame_placement(model, np.zeros(4), "tip").translation, [0, 0, -2.0])
    assert not tw.gravity(model, np.zeros(4)).any()
    for inertia, name in zip(model.inertia[1:], model.joint_names[1:], strict=True):
        inertia.check_physical(name)
    assert list(model.joint_names[1:]) == sorted(model.joint_names[1:])
    assert tw.chain(120).parent == tuple(range(-1, 120))


@pytest.mark.parametrize("kind", ["revolute", "prismatic", "continuous"])
def test_chain_has_the_joints_and_the_base_that_were_asked_for(kind):
    fixed, floating = (tw.chain(3, joint=kind, axis=[0, 3, 4], base=base) for base in ("fixed", "floating"))
    assert [joint.kind for joint in fixed.joints[1:]] == [kind] * 3
    assert [joint.kind for joint in floating.joints[1:]] == ["free_flyer", kind, kind]
    assert fixed.joints[3].axis == (0.0, 0.6, 0.8)
    assert floating.mass == fixed.mass == 3.0


@pytest.mark.parametrize(
    "bad",
    [
        {"n": 0},
        {"n": 2.5},
        {"n": True},
        {"n": 2, "mass": 0},
        {"n": 2, "length": -1},
        {"n": 2, "mass_ratio": np.nan},
        {"n": 2, "joint": "spherical"},
        {"n": 2, "axis": [0, 0, 0]},
        {"n": 2, "base": "loose"},
    ],
    ids=str,
)
def test_chain_that_cannot_be_is_refused(bad):
    with pytest.raises(tw.ModelError):
        tw.chain(**bad)


def test_random_tree_that_cannot_be_is_refused():
    for bad in (
        {"n": 0},
        {"n": 2.5},
        {"n": 3, "kinds": "revolute"},
        {"n": 3, "branching": 1.5},
        {"n": 3, "kinds": []},
        {"n": 3, "base": "loose"},
    ):
        with pytest.raises(tw.ModelError):
            tw.random_tree(**bad)
    with pytest.raises(tw.NameNotFound, match="kind of joint 'ball'"):
        tw.random_tree(3, kinds=["ball"])


@pytest.mark.parametrize("kind", KINDS)
def test_random_tree_of_one_kind_has_that_kind(kind):
    model = tw.random_tree(5, rng=0, kinds=[kind])
    assert {joint.kind for joint in model.joints[1:]} == {kind}


# ---------------------------------------------------------------- damping, friction, the base's joint


def test_damping_and_friction_are_kept_for_each_degree_of_freedom():
    builder = tw.Builder("slow", base="floating", root_joint="float")
    builder.link("a", parent="base_link", joint=tw.Planar(), inertia=lump(1), damping=[1, 2, 3], friction=0.5)
    model = builder.build()
    assert model.joint_names == ("universe", "float", "a")
    assert model.damping.tolist() == [0] * 6 + [1, 2, 3]
    assert model.friction.tolist() == [0] * 6 + [0.5] * 3
    assert not model.damping.flags.writeable
    assert not tw.chain(2).damping.any()


@pytest.mark.parametrize("number", ["damping", "friction"])
def test_damping_that_cannot_be_is_refused(number):
    for value, message in ((-1.0, "is below zero"), (np.inf, "is not finite"), (np.nan, "is not a number")):
        with pytest.raises(tw.ModelError, match=f"joint 'a': {number}.*{message}"):
            tw.Builder("b").link("a", parent="base_link", joint=tw.Revolute("x"), **{number: value})
    with pytest.raises(tw.ModelError, match="limits and armature belong to a joint"):
        tw.Builder("b").link("a", parent="base_link", **{number: 1.0})
