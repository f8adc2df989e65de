"""The student's folder: what is written into it, and read from it.

Each file imports only from those above it in this table.

=========  ===========================================
file       what it holds
=========  ===========================================
formulas   an answer that is typed as a formula
sources    the solutions as they are shown
workbook   `Workbook`: the answers in a folder; `mine`
skeletons  the files that a student starts from
=========  ===========================================
"""
