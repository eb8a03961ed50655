"""`Counterpart`: what another mesh of the same polygons has at each drawn vertex and triangle of a mesh.

The meshes may differ in their texture coordinates, and in the order of their polygons and where each
polygon begins. A vertex is drawn once for each set of position, own and others' texture coordinates;
where the others' are the mesh's own, as between the built-in people, nothing is split further.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from facemorph.core.arrays import Float32, Int32, Int64
from facemorph.core.mesh import Labels, Mesh
from facemorph.core.split import SplitVertices
from facemorph.core.triangles import Triangles


@dataclass(frozen=True, eq=False)
class Counterpart:
    """The other mesh over T triangles and G drawn vertices.

    uvs      (G, 2) float32 of the other mesh; None where they are the same as the mesh's own
    polygon  (T,) int32, the other mesh's polygon that each triangle is part of
    """

    mesh: Mesh
    uvs: Float32 | None
    polygon: Int32


def counterparts(
    mesh: Mesh, triangles: Triangles, split: SplitVertices, others: Sequence[Mesh]
) -> tuple[SplitVertices, tuple[Counterpart, ...]]:
    """The drawn vertices of `mesh`, split by everybody's texture coordinates, and each other mesh over them.

    `split` are the vertices as the mesh alone has them; the others correspond to it.
    """
    found: list[Counterpart] = []
    for other in others:
        corners = corresponding_corners(mesh, other)[triangles.corners]
        polygon_of = np.repeat(np.arange(other.polygon_count, dtype=np.int32), np.diff(other.polygon_starts))
        split, parent, uvs = _split_by(split, other, corners)
        found = [kept if kept.uvs is None else replace(kept, uvs=kept.uvs[parent]) for kept in found]
        found.append(Counterpart(other, uvs, polygon_of[corners[:, 0]]))
    return split, tuple(found)


def _split_by(
    split: SplitVertices, other: Mesh, corners: Int64
) -> tuple[SplitVertices, Int64 | slice, Float32 | None]:
    """`split` by the other mesh's coordinates at `corners` (T, 3): it, where its vertices were, those."""
    if other.corner_uvs is None or not len(other.uvs):
        uv = np.full(corners.shape, -1, np.int64)
    else:
        uv = other.corner_uvs[corners].astype(np.int64)
    known = np.concatenate([np.zeros((1, 2), np.float32), other.uvs]).astype(np.float32)
    if np.array_equal(known[uv + 1], split.uvs[split.triangles]):
        return split, slice(None), None
    pairs, drawn = np.unique(split.triangles.astype(np.int64) * len(known) + (uv + 1), return_inverse=True)
    parent, uv_of = np.divmod(pairs, len(known))
    finer = SplitVertices(
        split.position_of[parent], split.uvs[parent], drawn.reshape(corners.shape).astype(np.int32)
    )
    return finer, parent, known[uv_of]


def in_order_of(mesh: Mesh, other: Mesh) -> Mesh:
    """`other` with its polygons in the order of `mesh`'s, each begun where that one's begins."""
    corners = corresponding_corners(mesh, other)
    if np.array_equal(corners, np.arange(len(corners))):
        return other
    polygon_of = np.repeat(np.arange(other.polygon_count), np.diff(other.polygon_starts))
    lasting = np.diff(mesh.polygon_starts) > 0
    polygon = np.zeros(mesh.polygon_count, np.int64)
    polygon[lasting] = polygon_of[corners[mesh.polygon_starts[:-1][lasting]]]
    return replace(
        other,
        polygon_starts=mesh.polygon_starts,
        corner_vertices=mesh.corner_vertices,
        corner_uvs=None if other.corner_uvs is None else other.corner_uvs[corners],
        corner_normals=None,
        groups=_reordered(other.groups, polygon),
        objects=_reordered(other.objects, polygon),
        materials_used=_reordered(other.materials_used, polygon),
    )


def _reordered(labels: Labels | None, polygon: Int64) -> Labels | None:
    return None if labels is None else Labels(labels.names, labels.index[polygon])


def corresponding_corners(mesh: Mesh, other: Mesh) -> Int64:
    """For each corner (C,) of `mesh` the one of `other` in the same polygon at the same vertex."""
    found = np.arange(len(mesh.corner_vertices), dtype=np.int64)
    if np.array_equal(mesh.polygon_starts, other.polygon_starts) and np.array_equal(
        mesh.corner_vertices, other.corner_vertices
    ):
        return found
    for size in np.unique(np.diff(mesh.polygon_starts)).tolist():
        if size:
            found[_ordered_corners(mesh, size)] = _ordered_corners(other, size)
    return found


def _ordered_corners(mesh: Mesh, size: int) -> Int64:
    """Corners (n, size) of the polygons of one size: each begun at its lowest vertex, in ascending order."""
    first = mesh.polygon_starts[:-1][np.diff(mesh.polygon_starts) == size].astype(np.int64)
    lowest = mesh.corner_vertices[first[:, None] + np.arange(size)].argmin(axis=1)
    corners: Int64 = first[:, None] + (lowest[:, None] + np.arange(size)) % size
    return corners[np.lexsort(mesh.corner_vertices[corners].T[::-1])]
