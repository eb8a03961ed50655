"""Parts that a scan has nothing of (teeth, tongue, lashes, hair) where the skin says that they are.

Carried along through space they are pulled by the lips and lids next to them, and a fit would take that
for the person's own way.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from facemorph.core.arrays import Bool, Float32
from facemorph.core.rig import Rig
from facemorph.fit.align import similarity
from facemorph.fit.checks import AnySurface, points_of, used_shapes
from facemorph.fit.explaining import Explaining
from facemorph.fit.problem import placed_moves
from facemorph.fit.starting import GUESS
from facemorph.fit.threads import one_thread
from facemorph.fit.transferring import Transfer

# Shapes with less of their squared motion on the skin, as the eyes' and the tongue's, are not told by it.
_SEEN_SHARE = 0.5


def with_likely_parts(
    template: Rig,
    neutral: AnySurface,
    examples: Sequence[AnySurface],
    shapes: Sequence[str] | None = None,
) -> tuple[Float32, ...]:
    """Examples, positions (V, 3) each, whose skin alone was seen, with the rest where it is likely to be.

    Their skin, the largest part that moves, stays as it is and where it is. All else goes as the template's
    shapes carry it in the weights that explain the skin, found as a fit begins: on the shapes of plain
    deformation transfer. `shapes` are those that may explain, None is all that show on the skin.
    Raises as `example_based` does.
    """
    target = points_of(template, neutral, "the neutral")
    points = [points_of(template, example, f"example {j}") for j, example in enumerate(examples, start=1)]
    with one_thread():
        way = Transfer(template, target).prepared()
        moves = placed_moves(way, points, hold_still=True)
        seen = way.anchoring.main
        used = _showing(way, used_shapes(template, shapes), seen)
        explaining = Explaining(template, used)
        begin = np.zeros((len(moves), len(used)))
        rows = explaining.weights(way.planes[:, :, seen], moves[:, :, seen], begin, GUESS)
        likely = np.tensordot(explaining.coefficients(rows), way.planes[:, :, ~seen], 1)
    back = way.way.inverse()
    found = []
    for own, move, parts in zip(points, moves, likely, strict=True):
        whole = np.array(move)
        whole[:, ~seen] = parts
        placed = target + back.offsets(whole.T)
        made = own.copy()
        made[~seen] = similarity(placed[seen], own[seen], scaled=False).points(placed[~seen])
        found.append(made.astype(np.float32))
    return tuple(found)


def _showing(way: Transfer, names: Sequence[str], seen: Bool) -> list[str]:
    """The shapes that move the skin more than all else."""
    place = {name: k for k, name in enumerate(way.template.names)}
    found = []
    for name in names:
        motion = np.einsum("iv,iv->v", way.planes[place[name]], way.planes[place[name]])
        if motion[seen].sum() >= _SEEN_SHARE * motion.sum():
            found.append(name)
    return found
