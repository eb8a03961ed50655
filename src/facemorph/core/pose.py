"""`Pose`: what the user's controls say, apart from any face.

A pose goes from a source state to a target state (the slider along the bottom), and adds weights of
single shapes on top (the shapes panel). States are mixtures of shapes, so that the present face,
whatever it is, can become the next source without a jump (thesis, (2.11)).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.morph import Curve, eased, mixed_coefficients
from facemorph.errors import PoseError, UnknownNameError

NEUTRAL = "neutral"
# A weight beyond this, either way, is a slip: nothing of the face would be left in sight.
LARGEST_WEIGHT = 100.0
State = Mapping[str, float]


def state_of(name: str) -> State:
    """The state called `name`: that shape alone at weight 1, or no shape for `neutral`."""
    return {} if name == NEUTRAL else {name: 1.0}


def parsed_number(text: str, what: str) -> float:
    """A finite number from text. Raises `PoseError` naming `what`."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise PoseError(f"{what} takes a number, not {text!r}.")
    return value


def parsed_weight(text: str, what: str) -> float:
    """A weight from text. Raises `PoseError` naming `what` for no number, or one beyond `LARGEST_WEIGHT`."""
    value = parsed_number(text, what)
    if abs(value) > LARGEST_WEIGHT:
        raise PoseError(
            f"{what} takes a number from -{LARGEST_WEIGHT:g} to {LARGEST_WEIGHT:g}, not {text!r}."
        )
    return value


def mixed_state(source: State, target: State, t: float, curve: Curve = "linear") -> dict[str, float]:
    """The mixture at `t` between two states, (2.5) on their weights; shapes of weight 0 are left out."""
    e = eased(t, curve)
    names = dict.fromkeys([*source, *target])
    mixed = {name: (1.0 - e) * source.get(name, 0.0) + e * target.get(name, 0.0) for name in names}
    return {name: weight for name, weight in mixed.items() if weight != 0.0}


@dataclass(frozen=True)
class Pose:
    """Named control values. Weights may lie outside 0..1 where the user asks for it.

    source, target   shape name -> weight; empty is the neutral face
    t, curve         where the slider stands, and how it eases
    weights          shape name -> weight, added to the sum
    """

    source: State = field(default_factory=dict)
    target: State = field(default_factory=dict)
    t: float = 0.0
    curve: Curve = "linear"
    weights: State = field(default_factory=dict)

    @classmethod
    def between(cls, source: str, target: str, t: float, curve: Curve = "linear") -> Pose:
        """The state at `t` between two named expressions."""
        return cls(state_of(source), state_of(target), t, curve)

    @classmethod
    def of(cls, weights: Mapping[str, float]) -> Pose:
        """Single shapes at given weights."""
        return cls(weights=dict(weights))

    def rebased(self, target: str) -> Pose:
        """The present state becomes the source, `target` the goal, the slider 0: nothing jumps (2.11)."""
        return replace(self, source=self.way_state(), target=state_of(target), t=0.0)

    def way_state(self) -> dict[str, float]:
        """The mixture between source and target at the present t, without `weights`."""
        return mixed_state(self.source, self.target, self.t, self.curve)

    def with_weight(self, name: str, weight: float) -> Pose:
        """The same pose with one added shape's weight set; 0 takes it out."""
        weights = {n: w for n, w in self.weights.items() if n != name}
        if weight != 0.0:
            weights[name] = weight
        return replace(self, weights=weights)

    def names(self) -> set[str]:
        """Every shape the pose speaks of."""
        return {*self.source, *self.target, *self.weights}

    def coefficients(self, shape_names: tuple[str, ...]) -> Float64:
        """Coefficients (K,) over the shapes in order. Raises `UnknownNameError` and `PoseError`."""
        index = {name: k for k, name in enumerate(shape_names)}
        parts = [_vector(state, index) for state in (self.source, self.target, self.weights)]
        if not math.isfinite(self.t):
            raise PoseError(f"the slider's position must be a number, not {self.t}.")
        return mixed_coefficients(parts[0], parts[1], parts[2], self.t, self.curve)


def _vector(state: State, index: Mapping[str, int]) -> Float64:
    values = np.zeros(len(index))
    for name, weight in state.items():
        if name == NEUTRAL:
            continue
        if name not in index:
            raise UnknownNameError("shape", name, (NEUTRAL, *index))
        if not math.isfinite(weight):
            raise PoseError(f"the weight of {name!r} must be a number, not {weight}.")
        values[index[name]] = weight
    return values
