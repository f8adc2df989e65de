"""Types and checks of the commands' options: a whole number, and a file that can be written."""

from misstep.commands import at_least
from misstep.files import check_writable

__all__ = ["at_least", "check_writable"]
