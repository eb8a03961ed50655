"""How much a surface bends at each vertex: light in skin comes round a nose, hardly round a cheek."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Int32, Int64, distinct
from facemorph.core.normals import vertex_normals

# A head with neck and hair is about so many centimetres high; meshes need not say their unit.
_HEAD_CM = 30.0
_SHARPEST = 2.0  # per centimetre: rims of lids and holes are no ears
_SMOOTHINGS = 6


def bends(positions: Float32, triangles: Int32) -> Float32:
    """Mean absolute curvature (V,), per centimetre of a head of 30, smoothed over neighbours.

    Along an edge from i to j it is |(n_j - n_i) . (p_j - p_i)| / |p_j - p_i|^2, for normals n; a vertex has
    the mean over its edges.
    """
    result = np.zeros(len(positions), np.float32)
    height = float(np.ptp(positions[:, 1])) if len(positions) else 0.0
    if not len(triangles) or not height > 0.0:
        return result
    edges = _edges(triangles.astype(np.int64), len(positions))
    scaled = positions.astype(np.float64) * (_HEAD_CM / height)
    normals = vertex_normals(positions, triangles).astype(np.float64)
    along, turn = (values[edges[:, 1]] - values[edges[:, 0]] for values in (scaled, normals))
    length2 = np.einsum("ei,ei->e", along, along)
    bend = np.abs(np.einsum("ei,ei->e", turn, along)) / np.maximum(length2, 1e-12)
    bend = np.minimum(np.where(length2 > 1e-12, bend, 0.0), _SHARPEST)
    ends = edges.ravel()
    count = np.maximum(np.bincount(ends, minlength=len(positions)), 1)
    smooth = np.bincount(ends, weights=np.repeat(bend, 2), minlength=len(positions)) / count
    for _ in range(_SMOOTHINGS):
        neighbours = np.bincount(ends, weights=smooth[edges[:, ::-1]].ravel(), minlength=len(positions))
        smooth = 0.5 * smooth + 0.5 * neighbours / count
    return np.asarray(smooth, np.float32)


def _edges(triangles: Int64, vertex_count: int) -> Int64:
    """Every edge (E, 2) once."""
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    keys = distinct(pairs.min(axis=1) * vertex_count + pairs.max(axis=1))
    return np.stack([keys // vertex_count, keys % vertex_count], axis=1)
