"""How hypothesis runs here: without a clock, and the same examples every time where CI is set."""

import os

from hypothesis import settings

settings.register_profile("twistwrench", deadline=None, print_blob=True, derandomize="CI" in os.environ)
settings.load_profile("twistwrench")
