"""What a fit needs of its input, told by name where it is missing."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from facemorph.core.arrays import Float64, Int32
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.errors import CorrespondenceError, FitError, UnknownNameError
from facemorph.fit.align import diagonal_of
from facemorph.fit.gradients import edges_of, heights

# Relative to the longest side: what float32 positions can tell from zero.
_DEGENERATE = 1e-7
_SAME = 1e-6
# An expression changes a head's size by little.
_MOST_LARGER = 1.5
MOST_EXAMPLES = 64
AnySurface = Mesh | Float64
Weights = Sequence[Mapping[str, float]] | Mapping[str, Mapping[str, float]]


def points_of(template: Rig, surface: AnySurface, name: str) -> Float64:
    """Positions (V, 3) float64 of a mesh or array that corresponds to the template.

    Raises `CorrespondenceError` where it does not, `FitError` where a position is no finite number.
    """
    if isinstance(surface, Mesh):
        unlike = difference(template.neutral, surface)
        if unlike is not None:
            raise CorrespondenceError(
                name,
                unlike.problem.replace("the neutral", "the template"),
                cause=unlike.cause,
                hint="A surface of its own topology is wrapped first: `facemorph register TEMPLATE SCAN`.",
            )
        surface = surface.positions.astype(np.float64)
    points = np.asarray(surface, np.float64)
    if points.shape != template.neutral.positions.shape:
        raise CorrespondenceError(
            name,
            f"positions are {points.shape}, the template's {template.neutral.positions.shape}.",
            cause="vertices",
        )
    strange = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(strange):
        raise FitError(f"{name}: vertex {strange[0] + 1:,} has a position that is no finite number.")
    return points


def check_triangles(points: Float64, triangles: Int32, name: str) -> None:
    """Raises `FitError` where triangles have no area: their deformation is not defined."""
    bad = np.flatnonzero(heights(edges_of(points, triangles)) < _DEGENERATE)
    if len(bad):
        corners = " ".join(str(v + 1) for v in triangles[bad[0]].tolist())
        raise FitError(
            f"{name}: {len(bad):,} of {len(triangles):,} triangles are degenerate (no area), first the one "
            f"over the vertices {corners}. Move or remove their vertices, in every mesh alike."
        )


def check_example(points: Float64, neutral: Float64, name: str) -> None:
    """Raises `FitError` where an example is the neutral over again, or of quite another size."""
    size = diagonal_of(neutral)
    ratio = _spread(points) / max(_spread(neutral), 1e-300)
    if not 1.0 / _MOST_LARGER < ratio < _MOST_LARGER:
        words = f"{max(ratio, 1.0 / max(ratio, 1e-300)):.3g} times as {'large' if ratio > 1.0 else 'small'}"
        raise FitError(
            f"{name}: it is {words} as the neutral. Export both in the same unit, and of the same person."
        )
    if float(np.abs(points - neutral).max(initial=0.0)) <= _SAME * size:
        raise FitError(f"{name}: it is equal to the neutral, so nothing can be learnt from it. Leave it out.")


def used_shapes(template: Rig, shapes: Iterable[str] | None) -> tuple[str, ...]:
    """The shapes that may explain examples: those named, or all with a weight of their own."""
    if shapes is None:
        return tuple(shape.name for shape in template.controls)
    return tuple(dict.fromkeys(template.shape(name).name for name in shapes))


def _spread(points: Float64) -> float:
    """The root mean square distance of points (V, 3) from their middle: a few stray ones change it little."""
    return float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))


def weight_rows(names: Sequence[str], given: Weights, examples: Sequence[str]) -> Float64:
    """Weights (m, K) of the shapes called `names`, those that an example leaves out 0.

    given  for each of `examples`, in their order or by their names, shape -> weight
    Raises `UnknownNameError`, and `FitError` for a weight outside 0 to 1 or an example without weights.
    """
    place = {name: k for k, name in enumerate(names)}
    rows = np.zeros((len(examples), len(names)))
    for row, weights in zip(rows, _in_order(given, examples), strict=True):
        for name, value in weights.items():
            if name not in place:
                raise UnknownNameError("shape of the template", name, names)
            if not 0.0 <= value <= 1.0:
                raise FitError(f"a weight lies between 0 and 1; {name} = {value:g} does not.")
            row[place[name]] = value
    return rows


def _in_order(given: Weights, examples: Sequence[str]) -> Sequence[Mapping[str, float]]:
    if isinstance(given, Mapping):
        for name in given:
            if name not in examples:
                raise UnknownNameError("example", name, examples)
        for name in examples:
            if name not in given:
                raise FitError(f"give starting weights for every example, or for none; {name} has none.")
        return [given[name] for name in examples]
    if len(given) != len(examples):
        raise FitError(f"{len(given)} sets of weights were given for {len(examples)} examples.")
    return given
