"""The whole skin at one level of subdivision: textures, hair and occlusion are worked out on it."""

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from .atlas import build_atlas
from .cage import HEAD, Cage
from .source import BaseMesh
from .subdivide import Refinement, compact, refine_linear, refine_smooth, triangulate


@dataclass(frozen=True)
class FineMesh:
    """operator: sparse (n, 19158) from base-mesh points to fine points.

    base_vertices: (c,) the base-mesh vertices that the first c fine points stand for.
    coarse, coarse_uv: (m, 4) cage faces in fine indices; smooth and flat: how they split, for points
    and for uv; quads, uv_quads: (4m, 4); uv, source_uv: (t, 2) in the atlas and in MakeHuman's layout;
    island: (4m,); on_head: (n,) true on the head's outside.
    """

    operator: sp.csr_matrix
    base_vertices: np.ndarray
    coarse: np.ndarray
    coarse_uv: np.ndarray
    coarse_island: np.ndarray
    smooth: Refinement
    flat: Refinement
    quads: np.ndarray
    uv_quads: np.ndarray
    uv: np.ndarray
    source_uv: np.ndarray
    island: np.ndarray
    on_head: np.ndarray

    @property
    def triangles(self) -> np.ndarray:
        return triangulate(self.quads)

    @property
    def uv_triangles(self) -> np.ndarray:
        return triangulate(self.uv_quads)

    def averaging(self) -> sp.csr_matrix:
        """Sparse (n, n): the mean of each vertex's neighbours."""
        n = self.operator.shape[0]
        edges = np.concatenate([self.quads[:, [i, (i + 1) % 4]] for i in range(4)])
        rows, cols = np.concatenate([edges, edges[:, ::-1]]).T
        links = sp.coo_matrix((np.ones(len(rows)), (rows, cols)), (n, n)).tocsr()
        return sp.diags(1 / np.maximum(np.asarray(links.sum(1)).ravel(), 1)) @ links


def build_fine_mesh(base: BaseMesh, cage: Cage) -> FineMesh:
    used, coarse = compact(cage.faces)
    used_uv, coarse_uv = compact(cage.uv_faces)
    atlas = build_atlas(cage, base.uv)[used_uv]
    smooth, flat = refine_smooth(len(used), coarse), refine_linear(len(used_uv), coarse_uv)
    quads, island = smooth.quads(coarse), np.repeat(cage.island, 4)
    operator = (smooth.operator @ cage.cut[used].tocsr()).tocsr()
    on_head = np.zeros(operator.shape[0], bool)
    on_head[quads[island == HEAD].ravel()] = True
    return FineMesh(
        operator,
        used,
        coarse,
        coarse_uv,
        cage.island,
        smooth,
        flat,
        quads,
        flat.quads(coarse_uv),
        flat.operator @ atlas,
        flat.operator @ base.uv[used_uv],
        island,
        on_head,
    )
