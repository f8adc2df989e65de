"""Functions of school physics, right and wrong, to be diagnosed: no robot is needed for that."""

import numpy as np

from misstep.diagnose import Field
from misstep.exercise import Output, Part, Slip
from misstep.text import Text


def said(*words):
    return Text(*words * (2 // len(words)))


def projectile(speed, angle, t):
    x = speed * np.cos(angle) * t
    y = speed * np.sin(angle) * t - 9.81 * t**2 / 2
    return np.array([x, y])


def center(m, r):
    total = np.zeros(3)
    for mass, place in zip(m, r):
        total = total + mass * place
    return total / np.sum(m)


def stiffness(K, R):
    return R @ K @ R.T


def mean_and_spread(x):
    middle = np.sum(x) / len(x)
    return middle, np.sqrt(np.sum((x - middle) ** 2) / (len(x) - 1))


def _projectile_cases(rng):
    return [(10 * rng.random() + 1, rng.random(), rng.random() + 0.5) for _ in range(5)]


def _center_cases(rng):
    return [(rng.random(n), rng.standard_normal((n, 3))) for n in (2, 3, 5)]


def _stiffness_cases(rng):
    turns = [np.linalg.qr(rng.standard_normal((3, 3)))[0] for _ in range(3)]
    return [(np.diag(rng.random(3)) + 1, R) for R in turns]


PROJECTILE = Part(
    solution=projectile,
    returns=(Output("x, y"),),
    cases=_projectile_cases,
    slips={
        "falls-up": lambda speed, angle, t: (
            projectile(speed, angle, t) * [1, 0] + projectile(-speed, angle, t) * [0, -1]
        )
    },
)
CENTER = Part(solution=center, returns=(Output("c"),), cases=_center_cases, slips={})
STIFFNESS = Part(solution=stiffness, returns=(Output("K"),), cases=_stiffness_cases, slips={})
SPREAD = Part(
    solution=mean_and_spread,
    returns=(Output("mean"), Output("spread")),
    cases=lambda rng: [(rng.standard_normal(n),) for n in (3, 4, 7)],
    slips={"divided-by-n": lambda x: (np.mean(x), np.std(x))},
)
FIELD = Field(
    {
        "falls-up": Slip(said("gravity pushes up"), said("It pulls down: −g t²/2."), "1", said("sign")),
        "divided-by-n": Slip(said("divided by n"), said("The mean uses up one number: n − 1."), "2", said("factor")),
    }
)


def written(tmp_path, text):
    """Return the last function of a text that stands in a file, as a student's does."""
    path = tmp_path / "answer.py"
    path.write_text(text, encoding="utf-8")
    names = {"np": np, "__file__": str(path)}
    exec(compile(text, str(path), "exec"), names)
    return [x for x in names.values() if callable(x)][-1]
