"""The student's function statement by statement, beside a right solution that is run on the same arguments.

Each file imports only from those above it in this table.

========  ============================================================================
file      what it holds
========  ============================================================================
mixups    a view for a copy, all six numbers for three
records   what every expression is when it runs, and which values a right solution has
outputs   what each statement computes, and which goes wrong first
donors    what may stand in a wrong statement
stepwise  the search from one wrong statement to the next
========  ============================================================================
"""
