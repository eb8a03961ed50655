"""Scans whose truth is known: heads by formula in any triangulation, and people's skins meshed anew."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import ConvexHull

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.fit.parts import connected_parts

# Where landmarks sit on a head by formula, as directions from its middle.
PLACES = {
    "right eye": (-0.4, 0.25, 1.0),
    "left eye": (0.4, 0.25, 1.0),
    "nose": (0.0, 0.0, 1.0),
    "chin": (0.0, -0.8, 0.8),
    "right ear": (-1.0, 0.0, 0.05),
    "left ear": (1.0, 0.0, 0.05),
    "crown": (0.0, 1.0, 0.05),
}


def head_at(directions: np.ndarray, kind: float) -> np.ndarray:
    """Points (n, 3) of a lopsided head with a nose in some directions; `kind` tells heads apart."""
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    x, y, z = unit.T
    nose = 0.12 * (1.0 + 0.4 * kind) * np.exp(-((x / 0.18) ** 2 + (y / 0.25) ** 2)) * (z > 0)
    radius = 1.0 + nose + 0.06 * kind * np.sin(2.0 * x + 1.0) * y + 0.05 * (1 + kind) * y * z
    return unit * radius[:, None] * np.array([0.8 + 0.03 * kind, 1.1, 0.95])


def template_head(rings: int = 22, around: int = 34) -> Mesh:
    """A head of quads, kind 0, open below the chin as heads at the neck are."""
    down = np.linspace(0.06, 0.83, rings) * np.pi
    turn = np.arange(around) * 2.0 * np.pi / around
    v, u = np.meshgrid(down, turn, indexing="ij")
    directions = np.stack([np.sin(v) * np.sin(u), np.cos(v), np.sin(v) * np.cos(u)], axis=-1).reshape(-1, 3)
    index = np.arange(rings * around).reshape(rings, around)
    after = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], index[1:], after[1:], after[:-1]], axis=-1).reshape(-1, 4)
    return Mesh.from_polygons(head_at(directions, 0.0).astype(np.float32), quads)


def scanned_head(kind: float, count: int = 1500, seed: int = 0, noise: float = 0.0) -> Mesh:
    """A head of triangles between random points, closed, in an order of its own."""
    rng = np.random.default_rng(seed)
    directions = rng.normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    points = head_at(directions, kind) + rng.normal(scale=noise, size=(count, 3))
    return Mesh.from_triangles(points.astype(np.float32), hull_of(directions))


def hull_of(points: np.ndarray) -> np.ndarray:
    """Triangles (t, 3) int32 around points (n, 3) about 0 that are all on their hull, wound outwards."""
    triangles = ConvexHull(points).simplices.astype(np.int32)
    first, second, third = (points[triangles[:, corner]] for corner in range(3))
    inward = (np.cross(second - first, third - first) * first).sum(axis=1) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    return triangles


def skin_of(rig: Rig) -> tuple[np.ndarray, np.ndarray]:
    """The vertices (n,) of a face's largest part, and its triangles over them (t, 3)."""
    part = connected_parts(rig.triangles, rig.neutral.vertex_count)
    largest = int(np.bincount(part).argmax())
    kept = np.flatnonzero(part == largest)
    number = np.cumsum(part == largest) - 1
    return kept, number[rig.triangles[part[rig.triangles[:, 0]] == largest]]


def meshed_anew(points: np.ndarray, triangles: np.ndarray, count: int, seed: int = 0) -> Mesh:
    """The same surface with `count` other vertices: regions round random places of it, joined to triangles.

    Regions are measured along the surface, so the two lips are never joined.
    """
    rng = np.random.default_rng(seed)
    while len(points) < 3 * count:
        points, triangles = halved(points, triangles)
    ends = np.unique(np.sort(edges(triangles), axis=1), axis=0)
    lengths = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    graph = coo_matrix((lengths, (ends[:, 0], ends[:, 1])), shape=(len(points),) * 2).tocsr()
    chosen = np.sort(rng.choice(len(points), count, replace=False))
    _, _, source = dijkstra(graph, directed=False, indices=chosen, min_only=True, return_predecessors=True)
    label = np.searchsorted(chosen, source)
    order = rng.permutation(count)
    joined = order[label[triangles]]
    whole = (joined != np.roll(joined, 1, axis=1)).all(axis=1)
    _, first = np.unique(np.sort(joined[whole], axis=1), axis=0, return_index=True)
    placed = np.empty((count, 3))
    placed[order] = points[chosen]
    return Mesh.from_triangles(placed.astype(np.float32), joined[whole][np.sort(first)].astype(np.int32))


def halved(points: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same surface with every triangle cut in four."""
    ends, place = np.unique(np.sort(edges(triangles), axis=1), axis=0, return_inverse=True)
    a, b, c = triangles.T
    ab, bc, ca = len(points) + place.reshape(3, -1)
    cut = [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
    finer = np.concatenate([points, points[ends].mean(axis=1)])
    return finer, np.concatenate([np.stack(corners, axis=1) for corners in cut])


def edges(triangles: np.ndarray) -> np.ndarray:
    """(3 t, 2) ends, one edge of every triangle after another."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def with_triangles(mesh: Mesh, kept: np.ndarray) -> Mesh:
    """A mesh of triangles with some (t,) of them kept."""
    return Mesh.from_triangles(mesh.positions, mesh.corner_vertices.reshape(-1, 3)[kept])
