"""`Refinement`: a mesh, the finer one that subdivision makes of it, and the way from one to the other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Bool, Float32, Int32, Int64
from facemorph.core.mesh import Labels, Mesh
from facemorph.core.picture import checked_subdivision
from facemorph.core.progress import Progress, silent
from facemorph.core.subdivision import Step, step_of

_Real = TypeVar("_Real", np.float32, np.float64)


@dataclass(frozen=True, eq=False)
class Refinement:
    """`fine` is `coarse` after as many levels of Catmull-Clark as there are steps.

    A vertex of `coarse` has the same number in `fine`; what was made comes after. Texture coordinates are
    refined linearly, along with the polygons of their own that they make; labels go on to the parts of a
    polygon; normals of the file are left out.

    on_edge   (C,) bool, whether the edge that leaves each corner of `fine` is part of one of `coarse`'s
    """

    coarse: Mesh
    fine: Mesh
    steps: tuple[Step, ...]
    on_edge: Bool

    @classmethod
    def of(cls, mesh: Mesh, level: int, progress: Progress = silent) -> Refinement:
        """`mesh` at level 1 or 2; at 0 it is its own refinement.

        Raises `OptionError` for another level, and where it had more than `MOST_VERTICES`.
        """
        fine, steps = mesh, []
        on_edge = np.ones(len(mesh.corner_vertices), bool)
        for number in range(1, checked_subdivision(level) + 1):
            progress((number - 1) / level, f"Subdividing, level {number}")
            step = step_of(fine)
            fine = _finer(fine, step)
            inside = np.zeros(len(step.quads), bool)
            on_edge = np.stack(
                [on_edge[step.corner_of], inside, inside, on_edge[step.corner_of[step.before]]], 1
            ).ravel()
            steps.append(step)
        return cls(mesh, fine, tuple(steps), on_edge)

    def apply(self, values: NDArray[_Real]) -> NDArray[_Real]:
        """Values of the vertices of `coarse`, (V,) or (V, k), at those of `fine`: linear in the values."""
        if not self.steps:
            return values
        finer = values.reshape(len(values), -1)
        for step in self.steps:
            finer = step.apply(finer)
        return finer.reshape(-1, *values.shape[1:])

    def finer(self, mesh: Mesh) -> Mesh:
        """Another mesh of the very same polygons, refined alike; `fine`'s own arrays where they agree."""
        if mesh is self.coarse:
            return self.fine
        shared = _same_uvs(mesh, self.coarse)
        result = replace(mesh, corner_uvs=None) if shared else mesh
        for step in self.steps:
            result = _finer(result, step)
        return replace(result, uvs=self.fine.uvs, corner_uvs=self.fine.corner_uvs) if shared else result


def _finer(mesh: Mesh, step: Step) -> Mesh:
    uvs, corner_uvs = _finer_uvs(mesh, step)
    colours = None if mesh.colours is None else step.apply(mesh.colours)
    return Mesh(
        step.apply(mesh.positions),
        np.arange(0, step.quads.size + 1, 4, dtype=np.int32),
        step.quads.astype(np.int32).ravel(),
        uvs,
        corner_uvs,
        colours=colours,
        groups=_inherited(mesh.groups, step),
        objects=_inherited(mesh.objects, step),
        materials_used=_inherited(mesh.materials_used, step),
        materials=mesh.materials,
        notes=mesh.notes,
    )


def _inherited(labels: Labels | None, step: Step) -> Labels | None:
    return None if labels is None else Labels(labels.names, labels.index[step.polygon_of])


def _same_uvs(one: Mesh, other: Mesh) -> bool:
    if one.corner_uvs is None or other.corner_uvs is None:
        return one.corner_uvs is other.corner_uvs
    return np.array_equal(one.corner_uvs, other.corner_uvs) and np.array_equal(one.uvs, other.uvs)


def _finer_uvs(mesh: Mesh, step: Step) -> tuple[Float32, Int32 | None]:
    """Coordinates at corners, at the middles of edges and of polygons; none where a corner has none."""
    if mesh.corner_uvs is None:
        return mesh.uvs, None
    here = mesh.corner_uvs[step.corner_of].astype(np.int64)
    leaving, edge_middles = _edge_middles(mesh.uvs, here, here[step.after])
    of_face, face_middles = _face_middles(mesh.uvs, here, step.face_of)
    leaving[leaving >= 0] += len(mesh.uvs)
    of_face[of_face >= 0] += len(mesh.uvs) + len(edge_middles)
    corners = np.stack([here, leaving, of_face, leaving[step.before]], axis=1)
    return np.concatenate([mesh.uvs, edge_middles, face_middles]), corners.astype(np.int32).ravel()


def _edge_middles(uvs: Float32, here: Int64, after: Int64) -> tuple[Int64, Float32]:
    """The middle for each corner (Q,) of the edge that leaves it, -1 for none; and the middles."""
    known = (here >= 0) & (after >= 0)
    width = max(len(uvs), 1)
    low, high = np.minimum(here, after)[known], np.maximum(here, after)[known]
    keys, of_corner = np.unique(low * width + high, return_inverse=True)
    which = np.full(len(here), -1, np.int64)
    which[known] = of_corner.reshape(-1)
    return which, uvs[np.stack(np.divmod(keys, width), axis=1)].mean(axis=1, dtype=np.float32)


def _face_middles(uvs: Float32, here: Int64, face_of: Int64) -> tuple[Int64, Float32]:
    """The middle for each corner (Q,) of its face, -1 for none; and the middles."""
    if not len(here):
        return here.copy(), np.zeros((0, 2), np.float32)
    starts = np.flatnonzero(np.diff(face_of, prepend=-1))
    whole = np.minimum.reduceat(here, starts) >= 0
    sums = np.add.reduceat(uvs[np.maximum(here, 0)].astype(np.float64), starts, axis=0)
    means = sums / np.diff(starts, append=len(here))[:, None]
    which = np.where(whole, np.cumsum(whole) - 1, -1)
    return which[face_of], means[whole].astype(np.float32)
