"""Names what is wrong with a numerical function, given a right one, cases, and a list of slips.

`diagnose` compares a function with a right one and looks for one explanation: a slip of the list that gives the same
numbers, a small edit of its own code that makes it right, or one of a right solution that gives the same numbers.
Around it stands what a course needs: it judges, keeps students' folders, runs their code in a process of its own,
and grades a class. It knows NumPy, `ast` and pytest, and nothing of any field: what is special to one is a `Course`.

Each file imports only from those above it in this table.

===========  ======================================================================
file         what it holds
===========  ======================================================================
errors       the errors of a course
signals      work that nothing stops
files        a file is written whole or not at all
text         a text in two languages, from a data file, in lines of a given width
exercise     what an exercise is, and what a slip is
compare      right or wrong, entry by entry
calls        calls of functions that may be wrong
faults       wrong functions, made out of right ones
verdict      the record of a judged function: its message, and the failing case
listing      a function as a tree that can be changed, and the values of its expressions
grammar      small edits of a listing, rule by rule
differences  how wrong numbers differ from right ones, and the first wrong line
search       a wrong answer as evidence, and one search for what explains it
diagnose     the explanations in order, and one that is reported
rules        what an exercise forbids
domains      what an argument may be
course       a course: its sections, its exercises, and what is special to its field
cases        the cases that an answer is tried on
judge        to do, done or wrong, with a message
checked      the record of an exercise; as text, and as HTML
workbook     a student's folder: the answers in it; `mine`
skeletons    the files that a student starts from
process      the process of a student's code, as it is seen from outside
worker       the program that it runs
isolation    a folder judged in it
notebook     `check`
helping      hints and solutions
progress     a table of the sections
submissions  what a class has handed in
grading      a whole class
sheets       its marks as a table, a CSV and a page
commands     the command line of a course
plugin       the plugin of pytest in a student's folder
===========  ======================================================================

An example without any course: a mean that is wrong by a slip nobody has listed.

>>> import numpy as np
>>> from misstep.diagnose import Field, diagnose
>>> from misstep.exercise import Output, Part
>>> def mean(x):
...     return np.sum(x) / len(x)
>>> cases = [(np.array([1.0, 2.5, 4.0]),), (np.array([3.0, 0.25]),)]
>>> part = Part(solution=mean, returns=(Output("mean"),), cases=lambda rng: cases, slips={})
>>> found = diagnose(part, np.median, [np.sum(x) for (x,) in cases], cases, Field(slips={}))
>>> found.how, found.cure[0].en
('reference', 'Your numbers are those of a right solution that has `np.sum(x)` in place of `np.sum(x) / len(x)`.')
"""
