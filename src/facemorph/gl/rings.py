"""The triangles around each vertex, as lists that a shader walks."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Int32, Int64


def vertex_rings(triangles: Int32, vertex_count: int) -> tuple[Int32, Int32]:
    """For each vertex the triangles around it: rings (V, 2) start and count; corners (3 T, 2) the others.

    Corner (a, b) of vertex v stands for the triangle (v, a, b), turning as the triangle does.
    """
    corner_of = triangles.reshape(-1).astype(np.int64)
    order: Int64 = np.argsort(corner_of, kind="stable")
    count = np.bincount(corner_of, minlength=vertex_count)
    rings = np.stack([np.cumsum(count) - count, count], axis=1).astype(np.int32)
    following = triangles[:, [1, 2, 0]].reshape(-1)[order]
    before = triangles[:, [2, 0, 1]].reshape(-1)[order]
    return rings, np.stack([following, before], axis=1).astype(np.int32)
