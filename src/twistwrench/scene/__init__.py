"""The smallest model that a scene needs, the terms of its dynamics that are wanted, and the cost of each omission."""

from .scene import Scene

__all__ = ["Scene"]
