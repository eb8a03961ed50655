"""Catmull-Clark subdivision as sparse matrices, so that shapes can be subdivided like positions."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp


@dataclass(frozen=True)
class Refinement:
    """One level of subdivision of m quads over n vertices with e edges.

    operator: sparse (n + e + m, n); the new vertices are the old ones, the edges', then the faces'.
    edge_of: (m, 4) new vertex on the edge from corner i to corner i + 1; face_of: (m,) new vertex inside.
    """

    operator: sp.csr_matrix
    edge_of: np.ndarray
    face_of: np.ndarray

    def quads(self, faces: np.ndarray) -> np.ndarray:
        """The four quads of every face, (4m, 4)."""
        e, f = self.edge_of, self.face_of
        corners = [np.stack([faces[:, i], e[:, i], f, e[:, i - 1]], -1) for i in range(4)]
        return np.stack(corners, 1).reshape(-1, 4)


def _pairs(n: int, faces: np.ndarray):
    """Unique edges (e, 2), the edge of each face side (m, 4) and how many faces share each edge."""
    sides = np.sort(np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2), 1)
    edges, inverse, count = np.unique(sides, axis=0, return_inverse=True, return_counts=True)
    return edges, inverse.reshape(faces.shape), count


def _selection(rows, cols, shape, weight=1.0) -> sp.csr_matrix:
    return sp.csr_matrix((np.full(len(rows), weight), (rows, cols)), shape)


def _averages(n: int, faces: np.ndarray, edges: np.ndarray):
    """Operators for the middles of faces (m, n) and of edges (e, n)."""
    m, e = len(faces), len(edges)
    face_mid = _selection(np.repeat(np.arange(m), 4), faces.ravel(), (m, n), 0.25)
    edge_mid = _selection(np.repeat(np.arange(e), 2), edges.ravel(), (e, n), 0.5)
    return face_mid, edge_mid


def refine_linear(n: int, faces: np.ndarray) -> Refinement:
    """Split at the middles without smoothing: right for texture coordinates."""
    edges, side, _ = _pairs(n, faces)
    face_mid, edge_mid = _averages(n, faces, edges)
    operator = sp.vstack([sp.identity(n), edge_mid, face_mid]).tocsr()
    return Refinement(operator, n + side, n + len(edges) + np.arange(len(faces)))


def refine_smooth(n: int, faces: np.ndarray) -> Refinement:
    """Catmull-Clark's rules; borders follow the cubic curve rule."""
    edges, side, count = _pairs(n, faces)
    face_mid, edge_mid = _averages(n, faces, edges)
    m, e = len(faces), len(edges)
    edge_faces = _selection(side.ravel(), np.repeat(np.arange(m), 4), (e, m))
    inner = (count == 2).astype(float)
    face_mean = sp.diags(1 / count) @ edge_faces @ face_mid
    edge_points = sp.diags(inner) @ (0.5 * edge_mid + 0.5 * face_mean) + sp.diags(1 - inner) @ edge_mid
    old = _smooth_old(n, faces, edges, count, face_mid, edge_mid)
    operator = sp.vstack([old, edge_points, face_mid]).tocsr()
    return Refinement(operator, n + side, n + e + np.arange(m))


def _smooth_old(n, faces, edges, count, face_mid, edge_mid) -> sp.csr_matrix:
    """New places of the old vertices, (n, n)."""
    m, e = len(faces), len(edges)
    vertex_faces = _selection(faces.ravel(), np.repeat(np.arange(m), 4), (n, m))
    vertex_edges = _selection(edges.ravel(), np.repeat(np.arange(e), 2), (n, e))
    face_valence = np.asarray(vertex_faces.sum(1)).ravel()
    valence = np.maximum(np.asarray(vertex_edges.sum(1)).ravel(), 1)
    inside = (
        sp.diags(1 / valence / np.maximum(face_valence, 1)) @ vertex_faces @ face_mid
        + sp.diags(2 / valence**2) @ vertex_edges @ edge_mid
        + sp.diags((valence - 3) / valence)
    )
    border_edges = np.flatnonzero(count != 2)
    touching = _selection(edges[border_edges].ravel(), np.repeat(border_edges, 2), (n, e))
    border_valence = np.asarray(touching.sum(1)).ravel()
    border = 0.5 * sp.identity(n) + 0.5 * sp.diags(1 / np.maximum(border_valence, 1)) @ touching @ edge_mid
    lonely, on_border = face_valence == 0, border_valence > 0
    return (
        sp.diags((~on_border & ~lonely).astype(float)) @ inside
        + sp.diags((on_border & ~lonely).astype(float)) @ border
        + sp.diags(lonely.astype(float))
    )


def compact(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Used indices (ascending) and the faces renumbered into them."""
    used, inverse = np.unique(faces, return_inverse=True)
    return used, inverse.reshape(faces.shape)


def triangulate(quads: np.ndarray) -> np.ndarray:
    """Each quad (a, b, c, d) becomes two consecutive triangles (a, b, c), (a, c, d)."""
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], 1).reshape(-1, 3)


def vertex_normals(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Area-weighted unit normals (n, 3)."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    face_normal = np.cross(b - a, c - a)
    total = np.zeros_like(points)
    for i in range(3):
        np.add.at(total, triangles[:, i], face_normal)
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-12)
