"""`Scene`: what is drawn of a face in one frame, apart from where it is seen from and how it is shaded."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from facemorph.core.arrays import Float32
from facemorph.core.mesh import Mesh
from facemorph.core.motion import Contribution
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, as_pose

# How many people's colours can be mixed into a face's own: what every OpenGL 3.3 has texture units for.
MOST_PARTNERS = 8


@dataclass(frozen=True, eq=False)
class Partner:
    """Another person whose colours are mixed in, with `weight` (thesis, 2.1.2, for any number of people).

    colour = w_0 colour_own + sum_i w_i colour_i with w_0 = 1 - sum_i w_i, each looked up at its own texture
    coordinate. The partner's rig has the same polygons; its texture coordinates may be others.
    """

    rig: Rig
    weight: float


@dataclass(frozen=True, eq=False)
class Scene:
    """A pose and what comes on top of it. Arrays are never changed in place: identity tells a change.

    offsets    (V, 3) float32 added to the morphed positions, model units; None for none
    glow       (V,) float32 0..1, where the face is lit up; None for nowhere
    reference  (V, 3) float32 that the heat map measures distances from; None is the neutral
    partners   other people whose colours are mixed in; their order does not matter
    """

    pose: Pose
    offsets: Float32 | None = None
    glow: Float32 | None = None
    reference: Float32 | None = None
    partners: tuple[Partner, ...] = ()

    @classmethod
    def of(cls, what: Scene | Pose | Mapping[str, float]) -> Scene:
        """`what` itself, or the scene that a pose or a mapping of shape names to weights stands for."""
        return what if isinstance(what, Scene) else cls(as_pose(what))

    @classmethod
    def moved(cls, pose: Pose, contribution: Contribution, partners: Sequence[Partner] = ()) -> Scene:
        """`pose` with what the methods add to it."""
        return cls(contribution.added_to(pose), contribution.offsets, partners=tuple(partners))

    def positions(self, rig: Rig) -> Float32:
        """Positions (V, 3) float32 of `rig`: the reference for every faster way."""
        return Contribution(offsets=self.offsets).positions(rig, self.pose)


def colour_shares(own: Mesh, partners: Sequence[Partner]) -> dict[Mesh, float]:
    """Each person's share of the colours, `own` first: none below 0, together 1.

    A mixture typed beyond its people (s = 1.3) is right for geometry, but a colour of less than nobody is
    none: weights below 0 count as 0 and the others are scaled to a sum of 1. For one partner that takes s
    outside 0..1 for the nearer end. Who stands there twice has the sum, `own` among the partners is own.
    """
    listed: dict[Mesh, list[float]] = {own: [1.0, *(-partner.weight for partner in partners)]}
    for partner in partners:
        listed.setdefault(partner.rig.neutral, []).append(partner.weight)
    # Summed exactly, so that the order in which people stand changes no bit.
    kept = {mesh: max(math.fsum(weights), 0.0) for mesh, weights in listed.items()}
    whole = math.fsum(kept.values())
    return {mesh: weight / whole for mesh, weight in kept.items()}
