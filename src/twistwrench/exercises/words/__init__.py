"""The words of the messages, in English and Chinese.

Each file imports only from those above it in this table.

========  ================================================================
file      what it holds
========  ================================================================
text      `Text`: what is said, in both languages
mendings  sentences on a change that makes a student's function right
sayings   sentences on what a wrong result is
phrases   every other sentence that a message is made of
wrapping  lines of a given width, with spaces between the words or without
========  ================================================================
"""
