"""How many cases of a test a run tries, and how hypothesis runs here: without a clock.

The plain run is what a reader would read: of a test with many cases it tries the first and the last. `pytest -m slow`
tries the others, of a long list some that are drawn anew each time; with ``TWISTWRENCH_DRAW=all`` each of them. A case
that is named on the command line is always run.
"""

import os
import random
from collections import defaultdict

import pytest
from hypothesis import Phase, settings

from .sampling import DRAWN_BY

PLAIN_CASES = 2
"""Of each test in the plain run: the first and the last."""

SLOW_CASES = 6
"""Of each test in the slow run, at most; those are drawn."""

settings.register_profile(
    "twistwrench",
    deadline=None,
    print_blob=True,
    derandomize="CI" in os.environ,
    max_examples=100 if os.environ.get(DRAWN_BY) == "all" else 30,
)
settings.register_profile(
    "no_shrinking", settings.get_profile("twistwrench"), phases=[phase for phase in Phase if phase is not Phase.shrink]
)
settings.load_profile("twistwrench")

os.environ.setdefault(DRAWN_BY, str(random.randrange(1000)))  # before pytest-xdist starts its processes, which need it


def pytest_report_header():
    """Print by what a long list of slow tests is drawn, so that it can be drawn again."""
    seed = os.environ[DRAWN_BY]
    return f"of the longest lists of slow tests a part is drawn: {DRAWN_BY}={seed} (all: {DRAWN_BY}=all)"


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config, items):
    """Mark as slow what is not tried in the plain run, and leave out what the slow one does not draw."""
    if any("[" in name for name in config.invocation_params.args):
        return
    cases = defaultdict(list)
    for item in items:
        if isinstance(item, pytest.Function) and not item.get_closest_marker("slow"):
            cases[item.nodeid.partition("[")[0]].append(item)
    seed, left_out = os.environ[DRAWN_BY], set()
    for name, of_test in cases.items():
        if len(of_test) <= PLAIN_CASES:
            continue
        others = of_test[1:-1]
        for item in others:
            item.add_marker(pytest.mark.slow)
        if seed != "all" and len(others) > SLOW_CASES:
            left_out |= set(others) - set(random.Random(seed + name).sample(others, SLOW_CASES))
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]
