"""The catalogue of slips: TOML files with a table for each slip; one of them has the words for what kind it is."""

from __future__ import annotations

from misstep.exercise import Slip
from misstep.text import as_text, read

__all__ = ["FILES", "SLIPS", "Slip"]

FILES = (
    *("basics", "order", "algebra", "frames", "contact", "inertia", "bodies", "dynamics"),
    *("recursion", "tree", "measuring", "floating", "standing", "pipeline", "pinocchio"),
)
KINDS = {key: as_text(entry) for key, entry in read(__name__, "kinds").items()}

SLIPS = {
    key: Slip(as_text(entry["title"]), as_text(entry["why"]), entry["section"], KINDS[entry["kind"]])
    for name in FILES
    for key, entry in read(__name__, name).items()
}
"""Every slip by its key. An exercise maps the keys that can occur in it to wrong implementations."""
