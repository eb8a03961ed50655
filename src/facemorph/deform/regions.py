"""Parke's parametric face: each region has its own way between two states, and its own turn, size and shift.

Weights of the regions sum to at most 1 at every vertex; the rest of the head belongs to none and stays.
A vertex moves by the weighted sum of what its regions want (thesis, 1.3.4, after Parke 1974).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.morph import Curve
from facemorph.core.pose import State, mixed_state
from facemorph.core.rig import Rig
from facemorph.errors import DeformError, UnknownNameError


@dataclass(frozen=True)
class RegionControl:
    """What one region does.

    source, target   states (shape name -> weight), and t with its curve between them, as in (2.5)
    turn_deg         rotation about x, then y, then z through the pivot, degrees
    size             scale about the pivot
    shift            translation, model units
    pivot            model units; None takes the weighted middle of the region
    """

    source: State = field(default_factory=dict)
    target: State = field(default_factory=dict)
    t: float = 0.0
    curve: Curve = "linear"
    turn_deg: tuple[float, float, float] = (0.0, 0.0, 0.0)
    size: float = 1.0
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    pivot: tuple[float, float, float] | None = None

    def state(self) -> dict[str, float]:
        """Shape name -> weight at the present t."""
        return mixed_state(self.source, self.target, self.t, self.curve)

    @property
    def moves_rigidly(self) -> bool:
        """Whether turn, size or shift do anything."""
        return any(self.turn_deg) or self.size != 1.0 or any(self.shift)


class RegionSet:
    """Soft regions of one rig: bind once, call for every change. `weights` is (R, V) float32, 0..1."""

    def __init__(self, rig: Rig, names: tuple[str, ...], weights: Float32) -> None:
        if weights.shape != (len(names), rig.neutral.vertex_count):
            raise DeformError(
                f"region weights must be {(len(names), rig.neutral.vertex_count)}, not {weights.shape}."
            )
        if len(names) and (weights.min() < 0.0 or weights.sum(axis=0).max() > 1.0 + 1e-5):
            raise DeformError("region weights must be 0 or more and sum to at most 1 at every vertex.")
        self._rig = rig
        self.names = names
        self.weights = weights

    @classmethod
    def of(cls, rig: Rig) -> RegionSet:
        """The regions that the face brings. Raises `DeformError` where it has none."""
        if rig.regions is None:
            raise DeformError(f"{rig.info.name} has no regions; paint some on the face first.")
        return cls(rig, rig.regions.names, rig.regions.weights.astype(np.float32) / np.float32(255.0))

    def __call__(self, controls: Mapping[str, RegionControl]) -> Float32:
        """Offsets (V, 3) float32. Raises `UnknownNameError` for a region or shape that is not there."""
        total = np.zeros(self._rig.neutral.positions.shape)
        for name, control in controls.items():
            if name not in self.names:
                raise UnknownNameError("region", name, self.names)
            weight = self.weights[self.names.index(name)].astype(np.float64)
            inside = np.flatnonzero(weight)
            total[inside] += weight[inside, None] * self._wanted(control, weight, inside)
        return total.astype(np.float32)

    def middle(self, name: str) -> Float64:
        """The pivot of a region where none is set: its weighted middle, (3,)."""
        weight = self.weights[self.names.index(name)].astype(np.float64)
        return self._middle(weight)

    def _middle(self, weight: Float64) -> Float64:
        mass = max(float(weight.sum()), 1e-12)
        middle: Float64 = weight @ self._rig.neutral.positions.astype(np.float64) / mass
        return middle

    def _wanted(
        self, control: RegionControl, weight: Float64, inside: np.ndarray[tuple[int], np.dtype[np.intp]]
    ) -> Float64:
        """Where the region's vertices would go if they belonged to it alone, less where they rest, (n, 3)."""
        rest = self._rig.neutral.positions[inside].astype(np.float64)
        moved = rest.copy()
        coefficients = self._rig.coefficients(control.state())
        for k in np.flatnonzero(coefficients):
            moved += coefficients[k] * self._rig.deltas[k][inside]
        if control.moves_rigidly:
            pivot = self._middle(weight) if control.pivot is None else np.asarray(control.pivot)
            turned = (moved - pivot) @ rotation(control.turn_deg).T * control.size
            moved = turned + pivot + np.asarray(control.shift)
        return moved - rest


def rotation(turn_deg: tuple[float, float, float]) -> Float64:
    """(3, 3) rotation about x, then y, then z, degrees."""
    matrix = np.eye(3)
    for axis, degrees in enumerate(turn_deg):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        i, j = (axis + 1) % 3, (axis + 2) % 3
        turn = np.eye(3)
        turn[i, i], turn[i, j], turn[j, i], turn[j, j] = c, -s, s, c
        matrix = turn @ matrix
    return matrix


def painted(weights: Float32, region: int, brush: Float32) -> Float32:
    """Region weights (R, V) after a brush stroke (V,) 0..1 that gives to `region`, or takes where negative.

    The others make room in proportion, so that the sum at a vertex never passes 1.
    """
    result = weights.copy()
    result[region] = np.clip(weights[region] + brush, 0.0, 1.0)
    others = np.delete(np.arange(len(weights)), region)
    rest = weights[others].sum(axis=0)
    room = np.clip(np.float32(1.0) - result[region], 0.0, None)
    shrink = np.where(rest > room, room / np.maximum(rest, np.float32(1e-12)), np.float32(1.0))
    result[others] *= shrink
    return result
