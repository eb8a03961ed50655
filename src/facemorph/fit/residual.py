"""What does not fit: expressions that the template cannot make, and the residual as a shape of its own.

The paper of 2015 shows puffed cheeks that no shape of its template explains: the error E stays over a
threshold. Such an example is reported, and its residual may join the rig as a new shape.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from facemorph.core.pose import NEUTRAL
from facemorph.core.rig import EXPRESSION, Shape, plain_label
from facemorph.errors import FitError, UnknownNameError
from facemorph.fit.result import Example, FitResult

THRESHOLD_PERCENT = 0.25
"""An example is not explained where one vertex in five hundred is off by more, percent of the diagonal.

Tried on six people without a shape for puffed cheeks: a puff leaves 0.6 to 0.7 with weights given, 0.3 to 0.4
where other shapes had to stand in for it; smiles, frowns, blinks and open jaws leave 0.02 to 0.18.
"""


def unexplained(result: FitResult, threshold_percent: float = THRESHOLD_PERCENT) -> tuple[Example, ...]:
    """The examples that the shapes cannot make: `Example.worst_percent` is over the threshold."""
    if not threshold_percent > 0.0:
        raise FitError(f"a threshold is a part of the diagonal above 0 %, not {threshold_percent:g}.")
    return tuple(example for example in result.examples if example.worst_percent > threshold_percent)


def with_residual(result: FitResult, example: str, name: str) -> FitResult:
    """The fit with what is left of `example` as one more shape called `name`, at weight 1 in that example.

    The example is then met exactly, and the others are as before. Raises `UnknownNameError` for an example
    that is not there, `FitError` for a shape's name that is taken or empty.
    """
    told = {one.name: one for one in result.examples}
    if example not in told:
        raise UnknownNameError("example", example, tuple(told))
    plain = name.strip()
    if not plain or plain == NEUTRAL or plain in result.rig.names:
        raise FitError(f"a new shape needs a name of its own, not {name!r}.")
    left = told[example].offsets
    shape = Shape(plain, plain_label(plain), EXPRESSION)
    rig = replace(
        result.rig,
        shapes=(*result.rig.shapes, shape),
        deltas=np.concatenate([result.rig.deltas, left[None].astype(np.float32)]),
    )
    met = replace(told[example], weights={**told[example].weights, plain: 1.0}, offsets=np.zeros_like(left))
    examples = tuple(met if one.name == example else one for one in result.examples)
    return replace(result, rig=rig, examples=examples)
