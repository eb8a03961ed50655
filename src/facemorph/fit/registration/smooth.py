"""A surface that follows targets and stays smooth: the bi-Laplacian of its displacement is small.

    minimise over u   s (|L u|^2 + b sum_edges |u_i - u_j|^2) + sum_i c_i |x_i + u_i - q_i|^2

with L the umbrella operator, u_i less the mean of its neighbours: no unit, so that s means the same at any
scale. The small second term keeps what no target holds, such as the back of a head of which only the face
was scanned, from leaving along a straight line. One sparse factor serves the three coordinates.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.errors import FitError
from facemorph.fit.registration.turning import neighbours_of

# The bi-Laplacian rules over distances of up to about ten edges, the membrane beyond.
_MEMBRANE = 0.002
# So little that only what nothing else holds is held by it.
_HELD = 1e-7


class SmoothSurface:
    """Triangles (T, 3) over V vertices, bound once."""

    def __init__(self, triangles: Int64, vertex_count: int) -> None:
        from scipy.sparse import diags_array

        joined = neighbours_of(triangles, vertex_count)
        valence = np.asarray(joined.sum(axis=1)).ravel()
        umbrella = (
            diags_array((valence > 0).astype(float)) - diags_array(1.0 / np.maximum(valence, 1.0)) @ joined
        )
        membrane = diags_array(valence) - joined
        self._umbrella = umbrella.tocsr()
        self._energy = (umbrella.T @ umbrella + _MEMBRANE * membrane).tocsc()

    def bends(self, points: Float64) -> Float64:
        """How far each of points (V, 3) stands out from the mean of its neighbours, L x, (V, 3)."""
        return np.asarray(self._umbrella @ points)

    def moved(
        self, points: Float64, targets: Float64, pull: Float64, stiffness: float, bend: Float64 | None = None
    ) -> Float64:
        """Points (V, 3) displaced smoothly towards targets (V, 3) that pull by `pull` (V,), 0 for none.

        `bend` (V, 3) is what L u should be, where that is not 0.
        """
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import splu

        matrix = (stiffness * self._energy + diags_array(pull + _HELD * stiffness)).tocsc()
        options = {"SymmetricMode": True}
        try:
            factor: Any = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
        except RuntimeError as error:
            raise FitError(f"the template cannot be laid on the scan: {error}.") from error
        sides = pull[:, None] * (targets - points)
        if bend is not None:
            sides += stiffness * (self._umbrella.T @ bend)
        return np.asarray(points + factor.solve(np.asfortranarray(sides)))
