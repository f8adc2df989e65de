"""Contact: what a robot that touches its surroundings can and cannot do (49.9)."""

from .types import Contact, PointContact, SurfaceContact

__all__ = ["Contact", "PointContact", "SurfaceContact"]
