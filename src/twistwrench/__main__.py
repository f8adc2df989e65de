"""``python -m twistwrench`` does what ``twistwrench`` does, where that is not on the path."""

import sys

__all__ = ["run"]

EXIT_SIGINT = 130


def run() -> int:
    """Run the command line of the process; Ctrl-C while it is still being imported is one as well."""
    try:
        from .cli import main

        return main()
    except KeyboardInterrupt:
        return EXIT_SIGINT


if __name__ == "__main__":
    sys.exit(run())
