"""`Form`: what of a drawn surface can be worked out without OpenGL, and so in any thread.

A frame must not wait for it: at two levels of subdivision of a large face it takes seconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Bool, Float32, Int32, Int64
from facemorph.core.mesh import Material, Mesh
from facemorph.core.progress import Progress, silent
from facemorph.core.refinement import Refinement
from facemorph.core.split import SplitVertices, split_vertices
from facemorph.core.triangles import Triangles, triangulated
from facemorph.gl.bends import bends
from facemorph.gl.describe import Graphics
from facemorph.gl.hem import Hem, hem_of
from facemorph.gl.materials import PLAIN
from facemorph.gl.rings import vertex_rings
from facemorph.gl.shell import Shell, shell_of

OfTriangles = tuple[Sequence[Material], Int64]
_Real = TypeVar("_Real", np.float32, np.float64)


class Form:
    """A file's mesh at a level of subdivision, ready to be drawn: `refinement.fine` is what is drawn.

    materials   those in use and, for each triangle, which one; `clear` (T,) the triangles one sees through
    hem         the cut of a bust, or None; `shell` what may hide insides
    rings       the triangles around each vertex, as textures hold them
    """

    def __init__(self, refinement: Refinement) -> None:
        self.refinement = refinement
        self.mesh: Mesh = refinement.fine
        self.triangles: Triangles = triangulated(self.mesh)
        self.materials: OfTriangles = materials_of(self.mesh, self.triangles.polygon)
        self.clear: Bool = see_through(*self.materials)

    @classmethod
    def of(
        cls, mesh: Mesh, level: int = 0, progress: Progress = silent, ahead: Graphics | None = None
    ) -> Form:
        """The form of a mesh at a level; with `ahead`, all that drawing there will ask for is made now.

        Raises `OptionError` as `Refinement.of` does.
        """
        form = cls(Refinement.of(mesh, level, lambda part, doing: progress(0.3 * part, doing)))
        if ahead is not None:
            progress(0.5, "Splitting at seams")
            form.split  # noqa: B018
            progress(0.6, "Looking for a bust's end")
            form.hem  # noqa: B018
            progress(0.7, "Looking around vertices")
            form.shell if ahead.software else form.rings  # noqa: B018
            form.bend  # noqa: B018
            progress(1.0, "Ready")
        return form

    @property
    def level(self) -> int:
        """How many levels of subdivision it has."""
        return len(self.refinement.steps)

    @property
    def of_file(self) -> Mesh:
        """The mesh as its file has it."""
        return self.refinement.coarse

    def refined(self, values: NDArray[_Real]) -> NDArray[_Real]:
        """Values of the file's vertices, (V,) or (V, k), at those that are drawn."""
        return self.refinement.apply(values)

    @cached_property
    def bend(self) -> Float32:
        """How much the file's surface bends at its vertices (V,), so that all levels are lit alike."""
        coarse = self.of_file
        of = self.triangles if coarse is self.mesh else triangulated(coarse)
        return bends(coarse.positions, of.vertices)

    @cached_property
    def split(self) -> SplitVertices:
        """Vertices split at texture seams."""
        return split_vertices(self.mesh, self.triangles)

    @cached_property
    def hem(self) -> Hem | None:
        """The cut lower end, where there is one."""
        return hem_of(self.mesh, self.triangles.vertices, self.clear)

    @cached_property
    def shell(self) -> Shell | None:
        """The surfaces whose insides may be hidden."""
        apart = self.clear if self.hem is None else self.clear | self.hem.triangles
        return shell_of(self.mesh.positions, self.triangles.vertices, apart)

    @cached_property
    def rings(self) -> tuple[Int32, Int32]:
        """See `gl.rings.vertex_rings`."""
        return vertex_rings(self.triangles.vertices, self.mesh.vertex_count)


def see_through(materials: Sequence[Material], of_triangle: Int64) -> Bool:
    """(T,) whether a triangle's material lets light through: hair, lashes, tears."""
    clear = np.array([material.opacity < 1.0 for material in materials])
    return np.asarray(clear[of_triangle])


def materials_of(mesh: Mesh, polygon: Int32) -> OfTriangles:
    """The materials in use and, for triangles of polygons (T,), which one."""
    used = mesh.materials_used
    if used is None or not used.names:
        return (PLAIN,), np.zeros(len(polygon), np.int64)
    known = [mesh.materials.get(name, Material(name, diffuse=PLAIN.diffuse)) for name in used.names]
    return (*known, PLAIN), np.where(used.index < 0, len(known), used.index)[polygon].astype(np.int64)
