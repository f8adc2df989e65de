"""`check`, for the functions of a notebook's cell, a script or a shell.

Each file imports only from those above it in this table.

======  =================
file    what it holds
======  =================
markup  a verdict as HTML
cells   `check`
======  =================
"""
