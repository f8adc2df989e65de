"""``python -m benchmarks.study templates``: the error of each template of a walking robot, and its time."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

import twistwrench as tw
from twistwrench.motions import Motion
from twistwrench.templates import TEMPLATES

from .record import BUSY, Record, table, time_in_turns

ROBOTS = ("go2", "solo12", "talos_reduced", "g1")
REFERENCE = "full"
MEASURED = ("relative", "largest", "moment", "shift", "force", "rate", "law")


def losses(
    model: tw.Model, motion: Motion, *, rounds: int = 7, after_round: Callable[[], object] = lambda: None
) -> list[Record]:
    """Compare every template with the full model over a motion, and time them in turns.

    Each gives the root mean square over the states of the residual of ḣ_G: `relative`, and of that also the `largest`;
    of its parts `moment`, N m, and `force`, N; `shift`, m: by how much the moment moves the centre of pressure of a
    robot that pushes with its weight. And the times of its `rate` from (q, v, a) and of its `law`.

    >>> import twistwrench as tw
    >>> model = tw.load("go2")
    >>> for r in losses(model, tw.motions.walk(model, samples=20), rounds=1):
    ...     if r.quantity == "relative":
    ...         print(f"{r.way:12} {r.error:.0e}")
    point_mass   2e-02
    lipm         2e-02
    srbm_frozen  2e-02
    srbm         2e-02
    centroidal   ...e-16
    full         0e+00
    """
    state = motion.q, motion.v, motion.a
    found: list[Record] = []
    started: list[tuple[Record, Callable[[], object]]] = []
    for name, kind in TEMPLATES.items():
        template = kind.of(model, model.standing())
        residual = template.residual(*state)
        moment = _rms(residual.moment)
        errors = {
            "relative": _rms(residual.relative[:, None]),
            "largest": float(residual.relative.max()),
            "moment": moment,
            "shift": moment / residual.weight,
            "force": _rms(residual.force),
        }
        found += [Record(quantity, name, where=motion.name, error=error) for quantity, error in errors.items()]
        known = template.read(*model.state(motion.q, v=motion.v, a=motion.a))
        for quantity, call in (("rate", partial(template.rate, *state)), ("law", partial(template.law, *known))):
            started.append((Record(quantity, name, where=motion.name, states=len(motion)), call))
    return found + time_in_turns(started, rounds=rounds, after_round=after_round)


def _rms(x: Any) -> float:
    """Root of the mean over the states of the square of the length."""
    return float(np.sqrt((x * x).sum(axis=-1).mean()))


def shown(robot: str, model: tw.Model, motions: Sequence[Motion], found: Sequence[Record]) -> str:
    """Return the records of a robot as a table, and what the ground must do."""
    by = {(r.where, r.way, r.quantity): r for r in found}
    rows = []
    for where, way in dict.fromkeys((r.where, r.way) for r in found):
        relative, largest, moment, shift, force, rate, law = (by[where, way, name] for name in MEASURED)
        row = {"motion": where, "template": way, "relative": f"{relative.error:.2g} ({largest.error:.2g})"}
        row |= {"moment, N m": moment.error, "shift, mm": 1e3 * shift.error, "force, N": force.error}
        full = by[where, REFERENCE, "rate"].seconds
        busy = "~" * (not (rate.quiet and law.quiet))
        rows.append(
            row
            | {"a state": busy + rate.time.lstrip("~"), "× full": rate.seconds / full, "law × full": law.seconds / full}
        )
    formats = {"moment, N m": ".2g", "shift, mm": ".2g", "force, N": ".2g", "× full": ".2f", "law × full": ".3f"}
    lines = [
        f"{robot}, nv = {model.nv}, {model.mass:.3g} kg: what is left out of ḣ_G, root mean square over the states",
        "relative to the weight (largest); shift = moment / weight: how far it moves the centre of pressure",
        "",
        *([table(rows, dict.fromkeys(rows[0]), **formats)] if rows else []),
        *(_needs(model, motion) for motion in motions),
        *([] if all(r.quiet for r in found) else [BUSY]),
    ]
    return "\n".join(lines) + "\n"


def _needs(model: tw.Model, motion: Motion) -> str:
    """Return in words what the ground must do for a motion."""
    needed = tw.motions.ground(model, motion)
    broken = tw.motions.limits_broken(model, motion)
    limits = f"\n  outside the limits of {len(broken)} joints: {', '.join(broken)}" if broken else ""
    worst = 1e3 * float(needed.margin.min())
    return (
        f"{motion.name}: the ground is loaded for {100 * needed.loaded.mean():.0f} % of the time, friction of at least "
        f"{needed.friction.max():.2f},\n  centre of pressure at worst {abs(worst):.0f} mm "
        f"{'inside' if worst > 0 else 'outside'} the polygon of the feet's frames{limits}"
    )
