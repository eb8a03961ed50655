"""facemorph: view, morph and export 3D facial expressions.

rig = facemorph.load("ada")
positions = rig.positions(facemorph.Pose.between("neutral", "happy", t=0.5))
pixels = facemorph.render(rig, {"happy": 1.0}, size=(800, 800))

Names are imported when they are first used, so `import facemorph` costs next to nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from facemorph.api import export, load, render, render_sheet, save_picture
    from facemorph.core.camera import Camera
    from facemorph.core.mesh import Material, Mesh
    from facemorph.core.picture import Look
    from facemorph.core.pose import Pose
    from facemorph.core.rig import Rig, Shape
    from facemorph.errors import FacemorphError
    from facemorph.gl import Offscreen

__version__ = "0.1.0"

__all__ = [
    "Camera",
    "FacemorphError",
    "Look",
    "Material",
    "Mesh",
    "Offscreen",
    "Pose",
    "Rig",
    "Shape",
    "export",
    "load",
    "render",
    "render_sheet",
    "save_picture",
]

_HOMES = {
    "facemorph.api": ("export", "load", "render", "render_sheet", "save_picture"),
    "facemorph.core.camera": ("Camera",),
    "facemorph.core.mesh": ("Material", "Mesh"),
    "facemorph.core.picture": ("Look",),
    "facemorph.core.pose": ("Pose",),
    "facemorph.core.rig": ("Rig", "Shape"),
    "facemorph.errors": ("FacemorphError",),
    "facemorph.gl": ("Offscreen",),
}


def __getattr__(name: str) -> object:
    for home, names in _HOMES.items():
        if name in names:
            return getattr(importlib.import_module(home), name)
    raise AttributeError(f"module 'facemorph' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
