"""Where a fit begins: what plain deformation transfer makes of a person's examples."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from facemorph.fit.align import diagonal_of
from facemorph.fit.checks import AnySurface, check_example, points_of, used_shapes
from facemorph.fit.explaining import Explaining
from facemorph.fit.problem import left_over, placed_moves
from facemorph.fit.result import Example
from facemorph.fit.threads import one_thread
from facemorph.fit.transferring import Transfer

# How far weights estimated without a guess are held to 0: enough that shapes alike do not fight.
GUESS = 0.002


def explained(
    way: Transfer,
    examples: Mapping[str, AnySurface],
    shapes: Iterable[str] | None = None,
    *,
    hold_still: bool = True,
    stiffness: float = GUESS,
) -> tuple[Example, ...]:
    """Each example as well as the transferred shapes explain it, as `example_based` begins.

    way         a template and a person's neutral; see `Transfer`
    examples    by name, meshes of the template's topology or positions (V, 3), in the neutral's unit
    shapes      names of the shapes that may explain them; None is every one with a weight of its own
    hold_still  as in `example_based`
    stiffness   how far weights are held to 0 (see `Explaining.weights`); near 0 it is the best that
                plain transfer can do, against which a fit is measured

    Raises `CorrespondenceError`, `FitError`, `UnknownNameError`.
    """
    template = way.template
    used = used_shapes(template, shapes)
    target = way.way.inverse().points(way.neutral)
    points = []
    for name, surface in examples.items():
        points.append(points_of(template, surface, name))
        check_example(points[-1], target, name)
    explaining = Explaining(template, used)
    with one_thread():
        moves = placed_moves(way, points, hold_still=hold_still)
        rows = explaining.weights(way.planes, moves, np.zeros((len(moves), len(used))), stiffness)
        left = left_over(moves, way.planes, explaining.coefficients(rows))
    back = way.way.inverse()
    diagonal = diagonal_of(target)
    return tuple(
        Example(
            name,
            {shape: float(value) for shape, value in zip(used, row, strict=True) if value > 0.0},
            back.offsets(rest.T).astype(np.float32),
            diagonal,
        )
        for name, row, rest in zip(examples, rows, left, strict=True)
    )
