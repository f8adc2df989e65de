"""What a real robot would not have done in a motion, or not without being noticed."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Remark"]

SENTENCES = {
    "pull": "contact {name!r} pulls, by {value:.4g} N",
    "slip": "contact {name!r} holds {value:.4g} N along the ground; without slipping it can {limit:.4g} N",
    "tip": "contact {name!r} holds a moment of {value:.4g} N m; without tipping it can {limit:.4g} N m",
    "sunk": "the body of joint {name!r} is below all contacts, at {value:.4g} m",
    "range": "joint {name!r} is at {value:.4g}, beyond its range, which ends at {limit:.4g}",
    "speed": "joint {name!r} moves at {value:.4g} rad/s or m/s; it can {limit:.4g}",
    "effort": "the motor of joint {name!r} gives {value:.4g} N m or N; it can {limit:.4g}",
    "lift-off": "contact {name!r} leaves the ground",
    "slide": "contact {name!r} slides, at {value:.4g} m/s",
    "alternates": "the velocity of joint {name!r} alternates and grows, soon by {value:.4g} rad/s or m/s a step: lower "
    "gains, damping of the model, or a smaller dt?",
    "coulomb": "contact {name!r} misses Coulomb's law by {value:.4g} m/s, more than {limit:.4g}: a smaller dt?",
    "energy": "the energy of {name!r} grows by {value:.4g} J from nowhere, more than {limit:.4g}: a smaller dt?",
    "damping": "joint {name!r} has damping, here up to {value:.4g} N m or N, which only 'time-stepping' applies",
    "friction": "joint {name!r} has dry friction, {value:.4g} N m or N, which only 'time-stepping' applies",
}


class Remark(NamedTuple):
    """The first time that something happened in a motion.

    Attributes
    ----------
    t : float
        When, s.
    kind : str
        "pull", "slip", "tip" of a contact that sticks, "sunk" of a body below all of them; "range", "speed", "effort"
        of a joint, "alternates" of one whose velocity changes its way in each step, by more and more; "lift-off",
        "slide" of a contact on a ground, and "coulomb" where no forces were found that fulfil Coulomb's law to 1e-3 of
        the fastest point; "energy" where a robot on a ground has more than it had before and its motors put in, by 2 %
        of all that moved and ½ m g v dt; "damping", "friction" of a joint that moves, which only time stepping applies;
        the value is the largest that was left out.
    name : str
        Of the frame of the contact, the joint, or the robot.
    value, limit : float
        How large it was then, and what is allowed; in N, N m, J, rad, m, rad/s or m/s.
    """

    t: float
    kind: str
    name: str
    value: float
    limit: float

    def __str__(self) -> str:
        return f"from t = {self.t:.4g} s " + SENTENCES[self.kind].format(**self._asdict())
