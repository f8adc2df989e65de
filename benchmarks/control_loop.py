"""What a control loop asks for, one state and a thousand: `tw.fast` against Pinocchio called from Python, in turns.

python benchmarks/control_loop.py         # one or two minutes; prints the table of README.md
"""

from __future__ import annotations

# isort: off
import one_thread  # noqa: F401 - before NumPy

# isort: on
from collections.abc import Callable, Iterator

import numpy as np

import twistwrench as tw
from twistwrench.timing import race

MANY = 1000
FOOT = "FR_foot"

Calls = tuple[str, Callable[..., object], Callable[..., object]]  # name, ours and theirs, of (q, v, q1)


def calls(model: tw.Model) -> Iterator[Calls]:
    """Yield what is asked for: ours with any number of states, theirs with one, and v in their order."""
    import pinocchio as pin

    there = tw.bridge.to_pinocchio_model(model)
    data, foot = there.createData(), there.getFrameId(FOOT)
    fast = tw.fast

    def placement(q, v, q1):
        pin.framesForwardKinematics(there, data, q)
        return data.oMf[foot]

    def frame_jacobian(q, v, q1):
        return pin.computeFrameJacobian(there, data, q, foot, pin.LOCAL_WORLD_ALIGNED)

    def bias(q, v, q1):
        pin.forwardKinematics(there, data, q, v, 0 * v)
        pin.updateFramePlacement(there, data, foot)
        return pin.getFrameClassicalAcceleration(there, data, foot, pin.LOCAL_WORLD_ALIGNED)

    aligned = "local_world_aligned"
    yield "integrate", lambda q, v, q1: fast.integrate(model, q, v), lambda q, v, q1: pin.integrate(there, q, v)
    yield "difference", lambda q, v, q1: fast.difference(model, q, q1), lambda q, v, q1: pin.difference(there, q, q1)
    yield "d_integrate", lambda q, v, q1: fast.d_integrate(model, q, v), lambda q, v, q1: pin.dIntegrate(there, q, v)
    yield (
        "d_difference",
        lambda q, v, q1: fast.d_difference(model, q, q1),
        lambda q, v, q1: pin.dDifference(there, q, q1),
    )
    yield (
        "interpolate",
        lambda q, v, q1: fast.interpolate(model, q, q1, 0.3),
        lambda q, v, q1: pin.interpolate(there, q, q1, 0.3),
    )
    yield "frame_placement", lambda q, v, q1: fast.frame_placement(model, q, FOOT), placement
    yield "frame_jacobian", lambda q, v, q1: fast.frame_jacobian(model, q, FOOT, aligned), frame_jacobian
    yield (
        "frame_bias_acceleration",
        lambda q, v, q1: fast.frame_bias_acceleration(model, q, v, FOOT, aligned),
        bias,
    )
    yield (
        "center_of_mass",
        lambda q, v, q1: fast.center_of_mass(model, q),
        lambda q, v, q1: pin.centerOfMass(there, data, q, False),
    )
    yield (
        "center_of_mass_jacobian",
        lambda q, v, q1: fast.center_of_mass_jacobian(model, q),
        lambda q, v, q1: pin.jacobianCenterOfMass(there, data, q),
    )
    yield (
        "kinetic_energy",
        lambda q, v, q1: fast.kinetic_energy(model, q, v),
        lambda q, v, q1: pin.computeKineticEnergy(there, data, q, v),
    )
    yield (
        "potential_energy",
        lambda q, v, q1: fast.potential_energy(model, q),
        lambda q, v, q1: pin.computePotentialEnergy(there, data, q),
    )


def states(model: tw.Model) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return q, v, the same v in Pinocchio's order, and another q."""
    rng = np.random.default_rng(0)
    q, q1 = model.random_configuration((2, MANY), rng=rng)
    v = rng.standard_normal((MANY, model.nv))
    return q, v, tw.bridge.to_pinocchio_tangent(model, v), q1


def main() -> None:
    """Print the table."""
    model = tw.load("go2")
    q, v, theirs_v, q1 = states(model)
    few = [(a.copy(), b.copy(), c.copy()) for a, b, c in zip(q[:100], theirs_v, q1)]
    one = q[0].copy(), v[0].copy(), q1[0].copy()
    print(f"| | one state | {MANY:,} states |\n|---|---|---|")
    for name, ours, theirs in calls(model):

        def reference(theirs=theirs):
            for state in few:
                theirs(*state)

        cells = []
        for count, arguments in ((1, one), (MANY, (q, v, q1))):
            row = race((lambda x=arguments, f=ours: f(*x), count), (reference, len(few)), rounds=9).row()
            cells.append(f"{row['ratio']:.3g} ({row['ratio_q1']:.3g} … {row['ratio_q3']:.3g})")
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
