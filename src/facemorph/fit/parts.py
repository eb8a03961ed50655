"""Which vertices hang together, and which never move: what keeps a surface in its place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float32, Float64, Int32

# Moves shorter than this part of the diagonal are noise of the file's digits.
_STILL = 1e-6


@dataclass(frozen=True, eq=False)
class Anchoring:
    """How vertices are held while edges are solved for.

    still     (V,) vertices that no shape of the template moves
    part      (V,) int32, the connected part each vertex belongs to
    floating  (P,) parts in which every vertex moves: nothing but the template's own way holds them
    """

    still: Bool
    part: Int32
    floating: Bool

    @property
    def main(self) -> Bool:
        """Vertices (V,) of the part with most that moves: the skin, beside which hair and eyes are others."""
        moving = None if self.still.all() else ~self.still
        return np.asarray(self.part == np.bincount(self.part, moving).argmax())

    @property
    def drifting(self) -> Bool:
        """Vertices (V,) of floating parts."""
        return np.asarray(self.floating[self.part])


def anchoring(triangles: Int32, deltas: Float32, diagonal: float) -> Anchoring:
    """Of a template's shapes (K, V, 3) over triangles (T, 3)."""
    part = connected_parts(triangles, deltas.shape[1])
    moved = np.zeros(deltas.shape[1:], np.float32)
    for delta in deltas:
        np.maximum(moved, np.abs(delta), out=moved)
    still = moved.max(axis=1) <= _STILL * diagonal
    held = np.zeros(int(part.max(initial=-1)) + 1, bool)
    held[part[still]] = True
    return Anchoring(still, part, ~held)


def connected_parts(triangles: Int32, vertex_count: int) -> Int32:
    """The number of each vertex's connected part, (V,); a vertex without triangles is a part of its own."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    pairs = np.concatenate([triangles[:, :2], triangles[:, 1:]])
    graph = coo_matrix(
        (np.ones(len(pairs), np.int8), (pairs[:, 0], pairs[:, 1])), shape=(vertex_count, vertex_count)
    )
    _, labels = connected_components(graph, directed=False)
    return np.asarray(labels, np.int32)


class PartMeans:
    """The mean of values over each part; `part` (N,) is the part of each value, below `count`."""

    def __init__(self, part: Int32, count: int) -> None:
        self.count = count
        self._part = part
        self._size = np.maximum(np.bincount(part, minlength=count), 1)

    def __call__(self, rows: Float32 | Float64) -> Float64:
        """Means (R, count) of rows (R, N); 0 for a part without values."""
        sums = np.zeros((len(rows), self.count))
        for total, row in zip(sums, rows, strict=True):
            total += np.bincount(self._part, row, minlength=self.count)
        return np.asarray(sums / self._size)
