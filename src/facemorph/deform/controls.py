"""`Controls`: what all methods of a face are set to; `BoundControls`: from them to weights and offsets.

Each method can be switched off without losing what it is set to. Contributions add up; people come
last, because a mixture of people wears whatever expression the others make.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from facemorph.core.arrays import Float32
from facemorph.core.emotion import PAPER_POLES, Pole, emotion_weights
from facemorph.core.facs import Sides
from facemorph.core.morph import Curve
from facemorph.core.motion import Contribution, total
from facemorph.core.pose import NEUTRAL, Pose, State, mixed_state
from facemorph.core.rig import Rig
from facemorph.deform.handles import BoundHandles, HandleSet
from facemorph.deform.people import People, PeopleMix
from facemorph.deform.regions import RegionControl, RegionSet
from facemorph.deform.sides import SidedUnits
from facemorph.errors import UnknownNameError

METHODS = ("facs", "emotion", "people", "handles", "regions")


@dataclass(frozen=True)
class EmotionControl:
    """The emotion map: where the cursor stands, and the poles round it."""

    x: float = 0.0
    y: float = 0.0
    poles: tuple[Pole, ...] = PAPER_POLES

    def weights(self) -> dict[str, float]:
        """Weights by expression."""
        return emotion_weights(self.x, self.y, self.poles)


@dataclass(frozen=True)
class PeopleControl:
    """The bilinear pad: s between people, t between two states (2.10); no mix is the face itself.

    `skins`: the colours of skin and eyes blend along s too (2.1.2).
    """

    mix: PeopleMix | None = None
    source: State = field(default_factory=dict)
    target: State = field(default_factory=dict)
    t: float = 0.0
    curve: Curve = "linear"
    skins: bool = True

    def weights(self) -> dict[str, float]:
        """Weights by expression at the present t."""
        return mixed_state(self.source, self.target, self.t, self.curve)


@dataclass(frozen=True)
class Controls:
    """The settings of every method; `off` names those that are switched off."""

    facs: Mapping[int, Sides] = field(default_factory=dict)
    emotion: EmotionControl = field(default_factory=EmotionControl)
    people: PeopleControl = field(default_factory=PeopleControl)
    handles: HandleSet = field(default_factory=HandleSet)
    regions: Mapping[str, RegionControl] = field(default_factory=dict)
    off: frozenset[str] = frozenset()

    def on(self, method: str) -> bool:
        """Whether a method counts."""
        return method not in self.off


class BoundControls:
    """Methods bound to one rig, each when it is first used; what did not change is not computed again.

    people   other rigs of the same topology by name; `name` is what this rig is called among them
    regions  regions to use in place of the rig's own (painted ones)
    """

    def __init__(
        self,
        rig: Rig,
        name: str = "",
        people: Mapping[str, Rig] | None = None,
        regions: RegionSet | None = None,
    ) -> None:
        self.rig = rig
        self._name = name or rig.info.name
        self._people = people if people is not None else {}
        self._regions = regions
        self._units: SidedUnits | None = None
        self._bound_people: tuple[tuple[str, ...], People] | None = None
        self._handles = BoundHandles(rig)
        self._kept: dict[str, tuple[object, Contribution]] = {}

    def __call__(self, pose: Pose, controls: Controls) -> Contribution:
        """What all methods add to `pose`.

        Raises what the methods raise, and `UnknownNameError` for a weight of a shape that the face lacks.
        """
        makers: dict[str, tuple[object, Callable[[], Contribution]]] = {
            "facs": (controls.facs, lambda: self._sided(controls.facs)),
            "emotion": (controls.emotion, lambda: Contribution(controls.emotion.weights())),
            "people": (controls.people, lambda: Contribution(controls.people.weights())),
            "handles": (controls.handles, lambda: Contribution(offsets=self._handles(controls.handles))),
            "regions": (controls.regions, lambda: self._moved_regions(controls.regions)),
        }
        on = (self._kept_or_made(m, setting, make) for m, (setting, make) in makers.items() if controls.on(m))
        contribution = total(on)
        mixture = self._mixture(contribution.added_to(pose), controls)
        return contribution if mixture is None else contribution + Contribution(offsets=mixture)

    def _kept_or_made(self, method: str, setting: object, make: Callable[[], Contribution]) -> Contribution:
        kept = self._kept.get(method)
        if kept is None or kept[0] is not setting:
            kept = self._kept[method] = (setting, self._checked(make()))
        return kept[1]

    def _checked(self, contribution: Contribution) -> Contribution:
        known = {NEUTRAL, *self.rig.names}
        for name, weight in contribution.weights.items():
            if weight != 0.0 and name not in known:
                raise UnknownNameError("shape", name, (NEUTRAL, *self.rig.names))
        return contribution

    def _sided(self, units: Mapping[int, Sides]) -> Contribution:
        if self._units is None:
            self._units = SidedUnits(self.rig)
        return self._units(units)

    def _moved_regions(self, controls: Mapping[str, RegionControl]) -> Contribution:
        if not controls:
            return Contribution()
        if self._regions is None:
            self._regions = RegionSet.of(self.rig)
        return Contribution(offsets=self._regions(controls))

    def _mixture(self, pose: Pose, controls: Controls) -> Float32 | None:
        """What the other people add to the face in `pose`; None where this face is shown alone."""
        mix = controls.people.mix
        weights = mix.weights() if mix is not None and controls.on("people") else {}
        if not weights or weights.keys() == {self._name}:
            return None
        others = tuple(name for name in weights if name != self._name)
        if self._bound_people is None or self._bound_people[0] != others:
            known = {name: self._people[name] for name in others if name in self._people}
            self._bound_people = (others, People({self._name: self.rig, **known}))
        people = self._bound_people[1]
        offsets = people.offsets(weights, self.rig.coefficients(pose))
        uneven = {n: s for n, s in controls.facs.items() if s.left != s.right and controls.on("facs")}
        return offsets + people.sided_offsets(weights, uneven) if uneven else offsets
