"""What the notebooks use of IPython, in the page."""
