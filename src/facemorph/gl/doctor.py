"""What of OpenGL works on this machine: every way to a context tried, and a small face drawn with each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.camera import Camera
from facemorph.core.mesh import Mesh
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.errors import FacemorphError
from facemorph.gl.context import Way, attempt, install_hint, ways
from facemorph.gl.describe import Graphics, describe
from facemorph.gl.renderer import MorphPath, Renderer

PATHS: tuple[MorphPath, ...] = ("cpu", "shader")


@dataclass(frozen=True)
class Finding:
    """One way to a context: whether a face could be drawn with it, what it is, or why it failed."""

    way: str
    works: bool
    graphics: Graphics | None
    problem: str = ""


@dataclass(frozen=True)
class GraphicsReport:
    """Findings in the order the ways are tried; `hint` says what to install, empty where the first works."""

    findings: tuple[Finding, ...]
    hint: str

    @property
    def works(self) -> bool:
        """Whether pictures can be drawn at all."""
        return any(finding.works for finding in self.findings)


def examine() -> GraphicsReport:
    """Try every way to a context on this system; raises nothing, what fails is in the report."""
    findings = tuple(_finding(way) for way in ways())
    return GraphicsReport(findings, "" if any(finding.works for finding in findings) else install_hint())


def _finding(way: Way) -> Finding:
    try:
        ctx = attempt(way)
    except FacemorphError as error:
        return Finding(way.name, False, None, str(error))
    try:
        graphics = describe(ctx)
        with ctx:
            trials = [(path, _trial(Renderer(ctx, path))) for path in PATHS]
        problem = "; ".join(f"{path} path: {trial}" for path, trial in trials if trial)
        return Finding(way.name, not problem, graphics, problem)
    except FacemorphError as error:
        return Finding(way.name, False, describe(ctx), str(error))
    finally:
        ctx.release()


def _trial(renderer: Renderer) -> str:
    """Draw a triangle that its shape brings into the picture; empty if it is there, else what is wrong."""
    corners = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]], np.float32)
    away = corners + np.array([50.0, 0.0, 0.0], np.float32)
    mesh = Mesh.from_triangles(away, np.array([[0, 1, 2]], np.int32))
    try:
        renderer.load(Rig.from_arrays(mesh, {"here": corners}))
        camera = Camera(distance=6.0, scene_radius=2.0)
        renderer.draw(Pose.of({"here": 1.0}), camera, Look(background=(0.0, 0.0, 0.0, 0.0)), (16, 16))
        pixels = renderer.read()
    finally:
        renderer.release()
    return "" if pixels[8, 8, 3] == 255 else "it draws, but not what it is told to"
