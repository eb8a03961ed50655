"""Finding out that two meshes are one surface with its vertices in another order, and undoing it.

Vertices get colours that say how they are connected, and the colours of their neighbours are mixed into
them again and again (colour refinement: B. Weisfeiler and A. Leman, 1968), going round each polygon in
its sense, so that left and right are told apart. Vertices that alone in their mesh have a colour then
correspond. Texture coordinates, and vertices that a shape does not move, make colours different from
the start. Where a part is too regular (an eyeball), or one of several alike (lashes), a vertex of it is
taken for the one of its colour that lies nearest, and it goes on from there. The order found is believed
only if it turns the polygons of the one mesh into those of the other.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from facemorph.core.arrays import Float32, Int32, Int64
from facemorph.core.mesh import Mesh
from facemorph.errors import CorrespondenceError

_MOST_ROUNDS = 400
_MOST_CORNERS_VISITED = 100_000_000
_MOST_PARTS = 2_000

_UInt64 = NDArray[np.uint64]


def reorder(neutral: Mesh, mesh: Mesh, name: str = "the mesh") -> Mesh:
    """`mesh` with its vertices in the neutral's order, and the neutral's polygons, uvs and labels.

    Raises `CorrespondenceError` where they are not the same surface.
    """
    order = vertex_order(neutral, mesh)
    if order is None:
        raise CorrespondenceError(
            name, "it is not the neutral's surface, so no order of its vertices fits.", cause="polygons"
        )
    bare = replace(neutral, normals=np.zeros((0, 3), np.float32), corner_normals=None)
    colours = None if mesh.colours is None else mesh.colours[order]
    return replace(bare.with_positions(mesh.positions[order]), colours=colours)


def vertex_order(neutral: Mesh, mesh: Mesh) -> Int64 | None:
    """The order (V,) in which `mesh.positions[order]` correspond to the neutral's; None where none does."""
    if mesh.vertex_count != neutral.vertex_count or not np.array_equal(
        np.sort(np.diff(mesh.polygon_starts)), np.sort(np.diff(neutral.polygon_starts))
    ):
        return None
    # A vertex that a shape moves to just where another one was would mislead: then without those.
    for trust_places in (True, False):
        order = _Refinement(neutral, mesh, trust_places).order()
        if order is not None and _brings_nearer(neutral, mesh, order):
            return order
    return None


def _brings_nearer(neutral: Mesh, mesh: Mesh, order: Int64) -> bool:
    """Whether the vertices lie nearer to the neutral's in this order than as they stand.

    A symmetric face whose polygons are all turned over is also its own mirror image: that is no repair.
    """
    ordered = mesh.positions[order].astype(np.float64) - neutral.positions
    standing = mesh.positions.astype(np.float64) - neutral.positions
    return float((ordered**2).sum()) < float((standing**2).sum())


def same_polygons(neutral: Mesh, mesh: Mesh) -> bool:
    """Whether both have the same polygons over the same vertex numbers, wherever they stand and begin."""
    starts, others = neutral.polygon_starts, mesh.polygon_starts
    if np.array_equal(starts, others) and np.array_equal(neutral.corner_vertices, mesh.corner_vertices):
        return True
    sizes, other_sizes = np.diff(starts), np.diff(others)
    if not np.array_equal(np.sort(sizes), np.sort(other_sizes)):
        return False
    return all(
        np.array_equal(_sorted_rings(neutral, sizes, size), _sorted_rings(mesh, other_sizes, size))
        for size in np.unique(sizes).tolist()
    )


def _sorted_rings(mesh: Mesh, sizes: Int32, size: int) -> Int32:
    """The polygons of one size (n, size), each begun with its lowest vertex, in ascending order."""
    if not size:
        return np.zeros((0, 0), np.int32)
    first = mesh.polygon_starts[:-1][sizes == size].astype(np.int64)
    rings = mesh.corner_vertices[first[:, None] + np.arange(size)]
    lowest = rings.argmin(axis=1)[:, None]
    turned = np.take_along_axis(rings, (lowest + np.arange(size)) % size, axis=1)
    return turned[np.lexsort(turned.T[::-1])]


class _Refinement:
    """Colours (2 V,) of the vertices of both meshes, taken as one: the mesh's come after the neutral's."""

    def __init__(self, neutral: Mesh, mesh: Mesh, trust_places: bool) -> None:
        self._neutral, self._mesh = neutral, mesh
        self._count = neutral.vertex_count
        self._places = np.concatenate([neutral.positions, mesh.positions]).astype(np.float64)
        sizes = np.concatenate([np.diff(neutral.polygon_starts), np.diff(mesh.polygon_starts)])
        vertices = np.concatenate([neutral.corner_vertices, mesh.corner_vertices + np.int64(self._count)])
        after, before = _around(sizes)
        self._part = _connected(2 * self._count, vertices, vertices[after])
        self._by_vertex = np.argsort(vertices, kind="stable")
        self._used, self._first = np.unique(vertices[self._by_vertex], return_index=True)
        self._next, self._previous = vertices[after][self._by_vertex], vertices[before][self._by_vertex]
        self._sizes = _mixed(np.repeat(sizes, sizes).astype(np.uint64))[self._by_vertex]
        self._colours = (
            _place_colours(neutral, mesh) if trust_places else np.zeros(2 * self._count, np.uint64)
        )
        self._rounds = 0
        self._add_uvs()

    def order(self) -> Int64 | None:
        """The mesh's vertices in the neutral's order, if one is found."""
        while self._refine():
            mine, theirs = self._sorted()
            order = np.empty(self._count, np.int64)
            order[mine] = theirs
            pairs = self._nearest_pairs(order)
            if not len(pairs):
                return order if self._fits(order) else None
            numbers = np.arange(1, len(pairs) + 1).astype(np.uint64)
            told_apart = _mixed(self._colours[pairs[:, 0]] + numbers)
            self._colours[pairs[:, 0]] = self._colours[pairs[:, 1]] = told_apart
        return None

    def _sorted(self) -> tuple[Int64, Int64]:
        """The vertices of the neutral, and of the mesh, in the order of their colours."""
        colours = self._colours.reshape(2, self._count)
        return np.argsort(colours[0], kind="stable"), np.argsort(colours[1], kind="stable")

    def _add_uvs(self) -> None:
        """Mix each vertex's texture coordinates in, where both meshes have some."""
        if self._neutral.corner_uvs is None or self._mesh.corner_uvs is None:
            return
        of_corners = np.concatenate([_corner_uv_colours(self._neutral), _corner_uv_colours(self._mesh)])
        self._mix_in(of_corners[self._by_vertex])

    def _mix_in(self, of_corners: _UInt64) -> None:
        """Mix the sum over each vertex's corners into its colour; the corners' order has no effect."""
        if len(self._used):
            sums = np.add.reduceat(of_corners, self._first)
            self._colours[self._used] = _mixed(self._colours[self._used] + sums)

    def _refine(self) -> bool:
        """Mix neighbours' colours in until no more vertices are told apart.

        False where the meshes' colours come to differ, or it takes too long.
        """
        classes = 0
        while self._rounds < min(_MOST_ROUNDS, _MOST_CORNERS_VISITED // (len(self._next) + 1)):
            self._rounds += 1
            mine, theirs = np.sort(self._colours.reshape(2, self._count), axis=1)
            if not np.array_equal(mine, theirs):
                return False
            now = int(np.count_nonzero(np.diff(mine))) + 1
            if now == classes:
                return True
            classes = now
            following, preceding = self._colours[self._next], self._colours[self._previous]
            self._mix_in(_mixed(_mixed(following) + preceding + self._sizes))
        return False

    def _nearest_pairs(self, order: Int64) -> Int64:
        """Pairs (n, 2) of vertices of one colour to be taken for the same: at most one in each part."""
        used = np.zeros(2 * self._count, bool)
        used[self._used] = True
        _, which, each = np.unique(self._colours, return_inverse=True, return_counts=True)
        open_to = np.flatnonzero(used[: self._count] & (each[which[: self._count]] > 2))
        if not len(open_to):
            return np.zeros((0, 2), np.int64)
        known = np.flatnonzero(used[: self._count] & (each[which[: self._count]] == 2))
        # The rarest colour of each part: its vertices differ the most in place.
        rank = np.lexsort([which[open_to], each[which[open_to]], self._part[open_to]])
        first_of_part = np.unique(self._part[open_to][rank], return_index=True)[1]
        by_colour = np.argsort(which, kind="stable")
        ends = np.cumsum(each)
        found = []
        for v in open_to[rank][first_of_part][:_MOST_PARTS]:
            colour = which[v]
            alike = by_colour[ends[colour] - each[colour] : ends[colour]]
            found.append((*self._nearest(int(v), alike, known, order), int(v)))
        pairs, taken = [], set()
        for _, theirs, mine in sorted(found):
            if self._part[theirs] not in taken:
                taken.add(self._part[theirs])
                pairs.append((mine, theirs))
        return np.array(pairs, np.int64)

    def _nearest(self, vertex: int, alike: Int64, known: Int64, order: Int64) -> tuple[float, int]:
        """Of the mesh's vertices among `alike`, the one nearest to where `vertex` should have moved.

        It should have moved as the nearest vertex whose place is known has.
        """
        place = self._places[vertex]
        if len(known):
            guide = known[np.argmin(((self._places[known] - place) ** 2).sum(axis=1))]
            place = place + self._places[self._count + order[guide]] - self._places[guide]
        theirs = alike[alike >= self._count]
        gaps = ((self._places[theirs] - place) ** 2).sum(axis=1)
        nearest = int(np.argmin(gaps))
        return float(gaps[nearest]), int(theirs[nearest])

    def _fits(self, order: Int64) -> bool:
        """Whether the mesh's polygons in the neutral's numbers are the neutral's polygons."""
        number = np.empty(self._count, np.int32)
        number[order] = np.arange(self._count, dtype=np.int32)
        renumbered = replace(self._mesh, corner_vertices=number[self._mesh.corner_vertices])
        return same_polygons(self._neutral, renumbered)


def _connected(count: int, a: Int64, b: Int64) -> Int64:
    """For each of `count` vertices the lowest that edges a-b (E,) join it to, (count,)."""
    part = np.arange(count)
    while True:
        low = np.minimum(part[a], part[b])
        joined = part.copy()
        # An edge joins the parts of both its ends, so whole parts move at a time.
        np.minimum.at(joined, part[a], low)
        np.minimum.at(joined, part[b], low)
        joined = joined[joined]
        joined = joined[joined]
        if np.array_equal(joined, part):
            return part
        part = joined


def _mixed(values: _UInt64) -> _UInt64:
    """A well-spread hash of each value (SplitMix64's finish: G. Steele et al., 2014)."""
    values = values + np.uint64(0x9E3779B97F4A7C15)
    values = (values ^ (values >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    values = (values ^ (values >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return values ^ (values >> np.uint64(31))


def _around(sizes: Int32) -> tuple[Int64, Int64]:
    """For each corner of polygons of these sizes the corner after it, and the one before it, (C,) each."""
    sizes = sizes[sizes > 0]
    corner = np.arange(int(sizes.sum()))
    first = np.repeat(np.cumsum(sizes) - sizes, sizes)
    size = np.repeat(sizes, sizes)
    return first + (corner - first + 1) % size, first + (corner - first - 1) % size


def _place_colours(neutral: Mesh, mesh: Mesh) -> _UInt64:
    """A colour for each place where exactly one vertex of each mesh lies, 0 elsewhere, (2 V,)."""
    places = _row_hashes(np.concatenate([neutral.positions, mesh.positions]))
    count = neutral.vertex_count
    _, which, each = np.unique(places, return_inverse=True, return_counts=True)
    of_neutral = np.bincount(which[:count], minlength=len(each))
    alone = ((each == 2) & (of_neutral == 1))[which]
    return np.where(alone, places, np.uint64(0))


def _corner_uv_colours(mesh: Mesh) -> _UInt64:
    if mesh.corner_uvs is None:
        return np.zeros(len(mesh.corner_vertices), np.uint64)
    hashes = np.concatenate([_row_hashes(mesh.uvs), np.zeros(1, np.uint64)])
    return hashes[mesh.corner_uvs]


def _row_hashes(rows: Float32) -> _UInt64:
    """A hash of each row's bits; -0 counts as 0."""
    bits = np.ascontiguousarray(rows + np.float32(0.0)).view(np.uint32).astype(np.uint64)
    total = np.zeros(len(rows), np.uint64)
    for column in bits.T:
        total = _mixed(total + column)
    return total
