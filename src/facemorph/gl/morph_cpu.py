"""The CPU path: one blend in numpy, exact normals, one upload. Chosen where OpenGL itself runs on the CPU.

A refined surface is blended as the file has it, and then refined: that is the least work.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.blend import Blend
from facemorph.core.normals import NormalsOf
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.gl.surface import Surface

if TYPE_CHECKING:
    import moderngl


class CpuMorph:
    """Fills a surface's morphed buffer from a pose.

    vertices  (n, 6) float32, positions and normals of the pose; None before the first
    """

    def __init__(self, ctx: moderngl.Context, rig: Rig, surface: Surface, blend: Blend) -> None:
        self._rig = rig
        self._blend = blend
        self._refined = surface.form.refined
        self._normals_of = NormalsOf(surface.triangles.vertices, surface.mesh.vertex_count)
        self.vertices: Float32 | None = None
        self._both = np.empty((surface.mesh.vertex_count, 6), np.float32)
        self.bind(surface)

    def bind(self, surface: Surface) -> None:
        """Fill `surface` from now on, whose vertices are the same mesh's, split otherwise."""
        self._surface = surface
        self._drawn = np.empty((surface.drawn_count, 6), np.float32)
        self._copies = surface.position_of.astype(np.intp)

    def update(self, pose: Pose, offsets: Float32 | None = None, *, exactly: bool) -> None:
        """Morph to `pose` plus `offsets` (V, 3); `exactly` makes the result independent of poses before."""
        positions = self._blend(self._rig.coefficients(pose), exactly=exactly)
        if offsets is not None:
            positions = positions + offsets
        positions = self._refined(positions)
        for axis in range(3):
            # Column by column: numpy copies rows of three numbers one by one.
            self._both[:, axis] = positions[:, axis]
        self._normals_of(positions, out=self._both[:, 3:])
        self.vertices = self._both
        if len(self._drawn):
            # Without a mode numpy gathers into a buffer of its own first.
            self._both.take(self._copies, axis=0, out=self._drawn, mode="clip")
            self._surface.morphed.orphan()
            self._surface.morphed.write(self._drawn)

    def release(self) -> None:
        """Nothing of the context's is held."""
