"""``python -m benchmarks.study``: one command a study."""

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import twistwrench as tw
from twistwrench import bridge, cli
from twistwrench.files import write_text
from twistwrench.motions import MOTIONS
from twistwrench.options import at_least, check_writable

from . import budget, speed, templates, trade

ROUNDS = {"speed": 9, "templates": 7}
STATES = 100  # of each cell, in which programs are compared with the textbook
MAX_BODIES = 30  # robots with more are left out of --programs and --bounds: these take a minute to compile for them


def run_speed(args: argparse.Namespace) -> int:
    """Time the textbook and tw.fast against Pinocchio, called state by state: ten seconds."""
    from tqdm import tqdm

    model, rounds = tw.load(args.robot, base=args.base), ROUNDS["speed"]
    with tqdm(total=rounds * len(speed.QUANTITIES), unit=" rounds", disable=not _has_bar(args), leave=False) as bar:
        print(speed.shown(model, speed.speed(model, rounds=rounds, after_round=bar.update)))
    return 0


def run_trade(args: argparse.Namespace) -> int:
    """Time every way of computing every quantity, in every number type, and hold it against the truth in 60 digits."""
    effort = trade.SHORT if args.short else trade.FULL
    model = tw.load(args.robot, base=args.base, physical=False, mimic="independent")
    found = trade.weigh(model, only=args.only, effort=effort, seed=args.seed, progress=_has_bar(args))
    print(found)
    if args.json is not None:
        write_text(args.json, found.to_json())
    if args.plot is not None:
        from .pictures import draw_trade, save

        save(draw_trade(found), args.plot)
    return 0


def run_templates(args: argparse.Namespace) -> int:
    """Compare every template with the full model over a walk, a trot and a jump of each robot; draw the first robot."""
    from tqdm import tqdm

    for robot in args.robots:
        try:
            model = tw.load(robot)
        except tw.NameNotFound:
            if robot not in templates.ROBOTS:
                raise
            print(f"{robot}: not installed, left out (example-robot-data)\n")
            continue
        motions = [make(model, samples=args.samples) for make in MOTIONS.values()]
        rounds = ROUNDS["templates"]
        with tqdm(total=rounds * len(motions), desc=robot, disable=not _has_bar(args), leave=False) as bar:
            how = {"rounds": rounds, "after_round": bar.update}
            found = [r for motion in motions for r in templates.losses(model, motion, **how)]
        print(templates.shown(robot, model, motions, found))
        if args.plot is not None:
            from .pictures import draw_templates, save

            save(draw_templates(model, motions), args.plot)
            args.plot = None
    return 0


def run_budget(args: argparse.Namespace) -> int:
    """Put each source of error alone into one motion, and show what it costs at the worst motor and on the ground."""
    model = tw.load(args.robot)
    motion = budget.sampled_motion(model, args.motion)
    found = list(budget.budget(model, motion))
    print(f"{args.robot}, {motion!r}: the error of each source alone, where it is worst")
    print(budget.shown(found))
    _write(args.json, {"robot": args.robot, "motion": args.motion, "records": [r.as_dict() for r in found]})
    if args.plot is not None:
        from .pictures import draw_budget, save

        save(draw_budget(found, f"{args.robot}, {args.motion}: what each source of error costs at worst"), args.plot)
    return 0


def run_extremes(args: argparse.Namespace) -> int:
    """Compare every algorithm with 50 digits where robots and states are extreme; 1 where one of ours is at fault."""
    from tqdm import tqdm

    from .extremes import cells, grid, report
    from .turns import turns

    recipes = grid.cells(full=args.full)
    if args.bounds or args.programs:
        return _run_programs(args, [recipe for recipe in recipes if recipe.bodies <= MAX_BODIES])
    bar, with_pinocchio = tqdm(recipes, "extremes", unit="cell", disable=not _has_bar(args)), _has_pinocchio()
    found = [cells.Cell(recipe, cells.measure(recipe, with_pinocchio=with_pinocchio)) for recipe in bar]
    turned = turns(args.angles, progress=_has_bar(args)) if args.angles else []
    counted = {"cells": len(found), "ways": report.rows(found), "estimates": report.estimates(found)}
    print(report.ways_table(counted["ways"]), report.estimates_table(counted["estimates"]), sep="\n\n")
    print(f"\n{report.turns_table(turned)}" if turned else "")
    _write(args.json, counted | {"exp and log": [r.as_dict() for r in turned]})
    if args.pictures is not None:
        from .pictures import MAPS, draw_map, save

        args.pictures.mkdir(parents=True, exist_ok=True)
        for algorithm, name in MAPS.items():
            save(draw_map(found, algorithm), path := args.pictures / f"extremes_{name}.png")
            print(path)
    faults = report.faults(found)
    for cell, r in faults:
        print(f"{cell.recipe}: {r.quantity} by {r.way}: {r.fault}", file=sys.stderr)
    return int(bool(faults))


def _run_programs(args: argparse.Namespace, recipes: Sequence[Any]) -> int:
    """Compare the errors of programs with the textbook's, or with their bounds."""
    from tqdm import tqdm

    from .extremes import bounds, programs

    bar = tqdm(recipes, "bounds" if args.bounds else "programs", unit="cell", disable=not _has_bar(args))
    if args.bounds:
        found = bounds.counts(one for recipe in bar for one in bounds.measured(recipe))
        print(bounds.shown(found))
        _write(args.json, {"cells": len(recipes), "bounds": found})
        return int(any(bound["broken"] for bound in found))
    every = [one for recipe in bar for one in programs.compared(recipe, STATES)]
    counts = programs.counts(every)
    print(programs.shown(counts))
    _write(args.json, {"states": STATES, "counts": counts, "cells": programs.medians(every)})
    return 0


def _has_pinocchio() -> bool:
    """Whether Pinocchio is installed; the study is worth running without."""
    try:
        bridge.import_pinocchio()
    except ImportError as error:
        print(f"{error}: it has no column", file=sys.stderr)
        return False
    return True


def _has_bar(args: argparse.Namespace) -> bool:
    return args.progress or sys.stderr.isatty()


def _write(path: Path | None, found: dict[str, Any]) -> None:
    if path is not None:
        write_text(path, json.dumps(found, indent=1, ensure_ascii=False, allow_nan=False) + "\n")


def _angles(text: str) -> int:
    """Read how many angles: none, or one near 0 and one near π at least."""
    if not text.isdecimal() or text == "1":
        raise argparse.ArgumentTypeError(f"expected 0, or a whole number from 2, got {text!r}")
    return int(text)


# ---------------------------------------------------------------- the options

FLAG: dict[str, Any] = {"action": "store_true"}
FILE: dict[str, Any] = {"type": Path, "metavar": "FILE"}
N: dict[str, Any] = {"metavar": "N", "type": at_least(0)}
OPTIONS: dict[str, dict[str, Any]] = {
    "robot": {"nargs": "?", "default": "go2", "metavar": "ROBOT", "help": "a name or a URDF (go2)"},
    "--base": {"choices": ["fixed", "floating"], "help": "the base, if not the robot's own"},
    "--json": FILE | {"help": "write the numbers"},
    "--plot": FILE | {"help": "draw: a png, svg or pdf"},
    "--progress": FLAG | {"help": "a progress bar on stderr, also where that is not a terminal"},
    "--only": {"action": "append", "default": [], "metavar": "KEY", "help": f"of {', '.join(trade.KEYS)}"},
    "--seed": N | {"default": 0, "help": "of the random states (0)"},
    "--short": FLAG | {"help": "few states and rounds: to see that all is there"},
    "robots": {"nargs": "*", "default": list(templates.ROBOTS), "metavar": "ROBOT"},
    "--samples": N | {"type": at_least(2), "default": 200, "help": "states of each motion (200)"},
    "--motion": {"choices": MOTIONS, "default": "trot"},
    "--full": FLAG | {"help": "all ends of all pairs, and robots of 300 bodies"},
    "--pictures": FILE | {"metavar": "FOLDER", "help": "draw the map of every algorithm into a folder"},
    "--angles": N | {"type": _angles, "default": 10_000, "help": "of exp and log, or 0 (10000)"},
    "--bounds": FLAG | {"help": "instead: whether the bounds of programs hold; half an hour"},
    "--programs": FLAG | {"help": "instead: whether programs round worse, in 100 states a cell; ten minutes"},
}
STUDIES = {
    "speed": (run_speed, "robot --base"),
    "trade": (run_trade, "robot --base --only --seed --short --json --plot"),
    "templates": (run_templates, "robots --samples --plot"),
    "extremes": (run_extremes, "--full --pictures --angles --bounds --programs --json"),
    "budget": (run_budget, "robot --motion --json --plot"),
}


def _add(parsers: Any) -> None:
    """Add the parsers of all studies."""
    for name, (run, options) in STUDIES.items():
        parser = parsers.add_parser(name, help=run.__doc__, description=run.__doc__)
        parser.set_defaults(run=_checked, study=run)
        for option in (*options.split(), "--progress"):
            parser.add_argument(option, **OPTIONS[option])


def _checked(args: argparse.Namespace) -> int:
    """Run a study, where its files can be written and drawn."""
    if getattr(args, "plot", None) is not None:
        from .pictures import check_format

        check_format(args.plot)
    for option in ("json", "plot"):
        check_writable(f"--{option}", getattr(args, option, None))
    return int(args.study(args))


def main(argv: Sequence[str] | None = None) -> int:
    """Run one study, with the command line's exit statuses."""
    return cli.main(argv, program="python -m benchmarks.study", commands=[_add])


if __name__ == "__main__":
    sys.exit(main())
