"""Which part of a face a shape moves, as light: 0 where it stays, 1 where it moves most."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from facemorph.core.arrays import Float32
from facemorph.core.lengths import lengths
from facemorph.core.rig import Rig
from facemorph.errors import UnknownNameError


def glow_of(rig: Rig, weights: Mapping[str, float]) -> Float32:
    """|sum_k w_k delta_k| of each vertex by its largest, (V,) float32 0..1: what `Scene.glow` takes.

    All 0 where the shapes move nothing. Raises `UnknownNameError`.
    """
    moved = np.zeros_like(rig.neutral.positions)
    for name, weight in weights.items():
        if name not in rig.names:
            raise UnknownNameError("shape", name, rig.names)
        moved += np.float32(weight) * rig.deltas[rig.names.index(name)]
    away = lengths(moved)
    largest = float(away.max(initial=0.0))
    return away / np.float32(largest) if largest > 0.0 else away
