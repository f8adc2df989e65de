"""Exercise 49.1.1: nq and nv of Go2."""

from typing import Any

from misstep.exercise import Exercise, Output, Part

__all__ = ["EXERCISE", "sizes"]


def sizes() -> Any:
    """Nq and nv with a quaternion, and with Euler angles."""
    joints = 12
    return 3 + 4 + joints, 3 + 3 + joints, 3 + 3 + joints, 3 + 3 + joints


EXERCISE = Exercise(
    id="49.1.1",
    kind="number",
    parts=(
        Part(
            solution=sizes,
            returns=(
                Output("nq (quaternion)", zh="nq（四元数）"),
                Output("nv (quaternion)", zh="nv（四元数）"),
                Output("nq (Euler)", zh="nq（欧拉角）"),
                Output("nv (Euler)", zh="nv（欧拉角）"),
            ),
            cases=lambda rng: [()],
            slips={
                "nq-for-nv": lambda: (19, 19, 18, 18),
                "nq-nv-exchanged": lambda: (18, 19, 18, 18),
                "quaternion-of-three": lambda: (18, 18, 18, 18),
                "euler-of-four": lambda: (19, 18, 19, 18),
                "nv-one-less": lambda: (19, 18, 18, 17),
                "base-missing": lambda: (12, 12, 12, 12),
                "legs-left-out": lambda: (7, 6, 6, 6),
                "root-joint-counted": lambda: (20, 19, 19, 19),
            },
        ),
    ),
)
