"""Where digits are lost: one thing at its limit at a time, and pairs of them."""
