"""Which weights explain examples: step B for a rig, its correctives included.

What a corrective adds follows from the other shapes' weights and is not linear in them. So step B is
repeated on the rig as it is near the weights last found (Gauss and Newton), each time going only as far as
it comes closer.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.core.correctives import Activation, Corrective, hat
from facemorph.core.rig import Rig
from facemorph.fit.steps import bounded_minimum, checked_gram, mean_motion

_ROUNDS = 20
_SETTLED = 1e-5
_SHORTEST = 1.0 / 64.0
_APART = 1e-4


class Explaining:
    """Bound to a template and to the shapes that may explain, whose weights are (m, n)."""

    def __init__(self, template: Rig, used: Sequence[str]) -> None:
        place = {name: k for k, name in enumerate(template.names)}
        rules = template.correctives if template.corrected else ()
        driven = dict.fromkeys(place[rule.shape] for rule in rules)
        self.columns: Int64 = np.array([place[name] for name in used], np.int64)
        self._known = np.array([*self.columns, *(k for k in driven if k not in self.columns)], np.int64)
        self._activation = Activation(template.names, rules) if rules else None
        self._count = len(place)
        where = {template.names[k]: row for row, k in enumerate(self._known)}
        self._rules = [_Rule(rule, where, len(used)) for rule in rules]

    def coefficients(self, weights: Float64) -> Float64:
        """The coefficients (m, K) of all the rig's shapes, what weights (m, n) switch on included."""
        plain = np.zeros((len(weights), self._count))
        plain[:, self.columns] = weights
        return plain if self._activation is None else np.stack([self._activation(row) for row in plain])

    def weights(self, shapes: Float64, moves: Float64, near: Float64, stiffness: float) -> Float64:
        """Weights (m, n) in 0..1, each row the minimum of

            |t_j - sum_k c_k(x_j) B_k|^2 + stiffness (trace(B^T B) / n) |x_j - near_j|^2

        shapes  B (K, 3, V), all the rig's, as offsets from the neutral; moves t (m, 3, V); near (m, n)
        With correctives it is the minimum downhill from `near`.
        """
        every = flat(shapes)
        known = every if np.array_equal(self._known, np.arange(len(every))) else every[self._known]
        gram, sides = checked_gram(known), flat(moves) @ known.T
        n = near.shape[1]
        pull = stiffness * mean_motion(gram[:n, :n])
        if self._activation is None:
            held = gram + pull * np.eye(n)
            rows = [bounded_minimum(held, s + pull * x, begin=x) for s, x in zip(sides, near, strict=True)]
        else:
            rows = [self._downhill(gram, s, pull, x) for s, x in zip(sides, near, strict=True)]
        return np.array(rows).reshape(near.shape)

    def _downhill(self, gram: Float64, side: Float64, pull: float, near: Float64) -> Float64:
        """One example's weights (n,) where correctives follow from them."""

        def cost(x: Float64) -> float:
            c = self._switched(x)
            return float(c @ (gram @ c) - 2.0 * (c @ side) + pull * ((x - near) ** 2).sum())

        best = np.clip(near, 0.0, 1.0)
        least = cost(best)
        for _ in range(_ROUNDS):
            c, slopes = self._switched(best), self._slopes(best)
            inner = slopes.T @ gram @ slopes
            aim = slopes.T @ (side - gram @ c) + inner @ best + pull * near
            step = bounded_minimum(inner + pull * np.eye(len(near)), aim, begin=best) - best
            share = 1.0
            while not (reached := cost(best + share * step)) < least and share > _SHORTEST:
                share /= 2.0
            if not reached < least:
                break
            best, least = best + share * step, reached
            if np.abs(step).max(initial=0.0) < _SETTLED:
                break
        return best

    def _switched(self, weights: Float64) -> Float64:
        """Coefficients of the shapes used, and of the correctives that they switch on."""
        return np.asarray(self.coefficients(weights[None])[0, self._known])

    def _slopes(self, weights: Float64) -> Float64:
        """How those change with each weight, (len(known), n)."""
        made = np.eye(len(self._known), len(weights))
        for rule in self._rules:
            rule.add_slopes(weights, made)
        return made


class _Rule:
    """One corrective over weights (n,): its row among the coefficients known, and its drivers' places."""

    def __init__(self, rule: Corrective, where: Mapping[str, int], count: int) -> None:
        self._row = where[rule.shape]
        # A driver that may not explain is at rest, and so is what it would switch on.
        self._drivers = [k for k in {where.get(name, count) for name in rule.drivers} if k < count]
        self._rule, self._where = rule, where
        self._silent = len(self._drivers) < len(set(rule.drivers))

    def add_slopes(self, weights: Float64, slopes: Float64) -> None:
        """Add its slope over each driver to `slopes` (len(known), n)."""
        if self._silent:
            return
        for k in self._drivers:
            low, high = max(weights[k] - _APART, 0.0), min(weights[k] + _APART, 1.0)
            rise = self._weight(weights, k, high) - self._weight(weights, k, low)
            slopes[self._row, k] += rise / (high - low)

    def _weight(self, weights: Float64, changed: int, value: float) -> float:
        """The corrective's coefficient with one weight changed."""

        def of(name: str) -> float:
            k = self._where[name]
            return value if k == changed else float(weights[k])

        made = 1.0
        for name in self._rule.product:
            made *= min(max(of(name), 0.0), 1.0)
        for one in self._rule.hats:
            made *= hat(of(one.over), one.start, one.peak, one.end)
        return made


def flat(planes: Float64) -> Float64:
    """Offsets (K, 3, V) as rows (K, 3 V), also where there are none."""
    return planes.reshape(len(planes), planes.shape[1] * planes.shape[2])
