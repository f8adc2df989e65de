"""Write a file beside, then rename: the old file stays intact until the new one is whole."""

from misstep.files import errors_name, replacing, write_text

__all__ = ["errors_name", "replacing", "write_text"]
