"""Speed against accuracy: the time of every way of computing a quantity, and how many digits it keeps.

>>> KEYS
('ID', 'FD', 'M', 'A_G', 'dh_G', 'dJv', 'dID/dq', 'exp', 'log')
>>> trade = weigh("pendulum", only=["FD"], effort=SHORT)
>>> one, many = trade.fronts("FD")
>>> all(p.seconds < q.seconds and p.error > q.error for p, q in zip(one, one[1:]))
True
"""

from .measure import Effort, LeftOut, Point
from .report import Trade
from .run import FULL, KEYS, SHORT, weigh

__all__ = ["FULL", "KEYS", "SHORT", "Effort", "LeftOut", "Point", "Trade", "weigh"]
