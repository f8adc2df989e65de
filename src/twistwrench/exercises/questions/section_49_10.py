"""Answers to the questions of 49.10: what changes the momentum of the whole, and what simple models leave out."""

from __future__ import annotations

import numpy as np

import twistwrench as tw

from . import Facts
from .gaits import GAITS, acceleration, move


def air() -> Facts:
    """Effect of twelve motors on the centre of mass of a robot in the air."""
    model = tw.load("go2")
    q, rest = model.standing(), np.zeros(model.nv)
    pull = np.concatenate([np.zeros(6), np.full(12, 10.0)])
    rate = tw.centroidal_momentum_rate(model, q, rest, tw.aba(model, q, rest, pull))
    added = rate[3:] - model.mass * model.gravity
    return {"truth": "none" if np.linalg.norm(added) < 1e-9 else "up" if added[2] > 0 else "down"}


def standing() -> Facts:
    """Rate of l_G of a robot that stands still, upward, in N."""
    model = tw.load("go2")
    rest = np.zeros(model.nv)
    rate = tw.centroidal_momentum_rate(model, model.standing(), rest, rest)
    return {"truth": float(rate[5]), "down": -9.81 * model.mass, "up": 9.81 * model.mass}


def cat() -> Facts:
    """Angle in degrees by which the trunk has turned when Go2, in the air without momentum, has circled its hips."""
    model = tw.load("go2")
    q, steps = model.standing(), 24
    start = q.copy()
    hips, thighs = [0, 3, 6, 9], [1, 4, 7, 10]
    for k in range(steps):
        phase, legs = 2 * np.pi * (k + 0.5) / steps, np.zeros(12)
        legs[hips], legs[thighs] = 0.5 * np.cos(phase), 0.5 * np.sin(phase)
        legs *= 2 * np.pi / steps
        middle = model.integrate(q, np.concatenate([_base(model, q, legs), legs]) / 2)
        q = model.integrate(q, np.concatenate([_base(model, middle, legs), legs]))
    turned = float(np.degrees(np.linalg.norm(model.difference(start, q)[:3])))
    return {"truth": "turned" if turned > 1 else "same", "angle": turned}


def gait() -> Facts:
    """Gait with the largest k_y, and the three values."""
    model = tw.load("go2")
    largest = []
    for one in GAITS.values():
        momenta = tw.centroidal_momentum(model, *move(np.linspace(0, 1, 241) / one.strides, one))
        largest.append(float(np.abs(momenta[:, 1]).max()))
    walk, trot, bound = largest
    truth = ("walk", "trot", "bound")[int(np.argmax(largest))]
    return {"truth": truth, "walk": walk, "trotting": trot, "bounding": bound}


def load() -> Facts:
    """Least load on the feet in a trot whose trunk bobs by 19 mm, in per cent of the weight."""
    weight = 9.81 * tw.load("go2").mass
    return {"truth": 100 * float(_trot()[0].min()) / weight, "weight": 100.0, "half": 50.0}


def shift() -> Facts:
    """Shift in mm of the centre of pressure that a trot makes by the angular momentum which the LIPM leaves out."""
    weight = 9.81 * tw.load("go2").mass
    force, moment = _trot()
    half_length = float(tw.frame_placement(tw.load("go2"), tw.load("go2").standing(), "FL_foot").translation[0])
    return {
        "truth": 1000 * float((moment / force).max()),
        "weight": 1000 * float(moment.max()) / weight,
        "feet": 1000 * half_length,
    }


def rigid() -> Facts:
    """Part of the angular momentum of a trot that a single rigid body has, which turns with the trunk, in per cent."""
    trot = GAITS["trot"]
    _, v = move(np.linspace(0, 1, 61) / trot.strides, trot)
    model = tw.load("go2")
    inertia = tw.centroidal_map(model, model.standing())[:3, :3]
    whole = tw.centroidal_momentum(model, *move(np.linspace(0, 1, 61) / trot.strides, trot))[:, :3]
    part = np.abs(np.matvec(inertia, v[:, :3])).max() / np.abs(whole).max()
    return {"truth": 100 * float(part), "trunk": 100 * float(model.inertia[1].mass) / model.mass, "most": 90.0}


def _base(model: tw.Model, q: np.ndarray, legs: np.ndarray) -> np.ndarray:
    """Return the twist of the base that keeps the momentum at zero while the joints move."""
    A = tw.centroidal_map(model, q)
    return np.linalg.solve(A[:, :6], -A[:, 6:] @ legs)


def _trot() -> tuple[np.ndarray, np.ndarray]:
    """Return the vertical force that a trot needs, and the horizontal moment about the centre of mass."""
    model, trot = tw.load("go2"), GAITS["trot"]
    t = np.linspace(0, 1, 241) / trot.strides
    rate = tw.centroidal_momentum_rate(model, *move(t, trot), acceleration(t, trot))
    return rate[:, 5] + 9.81 * model.mass, np.hypot(rate[:, 0], rate[:, 1])
