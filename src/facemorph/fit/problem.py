"""One fit under way: the examples in the template's place, and the shapes as found so far."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int64
from facemorph.fit.align import diagonal_of, similarity
from facemorph.fit.explaining import Explaining, flat
from facemorph.fit.gradients import edges_of
from facemorph.fit.parts import PartMeans
from facemorph.fit.steps import freedom, freedom_to_go, pulled_shapes, pulls
from facemorph.fit.transferring import Transfer

# Fewer still vertices than this say little about where an example's head is.
_ENOUGH_STILL = 12
_AT_ONCE = 8
# Shapes of smaller weights in every example stay at deformation transfer in step A.
_HARDLY_USED = 0.02


class FitProblem:
    """The state of steps A and B. Weights are (m, n) over the shapes `used`; those of correctives follow.

    planes  (K, 3, V) float64, all shapes as found so far, as offsets from the neutral in the template's
            place; they begin as plain deformation transfer
    moves   (m, 3, V), the examples likewise
    explaining  finds weights for shapes, and says which coefficients follow from them
    """

    def __init__(
        self, way: Transfer, examples: Sequence[Float64], used: Sequence[str], *, hold_still: bool
    ) -> None:
        self.way = way
        self.used = tuple(used)
        self.planes = way.planes.copy()
        self.moves = placed_moves(way, examples, hold_still=hold_still)
        self.explaining = Explaining(way.template, self.used)
        self._changed = np.zeros(0, np.int64)
        triangles = way.template.triangles
        edges = [edges_of(move.T, triangles).astype(np.float32) for move in self.moves]
        self._edges = np.stack(edges).reshape(len(edges), 6, -1)
        self._free = freedom(way.motion.change)
        self._parts = _FloatingParts(way, self.moves)

    @property
    def diagonal(self) -> float:
        """The neutral's diagonal as its own axes measure it, in the template's size."""
        way = self.way.way
        own = way.inverse().points(self.way.neutral)
        return way.scale * diagonal_of(own)

    @property
    def offsets(self) -> Float64:
        """All shapes as found so far, (V, 3, K), as offsets from the neutral."""
        return self.planes.transpose(2, 1, 0)

    def reset(self) -> None:
        """Back to plain deformation transfer."""
        self.planes[self._changed] = self.way.planes[self._changed]
        self._changed = np.zeros(0, np.int64)

    def fit_shapes(self, weights: Float64, alpha: float) -> None:
        """Step A: new shapes from weights (m, n)."""
        self.reset()
        every = self.explaining.coefficients(weights)
        live = np.flatnonzero((every > _HARDLY_USED).any(axis=0))
        if not len(live):
            return
        free = np.zeros_like(self._free)
        free[live] = self._free[live]
        prior = self.way.motion.edges.reshape(len(free), 6, -1)
        found = pulls(prior, free, self._edges, every, alpha)
        parts = self._parts.pulls(live, every, alpha)
        for first in range(0, len(live), _AT_ONCE):
            some = live[first : first + _AT_ONCE]
            made = pulled_shapes(found, free[some], every[:, some]).reshape(len(some), 3, 2, -1)
            held = self._parts.correction(parts, some, every)
            self.planes[some] += self.way.solver.solve(made, held)
        self._changed = live

    def fit_weights(self, near: Float64, stiffness: float) -> Float64:
        """Step B: weights (m, n) near `near` for the present shapes."""
        return self.explaining.weights(self.planes, self.moves, near, stiffness)

    def residual_offsets(self, weights: Float64) -> Float32:
        """What weights (m, n) leave of each example, (m, V, 3), in the target's place and unit."""
        left = self._left(weights).transpose(0, 2, 1)
        return self.way.way.inverse().offsets(left).astype(np.float32)

    def rms_percent(self, weights: Float64) -> float:
        """Root mean square distance to all examples in percent of the neutral's diagonal."""
        left = self._left(weights)
        return 100.0 * float(np.sqrt((left**2).sum(axis=1).mean())) / self.diagonal

    def _left(self, weights: Float64) -> Float64:
        return left_over(self.moves, self.planes, self.explaining.coefficients(weights))


def left_over(moves: Float64, planes: Float64, coefficients: Float64) -> Float64:
    """What shapes `planes` (K, 3, V) in coefficients (m, K) leave of `moves` (m, 3, V), likewise."""
    made = coefficients @ flat(planes)
    return np.asarray(moves - made.reshape(moves.shape))


def placed_moves(way: Transfer, examples: Sequence[Float64], *, hold_still: bool) -> Float64:
    """Examples, positions (V, 3) each, as offsets from the neutral in the template's place, (m, 3, V).

    hold_still  put each rigidly where the neutral is, by the vertices that the template never moves: those of
                the skin, where there are enough
    """
    still, neutral = way.anchoring.still & way.anchoring.main, way.neutral
    if np.count_nonzero(still) < _ENOUGH_STILL:
        still = way.anchoring.still
    moves = np.empty((len(examples), *neutral.T.shape))
    for move, points in zip(moves, examples, strict=True):
        placed = way.way.points(points)
        if hold_still and np.count_nonzero(still) >= _ENOUGH_STILL:
            placed = similarity(placed[still], neutral[still], scaled=False).points(placed)
        np.subtract(placed.T, neutral.T, out=move)
    return moves


class _FloatingParts:
    """Where parts that hang on nothing go: step A for the mean motion of each, as if it were an edge."""

    def __init__(self, way: Transfer, moves: Float64) -> None:
        held = way.anchoring
        self._vertices = np.flatnonzero(held.drifting)
        self._part = held.part[self._vertices]
        self._shape = (3, len(held.part))
        count = len(held.floating)
        self._means = PartMeans(self._part, count)
        self._moves, self._prior = self._mean_moves(moves), self._mean_moves(way.planes)
        furthest = np.array([np.sqrt((plane**2).sum(axis=0).max()) for plane in way.planes])
        self._free = freedom_to_go(np.sqrt((self._prior**2).sum(axis=1)), furthest)

    def _mean_moves(self, planes: Float64) -> Float32:
        """The mean of offsets (K, 3, V) over each part, (K, 3, P)."""
        means = [self._means(plane[:, self._vertices]) for plane in planes]
        return np.array(means, np.float32).reshape(len(planes), 3, self._means.count)

    def pulls(self, live: Int64, weights: Float64, alpha: float) -> Float32 | Float64:
        """Step A's unknowns (m, 3, P) for coefficients (m, K); only shapes `live` may change."""
        free = np.zeros_like(self._free)
        free[live] = self._free[live]
        return pulls(self._prior, free, self._moves, weights, alpha)

    def correction(self, found: Float32 | Float64, some: Int64, weights: Float64) -> Float32:
        """How much further the vertices of floating parts go in shapes `some` than transferred, (n, 3, V)."""
        made = np.zeros((len(some), *self._shape), np.float32)
        shift = pulled_shapes(found, self._free[some], weights[:, some])
        made[..., self._vertices] = shift[..., self._part]
        return made
