"""What a slip is: a mistake with a name."""

from __future__ import annotations

from typing import NamedTuple

from ..words.text import Text

__all__ = ["Slip"]

LACKING = (" missing", " left out", " dropped", " is lost", " cut off")
"""Words of the titles of slips that lack something."""


class Slip(NamedTuple):
    """A mistake that many have made before.

    Attributes
    ----------
    title : Text
        Its name in the message.
    why : Text
        What is true instead, in a sentence or two.
    section : str
        Where the chapter has it.
    """

    title: Text
    why: Text
    section: str

    @property
    def lacks(self) -> bool:
        """Whether it is that something is not there."""
        return any(word in self.title.en for word in LACKING)
