"""Normals of a morphed surface: exact, area-weighted, fast enough to follow a dragged slider."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Float32, Float64, Int32

_Places = NDArray[np.intp]
_AT_ONCE = 1 << 14  # triangles; what is made of them on the way stays in the processor's cache


def vertex_normals(positions: Float32, triangles: Int32) -> Float32:
    """Unit normals (V, 3) float32 of positions (V, 3) and triangles (T, 3).

    n_v = sum over v's triangles of (p1 - p0) x (p2 - p0), normalised: the cross product's length is
    twice the area, so large triangles count more. A vertex without area gets (0, 0, 1).
    """
    return NormalsOf(triangles, len(positions))(positions)


class NormalsOf:
    """`vertex_normals` for one set of triangles: bind once, call for every pose, from one thread."""

    def __init__(self, triangles: Int32, vertex_count: int) -> None:
        # numpy would turn narrower indices into its own at every use.
        self._corners = np.ascontiguousarray(triangles.T, np.intp)
        self._sums = np.empty((3, vertex_count))

    def __call__(self, positions: Float32, out: Float32 | None = None) -> Float32:
        """Positions (V, 3) -> unit normals (V, 3) float32, in `out` where that is given."""
        axes = self._scaled(positions)
        self._sums.fill(0.0)
        for start in range(0, self._corners.shape[1], _AT_ONCE):
            self._add(axes, self._corners[:, start : start + _AT_ONCE])
        normals = np.empty(positions.shape, np.float32) if out is None else out
        self._normalise(self._sums, normals)
        return normals

    @staticmethod
    def _scaled(positions: Float32) -> Float32:
        """Positions as (3, V); very large or small models are scaled so that areas stay finite."""
        axes = np.ascontiguousarray(positions.T, np.float32)
        largest = max(float(axes.max()), -float(axes.min())) if axes.size else 0.0
        if largest > 1e6 or 0.0 < largest < 1e-6:
            axes = axes / np.float32(largest)
        return axes

    def _add(self, axes: Float32, corners: _Places) -> None:
        """Add the cross products of some triangles' edges to the sums at their corners (3, n)."""
        first, second, third = corners
        origin = [axis.take(first) for axis in axes]
        ux, uy, uz = (axis.take(second) - start for axis, start in zip(axes, origin, strict=True))
        wx, wy, wz = (axis.take(third) - start for axis, start in zip(axes, origin, strict=True))
        areas = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
        for sums, area in zip(self._sums, areas, strict=True):
            exact = area.astype(np.float64)
            for corner in corners:
                np.add.at(sums, corner, exact)

    @staticmethod
    def _normalise(sums: Float64, normals: Float32) -> None:
        length = np.sqrt(np.einsum("av,av->v", sums, sums))
        flat = length <= np.finfo(np.float32).tiny
        if flat.any():
            length[flat] = 1.0
            sums[:, flat] = np.array([[0.0], [0.0], [1.0]])
        for axis, component in enumerate(sums):
            np.divide(component, length, out=normals[:, axis], casting="same_kind")
