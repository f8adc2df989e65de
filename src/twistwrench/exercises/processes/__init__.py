"""The processes that run a student's code, so that nothing in it stops or harms the check.

Each file imports only from those above it in this table.

=========  ===================================================
file       what it holds
=========  ===================================================
isolation  a process of its own for the answers of a folder
limits     what such a process may use
forking    a copy of this process for a function of a notebook
worker     the program that the process of a folder runs
=========  ===================================================
"""
