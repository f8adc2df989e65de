"""What a digit costs: speed against accuracy, measured, and where each formulation breaks."""
