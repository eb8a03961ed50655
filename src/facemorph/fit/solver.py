"""Vertices from edges: one sparse system, factored once and solved for all shapes at once.

    (S^T S + diag(mu)) P = S^T D + mu P_prior

S is the edge matrix, D the edges asked for. mu is 1 where the template never moves, and 1e-5 on parts that
hang on nothing, which would drift away without it.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32
from facemorph.errors import FitError
from facemorph.fit.gradients import edge_matrix
from facemorph.fit.parts import Anchoring

_HELD = 1.0
_DRIFTING = 1e-5
# SuperLU is quickest with a few right sides at a time; between them another thread, a window, gets its turn.
_AT_ONCE = 8


class VertexSolver:
    """Bound to triangles and to what holds them; `solve` as often as is wanted."""

    def __init__(self, triangles: Int32, anchoring: Anchoring) -> None:
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import splu

        edges = edge_matrix(triangles, len(anchoring.part))
        self._pull = np.where(anchoring.still, _HELD, np.where(anchoring.drifting, _DRIFTING, 0.0))
        matrix = (edges.T @ edges + diags_array(self._pull)).tocsc()
        options = {"SymmetricMode": True}
        try:
            self._factor = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
        except RuntimeError as error:
            raise FitError(
                f"the surface cannot be solved for: {error}. Is a part of it without triangles?"
            ) from error
        gather = edges.T.tocsr()
        # +1 and -1 are exact in any precision, and no copy of the edges is made for them.
        self._gather = {np.dtype(kind): gather.astype(kind) for kind in (np.float32, np.float64)}

    def solve(self, edges: Float32 | Float64, prior: Float32 | Float64) -> Float64:
        """Positions or offsets (K, 3, V) whose edges come nearest to `edges` (K, 3, 2, T).

        `prior` (K, 3, V) is where anchored vertices are held.
        """
        gather = self._gather[edges.dtype]
        asked, held = edges.reshape(-1, gather.shape[1]), prior.reshape(-1, gather.shape[0])
        found = np.empty(held.shape)
        for first in range(0, len(found), _AT_ONCE):
            some = slice(first, first + _AT_ONCE)
            sides = self._pull * held[some]
            for side, row in zip(sides, asked[some], strict=True):
                side += gather @ row
            found[some] = self._factor.solve(sides.T).T
        return found.reshape(prior.shape)
