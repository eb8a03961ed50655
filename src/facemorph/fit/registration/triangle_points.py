"""Nearest points on triangles, pair by pair, in numpy alone."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float64


def nearest_in_triangles(points: Float64, corners: Float64) -> Float64:
    """Barycentric coordinates (N, 3) of the place in each triangle (N, 3, 3) nearest to its point (N, 3).

    Where the foot of the perpendicular lies outside, the nearest of the three edges takes its place. A
    triangle without area is its edges.
    """
    first = corners[:, 0]
    u, w, p = corners[:, 1] - first, corners[:, 2] - first, points - first
    uu, uw, ww = _dot(u, u), _dot(u, w), _dot(w, w)
    pu, pw = _dot(p, u), _dot(p, w)
    area = uu * ww - uw * uw
    safe = np.maximum(area, 1e-300)
    second, third = (ww * pu - uw * pw) / safe, (uu * pw - uw * pu) / safe
    found = np.stack([1.0 - second - third, second, third], axis=1)
    outside = np.flatnonzero(
        (area <= 1e-14 * np.maximum(uu, ww) ** 2) | (second < 0) | (third < 0) | (second + third > 1)
    )
    if len(outside):
        found[outside] = _on_edges(points[outside], corners[outside])
    return found


def _on_edges(points: Float64, corners: Float64) -> Float64:
    """Barycentric coordinates (N, 3) of the nearest place on the triangles' edges."""
    best = np.full(len(points), np.inf)
    found = np.zeros((len(points), 3))
    for start in range(3):
        end = (start + 1) % 3
        along = corners[:, end] - corners[:, start]
        offset = points - corners[:, start]
        t = np.clip(_dot(offset, along) / np.maximum(_dot(along, along), 1e-300), 0.0, 1.0)
        away = offset - t[:, None] * along
        square = _dot(away, away)
        nearer = np.flatnonzero(square < best)
        best[nearer] = square[nearer]
        found[nearer] = 0.0
        found[nearer, start] = 1.0 - t[nearer]
        found[nearer, end] = t[nearer]
    return found


def _dot(a: Float64, b: Float64) -> Float64:
    return np.asarray(np.einsum("ni,ni->n", a, b))
