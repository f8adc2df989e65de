"""What a scene requires, and no more: the smallest model, only what is wanted of it, and what each omission costs."""

from .scene import Scene

__all__ = ["Scene"]
