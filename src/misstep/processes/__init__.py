"""The process that runs a student's code, so that nothing in it stops or harms the check.

It answers in lines of JSON, of which only plain values are made: nothing that it sends is ever run. The process that
asks has a clock of its own, and ends it with all that it has started.

Each file imports only from those above it in this table.

=========  ====================================================
file       what it holds
=========  ====================================================
limits     what such a process may use
messages   verdicts as JSON, and back
transfer   a function of a notebook as bytes
process    the process as it is seen from outside
worker     the program that it runs
isolation  a folder, or a function, judged in it
=========  ====================================================
"""
