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
from facemorph.errors import DeformError

# How much a place that does not move counts beside the one that moves most.
STILL_IMPORTANCE = 0.3
LANDMARK_SHARE = 0.8


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


def control_vertices(rig: Rig, count: int, moved: Float32 | None = None) -> Int32:
    """`count` vertices that cover the face: always the one farthest from those chosen before.

    Landmarks are chosen first, for a part of the count (`LANDMARK_SHARE`), then any vertices.

    moved   (V,) how far each vertex moves; where given, distances count more where more moves, so that
            points gather there and some still hold the rest. Vertices at one place count once. Raises
            `DeformError` where there are not so many places.
    """
    positions = rig.neutral.positions.astype(np.float64)
    importance = np.ones(len(positions))
    if moved is not None and float(moved.max(initial=0.0)) > 0.0:
        importance = STILL_IMPORTANCE + moved.astype(np.float64) / float(moved.max())
    chosen: list[int] = []
    distance = np.full(len(positions), np.inf)
    marked = np.zeros(len(positions))
    marked[[mark.vertex for mark in rig.info.landmarks]] = 1.0
    _take(int(np.argmax(importance * (marked if marked.any() else 1.0))), chosen, distance, positions)
    while len(chosen) < count:
        score = distance * importance
        among_marks = len(chosen) < LANDMARK_SHARE * count and (score * marked).any()
        farthest = int(np.argmax(score * marked if among_marks else score))
        if distance[farthest] <= 1e-6 * rig.neutral.diagonal:
            raise DeformError(
                f"the face has only {len(chosen)} different places; {count} points were asked for."
            )
        _take(farthest, chosen, distance, positions)
    return np.array(chosen[:count], np.int32)


def _take(
    vertex: int, chosen: list[int], distance: np.ndarray[tuple[int], np.dtype[np.float64]],
    positions: np.ndarray[tuple[int, int], np.dtype[np.float64]],
) -> None:  # fmt: skip
    chosen.append(vertex)
    np.minimum(distance, np.linalg.norm(positions - positions[vertex], axis=1), out=distance)
