"""Exercise 49.0.4: what nq and nv count."""

from typing import Any

from misstep.exercise import Exercise, Output, Part

__all__ = ["EXERCISE", "count"]


def count(kinds: Any) -> Any:
    """Nq and nv of a list of joints."""
    in_q = {"revolute": 1, "prismatic": 1, "continuous": 2, "spherical": 4, "free_flyer": 7}
    in_v = {"revolute": 1, "prismatic": 1, "continuous": 1, "spherical": 3, "free_flyer": 6}
    return sum(in_q[kind] for kind in kinds), sum(in_v[kind] for kind in kinds)


def _less(kinds: Any, *, fewer: dict[str, int]) -> Any:
    """Count some kinds of joint as fewer numbers in q."""
    nq, nv = count(kinds)
    return nq - sum(fewer.get(kind, 0) for kind in kinds), nv


def _once(kinds: Any, kind: str) -> Any:
    """Return a list of joints with one of a kind in place of several."""
    return [k for n, k in enumerate(kinds) if k != kind or k not in kinds[:n]]


def _cases(rng: Any) -> Any:
    others = ["revolute", "prismatic", "continuous", "spherical"]
    every = ["free_flyer", *others]

    def some(n: int) -> list[str]:
        return [str(kind) for kind in rng.choice(others, size=n)]

    return [(every + some(4),), (some(5),), (every + some(3) + ["free_flyer"],), (some(2) + every,), ([],)]


EXERCISE = Exercise(
    id="49.0.4",
    taught="49.1",
    kind="explain",
    parts=(
        Part(
            solution=count,
            returns=(Output("nq"), Output("nv")),
            cases=_cases,
            edges=lambda rng: [([kind],) for kind in ("free_flyer", "revolute", "continuous", "spherical")],
            slips={
                "nq-for-nv": lambda kinds: (count(kinds)[0],) * 2,
                "nq-nv-exchanged": lambda kinds: count(kinds)[::-1],
                "quaternion-of-three": lambda kinds: _less(kinds, fewer={"free_flyer": 1, "spherical": 1}),
                "angle-of-one": lambda kinds: _less(kinds, fewer={"continuous": 1}),
                "base-missing": lambda kinds: count([kind for kind in kinds if kind != "free_flyer"]),
                "kinds-once": lambda kinds: count(set(kinds)),
                "base-once": lambda kinds: count(_once(kinds, "free_flyer")),
                "spherical-of-three": lambda kinds: _less(kinds, fewer={"spherical": 1}),
                "continuous-of-two": lambda kinds: (count(kinds)[0], count(kinds)[1] + kinds.count("continuous")),
                "one-more-than-nv": lambda kinds: (count(kinds)[1] + ("free_flyer" in kinds), count(kinds)[1]),
                "base-assumed": lambda kinds: count(["free_flyer", *(kind for kind in kinds if kind != "free_flyer")]),
            },
            residuals=(
                lambda answer, kinds: (
                    answer[0] - answer[1] - sum(k in ("free_flyer", "spherical", "continuous") for k in kinds)
                ),
            ),
        ),
    ),
)
