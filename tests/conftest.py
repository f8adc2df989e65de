"""How many cases of a test a run tries, and how hypothesis runs here: without a clock.

The plain run is what a reader would read: of a test with many cases it tries the first and the last, of one that is
marked `one_case` the first. `pytest -m slow` tries others, a few that are drawn anew each time, and of the longest
tests, `slow(one_in=3)`, a third; with ``TWISTWRENCH_DRAW=all`` all of them. What is named on the command line is run.
"""

import importlib
import os
import random
import sys
from collections import defaultdict
from pathlib import Path

import pytest
from hypothesis import Phase, settings

from .sampling import DRAWN_BY, SLOW_CASES

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


@pytest.fixture
def benchmark_file(monkeypatch):
    """Return what imports a file of benchmarks/ by its name."""
    monkeypatch.syspath_prepend(str(Path(__file__).parents[1] / "benchmarks"))
    return importlib.import_module


@pytest.fixture
def no_other_process(monkeypatch):
    """Answers to exercises are read and judged in this process, as in a page: another one takes half a second each."""
    monkeypatch.setattr(sys, "executable", "")


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
        if isinstance(item, pytest.Function) and "[" in item.nodeid:
            cases[item.nodeid.partition("[")[0]].append(item)
    seed, left_out = os.environ[DRAWN_BY], set()
    for name, of_test in cases.items():
        plain = [item for item in of_test if not item.get_closest_marker("slow")]
        kept = plain[:1] if of_test[0].get_closest_marker("one_case") else [*plain[:1], *plain[1:][-1:]]
        for item in plain:
            if item not in kept:
                item.add_marker(pytest.mark.slow)
        slow = [item for item in of_test if item not in kept]
        most = max((item.get_closest_marker("slow").kwargs.get("draw", SLOW_CASES) for item in slow), default=0)
        if seed != "all" and len(slow) > most:
            left_out |= set(slow) - set(random.Random(seed + name).sample(slow, most))
    if seed != "all" and not any("::" in name for name in config.invocation_params.args):
        longest = [item for item in items if _one_in(item) > 1]
        left_out |= {item for item in longest if random.Random(seed + item.nodeid).randrange(_one_in(item))}
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]


def _one_in(item):
    """Return how many runs of the slow tests have a test once, by its mark."""
    mark = item.get_closest_marker("slow")
    return mark.kwargs.get("one_in", 1) if mark else 1
