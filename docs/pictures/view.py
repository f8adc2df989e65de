"""The pictures of docs/view.md: the figure, and the page in a real browser.

usage:  python docs/pictures/view.py            (a minute; needs viser, example-robot-data, Pillow and Chromium)
        python docs/pictures/view.py --sizes    (of the files that viser and Plotly write; needs Plotly)
"""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from matplotlib.figure import Figure
from PIL import Image

import twistwrench as tw
from twistwrench import motions
from twistwrench.cli import main
from twistwrench.viewing.browser import Browser
from twistwrench.viewing.shapes import shapes

HERE = Path(__file__).parent
WIDTH, HEIGHT = 800, 560
CHROMIUM = (
    "chromium --headless --no-sandbox --no-first-run --disable-background-networking --use-gl=angle "
    f"--use-angle=swiftshader --enable-unsafe-swiftshader --virtual-time-budget=9000 --window-size={WIDTH},{HEIGHT}"
)
NO_NOTICE = "<style>[class*=Notification]{display:none}</style></head>"
"""Without a graphics card the page says that it draws slowly; that is no part of the picture."""


def figures() -> None:
    """Go2 as the command draws it; a humanoid on its soles."""
    main(["view", "go2", "--output", str(HERE / "view_go2.png")])
    soles = [tw.SurfaceContact(f"{side}_sole", (0.1, 0.05), mu=0.7) for side in ("left", "right")]
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    tw.view(tw.Scene("humanoid", contacts=soles), ax=figure.add_subplot(projection="3d", elev=20, azim=-60))
    figure.savefig(HERE / "view_soles.png", dpi=110)


def two_feet(motion: motions.Motion) -> motions.Motion:
    """Return the first part of a motion in which two feet stand, so that every moment of it does for a picture."""
    twos = motion.contacts.sum(axis=1) == 2
    start = int(twos.argmax())
    part = slice(start, start + int((~twos[start:]).argmax()))
    return replace(motion, **{name: getattr(motion, name)[part] for name in ("t", "q", "v", "a", "contacts")})


def page(browser: Browser, name: str) -> None:
    """Save a page, let a browser draw it, and keep what it shows in 256 colours."""
    html = browser.html().replace("</head>", NO_NOTICE, 1)
    browser.stop()
    with TemporaryDirectory() as folder:
        file, shot = Path(folder, "page.html"), Path(folder, "page.png")
        file.write_text(html, encoding="utf-8")
        where = [f"--user-data-dir={folder}", f"--screenshot={shot}", file.as_uri()]
        subprocess.run([*CHROMIUM.split(), *where], check=True, capture_output=True)
        with Image.open(shot) as image:
            image.convert("RGB").quantize(256, method=Image.Quantize.MAXCOVERAGE).save(HERE / name, optimize=True)


def sizes() -> None:
    """Write Go2 with its meshes as a page by viser and by Plotly, and print how large they are."""
    import plotly.graph_objects as go

    browser, figure = tw.view("go2", backend="browser"), go.Figure()
    model, q = tw.load("go2"), tw.load("go2").standing()
    T = tw.forward_kinematics(model, q).placement
    for shape in shapes(model, "go2"):
        (x, y, z), (i, j, k) = (T[shape.body] @ shape.placement).act(shape.mesh.vertices).T, shape.mesh.faces.T
        figure.add_mesh3d(x=x, y=y, z=z, i=i, j=j, k=k, vertexcolor=shape.mesh.visual.vertex_colors[:, :3])
    print(f"viser   {len(browser.html()) / 1e6:.1f} MB")
    print(f"Plotly  {len(figure.to_html(include_plotlyjs=True)) / 1e6:.1f} MB")
    browser.stop()


if __name__ == "__main__":
    if "--sizes" in sys.argv:
        sys.exit(sizes())
    figures()
    page(tw.view("go2", backend="browser"), "view_page.png")
    page(tw.view("go2", two_feet(motions.trot(tw.load("go2"))), backend="browser"), "view_trot.png")
