"""Catmull-Clark subdivision of any polygon mesh, as a linear operator on whatever its vertices carry.

E. Catmull and J. Clark, Recursively generated B-spline surfaces on arbitrary topological meshes,
Computer-Aided Design 10 (1978), with the border of H. Biermann, A. Levin and D. Zorin, Piecewise smooth
subdivision surfaces with normal control (SIGGRAPH 2000), 3.1. With S a vertex, n its edges:

    a face's point      the mean of its corners
    an edge's point     (S_a + S_b + F_1 + F_2) / 4, its ends and the points of its two faces
    a vertex's point    (n - 2) / n S + (sum of the n neighbours + sum of the n faces' points) / n^2

Edges of one face only, or of more than two, are creases: their points are midpoints, and a vertex between
two of them has 3/4 S + (S_a + S_b) / 8, a cubic B-spline that no inner vertex reaches. Vertices where another
number of creases meet, corners of one polygon only, and vertices without polygons stay where they are.

All of it is linear: S(n + sum_k c_k d_k) = S(n) + sum_k c_k S(d_k), for a neutral n and deltas d.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Bool, Int64
from facemorph.core.mesh import Mesh
from facemorph.errors import OptionError

MOST_VERTICES = 1_000_000
"""The most vertices a refined mesh may have."""
_LONG = 24  # from so many terms on, a sum's terms are gathered at once: vertices of such valence are few

_Real = TypeVar("_Real", np.float32, np.float64)
_Places = NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class _Sums:
    """Points that are weighted sums of as many terms each: own * x[centre] + each * sum of x[terms].

    to  (m,) rows of the result; terms  (m, s) rows of x; centre  (m,), or None where there is none
    """

    to: _Places | slice
    terms: _Places
    each: float
    centre: _Places | None = None
    own: float = 0.0

    def put(self, values: NDArray[_Real], out: NDArray[_Real]) -> None:
        """Sums over values (n, k) into the rows of `out`."""
        count = self.terms.shape[1]
        if not count:
            total = np.zeros((len(self.terms), values.shape[1]), values.dtype)
        elif count >= _LONG:
            total = values.take(self.terms, axis=0).sum(axis=1, dtype=values.dtype)
        else:
            total = values.take(self.terms[:, 0], axis=0)
            for place in range(1, count):
                total += values.take(self.terms[:, place], axis=0)
        total *= values.dtype.type(self.each)
        if self.centre is not None:
            total += values.take(self.centre, axis=0) * values.dtype.type(self.own)
        out[self.to] = total


@dataclass(frozen=True, eq=False)
class Step:
    """One level over V vertices, E edges and F faces (polygons of three corners or more).

    The finer mesh has V + E + F vertices: those that were there, the edges' points, the faces' points. It
    has a quad for each corner of a face: (vertex, edge that leaves it, face, edge that reaches it).

    counts      V, E and F
    quads       (Q, 4) int64
    polygon_of  (Q,) the polygon that each quad is part of; `face_of` the face
    corner_of   (Q,) its corner there
    after       (Q,) the quad of the next corner of the same polygon; `before` that of the one before
    """

    counts: tuple[int, int, int]
    quads: Int64
    polygon_of: Int64
    face_of: Int64
    corner_of: Int64
    after: Int64
    before: Int64
    _face_points: tuple[_Sums, ...]
    _points: tuple[_Sums, ...]

    @property
    def vertex_count(self) -> int:
        """Of the finer mesh."""
        return sum(self.counts)

    def apply(self, values: NDArray[_Real]) -> NDArray[_Real]:
        """Values (V, k) -> (V + E + F, k)."""
        vertices, edges, _ = self.counts
        out = np.empty((self.vertex_count, values.shape[1]), values.dtype)
        out[:vertices] = values
        for sums in self._face_points:
            sums.put(values, out[vertices + edges :])
        both = np.concatenate([values, out[vertices + edges :]])
        for sums in self._points:
            sums.put(both, out)
        return out


def step_of(mesh: Mesh) -> Step:
    """One level of subdivision of `mesh`. Raises `OptionError` where that has more than `MOST_VERTICES`."""
    faces = _Faces(mesh)
    _check(mesh.vertex_count + len(faces.starts) + len(faces.corner_of) // 2)
    edges = _Edges(faces, mesh.vertex_count)
    counts = mesh.vertex_count, len(edges.ends), len(faces.starts)
    _check(sum(counts))
    first_edge, first_face = counts[0], counts[0] + counts[1]
    quads = np.stack(
        [
            faces.vertex,
            first_edge + edges.of_corner,
            first_face + faces.of_corner,
            first_edge + edges.of_corner[faces.before],
        ],
        axis=1,
    )
    return Step(
        counts,
        quads,
        faces.polygon[faces.of_corner],
        faces.of_corner,
        faces.corner_of,
        faces.next,
        faces.before,
        tuple(_face_points(faces)),
        (*_edge_points(faces, edges, counts[0]), *_vertex_points(faces, edges, counts[0])),
    )


def _check(count: int) -> None:
    if count > MOST_VERTICES:
        raise OptionError(
            f"subdivision makes at most {MOST_VERTICES:,} vertices; this level of this mesh has {count:,}. "
            "Ask for a lower level."
        )


class _Faces:
    """The polygons of three corners or more, their corners one after another.

    corner_of  (C,) the mesh's corner; `vertex` its vertex, `of_corner` its face, `next` and `before` its
               neighbours, as indices into these arrays
    starts     (F,) first corner of each face, `sizes` its corners, `polygon` the mesh's polygon
    """

    def __init__(self, mesh: Mesh) -> None:
        begins = mesh.polygon_starts.astype(np.int64)
        sizes = np.diff(begins)
        self.polygon: Int64 = np.flatnonzero(sizes >= 3)
        self.sizes: Int64 = sizes[self.polygon]
        ends = np.cumsum(self.sizes)
        self.starts: Int64 = ends - self.sizes
        self.of_corner: Int64 = np.repeat(np.arange(len(self.sizes)), self.sizes)
        place = np.arange(len(self.of_corner))
        self.corner_of: Int64 = begins[self.polygon][self.of_corner] + place - self.starts[self.of_corner]
        self.vertex: Int64 = mesh.corner_vertices[self.corner_of].astype(np.int64)
        self.next: Int64 = np.where(place + 1 == ends[self.of_corner], self.starts[self.of_corner], place + 1)
        self.before: Int64 = np.empty_like(self.next)
        self.before[self.next] = place


class _Edges:
    """Every edge once.

    ends       (E, 2) vertices, the lower first; `of_corner` (C,) the edge that leaves each corner
    faces      (E, 2) faces on both sides, where `smooth`; the others are creases
    """

    def __init__(self, faces: _Faces, vertex_count: int) -> None:
        pair = np.stack([faces.vertex, faces.vertex[faces.next]], axis=1)
        keys, of_corner, count = np.unique(
            pair.min(axis=1) * vertex_count + pair.max(axis=1), return_inverse=True, return_counts=True
        )
        self.of_corner: Int64 = of_corner.reshape(-1).astype(np.int64)
        self.ends: Int64 = np.stack(np.divmod(keys, max(vertex_count, 1)), axis=1)
        self.solid: Bool = self.ends[:, 0] != self.ends[:, 1]
        self.smooth: Bool = (count == 2) & self.solid
        order = np.argsort(self.of_corner, kind="stable")
        first = np.cumsum(count) - count
        self.faces: Int64 = np.zeros((len(keys), 2), np.int64)
        of_face = faces.of_corner[order]
        self.faces[self.smooth] = of_face[first[self.smooth, None] + np.arange(2)]


def _face_points(faces: _Faces) -> Iterator[_Sums]:
    for size in np.unique(faces.sizes).tolist():
        chosen = np.flatnonzero(faces.sizes == size)
        terms = faces.vertex[faces.starts[chosen][:, None] + np.arange(size)]
        yield _Sums(_rows(chosen), terms, 1.0 / size)


def _edge_points(faces: _Faces, edges: _Edges, vertex_count: int) -> Iterator[_Sums]:
    inner, creased = np.flatnonzero(edges.smooth), np.flatnonzero(~edges.smooth)
    terms = np.concatenate([edges.ends[inner], vertex_count + edges.faces[inner]], axis=1)
    yield _Sums(_rows(vertex_count + inner), terms, 0.25)
    yield _Sums(_rows(vertex_count + creased), edges.ends[creased], 0.5)


def _vertex_points(faces: _Faces, edges: _Edges, vertex_count: int) -> Iterator[_Sums]:
    """All but those that stay where they are."""
    ends = edges.ends[edges.solid]
    ring_vertex, ring = ends.ravel(), ends[:, ::-1].ravel()
    valence = np.bincount(ring_vertex, minlength=vertex_count)
    around = np.bincount(faces.vertex, minlength=vertex_count)
    crease = np.repeat(~edges.smooth[edges.solid], 2)
    creases = np.bincount(ring_vertex[crease], minlength=vertex_count)
    # A polygon that names a vertex twice running has more corners there than edges.
    inner = (creases == 0) & (valence == around) & (valence >= 2)
    ends_of = _Lists(ring_vertex, ring, vertex_count)
    faces_of = _Lists(faces.vertex, faces.of_corner, vertex_count)
    for n in np.unique(valence[inner]).tolist():
        chosen = np.flatnonzero(inner & (valence == n))
        terms = np.concatenate([ends_of(chosen, n), vertex_count + faces_of(chosen, n)], axis=1)
        yield _Sums(chosen, terms, 1.0 / n**2, chosen, (n - 2) / n)
    border = np.flatnonzero((creases == 2) & (around >= 2))
    along = _Lists(ring_vertex[crease], ring[crease], vertex_count)
    yield _Sums(border, along(border, 2), 0.125, border, 0.75)


class _Lists:
    """Values (n,) by the vertex (n,) that each is of."""

    def __init__(self, vertex: Int64, values: Int64, vertex_count: int) -> None:
        order = np.argsort(vertex, kind="stable")
        self._values = values[order]
        count = np.bincount(vertex, minlength=vertex_count)
        self._first = np.cumsum(count) - count

    def __call__(self, vertices: Int64, number: int) -> Int64:
        """Those (m, number) of vertices (m,) that have as many each."""
        found: Int64 = self._values[self._first[vertices][:, None] + np.arange(number)]
        return found


def _rows(chosen: Int64) -> Int64 | slice:
    """Consecutive rows as a slice: what is put there needs no scattering."""
    if len(chosen) and int(chosen[-1]) - int(chosen[0]) == len(chosen) - 1:
        return slice(int(chosen[0]), int(chosen[-1]) + 1)
    return chosen
