"""Similarities: rotation, translation and scale between sets of corresponding points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Float64


@dataclass(frozen=True, eq=False)
class Similarity:
    """x -> scale * rotation x + translation; rotation (3, 3), translation (3,)."""

    scale: float
    rotation: Float64
    translation: Float64

    def points(self, points: Float64) -> Float64:
        """Points (V, 3) carried over."""
        return np.asarray(self.offsets(points) + self.translation)

    def offsets(self, offsets: Float64) -> Float64:
        """Offsets (..., 3) carried over: turned and scaled, not moved."""
        return np.asarray(self.scale * (offsets @ self.rotation.T))

    def inverse(self) -> Similarity:
        """The way back."""
        back = self.rotation.T / self.scale
        return Similarity(1.0 / self.scale, self.rotation.T, -back @ self.translation)


def diagonal_of(points: Float64) -> float:
    """The diagonal of the box around points (N, 3)."""
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def similarity(source: Float64, target: Float64, *, scaled: bool = True) -> Similarity:
    """The similarity that takes points `source` (N, 3) nearest to `target` (N, 3), least squares.

    After Umeyama (1991); never a reflection. `scaled` off: a rigid motion. Points that all coincide, or
    fewer than three, leave the rotation as it is.
    """
    middle, goal = source.mean(axis=0), target.mean(axis=0)
    offsets, aims = source - middle, target - goal
    left, sizes, right = np.linalg.svd(aims.T @ offsets)
    if len(source) < 3 or sizes[1] <= 1e-12 * max(float(sizes[0]), 1e-300):
        rotation = np.eye(3)
    else:
        signs = np.array([1.0, 1.0, np.sign(np.linalg.det(left @ right)) or 1.0])
        rotation = (left * signs) @ right
    spread = float((offsets**2).sum())
    scale = float((aims * (offsets @ rotation.T)).sum()) / spread if scaled and spread > 0.0 else 1.0
    scale = scale if scale > 0.0 else 1.0
    return Similarity(scale, rotation, goal - scale * rotation @ middle)
