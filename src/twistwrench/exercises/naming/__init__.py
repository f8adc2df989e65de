"""What is said of a wrong answer.

Each file imports only from those above it in this table.

============  ===========================================================================
file          what it holds
============  ===========================================================================
changing      the line that changes an argument
aliases       arrays with two names
independence  what a result does not depend on, and should
known         quantities with a name, to be compared with
neighbours    a result that is another quantity with a name
own           whether the student's code bears out a slip with the same numbers
matching      the slips of the list that give the student's numbers
properties    what right answers have, and this one has not
sizes         by how much numbers are wrong
relations     how a wrong array differs: sign, transpose, factor, zero, places
finer         what is an approximation: it is better with finer steps
simplest      the simplest arguments that give a wrong answer, and what all of them share
small         what is right for small numbers only
state         what stays from one call to the next
steps         the first quantity of a recursion that is wrong, and at which body
wrong_answer  a wrong answer, and what is found about it, each thing once
messages      the sentences about it
diagnose      the explanations that are tried, one after the other
============  ===========================================================================
"""
