"""How hypothesis runs here: without a clock, and the same examples every time where CI is set; and what a run draws."""

import os
import random

from hypothesis import Phase, settings

from .sampling import DRAWN_BY

settings.register_profile("twistwrench", deadline=None, print_blob=True, derandomize="CI" in os.environ)
settings.register_profile(
    "no_shrinking", settings.get_profile("twistwrench"), phases=[phase for phase in Phase if phase is not Phase.shrink]
)
settings.load_profile("twistwrench")

os.environ.setdefault(DRAWN_BY, str(random.randrange(1000)))  # before pytest-xdist starts its processes, which need it


def pytest_report_header():
    """Print by what a long list of slow tests is drawn, so that it can be drawn again."""
    seed = os.environ[DRAWN_BY]
    return f"of the longest lists of slow tests a part is drawn: {DRAWN_BY}={seed} (all: {DRAWN_BY}=all)"
