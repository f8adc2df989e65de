"""Scenes in which a smaller model may do: six of a practitioner and six more, with motions to choose by and others.

python benchmarks/scenes_to_choose.py            # all, some minutes, into results/, and the table of docs/scenes
python benchmarks/scenes_to_choose.py lamp lift  # the whole tables of scenes with such names
python benchmarks/scenes_to_choose.py --tables   # only the table of docs/scenes, from results/

Joints that have motors go on a course, and the rest moves as it must: without torque (`follow`). The motions that are
held out are faster, or go another way.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from tables import table, write_each

import twistwrench as tw
from twistwrench import motions
from twistwrench.motions import Motion
from twistwrench.spatial.rotation import rotation_to_quaternion

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "scenes_to_choose.json"
PAGES = {language: HERE.parent / "docs" / f"scenes{language}.md" for language in ("", ".zh-CN")}
MARGINS = (1.0, 1.5)
SHOWN = {"tau": (1.0, "N m"), "cop": (1e3, "mm"), "wrench": (1.0, "")}

Course = Callable[[float], tuple[float, float, float]]


class Case(NamedTuple):
    """A scene, what is needed of a model, the motions that decide, others, and the joints that may be held."""

    scene: tw.Scene
    need: dict[str, Any]
    judged: Sequence[Motion]
    unseen: Sequence[Motion]
    groups: dict[str, list[str]] | None = None


def wave(middle: float, size: float, hertz: float, phase: float = 0.0) -> Course:
    """Return q, q̇ and q̈ of a joint that swings."""
    w = 2 * np.pi * hertz

    def at(t: float) -> tuple[float, float, float]:
        s, c = np.sin(w * t + phase), np.cos(w * t + phase)
        return middle + size * s, size * w * c, -size * w * w * s

    return at


def follow(
    model: tw.Model, q: np.ndarray, courses: Mapping[str, Course], passive: Sequence[str] = (), duration: float = 1.0
) -> Motion:
    """Return a motion of 40 states: joints on their courses, those that are passive without torque, the rest still."""
    slices = dict(zip(model.joint_names, zip(model.q_slice, model.v_slice)))
    loose = np.concatenate([np.arange(model.nv)[slices[name][1]] for name in passive] or [np.zeros(0, int)])
    steps, dt = 400, duration / 400
    q, v, states = q.copy(), np.zeros(model.nv), []
    for k in range(steps):
        a = np.zeros(model.nv)
        for name, course in courses.items():
            (at_q, at_v) = slices[name]
            q[at_q], v[at_v], a[at_v] = course(k * dt)
        M = tw.crba(model, q)
        a[loose] = np.linalg.solve(M[np.ix_(loose, loose)], -tw.rnea(model, q, v, a)[loose])
        if k % 10 == 0:
            states.append((q.copy(), v.copy(), a.copy()))
        v[loose] += dt * a[loose]
        q = model.integrate(q, dt * v)
    return Motion.from_states(np.arange(0, steps, 10) * dt, *map(np.stack, zip(*states)))


def with_passive(model: tw.Model, motion: Motion, passive: str) -> Motion:
    """Return the motion of a robot with one more joint, the last, which swings without torque."""
    q, v, rows = 0.0, 0.0, []
    for k in range(len(motion)):
        at = np.r_[motion.q[k], q], np.r_[motion.v[k], v]
        a = -tw.rnea(model, *at, np.r_[motion.a[k], 0])[-1] / tw.crba(model, at[0])[-1, -1]
        rows.append((*at, np.r_[motion.a[k], a]))
        dt = motion.t[min(k + 1, len(motion) - 1)] - motion.t[k]
        v += dt * a
        q += dt * v
    return replace(motion, **dict(zip("qva", map(np.stack, zip(*rows)))))


def shaken(model: tw.Model, motion: Motion, entry: int, course: Course) -> Motion:
    """Return the motion of a floating robot on what moves in the world, along x (0) to z (2)."""
    q, v, a = motion.q.copy(), motion.v.copy(), motion.a.copy()
    for k, t in enumerate(motion.t):
        moved, speed, more = course(t)
        R = tw.frame_placement(model, q[k], model.frame_names[1]).rotation.T
        q[k, entry] += moved
        v[k, 3:6] += speed * R[:, entry]
        a[k, 3:6] += more * R[:, entry] - np.cross(v[k, :3], speed * R[:, entry])
    return replace(motion, q=q, v=v, a=a)


def box(mass: float, sides: tuple[float, float, float], name: str) -> tw.Model:
    """Return a body that floats."""
    return tw.Builder(name, base="floating", root_inertia=tw.SpatialInertia.from_box(mass, sides)).build()


# ---------------------------------------------------------------- the six of a practitioner


def bucket_on_a_go2() -> Case:
    """Build a Go2 that walks with a bucket on its back, whose bail is a hinge without a motor."""
    go2 = tw.load("go2")
    bail = tw.Builder("bucket", base="floating", root_inertia=tw.SpatialInertia.from_box(0.1, [0.1, 0.1, 0.1]))
    water = tw.SpatialInertia.from_box(1.0, [0.1, 0.1, 0.1]).transform(tw.SE3(np.eye(3), [0, 0, -0.1]))
    bail.link("pail", parent="base_link", joint=tw.Revolute("y"), inertia=water, effort_limit=0.0)
    model = tw.attach(go2, bail.build(), "base", placement=tw.SE3(np.eye(3), [-0.25, 0, 0.2]))
    feet = [tw.PointContact(foot, mu=0.7) for foot in go2.feet]
    judged = motions.walk(go2, samples=100)
    unseen = motions.walk(go2, samples=100, speed=0.08, direction=0.4)
    some = [with_passive(model, motion, "pail") for motion in (judged, unseen)]
    return Case(tw.Scene(model, contacts=feet), {"tau": 0.5}, some[:1], some[1:])


def sitting_humanoid_that_waves() -> Case:
    """Build a humanoid on a stool that waves one arm: all its torques are needed, though few of them change."""
    model = tw.load("humanoid")
    touch = [tw.SurfaceContact(frame, (0.1, 0.05), 0.7) for frame in ("pelvis", "left_sole", "right_sole")]
    q = model.neutral()
    arms = [waving(model, q, "left", hertz) for hertz in (0.5, 0.8)]
    return Case(tw.Scene(model, contacts=touch, q=q), {"tau": 0.5}, arms[:1], arms[1:])


def waving(model: tw.Model, q: np.ndarray, side: str, hertz: float) -> Motion:
    """Return a motion of one arm."""
    elbow, shoulder = f"{side}_elbow", f"{side}_shoulder_roll"
    return follow(model, q, {elbow: wave(-0.8, 0.5, hertz), shoulder: wave(0.4, 0.3, hertz, 1.0)})


def satellite_with_a_wrist() -> Case:
    """Build a body without weight and with an arm, whose wrist turns fast: the base gives way."""
    hull = tw.SpatialInertia.from_box(50, [1, 1, 1])
    builder = tw.Builder("satellite", base="floating", gravity=[0, 0, 0], root_inertia=hull)
    rod = tw.SpatialInertia.from_rod(3.0, 0.8).transform(tw.SE3(np.eye(3), [0, 0, 0.4]))
    hand = tw.SpatialInertia.from_box(1.0, [0.1, 0.3, 0.1]).transform(tw.SE3(np.eye(3), [0, 0.1, 0.05]))
    links = [
        ("upper", "base_link", 0.5, "y", rod),
        ("lower", "upper", 0.8, "y", rod),
        ("wrist", "lower", 0.8, "x", hand),
    ]
    for name, on, z, axis, inertia in links:
        at = tw.SE3(np.eye(3), [0, 0, z])
        builder.link(name, parent=on, joint=tw.Revolute(axis), inertia=inertia, placement=at)
    model = builder.build()
    some = [
        follow(
            model,
            model.neutral(),
            {"upper": wave(0.3, 0.4, f), "lower": wave(0.8, 0.6, f), "wrist": wave(0, 1.0, 2 * f)},
            model.joint_names[1:2],
        )
        for f in (0.4, 0.6)
    ]
    need = {"tau": 0.1, "of": ["upper", "lower"]}
    return Case(tw.Scene(model), need, some[:1], some[1:], {"wrist": ["wrist"], "arm": ["upper", "lower", "wrist"]})


def humanoid_on_a_platform() -> Case:
    """Build a humanoid that waves on a platform, which moves to and fro by 5 mm."""
    model = tw.load("humanoid")
    soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), 0.7) for side in ("left", "right")]
    q = model.standing()
    some = [shaken(model, waving(model, q, "right", f), 0, wave(0, 0.005, 4 * f)) for f in (0.5, 0.7)]
    return Case(
        tw.Scene(model, contacts=soles),
        {"cop": 0.01, "tau": 1.5, "of": ["*_hip_*", "*_knee", "*_ankle_*"]},
        some[:1],
        some[1:],
    )


def tool_in_two_fingers() -> Case:
    """Build an arm whose fingers hold a tool, a body of its own: a closed loop, in which the tool has no motor."""
    arm = tw.load("panda")
    q = arm.integrate(arm.neutral(), np.r_[0, 0.3, 0, -1.5, 0, 1.8, 0.5, 0.02, 0.02])
    both = tw.attach(arm, box(0.8, (0.04, 0.04, 0.2), "tool"), None, prefix="t_")
    grip = tw.SE3(np.eye(3), [0, 0, 0.08])

    def motion(hertz: float) -> Motion:
        courses = {f"panda_joint{k}": wave(q[k - 1], 0.2, hertz, k) for k in (2, 4, 6)} | {
            "panda_joint7": wave(0.5, 0.4, 2 * hertz)
        }
        mine = follow(arm, q, courses)
        T = tw.frame_placement(arm, mine.q, "panda_hand") @ grip
        X = grip.inverse().motion_transform()
        J = X @ tw.frame_jacobian(arm, mine.q, "panda_hand", "local")
        bias = np.matvec(X, tw.frame_bias_acceleration(arm, mine.q, mine.v, "panda_hand", "local"))
        turn = rotation_to_quaternion(T.rotation)
        poses = np.concatenate([mine.q, T.translation, turn], axis=1)
        speeds = np.concatenate([mine.v, np.matvec(J, mine.v)], axis=1)
        return Motion.from_states(mine.t, poses, speeds, np.concatenate([mine.a, np.matvec(J, mine.a) + bias], axis=1))

    hold = [tw.LoopClosure(f"panda_{side}finger", "t_base_link", welded=True) for side in ("left", "right")]
    scene = tw.Scene(both, contacts=hold, motors=["panda_*"])
    need = {"tau": 0.5, "of": ["panda_joint*"]}
    return Case(scene, need, [motion(0.3)], [motion(0.45)], {"tool": ["t_root_joint"], "wrist": ["panda_joint7"]})


def biped_in_a_plane() -> Case:
    """Build a biped in a plane on two point feet, which swings its arms: its base is planar, and has no motor."""
    builder = tw.Builder("biped")
    upright = tw.SE3(tw.exp3([np.pi / 2, 0, 0]), [0, 0, 0.8])  # the plane of x and z
    trunk = tw.SpatialInertia.from_box(10, [0.2, 0.4, 0.1]).transform(tw.SE3(np.eye(3), [0, 0.2, 0]))
    builder.link("trunk", parent="base_link", joint=tw.Planar(), placement=upright, inertia=trunk)
    limb = tw.SpatialInertia.from_rod(1.5, 0.4).transform(tw.SE3(tw.exp3([np.pi / 2, 0, 0]), [0, -0.2, 0]))
    for side in ("left", "right"):
        for name, on, y in (("hip", "trunk", 0.0), ("knee", f"{side}_hip", -0.4), ("arm", "trunk", 0.4)):
            at = tw.SE3(np.eye(3), [0, y, 0])
            builder.link(f"{side}_{name}", parent=on, joint=tw.Revolute("z"), inertia=limb, placement=at)
        builder.link(f"{side}_foot", parent=f"{side}_knee", placement=tw.SE3(np.eye(3), [0, -0.4, 0]))
    model = builder.build()
    feet = [tw.PointContact(f"{side}_foot", 0.7) for side in ("left", "right")]
    q, place = model.neutral(), dict(zip(model.joint_names, model.q_slice))
    for name, angle in (("left_hip", 0.5), ("left_knee", -0.4), ("right_hip", -0.3), ("right_knee", -0.4)):
        q[place[name]] = angle
    need = {"tau": 0.5, "of": ["*_hip", "*_knee"]}
    some = [follow(model, q, {"left_arm": wave(0, 0.4, f), "right_arm": wave(0, -0.3, f)}) for f in (0.5, 0.7)]
    return Case(tw.Scene(model, contacts=feet), need, some[:1], some[1:], {"arms": ["*_arm"], "left": ["left_arm"]})


# ---------------------------------------------------------------- six more


def cart_whose_pole_has_no_motor() -> Case:
    """Build a cart-pole: the pole falls as it must, while the cart goes to and fro."""
    model = tw.load("cart_pole")
    slide, pole = model.joint_names[1:]
    some = [follow(model, np.r_[0, 0.3], {slide: wave(0, 0.2, f)}, [pole]) for f in (0.5, 0.8)]
    return Case(tw.Scene(model), {"tau": 1.0}, some[:1], some[1:], {"pole": [pole]})


def talos_in_a_lift() -> Case:
    """Build a Talos that lifts its arm in a lift, which starts and stops with 2 m/s²."""
    model = tw.load("talos_reduced")
    soles = [tw.SurfaceContact(f"{side}_sole_link", (0.1, 0.06), 0.7) for side in ("left", "right")]
    q = model.standing()
    lift = wave(0, 2.0 / (2 * np.pi * 0.5) ** 2, 0.5)
    some = [shaken(model, follow(model, q, {"arm_left_4_joint": wave(-0.8, 0.3, f)}), 2, lift) for f in (0.4, 0.5)]
    need = {"tau": 2.0, "cop": 0.01, "of": ["leg_*"]}
    return Case(tw.Scene(model, contacts=soles), need, some[:1], some[1:])


def parallelogram_with_one_motor() -> Case:
    """Build a parallelogram with a lamp on a joint at its end: a closed loop of four joints, one with a motor."""
    builder = tw.Builder("lamp")
    rod = tw.SpatialInertia.from_rod(0.5, 0.4).transform(tw.SE3(tw.exp3([0, np.pi / 2, 0]), [0.2, 0, 0]))
    for name, on, at, mass in (
        ("crank", "base_link", [0, 0, 0.5], rod),
        ("coupler", "crank", [0.4, 0, 0], tw.SpatialInertia.from_box(0.3, [0.1, 0.02, 0.02])),
        (
            "lamp",
            "coupler",
            [0, 0, 0.05],
            tw.SpatialInertia.from_rod(0.4, 0.2).transform(tw.SE3(np.eye(3), [0, 0, 0.1])),
        ),
        ("rocker", "base_link", [0.1, 0, 0.5], rod),
    ):
        builder.link(name, parent=on, joint=tw.Revolute("y"), inertia=mass, placement=tw.SE3(np.eye(3), at))
    for name, on, x in (("coupler_end", "coupler", 0.1), ("rocker_end", "rocker", 0.4)):
        builder.link(name, parent=on, placement=tw.SE3(np.eye(3), [x, 0, 0]))
    model = builder.build()

    def motion(hertz: float) -> Motion:
        turn = wave(0.2, 0.4, hertz)
        back = wave(-0.2, -0.4, hertz)
        lamp = wave(0.5, 0.3, 2 * hertz)
        return follow(model, model.neutral(), {"crank": turn, "coupler": back, "rocker": turn, "lamp": lamp})

    scene = tw.Scene(model, contacts=[tw.LoopClosure("coupler_end", "rocker_end")], motors=["crank", "lamp"])
    need = {"tau": 0.05, "of": ["crank"]}
    return Case(scene, need, [motion(0.4)], [motion(0.6)], {"lamp": ["lamp"]})


def humanoid_that_is_pulled() -> Case:
    """Build a humanoid that waves one arm, while a rope pulls at the other hand with 30 N."""
    model = tw.load("humanoid")
    soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), 0.7) for side in ("left", "right")]
    scene = tw.Scene(model, contacts=soles, wrenches={"right_hand": [0, 0, 0, 25.0, 0, -15.0]})
    some = [waving(model, model.standing(), "right", f) for f in (0.4, 0.6)]
    return Case(scene, {"cop": 0.01, "tau": 2.0, "of": ["*_hip_*", "*_knee", "*_ankle_*"]}, some[:1], some[1:])


def drone_with_a_load() -> Case:
    """Build a drone under which a load hangs on a ball joint: forward and back by a course of its base."""
    model = tw.load("iris")
    load = tw.Builder("load", base="floating", root_inertia=tw.SpatialInertia.from_box(0.05, [0.02, 0.02, 0.02]))
    weight = tw.SpatialInertia.from_point(0.3, [0, 0, -0.4]) + tw.SpatialInertia.from_box(0.05, [0.1, 0.1, 0.1])
    load.link("rope", parent="base_link", joint=tw.Spherical(), inertia=weight, effort_limit=[0.0] * 3)
    both = tw.attach(model, load.build(), "iris__base_link")
    some = [shaken_load(both, f) for f in (0.3, 0.4)]
    return Case(tw.Scene(both), {"wrench": 0.05}, some[:1], some[1:])


def shaken_load(model: tw.Model, hertz: float) -> Motion:
    """Return a motion of a drone that goes to and fro, and what hangs on it."""
    to_and_fro = wave(0, 0.3, hertz)
    q, v, states, dt = model.neutral(), np.zeros(model.nv), [], 0.0025
    loose = np.arange(model.nv)[model.v_slice[model.joint_id("rope")]]
    for k in range(800):
        a = np.zeros(model.nv)
        q[0], v[3], a[3] = to_and_fro(k * dt)
        a[loose] = np.linalg.solve(tw.crba(model, q)[np.ix_(loose, loose)], -tw.rnea(model, q, v, a)[loose])
        if k % 20 == 0:
            states.append((q.copy(), v.copy(), a.copy()))
        v[loose] += dt * a[loose]
        q = model.integrate(q, dt * v)
    return Motion.from_states(np.arange(0, 800, 20) * dt, *map(np.stack, zip(*states)))


def gripper_of_coupled_fingers() -> Case:
    """Build a Panda whose second finger follows the first, as a gear does: it has no motor of its own."""
    model = tw.load("panda")
    gear = tw.Coupling("panda_finger_joint2", {"panda_finger_joint1": 1.0})
    q = model.integrate(model.neutral(), np.r_[0, 0.3, 0, -1.5, 0, 1.8, 0.5, 0.02, 0.02])

    def motion(hertz: float) -> Motion:
        fingers = {f"panda_finger_joint{k}": wave(0.02, 0.015, 3 * hertz) for k in (1, 2)}
        return follow(model, q, {f"panda_joint{k}": wave(q[k - 1], 0.3, hertz) for k in (1, 2, 4)} | fingers)

    scene = tw.Scene(
        model, contacts=[gear], motors=["panda_joint*", "panda_finger_joint1"], payload={"panda_hand": 0.5}
    )
    need = {"tau": 0.5, "of": ["panda_joint*"]}
    return Case(scene, need, [motion(0.4)], [motion(0.6)], {"fingers": ["panda_finger_*"], "wrist": ["panda_joint7"]})


CASES: dict[str, tuple[str, str]] = {
    "bucket_on_a_go2": ("a Go2 with a bucket that swings", "背着摆动水桶的 Go2"),
    "sitting_humanoid_that_waves": ("a humanoid that sits and waves", "坐着挥手的人形机器人"),
    "satellite_with_a_wrist": ("a satellite with a fast wrist", "腕关节快速转动的卫星"),
    "humanoid_on_a_platform": ("a humanoid on a moving platform", "站在移动平台上的人形机器人"),
    "tool_in_two_fingers": ("a tool in two fingers, a closed loop", "两指夹持工具（闭环）"),
    "biped_in_a_plane": ("a biped in a plane", "平面内的双足机器人"),
    "cart_whose_pole_has_no_motor": ("a cart whose pole has no motor", "摆杆没有电机的小车"),
    "talos_in_a_lift": ("Talos in a lift", "电梯里的 Talos"),
    "parallelogram_with_one_motor": ("a lamp on a parallelogram", "平行四边形机构上的灯"),
    "humanoid_that_is_pulled": ("a humanoid that is pulled", "被绳子拉着的人形机器人"),
    "drone_with_a_load": ("a drone with a load", "吊着重物的无人机"),
    "gripper_of_coupled_fingers": ("a gripper of coupled fingers", "两指联动的夹爪"),
}
"""By the function that builds each: its name on both pages. The first six are those of a practitioner."""

HEADS = {
    "": ("at most", "margin", "the choice", "tells", "promised", "found", "refused"),
    ".zh-CN": ("容许", "余量", "选中的模型", "能给出", "承诺", "实际", "不合格的"),
}


def choose(name: str) -> Iterator[dict[str, Any]]:
    """Yield what is promised and found: without a margin, and with one where another model is then the choice."""
    case: Case = globals()[name]()
    last = ""
    for margin in MARGINS:
        options = {"held_out": case.unseen, "groups": case.groups, "margin": margin}
        found = case.scene.cheapest(case.need, case.judged, **options)
        best = found.best
        if best.name == last:
            continue
        last = best.name
        yield {
            "margin": margin,
            "choice": best.name,
            "tells": [int(np.isin(found.motors, best.kept).sum()), len(found.motors)],
            "allowed": dict(found.tolerance),
            "promised": {quantity: best.worst(quantity) for quantity in found.tolerance},
            "found": {quantity: best.worst(quantity, held_out=True) for quantity in found.tolerance},
            "holds": found.holds,
            "refused": refused(found),
        }


def refused(found: Any) -> dict[str, Any]:
    """Return of the models with joints that do not do the one that misses least, or else tells most; none if all do."""
    need = found.tolerance
    some = [o for o in found.options if o.predicts_torques and not o.unfit and not o.within(need, found.margin)]
    if not some:
        return {}

    def told(option: Any) -> int:
        bears = np.isin(found.motors, option.kept).sum()
        return 0 if bears == len(found.motors) and "tau" not in option.errors else int(bears)

    def rank(option: Any) -> tuple[float, int]:
        return max(option.worst(name) / most for name, most in need.items()), -told(option)

    nearest = min(some, key=rank)
    missed = {name: nearest.worst(name) for name in need if nearest.worst(name) < np.inf}
    return {"name": nearest.name, "tells": [told(nearest), len(found.motors)], "misses": missed}


def tables(language: str) -> dict[str, str]:
    """Return the table of a page."""
    found = json.loads(RESULTS.read_text(encoding="utf-8"))
    return {"choices": table(cell for name in CASES for row in found[name] for cell in _cells(name, row, language))}


def _cells(name: str, row: dict[str, Any], language: str) -> Iterator[tuple[str, str, str]]:
    text = CASES[name][bool(language)]
    line = text if row["margin"] == 1 else f"{text} "  # a line of its own
    shown = (
        _errors(row["allowed"]),
        f"{row['margin']:g}",
        row["choice"],
        _tells(row["tells"], language) if "tau" in row["allowed"] else "ḣ_G",
        _errors(row["promised"]),
        _errors(row["found"]),
        _refused(row, language),
    )
    for head, cell in zip(HEADS[language], shown, strict=True):
        yield line, head, cell


def _tells(numbers: Sequence[int], language: str) -> str:
    """Return how many of the torques that are needed a model tells."""
    told, motors = numbers
    return f"{motors} 个 τ 中的 {told} 个" if language else f"τ {told} of {motors}"


def _refused(row: dict[str, Any], language: str) -> str:
    """Return a model that does not do, and why: its error, or how many torques it tells."""
    other = row["refused"]
    if not other:
        return ""
    less = other["tells"][0] < other["tells"][1] and "tau" in row["allowed"]
    return f"{other['name']}: {_tells(other['tells'], language) if less else _errors(other['misses'])}"


def _errors(errors: Mapping[str, float]) -> str:
    """Return errors with their units; what rounding leaves is 0."""
    some = ((error * SHOWN[name][0], SHOWN[name][1]) for name, error in errors.items())
    return ", ".join(f"{error if error > 1e-9 else 0:.2g} {unit}".strip() for error, unit in some)


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", help="parts of names: only these are run, and their whole tables printed")
    parser.add_argument("--tables", action="store_true", help="only the table, from results/")
    args = parser.parse_args()
    for name in CASES if args.names else ():
        if any(part in name for part in args.names):
            case = globals()[name]()
            print(name, case.scene.cheapest(case.need, case.judged, held_out=case.unseen, groups=case.groups), sep="\n")
    if args.names:
        return
    if not args.tables:
        found = {name: list(choose(name)) for name in CASES}
        RESULTS.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    write_each(PAGES, tables)


if __name__ == "__main__":
    main()
