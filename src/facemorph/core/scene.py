"""`Scene`: what is drawn of a face in one frame, apart from where it is seen from and how it is shaded."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from facemorph.core.arrays import Float32
from facemorph.core.motion import Contribution
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, as_pose


@dataclass(frozen=True, eq=False)
class Partner:
    """Another person whose colours are mixed in: `s` 0 is the face's own, 1 the partner's (thesis, 2.1.2).

    colour = (1 - s) colour_own + s colour_partner, each looked up at its own texture coordinate. The
    partner's rig has the same polygons; its texture coordinates may be others.
    """

    rig: Rig
    s: float


@dataclass(frozen=True, eq=False)
class Scene:
    """A pose and what comes on top of it. Arrays are never changed in place: identity tells a change.

    offsets    (V, 3) float32 added to the morphed positions, model units; None for none
    glow       (V,) float32 0..1, where the face is lit up; None for nowhere
    reference  (V, 3) float32 that the heat map measures distances from; None is the neutral
    partner    another person whose colours are mixed in
    """

    pose: Pose
    offsets: Float32 | None = None
    glow: Float32 | None = None
    reference: Float32 | None = None
    partner: Partner | None = None

    @classmethod
    def of(cls, what: Scene | Pose | Mapping[str, float]) -> Scene:
        """`what` itself, or the scene that a pose or a mapping of shape names to weights stands for."""
        return what if isinstance(what, Scene) else cls(as_pose(what))

    @classmethod
    def moved(cls, pose: Pose, contribution: Contribution, partner: Partner | None = None) -> Scene:
        """`pose` with what the methods add to it."""
        return cls(contribution.added_to(pose), contribution.offsets, partner=partner)

    def positions(self, rig: Rig) -> Float32:
        """Positions (V, 3) float32 of `rig`: the reference for every faster way."""
        return Contribution(offsets=self.offsets).positions(rig, self.pose)
