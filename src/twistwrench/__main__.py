"""``python -m twistwrench`` does what ``twistwrench`` does, where that is not on the path."""

import sys

from .cli import main

__all__: list[str] = []

if __name__ == "__main__":
    sys.exit(main())
