"""The tests are a package so that they can share `tests.strategies` under pytest's importlib mode."""
