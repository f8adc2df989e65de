"""How do I call it, and how many microseconds does it take? One table, in one process.

python benchmarks/calls.py                 # three minutes; writes results/calls.csv and calls.json
python benchmarks/calls.py --only rnea     # one group of it; writes nothing
python benchmarks/calls.py --robot talos_reduced

A row with … is a way to call what the row above it has, and is given as a ratio to that one. Where Pinocchio has the
same, its call from Python for one state after the other is in the same process, in turns with ours. What a version of
this package does not offer, and packages that are not installed, are left out by name.
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
import argparse
import csv
import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from speed import environment
from study.speed import States, random_states
from study.speed import theirs as pinocchio

import twistwrench as tw
from twistwrench.timing import round_robin

RESULTS = Path(__file__).parent / "results"
COLUMNS = ("group", "how", "us", "ratio", "us_pin", "ratio_pin")
LOOP = 100  # states in a loop of Pinocchio
SIZES = 5, 10, 100, 1000  # states in a call
LENGTHS = 20, 40, 80, 81, 150, 300  # joints of a chain

Row = dict[str, Any]


class Call(NamedTuple):
    """A way to call something.

    Attributes
    ----------
    how : str
        As the table has it.
    run : callable
    states : int
        By which the time is divided.
    theirs : callable, optional
        The same by Pinocchio, for `LOOP` states one after the other, from Python.
    base : bool
        Whether the calls after it are given as ratios to it.
    """

    how: str
    run: Callable[[], Any]
    states: int = 1
    theirs: Callable[[], Any] | None = None
    base: bool = False


def of_dynamics(model: tw.Model) -> Iterator[Call]:
    """Yield calls for M, h, J_c of the feet and A_G, whose contacts are given in several ways."""
    s = random_states(model, LOOP)
    q, v, feet, want = s.q[0], s.v[0], tuple(model.feet), ("M", "h", "J_c", "A_G")
    points = tuple(tw.PointContact(name, 0.6) for name in feet)

    def dynamics(**options: Any) -> Callable[[], Any]:
        return lambda: tw.fast.dynamics(model, q, v, **options)

    yield Call("`fast.dynamics`, `contacts=` a tuple", dynamics(contacts=feet), 1, _pin("set", model, s), True)
    yield Call("… a list", dynamics(contacts=[*feet]))
    yield Call("… `PointContact`s", dynamics(contacts=points))
    yield Call("… left out", dynamics())
    yield Call("… `want=` a tuple", dynamics(contacts=feet, want=want))
    yield Call("… `want=` a set", dynamics(contacts=feet, want={*want}))


def of_rnea(model: tw.Model) -> Iterator[Call]:
    """Yield calls for one state, and what can be added to them."""
    s = random_states(model, LOOP)
    args = [x[0].copy() for x in s]
    out, f = np.empty(model.nv), np.random.default_rng(1).standard_normal((model.nbodies, 6))
    f[0] = 0
    axis, lists, strided = [x[None] for x in args], [x.tolist() for x in args], [np.repeat(x, 2)[::2] for x in args]
    named, program = dict(zip("qva", args)), tw.compile(model, "rnea")
    yield Call("`fast.rnea`, three arrays", lambda: tw.fast.rnea(model, *args), 1, _pin("rnea", model, s), True)
    yield Call("… by name", lambda: tw.fast.rnea(model, **named))
    yield Call("… `out=`", lambda: tw.fast.rnea(model, *args, out=out))
    yield Call("… `f_ext=`", lambda: tw.fast.rnea(model, *args, f))
    yield Call("… one batch axis, of length 1", lambda: tw.fast.rnea(model, *axis))
    yield Call("… every second entry of an array", lambda: tw.fast.rnea(model, *strided))
    yield Call("… lists", lambda: tw.fast.rnea(model, *lists))
    yield Call('`tw.compile(model, "rnea")`', lambda: program(*args))
    yield Call("`tw.rnea`, the textbook", lambda: tw.rnea(model, *args))


def of_states(model: tw.Model) -> Iterator[Call]:
    """Yield calls with some states, and a loop over them."""
    s = random_states(model, max(SIZES))
    each = list(zip(s.q[:LOOP], s.v[:LOOP], s.a[:LOOP]))

    def loop() -> None:
        for q, v, a in each:
            tw.fast.rnea(model, q, v, a)

    yield Call("`fast.rnea` in a loop", loop, LOOP, _pin("rnea", model, s.first(LOOP)), True)
    for n in SIZES:
        some = [x[:n].copy() for x in s]
        yield Call(f"… {n} states in a call", lambda some=some: tw.fast.rnea(model, *some), n)


def of_steps(model: tw.Model) -> Iterator[Call]:
    """Yield steps on the manifold of configurations."""
    s = random_states(model, LOOP)
    q, v, other = s.q[0], s.v[0], s.q[1]
    there, pin = _of_pinocchio(model)
    states = [] if pin is None else zip(s.q, tw.bridge.to_pinocchio_tangent(model, s.v), np.roll(s.q, -1, 0))
    states = [*states]

    def each(call: Callable[..., Any]) -> Callable[[], Any] | None:
        return (lambda: [call(*state) for state in states]) if pin else None

    theirs = each(lambda x, u, y: pin.integrate(there, x, u))
    yield Call("`model.integrate`", lambda: model.integrate(q, v), 1, theirs, True)
    ways: tuple[tuple[str, tuple[Any, ...], Any], ...] = (
        ("integrate", (q, v), lambda x, u, y: pin.integrate(there, x, u)),
        ("difference", (q, other), lambda x, u, y: pin.difference(there, x, y)),
        ("interpolate", (q, other, 0.3), lambda x, u, y: pin.interpolate(there, x, y, 0.3)),
        ("d_integrate", (q, v), lambda x, u, y: pin.dIntegrate(there, x, u)),
        ("d_difference", (q, other), lambda x, u, y: pin.dDifference(there, x, y)),
    )
    for name, args, one in ways:
        yield Call(f"`fast.{name}`", _of_fast(name, model, *args), 1, each(one))


def of_frames(model: tw.Model) -> Iterator[Call]:
    """Yield what a control loop asks of frames, of the centre of mass and of energies, beside the RNEA."""
    s = random_states(model, LOOP)
    q, v, a, foot = s.q[0], s.v[0], s.a[0], (model.feet or model.frame_names)[-1]
    yield Call("`fast.rnea`", lambda: tw.fast.rnea(model, q, v, a), 1, _pin("rnea", model, s), True)
    for name, args in (
        ("frame_placement", (q, foot)),
        ("frame_jacobian", (q, foot)),
        ("frame_bias_acceleration", (q, v, foot)),
        ("center_of_mass", (q,)),
        ("kinetic_energy", (q, v)),
        ("potential_energy", (q,)),
    ):
        yield Call(f"`fast.{name}`", _of_fast(name, model, *args))


def of_contacts(model: tw.Model) -> Iterator[Call]:
    """Yield calls for q̈ and λ with all feet held, beside the ABA in the air."""
    s = random_states(model, LOOP)
    q, v, tau = s.q[0], s.v[0], s.a[0]
    feet = tuple(tw.PointContact(name, 0.6) for name in model.feet)
    yield Call("`fast.aba`, in the air", lambda: tw.fast.aba(model, q, v, tau), 1, _pin("aba", model, s), True)

    def forward() -> Any:
        return tw.contact_forward_dynamics(model, q, v, tau, feet)

    yield Call("`tw.contact_forward_dynamics`, all feet", forward, 1, _constrained(model, s))
    yield Call('`tw.compile(scene, ("qdd", "lambda"))`', _of_scene(model, feet, {"q": q, "v": v, "tau": tau}))


def of_bounds(model: tw.Model) -> Iterator[Call]:
    """Yield programs without a bound, and with each kind."""
    many = random_states(model, 1000)
    for quantity in ("rnea", "aba"):
        for n in (1, 1000):
            s, what = many.first(n), f"`{quantity}`, {n} state{'s' * (n > 1)}"
            for bound in (False, "running", True):
                program = tw.compile(model, quantity, bound=bound)
                how = f"… `bound={bound!r}`" if bound else f"{what} in a call"
                yield Call(how, lambda program=program, s=s: program(*s), n, None, not bound)


def of_chains(_: tw.Model) -> Iterator[Call]:
    """Yield calls for chains of revolute joints, whose time is that for a joint."""
    for name in ("rnea", "aba"):
        for n in LENGTHS:
            chain = tw.chain(n)
            s = random_states(chain, 1).first(1)
            call = _of_fast(name, chain, *s)
            yield Call(f"`fast.{name}`, {n} joints in a chain, a joint", call, n, None, n == LENGTHS[0])


def of_peers(model: tw.Model) -> Iterator[Call]:
    """Yield calls of packages that take a floating base, for one state, and for 1000 where they take many."""
    from peers import peers as installed

    from twistwrench.loading.catalogue import find

    s = random_states(model, 1000)
    found = list(installed(model, str(find("example-robot-data/go2").path)))
    for quantity in dict.fromkeys(peer.quantity for peer in found):
        for n in (1, 1000):
            there = [
                x for x in found if x.quantity == quantity and not x.name.endswith(OTHERS) and (n == 1 or x.batched)
            ]
            if not there:
                continue
            base = _of_fast(NAMES[quantity], model, *s.first(n)[: ARGUMENTS[quantity]])
            yield Call(f"`fast.{NAMES[quantity]}`, {n} in a call", base, n, None, True)
            few = type(s)(*(x[:n] for x in s))
            for peer in there:
                yield Call(f"… {peer.name}", peer.prepare(few), n)


OTHERS = "tw.compile", "(2)"  # what is in the table already, and what takes two threads
ARM = "example-robot-data/xarm7"
NAMES = {"rnea": "rnea", "aba": "aba", "crba": "crba", "h": "nonlinear_effects", "M": "crba"}
ARGUMENTS = {"rnea": 3, "aba": 3, "crba": 1, "h": 2, "M": 1}


def of_arm(_: tw.Model) -> Iterator[Call]:
    """Yield calls for an arm of seven joints, which dynibo takes; of floating bases it takes few."""
    from twistwrench.loading.catalogue import find

    arm = tw.load(ARM)
    s = random_states(arm, LOOP)
    q, v, a = s.first(1)
    urdf = str(find(ARM).path)
    for name, theirs, args in (
        ("rnea", "inverse_dynamics", (q, v, a)),
        ("aba", "forward_dynamics", (q, v, a)),
        ("crba", "mass_matrix", (q,)),
    ):
        yield Call(f"`fast.{name}`, an arm", _of_fast(name, arm, *args), 1, _pin(name, arm, s), True)
        yield Call("… dynibo", _of_dynibo(urdf, theirs, *args))


FIRST = """
import sys, time
import numpy as np, twistwrench as tw
model = tw.load(sys.argv[1])
q, v = model.neutral(), np.zeros(model.nv)
start = time.process_time()
getattr(tw.fast, sys.argv[2])(model, *(q, v, v)[: int(sys.argv[3])])
print(1e6 * (time.process_time() - start))
"""


def first_calls(model: tw.Model) -> Iterator[Row]:
    """Yield the processor time of the first call in a process: without machine code on disk, and with it."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        for name, count in (("rnea", 3), ("aba", 3), ("crba", 1)):
            times = []
            for place in ("off", folder, folder, folder):
                command = [sys.executable, "-c", FIRST, model.name, name, str(count)]
                environ = {**os.environ, "STRAIGHTLINE_CACHE": place}
                times.append(float(subprocess.run(command, capture_output=True, check=True, env=environ).stdout))
            for how, us in (("compiled", times[0]), ("machine code on disk", min(times[2:]))):
                yield {"group": "first", "how": f"`fast.{name}`, {how}", "us": us, "ratio": us / times[0]}


GROUPS: dict[str, Callable[[tw.Model], Iterator[Call]]] = {
    "dynamics": of_dynamics,
    "rnea": of_rnea,
    "states": of_states,
    "steps": of_steps,
    "frames": of_frames,
    "contacts": of_contacts,
    "bounds": of_bounds,
    "chains": of_chains,
    "arm": of_arm,
    "peers": of_peers,
}


# ---------------------------------------------------------------- what may be missing


def _of_fast(name: str, *args: Any) -> Callable[[], Any]:
    """Return a call of `tw.fast`; what it does not have raises AttributeError when it is called."""
    return lambda: getattr(tw.fast, name)(*args)


def _of_scene(model: tw.Model, contacts: tuple[Any, ...], given: dict[str, Any]) -> Callable[[], Any]:
    """Return a call of a scene's program, which is made at the first one."""
    made: list[Any] = []

    def call() -> Any:
        if not made:
            made.append(tw.compile(tw.Scene(model, contacts=contacts), ("qdd", "lambda")))
        return made[0](*(given[name] for name in made[0].arguments if name in given))

    return call


def _of_dynibo(urdf: str, name: str, *args: Any) -> Callable[[], Any]:
    """Return a call of dynibo; where that is not installed it raises ImportError when it is called."""
    robots: list[Any] = []

    def call() -> Any:
        if not robots:
            import dynibo

            robots.append(dynibo.Robot.from_urdf(urdf))
        return getattr(robots[0], name)(*args)

    return call


def _of_pinocchio(model: tw.Model) -> tuple[Any, Any]:
    """Return Pinocchio's model, and its module; None twice where it is not installed."""
    try:
        import pinocchio as pin
    except ImportError:
        return None, None
    return tw.bridge.to_pinocchio_model(model), pin


def _pin(quantity: str, model: tw.Model, s: States) -> Callable[[], Any] | None:
    """Return a loop of Pinocchio over states, or None."""
    return pinocchio(model, quantity, s) if _of_pinocchio(model)[1] else None


def _constrained(model: tw.Model, s: States) -> Callable[[], Any] | None:
    """Return a loop of `pin.constraintDynamics` over states, with a point at each foot, or None."""
    there, pin = _of_pinocchio(model)
    if pin is None:
        return None
    frames = [there.frames[there.getFrameId(name)] for name in model.feet]
    held = [
        pin.RigidConstraintModel(pin.ContactType.CONTACT_3D, there, x.parentJoint, x.placement, pin.LOCAL_WORLD_ALIGNED)
        for x in frames
    ]
    data = there.createData()
    models, datas = pin.StdVec_RigidConstraintModel(), pin.StdVec_RigidConstraintData()
    for one in held:
        models.append(one)
        datas.append(one.createData())
    pin.initConstraintDynamics(there, data, models, datas)
    v, tau = (tw.bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a))
    states, settings = list(zip(s.q, v, tau)), pin.ProximalSettings(1e-12, 0.0, 1)
    return lambda: [pin.constraintDynamics(there, data, *state, models, datas, settings) for state in states]


# ---------------------------------------------------------------- the table


def measured(group: str, model: tw.Model, rounds: int) -> list[Row]:
    """Return the rows of a group; print what is left out, and why."""
    calls: list[Call] = []
    try:
        for call in GROUPS[group](model):
            try:
                call.run()
                calls.append(call)
            except Exception as error:  # this version of this or of another package does not offer it
                print(f"{group:9} {call.how}: left out, {type(error).__name__}: {error}")
    except ImportError as error:
        print(f"{group}: left out, {error}")
    loops = [call for call in calls if call.theirs]
    laps = round_robin([call.run for call in calls] + [call.theirs for call in loops if call.theirs], rounds=rounds)
    theirs = dict(zip((call.how for call in loops), laps[len(calls) :]))
    rows, base = list[Row](), np.nan
    for call, lap in zip(calls, laps):
        us = 1e6 * float(np.median(lap.seconds)) / call.states
        base = us if call.base else base
        row: Row = {"group": group, "how": call.how, "us": us, "ratio": us / base}
        if call.how in theirs:
            us_pin = 1e6 * float(np.median(theirs[call.how].seconds)) / LOOP
            row |= {"us_pin": us_pin, "ratio_pin": us / us_pin}
        rows.append(row)
    return rows


def show(row: Row) -> None:
    """Print a row."""
    text = f"{row['group']:9} {row['how']:52} {row['us']:12.2f} µs {row['ratio']:10.2f} ×"
    if "us_pin" in row:
        text += f"   Pinocchio {row['us_pin']:8.2f} µs: {row['ratio_pin']:.2f} ×"
    print(text, flush=True)


def main() -> None:
    """Print the table, and keep it if it is whole."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robot", default="go2", metavar="ROBOT", help="of the catalogue (go2)")
    parser.add_argument("--only", choices=[*GROUPS, "first"], action="append", help="this group; may be repeated")
    parser.add_argument("--rounds", type=int, default=9, help="of each call (9)")
    args = parser.parse_args()
    model = tw.load(args.robot)
    where = environment(" ".join(["python", "benchmarks/calls.py", *sys.argv[1:]]))
    print(f"{model.name} on {where['processor']}: µs for one state; × is to the row above whose ratio is 1")
    found: list[Row] = []
    for group in args.only or [*GROUPS, "first"]:
        rows = list(first_calls(model)) if group == "first" else measured(group, model, args.rounds)
        for row in rows:
            show(row)
        found += rows
    if args.only or args.robot != "go2":
        return
    with (RESULTS / "calls.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()} for row in found)
    (RESULTS / "calls.json").write_text(json.dumps(where, indent=2) + "\n")


if __name__ == "__main__":
    main()
