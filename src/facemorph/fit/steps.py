"""The two steps that the fit alternates: A finds the blendshapes' edges, B the examples' weights.

After Li, Weise and Pauly, *Example-based facial rigging* (2010), eqs. 6 and 9, in closed form.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.errors import FitError

_KAPPA = 0.1
_PERCENTILE = 95.0
# Of shapes that move few triangles, or none, that percentile is what does not move.
_SCALE_FLOOR = 0.1
# Triangles whose systems are solved at once hold this many numbers, what a cache takes; and so many at least.
_AT_ONCE = 100_000
_TRIANGLES_AT_ONCE = 1000
# Smaller ones want double precision; and one of 0 would leave examples of the same weights singular.
_ENOUGH_FOR_SINGLE = 1e-3
_LEAST_ALPHA = 1e-10
# What a shape's motion adds to the diagonal, of the largest: shapes alike leave no pivot at 0.
_RIDGE = 1e-12


def freedom(change: Float32) -> Float32:
    """1 / w (K, T) of `change` q (K, T): how free each triangle of each shape is to leave the template's way.

    w = ((1 + q) / (0.1 + q))^2 with q = |H - I|: where the template does not move, the target should
    not. 1 / w is divided by its 95th percentile over the triangles of each shape, 0.1 at least, which makes
    the same alpha mean the same for shapes that move little and much.
    """
    free = ((_KAPPA + change) / (1.0 + change)) ** 2
    if free.size:
        free /= np.maximum(np.percentile(free, _PERCENTILE, axis=1, keepdims=True), _SCALE_FLOOR)
    return np.asarray(free, np.float32)


def freedom_to_go(moved: Float32, furthest: Float64) -> Float32:
    """1 / w (K, P) of parts that go by `moved` (K, P), in shapes whose vertices go `furthest` (K,) at most.

    1 for a part that goes as far. Edges do not tell that of teeth that a jaw lowers, or of an eyeball that
    turns where it is.
    """
    share = moved / np.maximum(furthest, 1e-300)[:, None]
    return np.asarray(((_KAPPA + share) / (1.0 + share) * 2.0 / (_KAPPA + 1.0)) ** 2, np.float32)


def pulls(
    prior: Float32, free: Float32, examples: Float32, weights: Float64, alpha: float
) -> Float32 | Float64:
    """Step A's unknowns Y (m, R, T), which `pulled_shapes` makes shapes of: for every T by itself

        Y = (alpha I + X W^-1 X^T)^-1 (E - X D*)

    prior     D* (K, R, T), what the template would do: R rows (edges' coordinates) of each of T triangles
    free      W^-1 (K, T), see `freedom`; 0 for shapes that stay as they are
    examples  E (m, R, T); weights X (m, K)
    """
    m = len(weights)
    lacking = examples - (weights.astype(np.float32) @ prior.reshape(len(prior), -1)).reshape(examples.shape)
    products = (weights[:, None] * weights[None]).reshape(m * m, -1)
    # Examples alike in their weights pull against each other by what differs over alpha.
    found = np.empty_like(lacking) if alpha >= _ENOUGH_FOR_SINGLE else np.empty(lacking.shape)
    step = max(_AT_ONCE // (m * (m + lacking.shape[1])), _TRIANGLES_AT_ONCE)
    for first in range(0, lacking.shape[2], step):
        some = slice(first, first + step)
        systems = (products @ free[:, some].astype(np.float64)).reshape(m, m, -1)
        systems[np.arange(m), np.arange(m)] += alpha + _LEAST_ALPHA * np.einsum("jjt->t", systems)
        found[..., some] = _solved(systems, lacking[..., some].astype(np.float64))
    return found


def _solved(systems: Float64, sides: Float64) -> Float64:
    """Solutions (m, R, T) of T positive definite systems (m, m, T) with R right sides each, all at once.

    Elimination without pivoting; both arrays are used up.
    """
    m = len(systems)
    for k in range(m):
        for i in range(k + 1, m):
            share = systems[i, k] / systems[k, k]
            systems[i, k + 1 :] -= share * systems[k, k + 1 :]
            sides[i] -= share * sides[k]
    for k in reversed(range(m)):
        for i in range(k + 1, m):
            sides[k] -= systems[k, i] * sides[i]
        sides[k] /= systems[k, k]
    return sides


def pulled_shapes(found: Float32 | Float64, free: Float32, weights: Float64) -> Float32 | Float64:
    """Step A: D - D* = W^-1 X^T Y (K, R, T) where D is, for every T by itself, the minimum of

        sum_j |E_j - sum_i x_ji D_i|^2 + alpha sum_i w_i |D_i - D*_i|^2

    found  Y (m, R, T) of `pulls`; free W^-1 (K, T); weights X (m, K): of all shapes, or of some
    """
    made = np.matmul(weights.T.astype(found.dtype), found.reshape(len(found), -1))
    shaped = made.reshape(-1, *found.shape[1:])
    shaped *= free[:, None]
    return np.asarray(shaped)


def checked_gram(shapes: Float64) -> Float64:
    """B^T B (K, K) of shapes B^T (K, N). Raises `FitError` where it is not finite."""
    gram = shapes @ shapes.T
    if not np.isfinite(gram).all():
        raise FitError("the shapes found so far are no finite numbers; are neutral and examples one face's?")
    return np.asarray(gram)


def mean_motion(gram: Float64) -> float:
    """trace / K of a Gram matrix (K, K): a typical shape's whole motion, squared."""
    return float(np.trace(gram)) / max(len(gram), 1)


def bounded_minimum(
    gram: Float64, side: Float64, upper: float = 1.0, begin: Float64 | None = None
) -> Float64:
    """The x (K,) in [0, upper] that minimises x^T G x / 2 - side^T x, for G (K, K) positive semidefinite.

    Active sets after Lawson and Hanson, with both bounds. `begin` is where the search starts, 0 where not
    given: near the minimum it is short. A shape without any motion stays 0.
    """
    diagonal = np.diag(gram)
    live = np.flatnonzero(diagonal > _RIDGE * max(float(diagonal.max(initial=0.0)), 1e-300))
    found = np.zeros(len(side))
    if len(live):
        scale = 1.0 / np.sqrt(diagonal[live])
        scaled = gram[np.ix_(live, live)] * scale * scale[:, None]
        scaled[np.diag_indices_from(scaled)] += _RIDGE
        start = np.zeros(len(live)) if begin is None else np.clip(begin[live], 0.0, upper) / scale
        search = _ActiveSets(scaled, side[live] * scale, upper / scale, start)
        found[live] = np.clip(search.minimum() * scale, 0.0, upper)
    return found


class _ActiveSets:
    """The minimum for G with ones on its diagonal: x stays within bounds, and every turn goes downhill."""

    def __init__(self, gram: Float64, side: Float64, upper: Float64, start: Float64) -> None:
        self._gram, self._side, self._upper, self._x = gram, side, upper, start
        self._inside = (start > 0.0) & (start < upper)

    def minimum(self) -> Float64:
        """x where no weight off its bound, and none moved off it, comes lower."""
        tolerance = 1e-12 * max(float(np.abs(self._side).max()), 1e-300)
        barred = np.zeros(len(self._side), bool)
        for _ in range(100 + 20 * len(self._side)):
            if self._settle():
                barred[:] = False
            slope = self._gram @ self._x - self._side
            gain = np.where(self._x <= 0.0, -slope, slope)
            gain[self._inside | barred] = 0.0
            best = int(gain.argmax())
            if gain[best] <= tolerance:
                break
            self._inside[best] = True
            # Where digits end, a weight let go may want out at once: it stays until others have moved.
            barred[best] = True
        return self._x

    def _settle(self) -> bool:
        """To the minimum over the weights inside; those that meet a bound stay there. Whether any moved."""
        moved = False
        while self._inside.any():
            inside = np.flatnonzero(self._inside)
            x = self._x[inside]
            step = np.linalg.solve(
                self._gram[np.ix_(inside, inside)], self._side[inside] - self._gram[inside] @ self._x
            )
            ahead = np.where(step > 0.0, self._upper[inside] - x, x)
            room = ahead / np.maximum(np.abs(step), 1e-300)
            share = min(1.0, float(room.min()))
            moved |= share * float(np.abs(step).max()) > 1e-14
            self._x[inside] = np.clip(x + share * step, 0.0, self._upper[inside])
            if share >= 1.0:
                break
            met = room <= share
            self._x[inside[met]] = np.where(step[met] > 0.0, self._upper[inside[met]], 0.0)
            self._inside[inside[met]] = False
        return moved
