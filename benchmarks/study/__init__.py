"""The cost of a digit: speed against accuracy, measured, and where each formulation breaks."""
