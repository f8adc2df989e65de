"""Run the notebooks and keep what they show, so that whoever only looks at a notebook sees its numbers and pictures.

usage:  python notebooks/execute.py [NAME...]    all, or those whose names begin so, as 49_06; in both languages

Each is run twice, in an empty folder. What the second run does not repeat, such as a time or an address, is not kept: a
line in its place says so. Pictures are PNG with 64 colours; the Chinese ones are SVG, whose words the reader's browser
draws. Needs `pip install -e ".[notebooks,validate]"`: without Pinocchio the comparisons would be kept as skipped.
"""

import argparse
import base64
import io
import os
import re
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import nbformat
from nbformat import NotebookNode

HERE = Path(__file__).resolve().parent
SLOWEST = 120  # s, a cell, on a machine that does other things too
COLOURS = 64
VARIES = {
    "en": "(A time, for example: it differs in each run, and is not kept here.)\n",
    "zh": "（例如用时：每次运行都不同，这里不保留。）\n",
}
"""In place of an output that a second run does not repeat."""
SAME = {"SOURCE_DATE_EPOCH": "0", "PYTHONHASHSEED": "0"}
"""The date in an SVG, and the order of sets."""
PATH = re.compile(r'(?<= )d="[^"]*"')


def run(path: Path) -> NotebookNode:
    """Return a notebook with its outputs, run in an empty folder; raises ValueError where it wrote to stderr."""
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        settings = Path(folder, "matplotlibrc")
        settings.write_text("svg.hashsalt: twistwrench\n", encoding="utf-8")  # the same names in each run
        options = {"timeout": SLOWEST, "record_timing": False, "coalesce_streams": True}
        options |= {"resources": {"metadata": {"path": folder}}, "extra_arguments": ["--log-level=40"]}
        environment = os.environ | SAME | {"MATPLOTLIBRC": str(settings)}
        try:
            NotebookClient(notebook, **options).execute(env=environment)
        except RuntimeError as error:  # kernels that start at the same time may choose the same port
            if "before replying to kernel_info" not in str(error):
                raise
            NotebookClient(notebook, **options).execute(env=environment)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    if complaints := [output.text for output in outputs if output.get("name") == "stderr"]:
        raise ValueError(f"{path.parent.name}/{path.name} wrote to stderr: {complaints[0]}")
    return notebook


def keep(notebook: NotebookNode, runs: tuple[NotebookNode, NotebookNode], language: str) -> NotebookNode:
    """Give a notebook those outputs that two runs have in common, without the numbers of the runs."""
    for cell, *others in zip(notebook.cells, *(done.cells for done in runs), strict=True):
        if cell.cell_type == "code":
            first, again = (list(map(small, other.outputs)) for other in others)
            varies = nbformat.v4.new_output("stream", name="stdout", text=VARIES[language])
            cell.outputs = first if first == again else [varies]
    return notebook


def small(output: NotebookNode) -> NotebookNode:
    """Return an output without the number of its run, a picture with few colours."""
    output = nbformat.from_dict(output)
    if "execution_count" in output:
        output.execution_count = None
    data = output.get("data", {})
    if "image/png" in data:
        data["image/png"] = few_colours(data["image/png"])
    if "image/svg+xml" in data:
        data["image/svg+xml"] = PATH.sub(short, data["image/svg+xml"])
    if {"image/png", "image/svg+xml"} & {*data}:
        data.pop("text/plain", None)  # the size of the figure
    return output


def short(path: re.Match[str]) -> str:
    """Return a path of an SVG on one line, its coordinates to a tenth of a point."""
    return re.sub(r"(\.\d)\d+", r"\1", " ".join(path[0].split()))


def few_colours(png: str) -> str:
    """Return a PNG in base64 with few colours, a quarter as long."""
    from PIL import Image

    content = io.BytesIO()
    with Image.open(io.BytesIO(base64.b64decode(png))) as picture:
        chosen = picture.convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        chosen.save(content, "PNG", optimize=True)
    return base64.b64encode(content.getvalue()).decode()


def write(path: Path) -> str:
    """Run a notebook twice and write what it shows into its file; return its name and its size."""
    notebook = keep(nbformat.read(path, as_version=4), (run(path), run(path)), path.parent.name)
    text = nbformat.writes(notebook) + "\n"
    path.write_text(text, encoding="utf-8", newline="\n")
    return f"{path.parent.name}/{path.name}: {len(text.encode()) / 1000:.0f} kB"


def main() -> None:
    """Run the notebooks and keep what they show."""
    parser = argparse.ArgumentParser(description="Run the notebooks and keep what they show.")
    parser.add_argument("names", nargs="*", default=[""], help="with which names begin, as 49_06; all unless given")
    names = tuple(parser.parse_args().names)
    paths = [path for path in sorted(HERE.glob("[ez][nh]/*.ipynb")) if path.stem.startswith(names)]
    if not paths:
        parser.error(f"no notebook begins with {' or '.join(names)}")
    with ProcessPoolExecutor(min(2, os.cpu_count() or 1)) as pool:
        for line in pool.map(write, paths):
            print(line, flush=True)


if __name__ == "__main__":
    main()
