"""Other packages that compute the same from Python, as far as they are installed.

Each is given Go2 as example-robot-data has it, since some of them want every origin written out. Joints are matched
by name; what is compared with ours before anything is timed are the entries of the joints, which do not depend on
how a package writes the velocity of the base.
"""

from __future__ import annotations

import contextlib
import io
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Iterator
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np
from study.speed import States

import twistwrench as tw

JOINTS = slice(6, None)


class Peer(NamedTuple):
    """A package, and what of it is timed.

    Attributes
    ----------
    name, version : str
    quantity : str
    batched : bool
        Whether one call does many states.
    base_at_rest : {"body", "world"}
        Whose linear acceleration of the base is zero in h: the one written in its own axes, or in the world's.
    prepare : callable
        Takes states with a batch axis, returns a call that does them all and returns the joints' entries.
    """

    name: str
    version: str
    quantity: str
    batched: bool
    base_at_rest: str
    prepare: Callable[[States], Callable[[], np.ndarray]]


def peers(model: tw.Model, urdf: str) -> Iterator[Peer]:
    """Yield what is installed; what cannot be set up says so and is left out."""
    makers = (_ours, _pinocchio_batches, _mujoco, _grid, _adam_numpy, _adam_casadi, _adam_c, _adam_jax, _frax)
    for make in makers:
        try:
            with warnings.catch_warnings(), contextlib.redirect_stderr(io.StringIO()):
                warnings.simplefilter("ignore")
                found = list(make(model, urdf))
        except ImportError as error:
            print(f"{make.__name__[1:]}: not installed ({error})")
            continue
        except Exception as error:  # a package of another make than this was written for
            print(f"{make.__name__[1:]}: {type(error).__name__}: {error}")
            continue
        yield from found


def _order(model: tw.Model, theirs: list[str]) -> np.ndarray:
    """Return for each of their joints its place among ours."""
    ours = list(model.joint_names[2:])
    return np.array([ours.index(name) for name in theirs])


def _placement(model: tw.Model, q: np.ndarray) -> np.ndarray:
    """Return the base's placements, shape (n, 4, 4)."""
    T = tw.forward_kinematics(model, q).placement[1]
    out = np.zeros((len(q), 4, 4))
    out[:, :3, :3], out[:, :3, 3], out[:, 3, 3] = T.rotation, T.translation, 1
    return out


def _ours(model: tw.Model, urdf: str) -> Iterator[Peer]:
    for quantity in ("rnea", "aba"):
        program = tw.compile(model, quantity)

        def prepare(s: States, program=program):
            args = [x[0] if len(x) == 1 else x for x in (s.q, s.v, s.a)]
            return lambda: program(*args)[..., JOINTS]

        yield Peer("tw.compile", version("twistwrench"), quantity, True, "body", prepare)


def _pinocchio_batches(model: tw.Model, urdf: str) -> Iterator[Peer]:
    import pinocchio as pin

    pool = pin.ModelPool(tw.bridge.to_pinocchio_model(model), 2)
    calls = {"rnea": pin.rneaInParallel, "aba": pin.abaInParallel}
    for quantity, call in calls.items():
        for threads in (1, 2):

            def prepare(s: States, call=call, threads=threads):
                v, a = (tw.bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a))
                columns = [np.asfortranarray(x.T) for x in (s.q, v, a)]
                return lambda: call(threads, pool, *columns).T[..., JOINTS]  # of one state it is a vector

            name = f"Pinocchio, {call.__name__}({threads})"
            yield Peer(name, version("pin"), quantity, True, "body", prepare)


def _mujoco(model: tw.Model, urdf: str) -> Iterator[Peer]:
    import mujoco
    from mujoco.rollout import rollout

    spec = mujoco.MjSpec.from_file(urdf)
    spec.compiler.fusestatic, spec.compiler.discardvisual = True, True
    for geom in list(spec.geoms):
        geom.contype = geom.conaffinity = 0
    base = spec.worldbody.first_body()
    base.add_freejoint()
    there = spec.compile()
    there.opt.gravity = model.gravity
    data = mujoco.MjData(there)
    names = [there.joint(k).name for k in range(1, there.njnt)]
    order = _order(model, names)
    back = np.argsort(order)
    M = np.zeros((there.nv, there.nv))

    def convert(s: States):
        base = tw.forward_kinematics(model, s.q).placement[1].rotation
        q = np.concatenate([s.q[:, :3], s.q[:, [6, 3, 4, 5]], s.q[:, 7:][:, order]], axis=-1)
        v = [np.concatenate([np.matvec(base, x[:, 3:6]), x[:, :3], x[:, 6:][:, order]], axis=-1) for x in (s.v, s.a)]
        return list(zip(q, *v, strict=True))

    def one_by_one(call):
        def prepare(s: States):
            states = convert(s)

            def run():
                return np.stack([call(*state) for state in states])

            return run

        return prepare

    def crba(q, v, a):
        data.qpos[:] = q
        mujoco.mj_kinematics(there, data)
        mujoco.mj_comPos(there, data)
        mujoco.mj_crb(there, data)
        mujoco.mj_fullM(there, data, M)
        return M[JOINTS, JOINTS][np.ix_(back, back)]

    def bias(q, v, a):
        data.qpos[:], data.qvel[:] = q, v
        mujoco.mj_kinematics(there, data)
        mujoco.mj_comPos(there, data)
        mujoco.mj_comVel(there, data)
        mujoco.mj_rne(there, data, 0, data.qfrc_bias)
        return data.qfrc_bias[JOINTS][back]

    def forward(q, v, tau):
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q, v, tau
        mujoco.mj_forward(there, data)
        return data.qacc[JOINTS][back]

    there.opt.disableflags = mujoco.mjtDisableBit.mjDSBL_CONSTRAINT | mujoco.mjtDisableBit.mjDSBL_EULERDAMP
    there.dof_damping[:] = there.dof_frictionloss[:] = 0
    for quantity, call in (("crba", crba), ("h", bias), ("aba", forward)):
        yield Peer("MuJoCo", version("mujoco"), quantity, False, "world", one_by_one(call))

    def rolled_out(s: States):
        states = convert(s)
        start = np.stack([[0.0, *q, *v] for q, v, _ in states])
        tau = np.stack([tau for _, _, tau in states])[:, None]
        applied, step = int(mujoco.mjtState.mjSTATE_QFRC_APPLIED), there.opt.timestep

        def run():
            after = rollout(there, data, start, tau, control_spec=applied)[0][:, 0]
            return ((after - start)[:, -there.nv :] / step)[:, JOINTS][:, back]

        return run

    yield Peer("MuJoCo, rollout of a step", version("mujoco"), "aba", True, "world", rolled_out)


def _grid(model: tw.Model, urdf: str) -> Iterator[Peer]:
    from RBDReference import RBDReference
    from URDFParser import URDFParser

    with contextlib.redirect_stdout(io.StringIO()):  # it prints the order of its joints
        there = RBDReference(URDFParser().parse(urdf, floating_base=True))
    calls = {
        "rnea": lambda q, v, a: there.inverse_dynamics(q, v, a)[0][JOINTS],
        "crba": lambda q, v, a: there.crba(q)[JOINTS, JOINTS],
        "aba": lambda q, v, tau: there.aba(q, v, tau)[JOINTS],
    }
    for quantity, call in calls.items():

        def prepare(s: States, call=call):
            states = list(zip(s.q, *(tw.bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a)), strict=True))
            return lambda: np.stack([call(*state) for state in states])

        yield Peer("RBDReference", version("grid-rbd"), quantity, False, "body", prepare)


def _adam(model: tw.Model, kindyn, name: str, batched_jit) -> Iterator[Peer]:
    import adam

    kindyn.set_frame_velocity_representation(adam.Representations.BODY_FIXED_REPRESENTATION)
    kindyn.g = kindyn.g * 0 + np.concatenate([model.gravity, np.zeros(3)])
    calls = {
        "crba": lambda T, q, V, v: kindyn.mass_matrix(T, q)[..., JOINTS, JOINTS],
        "h": lambda T, q, V, v: kindyn.bias_force(T, q, V, v)[..., JOINTS],
    }
    for quantity, call in calls.items():
        compiled = batched_jit(call)

        def prepare(s: States, compiled=compiled):
            arguments = _placement(model, s.q), s.q[:, 7:], np.concatenate([s.v[:, 3:6], s.v[:, :3]], -1), s.v[:, 6:]
            return lambda: np.asarray(compiled(*arguments))

        yield Peer(name, version("adam-robotics"), quantity, True, "body", prepare)


def _adam_numpy(model: tw.Model, urdf: str) -> Iterator[Peer]:
    from adam.numpy import KinDynComputations

    yield from _adam(model, KinDynComputations(urdf, list(model.joint_names[2:])), "adam (NumPy)", lambda call: call)


def _adam_casadi(model: tw.Model, urdf: str) -> Iterator[Peer]:
    import adam
    from adam.casadi import KinDynComputations

    kindyn = KinDynComputations(urdf, list(model.joint_names[2:]))
    kindyn.set_frame_velocity_representation(adam.Representations.BODY_FIXED_REPRESENTATION)
    kindyn.g = np.concatenate([model.gravity, np.zeros(3)])
    M, h = kindyn.mass_matrix_fun(), kindyn.bias_force_fun()
    calls = {
        "crba": lambda T, q, V, v: np.asarray(M(T, q))[JOINTS, JOINTS],
        "h": lambda T, q, V, v: np.asarray(h(T, q, V, v))[JOINTS, 0],
    }
    for quantity, call in calls.items():

        def prepare(s: States, call=call):
            V = np.concatenate([s.v[:, 3:6], s.v[:, :3]], -1)
            states = list(zip(_placement(model, s.q), s.q[:, 7:], V, s.v[:, 6:], strict=True))
            return lambda: np.stack([call(*state) for state in states])

        yield Peer("adam (CasADi)", version("adam-robotics"), quantity, False, "body", prepare)


def _adam_c(model: tw.Model, urdf: str) -> Iterator[Peer]:
    """Yield the C that CasADi generates from adam's functions, compiled for this processor, over the batch."""
    import adam
    import casadi
    from adam.casadi import KinDynComputations

    kindyn = KinDynComputations(urdf, list(model.joint_names[2:]))
    kindyn.set_frame_velocity_representation(adam.Representations.BODY_FIXED_REPRESENTATION)
    kindyn.g = np.concatenate([model.gravity, np.zeros(3)])
    folder = Path(tempfile.mkdtemp())
    for quantity, function, given in (("crba", kindyn.mass_matrix_fun(), 2), ("h", kindyn.bias_force_fun(), 4)):
        generated = casadi.CodeGenerator(f"{quantity}.c")
        generated.add(function)
        source = generated.generate(f"{folder}/")
        library = folder / f"{quantity}.so"
        subprocess.run(["cc", "-O3", "-march=native", "-shared", "-fPIC", source, "-o", library], check=True)
        compiled = casadi.external(function.name(), str(library))

        def prepare(s: States, compiled=compiled, given=given, matrix=quantity == "crba"):
            V = np.concatenate([s.v[:, 3:6], s.v[:, :3]], -1)
            T = np.concatenate([*_placement(model, s.q)], axis=1)
            arguments, mapped = [T, s.q[:, 7:].T, V.T, s.v[:, 6:].T][:given], compiled.map(len(s.q))

            def run():
                x = np.asarray(mapped(*arguments))
                return x.reshape(len(x), -1, len(x)).swapaxes(0, 1)[:, JOINTS, JOINTS] if matrix else x.T[:, JOINTS]

            return run

        yield Peer("adam (CasADi's C)", version("adam-robotics"), quantity, True, "body", prepare)


def _adam_jax(model: tw.Model, urdf: str) -> Iterator[Peer]:
    import jax
    from adam.jax import KinDynComputations

    yield from _adam(model, KinDynComputations(urdf, list(model.joint_names[2:])), "adam (JAX)", jax.jit)


def _frax(model: tw.Model, urdf: str) -> Iterator[Peer]:
    import jax
    from frax.core.robot import Robot

    robot = Robot(urdf, floating_base="quaternion")
    order = _order(model, list(robot.joint_names[6:]))
    back = np.argsort(order)
    calls = {
        "crba": lambda q, v: robot.mass_matrix(q)[6:, 6:],
        "h": lambda q, v: robot.nonlinear_bias(q, v)[6:],
    }
    for quantity, call in calls.items():
        compiled = jax.jit(jax.vmap(call))

        def prepare(s: States, compiled=compiled, quantity=quantity):
            q = np.concatenate([s.q[:, :3], s.q[:, [6, 3, 4, 5]], s.q[:, 7:][:, order]], axis=-1)
            base = tw.forward_kinematics(model, s.q).placement[1].rotation
            v = np.concatenate([np.matvec(base, s.v[:, 3:6]), s.v[:, :3], s.v[:, 6:][:, order]], axis=-1)

            def run():
                x = np.asarray(compiled(q, v))
                return x[:, back] if quantity == "h" else x[:, back[:, None], back]

            return run

        yield Peer("frax", version("frax"), quantity, True, "world", prepare)


def expected(model: tw.Model, peer: Peer, s: States) -> np.ndarray:
    """Return our joints' entries of what a peer computes."""
    if peer.quantity in ("rnea", "aba"):
        found: np.ndarray = getattr(tw, peer.quantity)(model, s.q, s.v, s.a)[:, JOINTS]
        return found
    if peer.quantity == "crba":
        return tw.fast.crba(model, s.q)[:, JOINTS, JOINTS]
    a = np.zeros_like(s.v)
    if peer.base_at_rest == "world":  # the velocity of the origin keeps its direction in the world, not in the body
        a[:, 3:6] = -np.cross(s.v[:, :3], s.v[:, 3:6])
    return tw.fast.rnea(model, s.q, s.v, a)[:, JOINTS]
