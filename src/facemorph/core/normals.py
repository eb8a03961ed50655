"""Normals of a morphed surface: exact, area-weighted, fast enough to follow a dragged slider."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Int32


def vertex_normals(positions: Float32, triangles: Int32) -> Float32:
    """Unit normals (V, 3) float32 of positions (V, 3) and triangles (T, 3).

    n_v = sum over v's triangles of (p1 - p0) x (p2 - p0), normalised: the cross product's length is
    twice the area, so large triangles count more. A vertex without area gets (0, 0, 1).
    """
    return NormalsOf(triangles, len(positions))(positions)


class NormalsOf:
    """`vertex_normals` for one set of triangles: bind once, call for every pose."""

    def __init__(self, triangles: Int32, vertex_count: int) -> None:
        self._first, self._second, self._third = (np.ascontiguousarray(triangles[:, i]) for i in range(3))
        self._vertex_count = vertex_count

    def __call__(self, positions: Float32) -> Float32:
        """Positions (V, 3) -> unit normals (V, 3) float32."""
        areas = self._triangle_areas(self._scaled(positions))
        sums = np.empty((3, self._vertex_count))
        for axis, area in enumerate(areas):
            sums[axis] = np.bincount(self._first, area, self._vertex_count)
            sums[axis] += np.bincount(self._second, area, self._vertex_count)
            sums[axis] += np.bincount(self._third, area, self._vertex_count)
        length = np.sqrt(np.einsum("av,av->v", sums, sums))
        flat = length <= np.finfo(np.float32).tiny
        length[flat] = 1.0
        sums /= length
        sums[:, flat] = np.array([[0.0], [0.0], [1.0]])
        return np.ascontiguousarray(sums.T, np.float32)

    @staticmethod
    def _scaled(positions: Float32) -> Float32:
        """Positions as (3, V); very large or small models are scaled so that areas stay finite."""
        axes = np.ascontiguousarray(positions.T, np.float32)
        largest = float(np.abs(axes).max()) if axes.size else 0.0
        if largest > 1e6 or 0.0 < largest < 1e-6:
            axes = axes / np.float32(largest)
        return axes

    def _triangle_areas(self, axes: Float32) -> tuple[Float32, Float32, Float32]:
        """Cross products of the triangles' edges as three (T,) arrays; axes is (3, V)."""
        origin = [axis.take(self._first) for axis in axes]
        ux, uy, uz = (axis.take(self._second) - start for axis, start in zip(axes, origin, strict=True))
        wx, wy, wz = (axis.take(self._third) - start for axis, start in zip(axes, origin, strict=True))
        return uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
