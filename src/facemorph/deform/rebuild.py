"""The thesis's own use of RBF: rebuild a target expression from n control points, and say how well (2.3).

The displacement of n points from the source to the target expression is all that is known of the target;
the field through them moves the whole face, and the distance to the true target is the error.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float32, Int32
from facemorph.core.rig import Rig
from facemorph.deform.rbf import Kernel, RbfField


@dataclass(frozen=True, eq=False)
class Rebuilt:
    """A rebuilt expression.

    positions    (V, 3) float32; errors (V,) float32, model units, against the true target
    bind_secs    forming the matrix; drag_secs the one product
    """

    positions: Float32
    errors: Float32
    diagonal: float
    bind_secs: float
    drag_secs: float

    @property
    def rms_percent(self) -> float:
        """Root mean square error in percent of the face's diagonal."""
        return float(np.sqrt(np.mean(self.errors.astype(np.float64) ** 2))) / self.diagonal * 100.0

    @property
    def max_percent(self) -> float:
        """Largest error in percent of the face's diagonal."""
        return float(self.errors.max(initial=0.0)) / self.diagonal * 100.0


def rebuilt(
    rig: Rig, source: Float32, target: Float32, vertices: Int32, kernel: Kernel = "r", c: float | None = None
) -> Rebuilt:
    """The target (V, 3) rebuilt from the source (V, 3) and the control points at `vertices` (n,).

    Raises `DeformError` and `OptionError` as `RbfField` does.
    """
    begun = time.perf_counter()
    field = RbfField(source[vertices].astype(np.float64), source, kernel, c)
    bound = time.perf_counter()
    positions = source + field((target - source)[vertices].astype(np.float64))
    dragged = time.perf_counter()
    errors = np.linalg.norm(positions - target, axis=1).astype(np.float32)
    return Rebuilt(positions, errors, rig.neutral.diagonal, bound - begun, dragged - bound)
