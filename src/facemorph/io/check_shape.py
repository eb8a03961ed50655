"""What may be wrong with how a shape moves its neutral, with few false alarms.

Expressions turn and squeeze parts of a face strongly and rightly (lips roll in, lids close), so a
triangle is compared with its surroundings: folded when it faces against the surface around it and did
not in the neutral. A vertex strays when it leaves its neighbours by far more than any of theirs do.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int64
from facemorph.core.mesh import Mesh
from facemorph.core.triangles import triangulated
from facemorph.io.check_axes import half_size, turn_between
from facemorph.io.check_mesh import polygon_numbers, triangle_areas, vertex_numbers

STILL = 1e-6
"""Movement below this part of the diagonal is none: it is what rounding to six digits leaves."""

_OTHER_SIZE = 3.0
_FAR = 0.05
_FOLDED = -0.5
_SHRUNK = 1e-4
_STRAY = 0.01
# Even good scans and sculpts crumple a few small triangles at the corners of mouth and eyes.
_WORTH_TELLING = 0.002
_STRAY_RATIO = 6.0
_MOST_SUSPECTS = 10_000


class Movements:
    """The checks of shapes of one neutral; what depends on it alone is worked out once."""

    def __init__(self, neutral: Mesh) -> None:
        self._neutral = neutral
        self._triangles = triangulated(neutral)
        self._places = neutral.positions.astype(np.float64)
        self._size = max(neutral.diagonal, float(np.finfo(np.float32).tiny))

    def findings(self, delta: Float32, under: Float32 | None = None) -> Iterator[tuple[str, str]]:
        """Kind and message of each thing that looks wrong with a shape's deltas (V, 3).

        under  (V, 3), of a corrective: what the shapes move that switch it on, without which it means nothing
        """
        moved = np.linalg.norm(delta.astype(np.float64), axis=1)
        if float(moved.max()) <= STILL * self._size:
            yield "empty", "moves no vertex."
            return
        whole = next(self._whole(delta), None)
        if whole is not None:
            yield whole
            return
        stray = self._stray(delta)
        if len(stray):
            moves = "1 vertex moves" if len(stray) == 1 else f"{len(stray):,} vertices move"
            yield "stray-movement", f"{moves} far away from all neighbours: {vertex_numbers(stray)}."
            # That tells what they do to the polygons around them; these are looked at as if they went along.
            delta = delta.copy()
            delta[stray] = self._means(delta)[stray]
        yield from self._surface(delta if under is None else delta + under)

    def alike(self, delta: Float32, other: Float32) -> bool:
        """Whether two shapes move every vertex alike."""
        return bool((np.abs(delta - other) <= STILL * self._size).all())

    def _whole(self, delta: Float32) -> Iterator[tuple[str, str]]:
        """Another size, other axes, or another place, of the shape as a whole; a few vertices make none."""
        places = self._places + delta
        ratio = half_size(places) / half_size(self._places)
        if not 1.0 / _OTHER_SIZE <= ratio <= _OTHER_SIZE:
            times = float(f"{max(ratio, 1.0 / ratio):.2g}")
            words = f"{times:,g} times as {'large' if ratio > 1.0 else 'small'}"
            yield "scale", f"is about {words} as the neutral. Export both in the same unit."
            return
        turn = turn_between(self._places, places)
        if turn is not None:
            yield "turned", turn
            return
        middle = np.median(delta, axis=0)
        spread = float(np.median(np.abs(delta - middle)))
        shift = float(np.linalg.norm(middle))
        if shift > _FAR * self._size and spread < 0.1 * shift:
            yield (
                "moved",
                f"lies {shift:.3g} away from the neutral as a whole. Export both at the same place.",
            )

    def _stray(self, delta: Float32) -> Int64:
        """Vertices (n,) that move far off from where all of their neighbours move."""
        away = np.linalg.norm(delta - self._means(delta), axis=1)
        suspects = np.flatnonzero(away > _STRAY * self._size)
        stray = [v for v in suspects[:_MOST_SUSPECTS].tolist() if self._leaves_all(v, delta)]
        return np.array(stray, np.int64)

    def _leaves_all(self, vertex: int, delta: Float32) -> bool:
        """Whether a vertex moves otherwise than each neighbour, and they move alike."""
        begin, end = self._edges[2][vertex : vertex + 2]
        around = delta[self._edges[1][begin:end]].astype(np.float64)
        if len(around) < 2:
            return False
        middle = np.median(around, axis=0)
        apart = float(np.linalg.norm(around - middle, axis=1).max())
        return float(np.linalg.norm(delta[vertex] - middle)) > max(_STRAY_RATIO * apart, _STRAY * self._size)

    def _surface(self, delta: Float32) -> Iterator[tuple[str, str]]:
        """Triangles that fold over, or lose their area."""
        corners = self._triangles.vertices
        before, after = self._areas, triangle_areas(self._places + delta, corners)
        old, new = np.linalg.norm(before, axis=1), np.linalg.norm(after, axis=1)
        solid = old > float(np.median(old)) * 1e-3
        folded = solid & (new > old * 0.05) & (self._facing(after) < _FOLDED) & (self._facing(before) > 0.0)
        shrunk = solid & (new < old * _SHRUNK)
        moving = (np.abs(delta).max(axis=1) > STILL * self._size)[corners].any(axis=1)
        least = _WORTH_TELLING * float(old[moving].sum())
        for kind, chosen, words in (
            ("folded", folded, "turned over against the surface around"),
            ("collapsed", shrunk, "squeezed to nothing"),
        ):
            polygons = np.unique(self._triangles.polygon[chosen])
            if float(old[chosen].sum()) > least:
                are = "1 polygon is" if len(polygons) == 1 else f"{len(polygons):,} polygons are"
                yield kind, f"{are} {words}: {polygon_numbers(polygons.astype(np.int64))}."

    def _facing(self, areas: Float64) -> Float64:
        """Cosine (T,) between each triangle's normal and that of the other triangles at its corners."""
        corners = self._triangles.vertices
        sums = np.stack(
            [
                sum(np.bincount(corners[:, i], areas[:, axis], len(self._places)) for i in range(3))
                for axis in range(3)
            ],
            axis=1,
        )
        around = sums[corners].sum(axis=1) - 3.0 * areas
        lengths = np.linalg.norm(around, axis=1) * np.linalg.norm(areas, axis=1)
        cosine: Float64 = np.einsum("ta,ta->t", around, areas) / np.maximum(lengths, 1e-300)
        return cosine

    def _means(self, delta: Float32) -> Float64:
        """The mean movement (V, 3) of each vertex's neighbours; its own where it has none."""
        start, end, _ = self._edges
        counts = np.bincount(start, minlength=len(delta))
        sums = np.stack([np.bincount(start, delta[end, axis], len(delta)) for axis in range(3)], axis=1)
        return np.where(counts[:, None] > 0, sums / np.maximum(counts, 1)[:, None], delta)

    @cached_property
    def _areas(self) -> Float64:
        return triangle_areas(self._places, self._triangles.vertices)

    @cached_property
    def _edges(self) -> tuple[Int64, Int64, Int64]:
        """Each triangle edge both ways as start and end, by start; and where each vertex's begin (V + 1,)."""
        corners = self._triangles.vertices.astype(np.int64)
        ways = np.concatenate(
            [corners[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2))]
        )
        count = len(self._places)
        start, end = np.divmod(np.unique(ways[:, 0] * count + ways[:, 1]), count)
        return start, end, np.searchsorted(start, np.arange(count + 1))
