"""A whole class: its folders, its points.

Each file imports only from those above it in this table.

===========  ========================================
file         what it holds
===========  ========================================
submissions  what was handed in, in folders and zips
grading      each student judged, by itself
sheets       a table, a page, CSV and JUnit's XML
===========  ========================================
"""
