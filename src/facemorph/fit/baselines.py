"""What the fit is compared with, as the paper does: plain transfer, copied deltas, PCA of the examples.

All in the template's place and size, as offsets (K, 3, V) from the target's neutral.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.rig import Rig
from facemorph.fit.explaining import flat
from facemorph.fit.problem import FitProblem, left_over

# Holds weights that the shapes leave undecided; small enough not to be seen in an error.
_UNDECIDED = 1e-9


def copied(template: Rig) -> Float64:
    """The template's deltas as they are, on the target's neutral, (K, 3, V)."""
    return np.ascontiguousarray(template.deltas.transpose(0, 2, 1), np.float64)


def principal(moves: Float64) -> Float64:
    """Principal components of the examples' offsets (m, 3, V), largest first, as shapes likewise.

    No mean is taken out: the neutral is the origin of every face.
    """
    flat = moves.reshape(len(moves), -1)
    values, vectors = np.linalg.eigh(flat @ flat.T)
    keep = values > values[-1] * 1e-12
    components = vectors[:, keep][:, ::-1].T @ flat
    return np.asarray(components.reshape(-1, *moves.shape[1:]))


def shapes_percent(
    problem: FitProblem, planes: Float64, moves: Float64, weights: Float64 | None = None
) -> float:
    """The error of faces `moves` (m, 3, V) made of a rig's shapes `planes` (K, 3, V), in percent.

    Weights are the best in 0..1, or those given (m, n); correctives follow.
    """
    explaining = problem.explaining
    if weights is None:
        none = np.zeros((len(moves), len(problem.used)))
        weights = explaining.weights(planes, moves, none, _UNDECIDED)
    return _percent(left_over(moves, planes, explaining.coefficients(weights)), problem.diagonal)


def components_percent(parts: Float64, moves: Float64, diagonal: float) -> float:
    """The same for principal components (k, 3, V), whose weights have no range."""
    every, faces = flat(parts), flat(moves)
    best = np.linalg.lstsq(every.T, faces.T, rcond=None)[0].T
    return _percent((faces - best @ every).reshape(moves.shape), diagonal)


def _percent(left: Float64, diagonal: float) -> float:
    return 100.0 * float(np.sqrt((left**2).sum(axis=1).mean())) / diagonal


@dataclass(frozen=True)
class Row:
    """One method: seconds it took, its error on the examples and on expressions it has not seen, percent.

    `training` is with the weights that the method found or was given, `held_out` with the best weights;
    None where there were no held-out expressions.
    """

    method: str
    seconds: float
    training: float
    held_out: float | None
