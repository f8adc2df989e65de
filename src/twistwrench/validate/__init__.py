"""Every quantity of the chapter, held against Pinocchio and against the truth in 50 digits (49.11).

>>> report = validate("double_pendulum", states=2, truths=1)
>>> report.passed, len(report.rows)
(True, 29)
"""

from .measure import Comparison, Judge
from .report import Report
from .run import validate

__all__ = ["Comparison", "Judge", "Report", "validate"]
