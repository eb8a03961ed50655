"""`Shell`: large surfaces of a mesh whose insides nobody can see from without, unless through a rim.

Triangles that lie hidden cost software OpenGL nearly as much as those that are seen, and half of a head's
always do. So the large components are looked for that are wound the same way all over. With each rim
closed by a fan of triangles, its cap, such a surface has no border: a ray from outside enters it, if no
cap is met first, through an outside. Where no cap is seen, no inside is.

Two things can break that, and both are looked for: a surface turned inside out as a whole (`outwardness`),
and one that passes through itself the wrong way, which only drawing shows (`gl.insides`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float32, Float64, Int32, Int64

# Small parts, such as lashes, are cheap to draw from both sides.
_SMALLEST = 400


@dataclass(frozen=True, eq=False)
class Shell:
    """`triangles` (T,) bool, those of the shell; `caps` (n, 3) int32 over the positions close its rims."""

    triangles: Bool
    caps: Int32


def shell_of(positions: Float32, triangles: Int32, apart: Bool | None = None) -> Shell | None:
    """The shell of a mesh with positions (V, 3) and triangles (T, 3), or None where it has none.

    Triangles `apart` (T,) are no part of it: a bust's ragged hem, so that its cap lies where the hem begins.
    """
    if not len(triangles):
        return None
    corners = triangles.astype(np.int64)
    solid = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    if apart is not None:
        solid &= ~apart
    component = _components(corners[solid], len(positions))
    whose = component[corners[:, 0]]
    kept = solid & (np.bincount(whose[solid], minlength=len(positions)) >= _SMALLEST)[whose]
    rim, mixed = _rim(corners[kept], len(positions))
    bad = np.zeros(len(positions), bool)
    bad[component[mixed]] = True
    rim = rim[~bad[component[rim[:, 0]]]]
    caps = _caps(rim, len(positions))
    volume = _volumes(positions, component, [corners[kept], caps])
    kept &= (~bad & (volume > 0.0))[whose]
    if not kept.any():
        return None
    used = np.zeros(len(positions), bool)
    used[component[corners[kept, 0]]] = True
    return Shell(kept, caps[used[component[caps[:, 0]]]].astype(np.int32))


def _rim(corners: Int64, vertex_count: int) -> tuple[Int64, Int64]:
    """Edges (n, 2) of one triangle only, as it runs through them; and a vertex of each edge that is mixed.

    Mixed is an edge that two triangles run through the same way (they are wound against each other), and
    one where more than two meet.
    """
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    rising = edges[:, 0] < edges[:, 1]
    order = np.argsort(edges.min(axis=1) * vertex_count + edges.max(axis=1))
    edges, rising = edges[order], rising[order]
    low, high = edges.min(axis=1), edges.max(axis=1)
    first = np.ones(len(edges), bool)
    first[1:] = (low[1:] != low[:-1]) | (high[1:] != high[:-1])
    starts = np.flatnonzero(first)
    count = np.diff(starts, append=len(edges))
    up = np.add.reduceat(rising.astype(np.int64), starts) if len(starts) else count
    mixed = (up > 1) | (count - up > 1)
    return edges[starts[count == 1]], edges[starts[mixed], 0]


def _components(corners: Int64, vertex_count: int) -> Int64:
    """For each vertex (V,) the lowest vertex that triangles join it to."""
    label = np.arange(vertex_count, dtype=np.int64)
    while True:
        lowest = label[corners].min(axis=1)
        joined = label.copy()
        # The roots take the lowest label too, so that whole trees move at once.
        for corner in corners.T:
            np.minimum.at(joined, label[corner], lowest)
            np.minimum.at(joined, corner, lowest)
        while not np.array_equal(joined[joined], joined):
            joined = joined[joined]
        if np.array_equal(joined, label):
            return label
        label = joined


def _caps(rim: Int64, vertex_count: int) -> Int64:
    """Fans (n, 3) from one vertex of each rim over its edges, turned so that they close the surface."""
    if not len(rim):
        return np.zeros((0, 3), np.int64)
    apex = _components(rim[:, [0, 1, 1]], vertex_count)[rim[:, 0]]
    return np.stack([apex, rim[:, 1], rim[:, 0]], axis=1)


def _volumes(positions: Float32, component: Int64, surfaces: list[Int64]) -> Float64:
    """Six times the volume in each component, at the place of its label, (V,)."""
    centred = positions.astype(np.float64) - positions.mean(axis=0, dtype=np.float64)
    volume = np.zeros(len(positions))
    for triangles in surfaces:
        a, b, c = (centred[triangles[:, i]] for i in range(3))
        parts = np.einsum("ti,ti->t", a, np.cross(b, c))
        volume += np.bincount(component[triangles[:, 0]], weights=parts, minlength=len(positions))
    return volume


def outwardness(positions: Float32, normals: Float32) -> float:
    """How much normals (V, 3) point away from the middle of positions (V, 3), about -1..1.

    A surface that a pose turns inside out has the negative of what it had before.
    """
    middle = (positions.min(axis=0) + positions.max(axis=0)) * 0.5
    away = positions - middle
    length = float(np.sqrt(np.einsum("vi,vi->", away, away) * len(positions)))
    return float(np.einsum("vi,vi->", away, normals)) / length if length > 0.0 else 0.0
