"""How long does XLA compile a program, as rows and as numbers with a name each? CPU seconds, in one process.

python benchmarks/elsewhere.py               # as rows, half a minute
python benchmarks/elsewhere.py --scalars     # and by name: minutes
python benchmarks/elsewhere.py --robot talos
"""

import argparse
import time
from collections.abc import Callable
from typing import Any

import jax
import numpy as np

import twistwrench as tw
from straightline import python_source
from twistwrench.fast.program import Program

QUANTITIES = ("crba", "rnea", "aba", "dqdd_dq")
MAX_SCALARS = 5000  # operations: of more, XLA takes longer than anybody waits
CALLS = 100


def function(program: Program, text: str) -> Callable[..., Any]:
    """Return what a text defines, with an array as its result."""
    names: dict[str, Any] = {}
    exec(text, names)
    defined = names[program.quantities[0].symbol]
    return lambda *x: jax.numpy.asarray(defined(*x))


def measure(compute: Callable[..., Any], state: list[Any]) -> tuple[float, float, np.ndarray]:
    """Return the CPU seconds until a function is compiled, those of a call, and what it returns."""
    start = time.process_time()
    compiled = jax.jit(compute).lower(*state).compile()
    seconds = time.process_time() - start
    found = np.asarray(compiled(*state))
    start = time.process_time()
    for _ in range(CALLS):
        compiled(*state).block_until_ready()
    return seconds, (time.process_time() - start) / CALLS, found


def main() -> None:
    """Print a line for each quantity and text."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", default="go2")
    parser.add_argument("--scalars", action="store_true")
    asked = parser.parse_args()
    jax.config.update("jax_enable_x64", True)
    model, rng = tw.load(asked.robot), np.random.default_rng(0)
    state = {"q": model.random_configuration(rng=rng)}
    state |= {name: rng.standard_normal(model.nv) for name in ("v", "a", "tau")}
    for want in QUANTITIES:
        program = tw.compile(model, want)
        total = program.operations.total()
        args = [jax.numpy.asarray(state[name]) for name in program.arguments if name in state]
        expected = program(*map(np.asarray, args))
        texts = {"rows": program.source("jax.numpy")}
        if asked.scalars and total <= MAX_SCALARS:
            texts["scalars"] = python_source(program.line, program.quantities[0].symbol, "jax.numpy")
        for kind, text in texts.items():
            seconds, call, found = measure(function(program, text), args)
            error = np.abs(found - expected).max() / np.abs(expected).max()
            print(f"{want:8} {total:6} operations  {kind:8}", end="")
            print(f" {seconds:6.2f} s to compile  {1e6 * call:5.0f} us  {error:.0e}")


if __name__ == "__main__":
    main()
