"""Step B by itself, as the digest states it; the fit's own counts correctives too (`fit.explaining`)."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.fit.steps import bounded_minimum, checked_gram, mean_motion


def fitted_weights(
    shapes: Float64, examples: Float64, near: Float64, stiffness: float, upper: float = 1.0
) -> Float64:
    """Step B where no correctives follow: weights X (m, K) in [0, upper], each row the minimum of

        |t_j - B x_j|^2 + stiffness (trace(B^T B) / K) |x_j - near_j|^2

    shapes    B^T (K, N), one row a shape: coordinates of all vertices, as offsets from neutral
    examples  (m, N), the examples' offsets; near (m, K)
    stiffness without a unit: 1 weighs a change of a weight as a typical shape's whole motion
    """
    gram = checked_gram(shapes)
    pull = stiffness * mean_motion(gram)
    gram[np.diag_indices_from(gram)] += pull
    sides = examples @ shapes.T + pull * near
    return np.stack([bounded_minimum(gram, side, upper, row) for side, row in zip(sides, near, strict=True)])
