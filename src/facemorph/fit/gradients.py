"""Triangles as edges and frames: how a surface deforms, without where it is.

The edge part of a triangle is the 3 x 2 matrix of its two edge vectors, M = [v2 - v0, v1 - v0]; its frame
adds the normal, A = [M, n / sqrt|n|] with n the cross product of the edges. The gradient that takes a
triangle of one surface to that of another is H = A_d A_r^-1 (Sumner and Popovic 2004).

Edges are kept as (..., 3, 2, T): coordinate, edge, triangle; of many shapes with the shape first. So each
coordinate of a shape is one vector that S, the sparse edge matrix, multiplies, and sums over shapes are
matrix products.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

# A triangle whose height is less than this part of its longest side says nothing about its own plane.
_SLIVER = 1e-3


def edge_matrix(triangles: Int32, vertex_count: int) -> csr_matrix:
    """S (2 T, V) of +1 and -1: S positions are the edges v2 - v0 of every triangle, then v1 - v0."""
    from scipy.sparse import csr_matrix

    count = len(triangles)
    rows = np.repeat(np.arange(2 * count), 2)
    heads = np.concatenate([triangles[:, 2], triangles[:, 1]])
    tails = np.concatenate([triangles[:, 0], triangles[:, 0]])
    columns = np.stack([heads, tails], axis=1).ravel()
    values = np.tile(np.array([1.0, -1.0]), 2 * count)
    return csr_matrix((values, (rows, columns)), shape=(2 * count, vertex_count))


def edges_of(positions: Float64, triangles: Int32) -> Float64:
    """Both edge vectors of every triangle, (3, 2, T), of positions (V, 3)."""
    first, second, third = (positions[triangles[:, corner]].T for corner in range(3))
    return np.stack([third - first, second - first], axis=1)


def heights(edges: Float64) -> Float64:
    """Each triangle's height over its longest side as a part of that side, (T,); 0 where it is degenerate."""
    sides = [_length(edges[:, 0]), _length(edges[:, 1]), _length(edges[:, 0] - edges[:, 1])]
    doubled = _length(_cross(edges[:, 0], edges[:, 1]))
    return np.asarray(doubled / np.maximum(np.max(sides, axis=0), 1e-150) ** 2)


def _length(vectors: Float64) -> Float64:
    """Lengths (T,) of vectors (3, T)."""
    return np.asarray(np.sqrt(vectors[0] ** 2 + vectors[1] ** 2 + vectors[2] ** 2))


def _cross(a: Float64, b: Float64) -> Float64:
    """a x b, all (3, T)."""
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def frames(edges: Float64) -> Float64:
    """A (3, 3, T) of edges (3, 2, T): both edges as columns, and the normal over the root of its length."""
    normal = _cross(edges[:, 0], edges[:, 1])
    normal /= np.sqrt(np.maximum(_length(normal), 1e-300))
    return np.concatenate([edges, normal[:, None]], axis=1)


@dataclass(frozen=True, eq=False)
class Motion:
    """What a template does, carried to a target neutral.

    edges   M* (K, 3, 2, T) float32: offsets of the target's edges, (H - I) M_0, target's unit
    change  q = |H - I|_F (K, T) float32: how much each shape deforms each triangle; no unit
    """

    edges: Float32
    change: Float32


def carried_motion(template: Float64, deltas: Float32, target: Float64, triangles: Int32) -> Motion:
    """The gradients of every shape applied to the target's edges (Sumner and Popovic 2004).

    template, target  neutral positions (V, 3), float64: gradients of small triangles need it
    deltas            (K, V, 3)
    Slivers, which have no plane to turn, keep the template's own edge offsets.
    """
    rest, base = edges_of(template, triangles), edges_of(target, triangles)
    flat = np.minimum(heights(rest), heights(base)) < _SLIVER
    inverse = np.linalg.inv(np.where(flat[:, None, None], np.eye(3), frames(rest).transpose(2, 0, 1)))
    # What a moved frame is multiplied by: A_r^-1 M_0 for new edges, A_r^-1 for H itself; (column, 5, T).
    onto = np.concatenate([inverse @ base.transpose(2, 0, 1), inverse], axis=2).transpose(1, 2, 0).copy()
    still = np.concatenate([base, np.broadcast_to(np.eye(3)[..., None], (3, 3, len(triangles)))], axis=1)
    edges = np.zeros((len(deltas), 3, 2, len(triangles)), np.float32)
    change = np.zeros((len(deltas), len(triangles)), np.float32)
    for k, delta in enumerate(deltas):
        moving = np.flatnonzero(delta.any(axis=1)[triangles].any(axis=1))
        offsets = edges_of(delta.astype(np.float64), triangles[moving])
        frame, there = frames(rest[..., moving] + offsets), onto[..., moving]
        made = -still[..., moving]
        for column in range(3):
            made += frame[:, column, None] * there[column]
        stiff = flat[moving]
        edges[k][..., moving] = np.where(stiff, offsets, made[:, :2])
        change[k, moving] = np.where(stiff, 0.0, np.sqrt((made[:, 2:] ** 2).sum(axis=(0, 1))))
    return Motion(edges, change)
