"""The questions of the notebooks, by section: the texts, and the functions that compute their answers.

A function has the name of its question. It returns a dict: ``truth``, which is a number or the name of a choice, the
numbers of usual wrong answers, and those that the texts show.
"""

Facts = dict[str, float | str]
"""What such a function returns."""
