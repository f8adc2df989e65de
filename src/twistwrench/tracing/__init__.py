"""Traces of the recursions: what each body received and passed inward, step by step (49.6 to 49.8, 49.10).

- `listing`: which line of an algorithm gives which term its value, read from the source.
- `ledger`: a body's account: its own, what its children passed on, the sum, what goes to its parent.
- `algorithms`: `trace`, which reads the accounts of `rnea`, `aba`, `crba` and the CCRBA off their records.
- `printing`: the accounts as text, as a tree and as HTML.
- `stepper`: the steps as a page to go through: line, formula, body, picture and numbers (`stepper.html`).
"""

from .algorithms import trace
from .ledger import Trace

__all__ = ["Trace", "trace"]
