"""How hypothesis runs here: without a clock, and the same examples every time where CI is set."""

import os

from hypothesis import Phase, settings

settings.register_profile("twistwrench", deadline=None, print_blob=True, derandomize="CI" in os.environ)
settings.register_profile(
    "no_shrinking", settings.get_profile("twistwrench"), phases=[phase for phase in Phase if phase is not Phase.shrink]
)
settings.load_profile("twistwrench")
