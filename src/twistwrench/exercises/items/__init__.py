"""The exercises, one file each, named by its number in the chapter."""
