"""Cold starts: from the command to the first picture, wall time and peak memory, each in a fresh process."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from benchmarks.harness import Table, have, median_run, python
from facemorph.resources import builtin_face

POLYSCOPE = """
import numpy as np, trimesh, polyscope
mesh = trimesh.load({obj!r}, process=False, force="mesh")
polyscope.set_allow_headless_backends(True)
polyscope.set_verbosity(0)
polyscope.init()
polyscope.register_surface_mesh("face", mesh.vertices, mesh.faces)
polyscope.screenshot({png!r})
"""
WINDOW = """
import facemorph.ui.run as program
import facemorph.ui.session as session

draw = session.Session.frame

def until_the_face_is_there(self, *arguments):
    draw(self, *arguments)
    self.app.quit = self.app.quit or self.app.face is not None

session.Session.frame = until_the_face_is_there
program.run_window("ada", {}, platform="null")
"""
PYVISTA = """
import pyvista
plotter = pyvista.Plotter(off_screen=True, window_size=(1280, 800))
plotter.add_mesh(pyvista.read({obj!r}))
plotter.screenshot({png!r})
"""


def run() -> list[Table]:
    """One table: facemorph's picture of a built-in face, and peers' of its neutral alone.

    Modules are compiled to byte code once, as installing does it.
    """
    table = Table("Cold start to a picture on disk", ("what", "median s", "processor s", "peak MB"))
    with tempfile.TemporaryDirectory() as name:
        png, obj = str(Path(name) / "x.png"), str(builtin_face("ada") / "neutral.obj")
        render = [sys.executable, "-m", "facemorph", "render", "ada", "--to", "happy", "-o", png]
        fresh = {
            "FACEMORPH_CACHE_DIR": str(Path(name) / "cache"),
            "FACEMORPH_CONFIG_DIR": name,
            "PYTHONDONTWRITEBYTECODE": "",
            "PYTHONPYCACHEPREFIX": str(Path(name) / "compiled"),
        }
        commands = {
            "facemorph render ada (all shapes and textures)": render,
            "facemorph's window, to the first frame with the face": python(WINDOW),
            "import numpy, moderngl": python("import numpy, moderngl"),
            "polyscope, neutral alone": python(POLYSCOPE.format(obj=obj, png=png)),
            "pyvista, neutral alone": python(PYVISTA.format(obj=obj, png=png)),
        }
        for what, command in commands.items():
            if any(peer in what and not have(peer) for peer in ("polyscope", "pyvista")):
                continue
            done = median_run(command, environment=fresh)
            table.add(what, f"{done.seconds:.2f}", f"{done.cpu_seconds:.2f}", f"{done.peak_mb:.0f}")
    return [table]
