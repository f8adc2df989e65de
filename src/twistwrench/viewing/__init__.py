"""See a robot: as a stick figure, in the browser, or as a page that stands alone.

- `subject`: what is seen: model, configuration, contacts, forces.
- `figure`: the stick figure, by matplotlib.
- `shapes`: the meshes of a URDF.
- `stage`: what stands in the browser's scene, and where, by viser.
- `browser`: the page, with sliders, and its export.
- `showing`: `view`, which chooses.
- `commands`: ``twistwrench view``.
"""

from .viewer import view

__all__ = ["view"]
