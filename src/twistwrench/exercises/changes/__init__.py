"""Small changes of a function: which there are, which of them a student makes, and which explain his numbers.

Each file imports only from those above it in this table.

============  ===================================================================
file          what it holds
============  ===================================================================
containers    what may be changed in a list, a tuple, an index or a slice
excerpts      how a piece of a program and its change are written in a message
places        places in a syntax tree, and how something is put there
twins         names and numbers that are taken for each other
calling       what could stand in place of a call or of a name
alternatives  what could stand in place of a piece of a program
scope         what the names in a function stand for, and may be taken for
whole         an edit; and edits of what goes into a function and comes out of it
edits         all small edits of a right function
written       the source of a student's function, with the helpers that it calls
crosses       cross products and differences in a text, and which of the two is turned
of_wrenches   whether a change would transform a wrench as a twist, or a twist as a wrench
plausible     which changes are slips that somebody makes
likeness      which changes are the same for a student, and which are less likely than others
planets       whether a function takes the gravity of the earth, whatever its robot's is
sound         whether a change that makes a function right holds in special cases too
nearer        changes that make a part of an answer right
search        the edit of the right function that gives the student's numbers
meanings      what a change means: a condition that always holds, an argument of zeros
repair        a change that makes the student's own function right, and how it is said
chosen        which of the changes that make a function right are reported
repairs       the search for it
============  ===================================================================
"""
