"""The command line of the views: ``twistwrench view ROBOT``."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

from ..files import replacing
from ..options import check_writable

__all__ = ["register"]

PICTURE_SUFFIXES = (".png", ".svg", ".pdf")
DOTS_PER_INCH = 110


def register(commands: Any) -> None:
    """Add ``twistwrench view``."""
    parser = commands.add_parser(
        "view",
        help="show a robot, or write a picture of it",
        description="Show a robot with its frames, centre of mass, support polygon and the forces that hold it at "
        "rest: in a window, in the browser, or in a file.",
    )
    parser.add_argument("robot", metavar="ROBOT", help="a name of `twistwrench robots` or a URDF")
    parser.add_argument("--base", choices=["fixed", "floating"], help="the base, if not the robot's own")
    parser.add_argument(
        "--posture", metavar="NAME", help="a named posture (standing, or neutral where it does not exist)"
    )
    parser.add_argument("--frame", action="append", metavar="NAME", help="draw this frame, with its name; repeatable")
    parser.add_argument("--contact", action="append", metavar="NAME", help="a frame on the ground; repeatable (feet)")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--output", metavar="FILE", type=Path, help=".png, .svg or .pdf; .html is a page to turn about")
    where.add_argument("--browser", action="store_true", help="serve a page with sliders until Ctrl-C")
    parser.set_defaults(run=run_view, misuse=parser.error)


def run_view(args: argparse.Namespace) -> int:
    """Show it, or write it."""
    suffix = args.output.suffix.lower() if args.output else ""
    if args.output and suffix not in (*PICTURE_SUFFIXES, ".html"):
        args.misuse(f"argument --output: expected a name in {', '.join(PICTURE_SUFFIXES)} or .html, got {args.output}")
    if args.output:
        check_writable("--output", args.output)
        _write(args, suffix)
    elif args.browser:
        _serve(args)
    else:
        _window(args)
    return 0


def _view(args: argparse.Namespace, **how: Any) -> Any:
    """Call `view` with the options of the command line."""
    from ..errors import unknown_name
    from ..loading import load
    from .viewer import view

    model = load(args.robot, base=args.base, physical=False)
    q = None
    if args.posture is not None:
        if args.posture not in model.postures:
            raise unknown_name("posture", args.posture, model.postures, f" of {args.robot!r}")
        q = model.postures[args.posture]
    if how.get("backend") == "browser":
        how["meshes"] = args.robot
    contacts = None if args.contact is None else list(dict.fromkeys(args.contact))
    return view(model, q, contacts=contacts, frames=args.frame, **how)


def _write(args: argparse.Namespace, suffix: str) -> None:
    if suffix == ".html":
        browser = _view(args, backend="browser")
        browser.save(args.output)
        browser.stop()
        return
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 6.0), layout="constrained")  # no window, hence no pyplot
    _view(args, ax=figure.add_subplot(projection="3d", elev=20, azim=-60))
    with replacing(args.output) as beside:
        figure.savefig(beside, dpi=DOTS_PER_INCH)


def _serve(args: argparse.Namespace) -> None:
    import webbrowser

    browser = _view(args, backend="browser")
    print(f"{browser.url}  (Ctrl-C ends it)", flush=True)
    webbrowser.open(browser.url)
    try:
        while True:
            time.sleep(1)
    finally:
        browser.stop()


def _window(args: argparse.Namespace) -> None:
    import matplotlib.pyplot as plt

    if plt.get_backend().lower() == "agg":
        raise OSError("there is no display here to open a window on; --output FILE writes a picture")
    _view(args)
    plt.show()
