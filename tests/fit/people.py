"""Our own people as data: one is the template, another the truth, in a smooth style so that it is no copy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

import facemorph
from facemorph.core.rig import Rig, Shape
from tests.fit.weights import fitted_weights


@cache
def person(name: str) -> Rig:
    """A built-in person."""
    return facemorph.load(name)


def with_shapes(rig: Rig, wanted: Callable[[Shape], bool]) -> Rig:
    """The rig with the shapes that are wanted, and the correctives that they leave."""
    kept = [k for k, shape in enumerate(rig.shapes) if wanted(shape)]
    names = {rig.shapes[k].name for k in kept}
    rules = tuple(rule for rule in rig.correctives if {rule.shape, *rule.drivers} <= names)
    return replace(
        rig,
        shapes=tuple(rig.shapes[k] for k in kept),
        deltas=rig.deltas[kept],
        correctives=rules,
        wrinkles=(),
    )


def in_style(rig: Rig, seed: int) -> Rig:
    """The same person, each shape stronger here and weaker there, smoothly and by up to a half."""
    draw = np.random.default_rng(seed)
    points = rig.neutral.positions.astype(np.float64)
    points = (points - points.mean(axis=0)) / rig.neutral.diagonal
    deltas = rig.deltas.copy()
    for delta in deltas:
        waves = np.sin(points @ draw.normal(0.0, 6.0, (3, 3)) + draw.uniform(0.0, 6.0, 3))
        delta *= (1.0 + waves @ draw.uniform(0.08, 0.25, 3))[:, None]
    return replace(rig, deltas=deltas.astype(np.float32))


@dataclass(frozen=True)
class Task:
    """A template, a person, and weights of that person's faces: of the examples, and of those kept back."""

    template: Rig
    truth: Rig
    weights: np.ndarray
    held_out: np.ndarray
    noisy: Sequence[dict[str, float]]

    @property
    def neutral(self) -> np.ndarray:
        """Positions (V, 3)."""
        return self.truth.neutral.positions.astype(np.float64)

    @property
    def examples(self) -> dict[str, np.ndarray]:
        """Positions (V, 3) by name."""
        made = np.tensordot(self.weights, self.truth.deltas.astype(np.float64), 1)
        return {f"example {j}": self.neutral + one for j, one in enumerate(made, start=1)}

    def percent(self, rig: Rig, rows: np.ndarray, weights: np.ndarray | None = None) -> float:
        """The error of `rig` on the faces in `rows`, percent: in `weights`, or the best ones."""
        truth = self.truth.deltas.reshape(len(self.truth.names), -1).astype(np.float64)
        shapes = rig.deltas.reshape(len(rig.names), -1).astype(np.float64)
        faces = rows @ truth
        if weights is None:
            weights = fitted_weights(shapes, faces, np.zeros((len(rows), len(shapes))), 1e-9)
        left = (faces - weights @ shapes).reshape(len(rows), -1, 3)
        return 100.0 * float(np.sqrt((left**2).sum(axis=2).mean())) / rig.neutral.diagonal


def task(template: str, target: str, shapes: Sequence[str], seed: int, per_face: int = 3) -> Task:
    """Four examples of `per_face` shapes each, together of as many as can be; eight such faces kept back.

    The examples' weights are noisy by 0.1.
    """
    draw = np.random.default_rng(seed)
    rigs = [with_shapes(person(name), lambda shape: shape.name in shapes) for name in (template, target)]
    count = len(rigs[0].names)

    def faces(number: int) -> np.ndarray:
        rows, deck = np.zeros((number, count)), []
        for row in rows:
            if len(deck) < per_face:
                deck = [*deck, *(k for k in draw.permutation(count) if k not in deck)]
            row[deck[:per_face]] = draw.uniform(0.3, 1.0, per_face)
            deck = deck[per_face:]
        return rows

    weights, held = faces(4), faces(8)
    off = np.clip(weights + draw.normal(0.0, 0.1, weights.shape), 0.0, 1.0)
    noisy = [
        {name: float(o) for name, w, o in zip(rigs[0].names, row, offs, strict=True) if w > 0.0}
        for row, offs in zip(weights, off, strict=True)
    ]
    return Task(rigs[0], in_style(rigs[1], seed), weights, held, noisy)
