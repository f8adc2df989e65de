"""The values of a step-through: what each body of a robot received and passed on, as `tw.trace` tells it."""

from __future__ import annotations

from typing import Any


def section(said: dict[str, Any], language: str) -> str:
    """Return the section of an algorithm's page that shows the values."""
    return ""
