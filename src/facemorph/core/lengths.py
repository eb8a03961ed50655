"""How far vertices move: one formula for heat maps, lit-up regions and the choice of control points."""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32


def lengths(vectors: Float32) -> Float32:
    """Lengths (V,) of vectors (V, 3), float32."""
    result: Float32 = np.sqrt(np.einsum("vi,vi->v", vectors, vectors))
    return result


def displacements(positions: Float32, reference: Float32) -> Float32:
    """How far each vertex is from its place in `reference`, (V,), for positions and reference (V, 3)."""
    return lengths(positions - reference)
