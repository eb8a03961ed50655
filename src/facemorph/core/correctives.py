"""Correctives: shapes that other shapes' weights switch on, where a straight line between shapes is wrong.

An in-between takes the straight way of one shape onto its arc (a jaw on its hinge, a lid on the ball): it
is full half way and gone at both ends. A combination mends two shapes that are on together. Both are
ordinary shapes of a rig whose weight is not set but follows from the others' coefficients c:

    w = product over `product` of clamp(c_i, 0, 1)  *  product over `hats` of hat(c_j)

    hat(c; a, p, b) = u (2 - u),   u = (c - a) / (p - a) up to p, (b - c) / (b - p) after it; 0 outside a..b

A hat is a parabola on each side: 1 and level at its peak, 0 at its feet. For a rotation that a shape
carries along its chord, 4 c (1 - c), the hat over 0..1, is what the arc leaves the chord by, to third order
of the angle. Weights outside 0..1 switch on no more than 0 and 1 do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.errors import MeshDataError

CORRECTIVE = "corrective"
"""The set of shapes that are switched on by others."""


@dataclass(frozen=True)
class Hat:
    """A hat over one shape's coefficient: 0 at `start` and `end`, 1 at `peak` between them."""

    over: str
    start: float = 0.0
    peak: float = 0.5
    end: float = 1.0


@dataclass(frozen=True)
class Corrective:
    """A rule: `shape` is added with the product of the shapes' weights in `product`, and of the hats."""

    shape: str
    product: tuple[str, ...] = ()
    hats: tuple[Hat, ...] = ()

    @property
    def drivers(self) -> tuple[str, ...]:
        """The shapes that it follows."""
        return (*self.product, *(hat.over for hat in self.hats))


def hat(c: float, start: float, peak: float, end: float) -> float:
    """A parabola from 0 at `start` to 1 at `peak` and back to 0 at `end`; 0 outside."""
    if not start < c < end:
        return 0.0
    u = (c - start) / (peak - start) if c <= peak else (end - c) / (end - peak)
    return u * (2.0 - u)


class Activation:
    """A rig's rules bound to its shapes' places.

    Raises `MeshDataError` for a rule over shapes that are not there, or that are correctives themselves.
    """

    def __init__(self, names: Sequence[str], rules: Sequence[Corrective]) -> None:
        index = {name: k for k, name in enumerate(names)}
        driven = {rule.shape for rule in rules}
        for rule in rules:
            _check(rule, index, driven)
        self._rules = [
            (
                index[rule.shape],
                [index[name] for name in rule.product],
                [(index[h.over], h.start, h.peak, h.end) for h in rule.hats],
            )
            for rule in rules
        ]

    def __call__(self, coefficients: Float64) -> Float64:
        """The coefficients (K,) with the rules' weights added."""
        total = coefficients.copy()
        for shape, product, hats in self._rules:
            weight = 1.0
            for k in product:
                weight *= min(max(float(coefficients[k]), 0.0), 1.0)
            for k, start, peak, end in hats:
                weight *= hat(float(coefficients[k]), start, peak, end)
            total[shape] += weight
        return np.asarray(total, np.float64)


def _check(rule: Corrective, index: dict[str, int], driven: set[str]) -> None:
    if not rule.drivers:
        raise MeshDataError(f"the corrective {rule.shape!r} follows no shape; name some in product or hat.")
    for name in (rule.shape, *rule.drivers):
        if name not in index:
            raise MeshDataError(f"the corrective {rule.shape!r} speaks of {name!r}, which is no shape here.")
    for name in rule.drivers:
        if name in driven:
            raise MeshDataError(f"the corrective {rule.shape!r} follows {name!r}, a corrective itself.")
    for h in rule.hats:
        if not h.start < h.peak < h.end:
            raise MeshDataError(
                f"the corrective {rule.shape!r} has a hat from {h.start:g} over {h.peak:g} to {h.end:g}; "
                "these must grow."
            )
