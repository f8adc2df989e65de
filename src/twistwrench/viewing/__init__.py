"""See a robot: as a stick figure, in the browser, or as a page that stands alone.

- `state`: what is shown: model, configuration, contacts, forces.
- `figure`: the stick figure, by matplotlib.
- `shapes`: the meshes of a URDF.
- `scene`: the parts of the browser's scene, by viser.
- `browser`: the page, with sliders, and its export.
- `viewer`: `view`, which chooses.
- `commands`: ``twistwrench view``.
"""

from .viewer import view

__all__ = ["view"]
