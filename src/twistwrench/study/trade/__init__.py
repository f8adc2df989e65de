"""Speed against accuracy: what every way of computing a quantity costs, and how many digits it keeps.

>>> trade = weigh("pendulum", effort=SHORT)
>>> sorted(trade.names)
['A_G', 'FD', 'ID', 'M', 'dID/dq', 'dJv', 'dh_G', 'exp', 'log']
>>> one, many = trade.fronts("FD")
>>> all(p.seconds < q.seconds and p.error > q.error for p, q in zip(one, one[1:]))
True
"""

from .measure import Effort, LeftOut, Point
from .report import Trade
from .run import FULL, SHORT, weigh

__all__ = ["FULL", "SHORT", "Effort", "LeftOut", "Point", "Trade", "weigh"]
