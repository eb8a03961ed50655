"""Cut the head and bust out of MakeHuman's body as one cage of quads.

The cut is a linear operator on the body's vertices, so every shape offset passes through it unchanged.
"""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from .source import BaseMesh

HEAD, MOUTH, BUST, SOCKET_A, SOCKET_B = range(5)
SOCKET_RINGS = 4


@dataclass(frozen=True)
class Cage:
    """faces, uv_faces: (m, 4) base-mesh indices; island: (m,) uv island of each face;
    cut: sparse (19158, 19158) that moves the vertices outside the bust onto its rim."""

    faces: np.ndarray
    uv_faces: np.ndarray
    island: np.ndarray
    cut: sp.csr_matrix


def undirected_edges(faces: np.ndarray) -> np.ndarray:
    """Unique edges (e, 2) of polygons (m, k), each with its lower index first."""
    pairs = np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2)
    return np.unique(np.sort(pairs, 1), axis=0)


def _inside(points: np.ndarray) -> np.ndarray:
    """Positive inside the bust: all of the head, and an ellipsoid of neck and shoulders."""
    centre, radii = np.array([0, 6.95, 0.25]), np.array([1.75, 1.62, 1.55])
    ellipsoid = 1 - (((points - centre) / radii) ** 2).sum(1)
    return np.where(points[:, 1] > 6.3, 1.0, np.where(points[:, 1] < 4.8, -1.0, ellipsoid))


def _cut_operator(faces: np.ndarray, inside: np.ndarray) -> sp.csr_matrix:
    """Slide outside vertices along their edges to where the bust ends."""
    n = len(inside)
    edges = undirected_edges(faces)
    both = np.concatenate([edges, edges[:, ::-1]])
    used = np.zeros(n, bool)
    used[faces.ravel()] = True
    outside = used & (inside <= 0)
    crossing = both[outside[both[:, 0]] & (inside[both[:, 1]] > 0)]
    out, kept = crossing.T
    t = inside[kept] / (inside[kept] - inside[out])
    count = np.bincount(out, minlength=n)
    rows, cols = np.concatenate([out, out]), np.concatenate([kept, out])
    slide = sp.csr_matrix((np.concatenate([1 - t, t]) / np.maximum(count[rows], 1), (rows, cols)), (n, n))
    moved = (slide + sp.diags((~outside).astype(float))).tocsr()
    return (moved + _corner_operator(both, outside & (count == 0), n) @ moved).tocsr()


def _corner_operator(both: np.ndarray, corner: np.ndarray, n: int) -> sp.csr_matrix:
    """Outside vertices without an inside neighbour follow the mean of their moved neighbours."""
    pairs = both[corner[both[:, 0]] & ~corner[both[:, 1]]]
    count = np.bincount(pairs[:, 0], minlength=n)
    return sp.csr_matrix((1 / count[pairs[:, 0]], (pairs[:, 0], pairs[:, 1])), (n, n))


def _islands(uv_faces: np.ndarray, uv_count: int) -> np.ndarray:
    """uv island of each face, the largest first."""
    links = (np.ones(uv_faces.size), (uv_faces.ravel(), np.roll(uv_faces, -1, 1).ravel()))
    _, label = connected_components(sp.coo_matrix(links, (uv_count, uv_count)), directed=False)
    label = label[uv_faces[:, 0]]
    order = sorted(np.unique(label), key=lambda i: (-(label == i).sum(), i))
    return np.array([order.index(i) for i in label])


def _shallow(faces: np.ndarray, island: np.ndarray, vertex_count: int) -> np.ndarray:
    """Faces to keep: the deep rings of the eye sockets would pierce the cheeks in strong expressions."""
    rim = np.zeros(vertex_count, bool)
    for socket in (SOCKET_A, SOCKET_B):
        rim[np.intersect1d(faces[island == HEAD], faces[island == socket])] = True
    in_socket = island >= SOCKET_A
    near = in_socket
    for _ in range(SOCKET_RINGS):
        near = in_socket & rim[faces].any(1)
        rim[faces[near]] = True
    return ~in_socket | near


def build_cage(base: BaseMesh) -> Cage:
    faces, uv_faces = base.faces["body"], base.uv_faces["body"]
    inside = _inside(base.points)
    # The ellipsoid would also catch hands and arms.
    torso = (np.abs(base.points[:, 0]) < 2.2) & (base.points[:, 1] > 4.8)
    keep = (inside[faces] > 0).any(1) & torso[faces].all(1)
    faces, uv_faces = faces[keep], uv_faces[keep]
    cut = _cut_operator(faces, inside)
    island = _islands(uv_faces, len(base.uv))
    keep = _shallow(faces, island, len(base.points))
    return Cage(faces[keep], uv_faces[keep], island[keep], cut)
