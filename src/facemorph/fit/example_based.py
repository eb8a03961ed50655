"""A person's blendshapes from a template and a few examples: Li, Weise and Pauly, *Example-based facial
rigging* (2010), as the paper of 2015 uses it.

Alternately, A: with the weights kept, the blendshapes whose edges explain the examples and stay near the
template's motion; B: with the blendshapes kept, the examples' weights near those given. Shapes that no
example uses stay what deformation transfer makes of them.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.core.rig import FaceInfo, Rig
from facemorph.errors import FitError
from facemorph.fit.checks import (
    MOST_EXAMPLES,
    AnySurface,
    Weights,
    check_example,
    points_of,
    used_shapes,
    weight_rows,
)
from facemorph.fit.problem import FitProblem
from facemorph.fit.result import Example, FitResult, Iteration
from facemorph.fit.starting import GUESS
from facemorph.fit.threads import one_thread
from facemorph.fit.transferring import Transfer
from facemorph.fit.units import unit_of


def transfer(template: Rig, neutral: AnySurface, *, progress: Progress = silent) -> FitResult:
    """All shapes of `template` on another person's `neutral` by deformation transfer.

    neutral   a `Mesh` of the template's topology, or positions (V, 3) in any unit, place and turn
    Raises `CorrespondenceError`, `FitError`; what `progress` raises passes through.
    """
    return example_based(template, neutral, (), progress=progress)


def example_based(
    template: Rig,
    neutral: AnySurface,
    examples: Mapping[str, AnySurface] | Sequence[AnySurface],
    weights: Weights | None = None,
    *,
    iterations: int = 10,
    alpha: tuple[float, float] = (0.5, 0.1),
    lambda_: tuple[float, float] = (100.0, 10.0),
    schedule: str = "geometric",
    shapes: Iterable[str] | None = None,
    hold_still: bool = True,
    progress: Progress = silent,
    each: Callable[[Iteration], None] = lambda iteration: None,
) -> FitResult:
    """The blendshapes of the person whose neutral and example expressions are given.

    template    a rig; its shapes say what each blendshape means
    neutral     the person's neutral, a `Mesh` of the template's topology or positions (V, 3), any unit
    examples    expressions of the person, likewise, by name or in order; none is plain transfer
    weights     for each example, in order or by its name, which template shapes make it up: shape -> 0..1,
                roughly; None estimates them by bounded least squares on the transferred shapes. Shapes
                whose weights stay below 0.02 in every example stay as transferred
    iterations  how often steps A and B follow each other
    alpha       from and to: how much the template's motion counts beside the examples in step A; no unit.
                Near 0.1 is best; at 0.05 shapes begin to distort; far above 1 is deformation transfer
    lambda_     from and to: how much the given weights count in step B, in percent: at 100 a change of a
                weight by 1 costs as much as an average shape's whole motion
    schedule    how alpha and lambda_ fall: "geometric", or "linear" as in the paper, which needs all ten
                iterations where the other needs four: the one default that is not the paper's
    shapes      names of the shapes that may explain the examples; None is every one with a weight of its own
    hold_still  put each example rigidly where the neutral is, by the vertices that the template never
                moves; off where the examples are in place to the last digit already
    each        is told what came of an iteration when it is done, before the progress is

    Raises `CorrespondenceError`, `FitError`, `UnknownNameError`; what `progress` raises passes through.
    """
    named = _named(examples)
    steps = scheduled(alpha, lambda_, iterations, schedule)
    with one_thread():
        way, points, seconds = _prepared(template, neutral, named, progress)
        if not named:
            return FitResult(person(template, neutral, way, way.offsets), seconds=seconds)
        begun = time.perf_counter()
        problem = FitProblem(way, points, used_shapes(template, shapes), hold_still=hold_still)
        start = _start(problem, named, weights)
        found, history = _alternated(problem, start, steps, progress, each)
        rig = person(template, neutral, way, problem.offsets)
        told = _told(problem, tuple(named), found, rig)
    return FitResult(rig, told, history, seconds | {"fit": time.perf_counter() - begun})


def _prepared(
    template: Rig, neutral: AnySurface, named: Mapping[str, AnySurface], progress: Progress
) -> tuple[Transfer, list[Float64], dict[str, float]]:
    """The transferred shapes, the examples' positions, and how long that took."""
    begun = time.perf_counter()
    target = points_of(template, neutral, "the neutral")
    points = [points_of(template, surface, name) for name, surface in named.items()]
    for name, example in zip(named, points, strict=True):
        check_example(example, target, name)
    share = 0.4 if named else 1.0
    way = Transfer(template, target).prepared(lambda part, doing: progress(part * share, doing))
    return way, points, {"transfer": time.perf_counter() - begun}


def _alternated(
    problem: FitProblem, start: Float64, steps: Sequence[tuple[float, float]], progress: Progress,
    each: Callable[[Iteration], None],
) -> tuple[Float64, tuple[Iteration, ...]]:  # fmt: skip
    """Steps A and B in turn, from weights `start` (m, n): the weights found, and what came of each turn."""
    found, history = start, []
    for turn, (alpha, lambda_) in enumerate(steps, start=1):
        problem.fit_shapes(found, alpha)
        found = problem.fit_weights(start, lambda_ / 100.0)
        history.append(Iteration(alpha, lambda_, problem.rms_percent(found)))
        each(history[-1])
        told = f"iteration {turn} of {len(steps)}: {history[-1].rms_percent:.3f} % off the examples"
        progress(0.4 + 0.6 * turn / len(steps), told)
    return found, tuple(history)


def person(template: Rig, neutral: AnySurface, way: Transfer, offsets: Float64) -> Rig:
    """The template's rig with the target's neutral, and offsets (V, 3, K) in the template's place as deltas.

    The target's own mesh is kept where it says how it looks; else it gets the template's parts and materials.
    """
    base = template.neutral
    points = neutral.positions if isinstance(neutral, Mesh) else np.asarray(neutral, np.float32)
    looks = isinstance(neutral, Mesh) and neutral.materials_used is not None
    mesh = neutral if isinstance(neutral, Mesh) and looks else base.with_positions(points)
    info = _info_of(template.info, way)
    return replace(template, neutral=mesh, deltas=way.deltas(offsets), info=info)


def _info_of(info: FaceInfo, way: Transfer) -> FaceInfo:
    """What holds of the new person too: landmarks, the frame carried over, the unit that the size tells."""
    back = way.way.inverse()
    shapes_of = f"Blendshapes made from those of {info.name}"
    credit = f"{shapes_of} ({info.credit})" if info.credit else shapes_of
    frame = None
    if info.frame is not None:
        corners = np.array(info.frame)
        middle, half = back.points(corners.mean(axis=0)[None])[0], back.scale * np.ptp(corners, axis=0) / 2.0
        low, high = (middle - half).tolist(), (middle + half).tolist()
        frame = ((low[0], low[1], low[2]), (high[0], high[1], high[2]))
    unit = unit_of(info.unit, way.way.scale)
    return FaceInfo("face", credit=credit, unit=unit, landmarks=info.landmarks, frame=frame)


def _named(examples: Mapping[str, AnySurface] | Sequence[AnySurface]) -> dict[str, AnySurface]:
    if not isinstance(examples, Mapping):
        examples = {f"example {j}": surface for j, surface in enumerate(examples, start=1)}
    if len(examples) > MOST_EXAMPLES:
        raise FitError(f"at most {MOST_EXAMPLES} examples are taken, not {len(examples)}; four are plenty.")
    return dict(examples)


def _start(problem: FitProblem, named: Mapping[str, AnySurface], weights: Weights | None) -> Float64:
    if weights is None:
        return problem.fit_weights(np.zeros((len(named), len(problem.used))), GUESS)
    return weight_rows(problem.used, weights, tuple(named))


def scheduled(
    alpha: tuple[float, float], lambda_: tuple[float, float], iterations: int, schedule: str = "geometric"
) -> list[tuple[float, float]]:
    """alpha and lambda_ of each iteration. Raises `FitError` for what is no schedule."""
    falling = [_falling(pair, iterations, schedule) for pair in (alpha, lambda_)]
    return list(zip(*falling, strict=True))


def _falling(ends: tuple[float, float], count: int, schedule: str) -> list[float]:
    first, last = (float(end) for end in ends)
    if count < 1:
        raise FitError(f"a fit takes at least one iteration, not {count}.")
    if not (np.isfinite([first, last]).all() and first > 0.0 and last > 0.0):
        raise FitError(f"alpha and lambda are numbers above 0; {first:g} to {last:g} are not.")
    if schedule == "geometric":
        return [float(value) for value in np.geomspace(first, last, count)]
    if schedule == "linear":
        return [float(value) for value in np.linspace(first, last, count)]
    raise FitError(f"a schedule is geometric or linear, not {schedule!r}.")


def _told(problem: FitProblem, names: tuple[str, ...], found: Float64, rig: Rig) -> tuple[Example, ...]:
    offsets = problem.residual_offsets(found)
    rows = [
        {name: float(value) for name, value in zip(problem.used, row, strict=True) if value > 0.0}
        for row in found
    ]
    diagonal = rig.neutral.diagonal
    return tuple(
        Example(name, row, offset, diagonal) for name, row, offset in zip(names, rows, offsets, strict=True)
    )
