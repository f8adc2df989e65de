"""A whole class: its folders, its points.

Each file imports only from those above it in this table.

=======  ====================================
file     what it holds
=======  ====================================
grading  the folders, each judged by itself
sheets   a table, a page, CSV and JUnit's XML
=======  ====================================
"""
