"""Whether a shape is its neutral in other axes: mirrored, turned by quarter turns, axes swapped."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations, product

import numpy as np

from facemorph.core.arrays import Float64

Signs = tuple[int, int, int]
_AXES = "xyz"
# A shape counts as turned when that puts it so much nearer to the neutral, and it is not near already.
_NEARER = 0.25
_FAR = 0.1
_WITHIN = 4.0
_TURNS = {
    (1, -1, -1): "is upside down and back to front: turned by half a turn about x",
    (-1, 1, -1): "faces backwards: turned by half a turn about y",
    (-1, -1, 1): "is upside down: turned by half a turn about z",
    (-1, -1, -1): "is mirrored through the origin: x, y and z are all negated",
}


def half_size(places: Float64) -> float:
    """The distance from the middle that half of the places (V, 3) exceed; stray ones do not change it."""
    away = np.linalg.norm(places - np.median(places, axis=0), axis=1)
    half = float(np.median(away))
    # Where most vertices share one place, only the others tell the size.
    return max(half if half > 0.0 else float(away.max()), float(np.finfo(np.float32).tiny))


def turn_between(neutral: Float64, places: Float64) -> str | None:
    """In words, how `places` (V, 3) are the neutral's in other axes; None where they are not.

    Of the 48 ways to swap and negate axes, the one is taken under which the places, from their medians
    on, correlate best with the neutral's; and believed where it puts them much nearer.
    """
    a, b = neutral - np.median(neutral, axis=0), places - np.median(places, axis=0)
    size = half_size(neutral)
    near = (np.abs(a) < _WITHIN * size).all(axis=1) & (np.abs(b) < _WITHIN * size).all(axis=1)
    products = b[near].T @ a[near]
    scores = [
        (sum(sign * products[axis, i] for i, (axis, sign) in enumerate(zip(order, signs, strict=True))))
        for order, signs in _ways()
    ]
    best = max(scores)
    # Of equal ones (a flat mesh does not tell whether it is mirrored across) the first is the plainest.
    order, signs = next(
        way for way, score in zip(_ways(), scores, strict=True) if score >= best - 1e-9 * abs(best)
    )
    off = float(np.median(np.linalg.norm(b - a, axis=1)))
    left = float(np.median(np.linalg.norm(b[:, order] * np.array(signs) - a, axis=1)))
    if off <= _FAR * size or left >= _NEARER * off:
        return None
    return f"{_words(order, signs)}. Export both with the same axes."


def _ways() -> Iterator[tuple[tuple[int, ...], Signs]]:
    """Every order of axes and signs, those that change least first."""
    orders = sorted(permutations(range(3)), key=lambda order: sum(a != i for i, a in enumerate(order)))
    every: list[Signs] = [(x, y, z) for x, y, z in product((1, -1), repeat=3)]
    signs = sorted(every, key=lambda s: -sum(s))
    return ((order, sign) for order in orders for sign in signs)


def _words(order: tuple[int, ...], signs: Signs) -> str:
    """What was done to the shape, from what puts it right."""
    if order == (0, 1, 2):
        if sum(signs) == 1:
            axis = _AXES[signs.index(-1)]
            side = {"x": ", left for right", "y": ", upside down", "z": ", back to front"}[axis]
            return f"is mirrored in {axis}{side}"
        return _TURNS[signs]
    from_shape = ", ".join(("-" if s < 0 else "") + _AXES[a] for a, s in zip(order, signs, strict=True))
    return f"has its axes swapped: the neutral's x, y, z are its {from_shape}"
