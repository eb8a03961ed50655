"""Wrinkles that shapes fade in: heights painted in three sets, each area of the picture with a weight.

A set's heights (a channel of the material's wrinkle picture) are the wrinkles of the face at their
deepest. A `Wrinkle` is an area of one set, as the left half of the forehead, and says which shapes show it:

    w = clamp(rest + sum_k gain_k max(c_k, 0), 0, 1)

A shape's coefficient below 0 shows nothing: what a muscle folds, its opposite stretches. At a texture
coordinate (u, v) a set's heights then count

    W_set(u, v) = sum over its wrinkles of w rise(u; u0) (1 - rise(u; u1)) rise(v; v0) (1 - rise(v; v1))
    rise(x; edge) = smoothstep(edge - soft / 2, edge + soft / 2, x)

so that two areas that meet at an edge are a whole there. `shaders/lib/wrinkles.glsl` carries the same names.
Drawn as Blinn's bumps (SIGGRAPH 1978): the surface stays where it is, its normal turns.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.errors import MeshDataError

SETS = ("red", "green", "blue")
"""The channels of a wrinkle picture."""
MOST_WRINKLES = 32


@dataclass(frozen=True)
class Wrinkle:
    """An area of a set and what shows it.

    set    the channel of the picture, one of `SETS`
    area   u0, v0, u1, v1 in texture coordinates, v up; its border is `soft` wide, half of it outside
    rest   its weight in the neutral face
    shapes name -> gain
    """

    name: str
    set: str
    area: tuple[float, float, float, float]
    soft: float = 0.04
    rest: float = 0.0
    shapes: Mapping[str, float] = field(default_factory=dict)


class WrinkleWeights:
    """Wrinkles bound to a rig's shapes; names of shapes that it has not count nothing.

    Raises `MeshDataError` for a wrinkle that is none: an unknown set, or an area without an inside.
    """

    def __init__(self, names: Sequence[str], wrinkles: Sequence[Wrinkle]) -> None:
        if len(wrinkles) > MOST_WRINKLES:
            raise MeshDataError(f"a face can have {MOST_WRINKLES} wrinkles, not {len(wrinkles)}.")
        for wrinkle in wrinkles:
            _check(wrinkle)
        self._rest = np.array([wrinkle.rest for wrinkle in wrinkles], np.float64)
        self._gains = np.array(
            [[wrinkle.shapes.get(name, 0.0) for name in names] for wrinkle in wrinkles], np.float64
        ).reshape(len(wrinkles), len(names))

    def __call__(self, coefficients: Float64) -> Float64:
        """The weights (n,) of the wrinkles, 0..1, for coefficients (K,) of the shapes."""
        shown: Float64 = self._rest + self._gains @ np.maximum(coefficients, 0.0)
        return np.clip(shown, 0.0, 1.0)


def set_weights(wrinkles: Sequence[Wrinkle], weights: Float64, uvs: Float64) -> Float64:
    """What each set's heights count at texture coordinates (n, 2): (n, 3)."""
    u, v = uvs[:, 0], uvs[:, 1]
    total = np.zeros((len(uvs), len(SETS)))
    for wrinkle, weight in zip(wrinkles, weights, strict=True):
        u0, v0, u1, v1 = wrinkle.area
        soft = wrinkle.soft
        inside = _rise(u, u0, soft) * (1.0 - _rise(u, u1, soft))
        inside *= _rise(v, v0, soft) * (1.0 - _rise(v, v1, soft))
        total[:, SETS.index(wrinkle.set)] += weight * inside
    return total


def _rise(x: Float64, edge: float, soft: float) -> Float64:
    """0 before an edge of the width `soft`, 1 behind it."""
    t = np.clip((x - edge) / soft + 0.5, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t), np.float64)


def _check(wrinkle: Wrinkle) -> None:
    u0, v0, u1, v1 = wrinkle.area
    if wrinkle.set not in SETS:
        raise MeshDataError(
            f"the wrinkle {wrinkle.name!r} is of the set {wrinkle.set!r}; there are {', '.join(SETS)}."
        )
    if not (u0 < u1 and v0 < v1):
        raise MeshDataError(
            f"the wrinkle {wrinkle.name!r} has the area {u0:g}, {v0:g} to {u1:g}, {v1:g}; these must grow."
        )
    if not wrinkle.soft > 0.0:
        raise MeshDataError(f"the wrinkle {wrinkle.name!r} needs a soft border wider than 0.")
