r"""The single numbers of docs/extremes.md, and its tables.

python benchmarks/extremes.py            # some minutes; results/extremes.json, the tables
python benchmarks/extremes.py --tables   # only make the tables anew from results/

The tables of the whole grid, of programs and of bounds are made from what these commands write:

python -m benchmarks.study extremes --full --angles 0 \
    --json benchmarks/results/extremes_grid.json  # a quarter of an hour
python -m benchmarks.study extremes --programs --json benchmarks/results/extremes_programs.json  # ten minutes
python -m benchmarks.study extremes --bounds --json benchmarks/results/bounds.json  # half an hour
"""

from __future__ import annotations

import argparse
import importlib
import json
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
from study.extremes.cells import measure
from study.extremes.robots import Recipe
from study.extremes.truth import truth
from study.record import Record
from study.turns import turns
from tables import table, write

import twistwrench as tw
from twistwrench import bridge
from twistwrench import newton_euler_3d as ne

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "extremes.json"
GRID, PROGRAMS = (RESULTS.with_name(f"extremes_{name}.json") for name in ("grid", "programs"))
BOUNDS = RESULTS.with_name("bounds.json")
PAGES = tuple(HERE.parent / "docs" / f"extremes{language}.md" for language in ("", ".zh-CN"))
CELLS = {
    "heavy tip, 20 bodies": Recipe(bodies=20, mass_ratio=1e9),
    "heavy tip": Recipe(mass_ratio=1e9),
    "heavy tip, heavy rotors": Recipe(mass_ratio=1e9, rotor=1e9),
    "base at 1e6 m": Recipe(distance=1e6),
    "base at 1e9 m": Recipe(distance=1e9),
    "base at 1e4 m/s": Recipe(base_speed=1e4),
    "base at 1e8 m/s": Recipe(base_speed=1e8),
    "down to 1e-18 kg": Recipe(bodies=20, mass_ratio=1e-18),
    "quaternion off by 1e-9": Recipe(off=1e-9),
    "quaternion off by 0.1": Recipe(off=0.1),
}
TORQUES = ("pushed", "steered")
PLAIN = {  # a line of the source -> what it would be without the care that it takes
    ("aba", "symmetric"): lambda M: M,
    ("rnea", "bias_wrench"): lambda I, V: tw.cross_force(V[..., 0]) @ (I @ V),
    ("aba", "bias_wrench"): lambda I, V: tw.cross_force(V[..., 0]) @ (I @ V),
}


def without_care(recipe: Recipe, algorithm: str, line: str) -> float:
    """Return the error of an algorithm of ours, one of whose lines is written as in a book."""
    module = importlib.import_module(f"twistwrench.algorithms.{algorithm}")
    careful, (model, s) = getattr(module, line), (recipe.model, recipe.state)
    right = truth(model, s)
    setattr(module, line, PLAIN[algorithm, line])
    try:
        if algorithm == "rnea":
            return float(right.error("tau", tw.rnea(model, *s)))
        name = "pushed" if line == "symmetric" else "steered"
        return float(right.error(name, tw.aba(model, s.q, s.v, right.torques[name])))
    finally:
        setattr(module, line, careful)


def of_a_fast_base(recipe: Recipe) -> dict[str, dict[str, float]]:
    """Return the errors of C v and of the moment of ḣ_G, relative to the largest entry."""
    model, s = recipe.model, recipe.state
    pin, there = bridge.import_pinocchio(), bridge.to_pinocchio_model(model)
    data, (v, a) = there.createData(), (bridge.to_pinocchio_tangent(model, x) for x in (s.v, s.a))
    exact = [ne.as_mpmath(x) for x in s]
    right = ne.inverse_dynamics(model, exact[0], exact[1], 0 * exact[2])
    right = right - ne.inverse_dynamics(model, exact[0], 0 * exact[1], 0 * exact[2])
    C = bridge.from_pinocchio_matrix(model, pin.computeCoriolisMatrix(there, data, s.q, v))
    rate = pin.computeCentroidalMomentumTimeVariation(there, data, s.q, v, a)
    moment = ne.centroidal_momentum_rate(model, *exact)[:3]

    def off(got: Any, expected: Any) -> float:
        return float(abs(got - expected).max() / abs(expected).max())

    return {
        "C v": {"textbook": off(tw.coriolis_matrix(model, s.q, s.v) @ s.v, right), "pinocchio": off(C @ s.v, right)},
        "moment of ḣ_G": {
            "textbook": off(tw.centroidal_momentum_rate(model, *s)[:3], moment),
            "pinocchio": off(np.asarray(rate.angular), moment),
        },
    }


def cost(model: tw.Model, q: np.ndarray, rounds: int) -> float:
    """Return the processor time of `accuracy` over that of `aba`, called in turns: the median."""
    rest, ratios = np.zeros(model.nv), []
    for _ in range(rounds + 1):
        start = time.process_time()
        tw.accuracy(model, q)
        between = time.process_time()
        tw.aba(model, q, rest, rest)
        ratios.append((between - start) / (time.process_time() - between))
    return float(np.median(ratios[1:]))  # the first round makes what is made once


def measured() -> dict[str, Any]:
    """Measure everything."""
    found: dict[str, Any] = {"cells": {}}
    for name, recipe in CELLS.items():
        errors: dict[str, dict[str, float]] = {}
        for record in measure(recipe, with_pinocchio=True):
            if record.error is not None:
                errors.setdefault(record.quantity, {})[record.way] = record.error
        found["cells"][name] = errors
    found["plain"] = {
        "aba, not symmetric": without_care(CELLS["heavy tip, 20 bodies"], "aba", "symmetric"),
        "rnea, v × m v": without_care(CELLS["base at 1e8 m/s"], "rnea", "bias_wrench"),
        "aba, v × m v": without_care(CELLS["base at 1e8 m/s"], "aba", "bias_wrench"),
    }
    for name in ("base at 1e4 m/s", "base at 1e8 m/s"):
        found["cells"][name] |= of_a_fast_base(CELLS[name])
    long = replace(Recipe(), bodies=300)
    single = tw.rnea(long.model, *(x.astype(np.float32) for x in long.state))
    tau = tw.rnea(long.model, *long.state)
    found["float32, 300 links"] = float(np.abs(single - tau).max() / np.abs(tau).max())
    go2, chain = tw.load("go2"), tw.chain(1000)
    found["accuracy / aba"] = {
        "go2": cost(go2, go2.standing(), 40),
        "chain of 1000": cost(chain, np.full(1000, 0.3), 3),
    }
    found["exp and log"] = [record.as_dict() for record in turns()]
    return found


def tables() -> dict[str, str]:
    """Return all tables."""
    found, grid, programs = (json.loads(path.read_text(encoding="utf-8")) for path in (RESULTS, GRID, PROGRAMS))
    return {
        "grid": table(_grid(grid["ways"])),
        "programs": table(_programs(programs["counts"])),
        "base": table(_base(found["cells"])),
        "turns": table(_turns(found["exp and log"])),
    }


def quoted() -> list[str]:
    """Return the numbers that the page has in its sentences, as it writes them."""
    found = json.loads(RESULTS.read_text(encoding="utf-8"))
    cells, plain = found["cells"], found["plain"]
    heavy, tip, far = cells["heavy tip, 20 bodies"], cells["down to 1e-18 kg"]["crba"], "base at 1e9 m"
    numbers = [heavy[f"{way}, {torques}"]["textbook"] for way in ("aba", "crba + solve") for torques in TORQUES]
    numbers += [heavy["aba, pushed"]["pinocchio"], *plain.values(), found["float32, 300 links"], tip["textbook"]]
    numbers += [cells[name]["centroidal map"]["pinocchio"] for name in ("base at 1e6 m", far)]
    numbers += [cells[far]["centroidal map"]["textbook"], cells["quaternion off by 1e-9"]["rnea"]["pinocchio"]]
    numbers += [cells[name]["aba, steered"]["textbook"] for name in ("heavy tip", "heavy tip, heavy rotors")]
    said = [f"{number:.1e}".replace("e-0", "e-") for number in numbers]
    said += [f"{cells['down to 1e-18 kg']['crba']['pinocchio']:.1f}"]
    said += [f"{100 * cells['quaternion off by 0.1']['rnea']['pinocchio']:.0f} %"]
    return [*said, *_of_the_grid(), *_of_bounds()]


def _of_the_grid() -> Iterator[str]:
    """Yield the numbers of the whole grid that are in sentences."""
    grid = json.loads(GRID.read_text(encoding="utf-8"))
    yield f"{grid['cells']}"
    for who in ("textbook", "fast"):
        above = {way["quantity"]: way["above"] for way in grid["ways"] if way["way"] == who}
        dynamics = sum(count for name, count in above.items() if name.startswith(("aba", "crba +")))
        yield f"{sum(above.values())}"
        yield f"{sum(above.values()) - dynamics}"
    ratios = [one["median"] for one in grid["estimates"]]
    yield f"{min(ratios):.0f}"
    yield f"{max(ratios):.0f}"
    assert all(one["held"] == one["cells"] for one in grid["estimates"]), "an error is above its estimate"


def _of_bounds() -> Iterator[str]:
    """Yield the numbers of the bounds that are in sentences."""
    found = json.loads(BOUNDS.read_text(encoding="utf-8"))
    assert all(one["held"] == one["entries"] for one in found["bounds"]), "an error is above its bound"
    yield f"{found['cells']}"
    yield f"{sum(one['entries'] for one in found['bounds']):,}".replace(",", " ")
    yield f"{sum(one['infinite'] for one in found['bounds'])}"


COUNTED = {
    "answers asked for": "cells",
    "raised an error": "raised",
    "a NaN, an infinity, a warning, a number where none is right": "faults",
    "error above 2 × Pinocchio's + 4 ε": "above",
    "Pinocchio's above 2 × this + 4 ε": "below",
    "less than a tenth of Pinocchio's": "tenth",
}


def _grid(ways: list[dict[str, Any]]) -> Iterator[tuple[str, str, str]]:
    for line, name in COUNTED.items():
        for column, who in (("textbook", "textbook"), ("`tw.fast`", "fast")):
            yield line, column, str(sum(way[name] for way in ways if way["way"] == who))


def _programs(counts: list[dict[str, Any]]) -> Iterator[tuple[str, str, str]]:
    for count in counts:
        line = f"`{count['quantity']}`" if count["quantity"] in ("rnea", "crba") else count["quantity"]
        yield line, "states", f"{count['states']}"
        for column, name in (("above 2 ×", "above"), ("below ½ ×", "below")):
            yield line, column, f"{100 * count[name]:.1f} %"
        yield line, "median", f"{count['median']:.2f}"
        yield line, "99 %", f"{count['high']:.1f}"
        yield line, "cells, median", f"{count['cell_median']:.2f}"
        yield line, "cells, largest", f"{count['cell_worst']:.2f}"


def _base(cells: dict[str, Any]) -> Iterator[tuple[str, str, str]]:
    rows = {"`rnea`": "rnea", "`aba`": "aba, steered", "M, h → q̈": "crba + solve, steered"}
    for line, algorithm in (rows | {name: name for name in ("C v", "moment of ḣ_G")}).items():
        for speed in ("1e4", "1e8"):
            for who in ("textbook", "fast", "pinocchio"):
                error = cells[f"base at {speed} m/s"][algorithm].get(who)
                yield line, f"{who}, {speed} m/s", "" if error is None else f"{error:.1e}"


def _turns(found: list[dict[str, Any]]) -> Iterator[tuple[str, str, str]]:
    for record in map(Record.from_dict, found):
        yield f"`{record.quantity}`", f"{record.way}, {record.where.removeprefix('near ')}", f"{record.error:.1e}"


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description="Make the numbers and the tables of docs/extremes.md.")
    parser.add_argument("--tables", action="store_true", help="only the tables, from results/")
    if not parser.parse_args().tables:
        with mpmath.workdps(50):
            text = json.dumps(measured(), indent=1, ensure_ascii=False, allow_nan=False)
        RESULTS.write_text(text + "\n", encoding="utf-8")
    write(PAGES, tables())


if __name__ == "__main__":
    main()
