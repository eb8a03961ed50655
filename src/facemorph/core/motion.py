"""`Contribution`: what one method adds to a face; contributions of several methods add up.

positions = neutral + sum_k (pose_k + weights_k) delta_k + offsets
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from facemorph.core.arrays import Float32
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig


@dataclass(frozen=True, eq=False)
class Contribution:
    """Weights by shape name, and offsets (V, 3) float32 in model units, or None for none.

    Offsets are never changed in place: whoever draws may tell by identity that they are the same.
    """

    weights: Mapping[str, float] = field(default_factory=dict)
    offsets: Float32 | None = None

    def __add__(self, other: Contribution) -> Contribution:
        """Both at once."""
        weights = dict(self.weights)
        for name, weight in other.weights.items():
            weights[name] = weights.get(name, 0.0) + weight
        return Contribution(weights, _summed(self.offsets, other.offsets))

    def added_to(self, pose: Pose) -> Pose:
        """`pose` with these weights on top of its own."""
        total = Contribution(pose.weights) + Contribution(self.weights)
        return replace(pose, weights={n: w for n, w in total.weights.items() if w != 0.0})

    def positions(self, rig: Rig, pose: Pose) -> Float32:
        """Positions (V, 3) float32 of `rig` in `pose` with this on top: the reference for faster ways."""
        moved = rig.positions(self.added_to(pose))
        return moved if self.offsets is None else moved + self.offsets


def total(contributions: Iterable[Contribution]) -> Contribution:
    """The sum of all."""
    result = Contribution()
    for contribution in contributions:
        result = result + contribution
    return result


def _summed(one: Float32 | None, other: Float32 | None) -> Float32 | None:
    if one is None or other is None:
        return other if one is None else one
    return one + other
