"""One report: the fit beside its baselines, E over alpha, and E against noise in the starting weights.

After the paper's figures 1 and 2: alpha near 0.1 is best, smaller overfits, larger ends at plain transfer;
perturbed starting weights change little. Numbers here, pictures in `report_plots`.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import Rig
from facemorph.errors import FitError
from facemorph.fit.baselines import Row, components_percent, copied, principal, shapes_percent
from facemorph.fit.checks import AnySurface, Weights, check_example, points_of, used_shapes, weight_rows
from facemorph.fit.example_based import scheduled
from facemorph.fit.problem import FitProblem, placed_moves
from facemorph.fit.starting import GUESS
from facemorph.fit.threads import one_thread
from facemorph.fit.transferring import Transfer

ALPHAS: tuple[float, ...] = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 3.0, 10.0)
NOISES: tuple[float, ...] = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3)


@dataclass(frozen=True)
class Point:
    """One fit of a sweep: the value varied, and the errors in percent of the diagonal."""

    value: float
    training: float
    held_out: float | None


@dataclass(frozen=True)
class FitReport:
    """Methods side by side, and both sweeps. Noise is the standard deviation added to every given weight."""

    rows: tuple[Row, ...]
    over_alpha: tuple[Point, ...]
    over_noise: tuple[Point, ...]
    examples: tuple[str, ...]
    held_out: tuple[str, ...]

    def as_dict(self) -> dict[str, object]:
        """Ready for JSON; errors in percent of the neutral's diagonal."""
        return asdict(self)


def fit_report(
    template: Rig,
    neutral: AnySurface,
    examples: Mapping[str, AnySurface],
    weights: Weights | None = None,
    held_out: Mapping[str, AnySurface] | None = None,
    *,
    alphas: Sequence[float] = ALPHAS,
    noises: Sequence[float] = NOISES,
    repeats: int = 3,
    iterations: int = 10,
    seed: int = 1,
    shapes: Sequence[str] | None = None,
    progress: Progress = silent,
) -> FitReport:
    """Compare the fit with its baselines, and vary alpha and the starting weights.

    examples, weights   as for `example_based`; held_out are expressions that no fit sees
    alphas              each kept the same over all iterations
    noises              standard deviations added to weights that are not 0, `repeats` times each
    Raises as `example_based` does.
    """
    if not examples:
        raise FitError("a report compares how examples are met; there are none.")
    with one_thread():
        trial = _Trial(template, neutral, examples, weights, held_out or {}, shapes, iterations)
        progress(0.1, "comparing methods")
        rows = trial.rows()
        runs = len(alphas) + len(noises) * repeats
        points, done = [], 0
        for alpha in alphas:
            progress(0.2 + 0.8 * done / runs, f"alpha {alpha:g}")
            points.append(trial.point(alpha, trial.start, (alpha, alpha)))
            done += 1
        noisy, draw = [], np.random.default_rng(seed)
        for noise in noises:
            found = []
            for _ in range(repeats):
                progress(0.2 + 0.8 * done / runs, f"starting weights off by {noise:g}")
                found.append(trial.point(noise, _perturbed(trial.start, noise, draw), None))
                done += 1
            noisy.append(_mean(found))
    progress(1.0, "compared")
    return FitReport(rows, tuple(points), tuple(noisy), tuple(examples), tuple(held_out or {}))


class _Trial:
    """The same fit again and again, with what is bound once kept."""

    def __init__(
        self,
        template: Rig,
        neutral: AnySurface,
        examples: Mapping[str, AnySurface],
        weights: Weights | None,
        held_out: Mapping[str, AnySurface],
        shapes: Sequence[str] | None,
        iterations: int,
    ) -> None:
        target = points_of(template, neutral, "the neutral")
        points = {name: points_of(template, surface, name) for name, surface in examples.items()}
        for name, example in points.items():
            check_example(example, target, name)
        unseen = [points_of(template, surface, name) for name, surface in held_out.items()]
        begun = time.perf_counter()
        self._way = Transfer(template, target).prepared()
        self._transfer_secs = time.perf_counter() - begun
        self._problem = FitProblem(
            self._way, list(points.values()), used_shapes(template, shapes), hold_still=True
        )
        self._held = placed_moves(self._way, unseen, hold_still=True)
        self._iterations = iterations
        self.start = self._started(weights, tuple(points))

    def _started(self, weights: Weights | None, examples: tuple[str, ...]) -> Float64:
        used = self._problem.used
        if weights is None:
            return self._problem.fit_weights(np.zeros((len(examples), len(used))), GUESS)
        return weight_rows(used, weights, examples)

    def rows(self) -> tuple[Row, ...]:
        """Fit, plain transfer, copied deltas, and PCA."""
        problem, diagonal = self._problem, self._problem.diagonal
        moves = problem.moves
        begun = time.perf_counter()
        fitted = self.point(0.0, self.start, None)
        fit_secs = self._transfer_secs + time.perf_counter() - begun
        plain, copies, parts = self._way.planes, copied(self._way.template), principal(moves)
        return (
            Row("example-based fit", fit_secs, fitted.training, fitted.held_out),
            Row("deformation transfer", self._transfer_secs, self._given(plain), self._unseen(plain)),
            Row("deltas copied", 0.0, self._given(copies), self._unseen(copies)),
            Row(
                "PCA of the examples",
                0.0,
                components_percent(parts, moves, diagonal),
                components_percent(parts, self._held, diagonal) if len(self._held) else None,
            ),
        )

    def _given(self, planes: Float64) -> float:
        """The error on the examples in the weights given."""
        return shapes_percent(self._problem, planes, self._problem.moves, self.start)

    def _unseen(self, planes: Float64) -> float | None:
        """The error on held-out expressions in the best weights, None where there are none."""
        return shapes_percent(self._problem, planes, self._held) if len(self._held) else None

    def point(self, value: float, start: Float64, alpha: tuple[float, float] | None) -> Point:
        """One fit from weights `start`, alpha as usual or as given."""
        problem = self._problem
        problem.reset()
        found = start
        for step_alpha, step_lambda in scheduled(alpha or (0.5, 0.1), (100.0, 10.0), self._iterations):
            problem.fit_shapes(found, step_alpha)
            found = problem.fit_weights(start, step_lambda / 100.0)
        return Point(value, problem.rms_percent(found), self._unseen(problem.planes))


def _perturbed(start: Float64, noise: float, draw: np.random.Generator) -> Float64:
    """Weights that are not 0, off by normal noise; the others stay 0, as an artist would leave them."""
    off = start + noise * draw.standard_normal(start.shape)
    return np.where(start > 0.0, np.clip(off, 0.0, 1.0), 0.0)


def _mean(points: Sequence[Point]) -> Point:
    held = [point.held_out for point in points if point.held_out is not None]
    mean = float(np.mean(held)) if held else None
    return Point(points[0].value, float(np.mean([point.training for point in points])), mean)
