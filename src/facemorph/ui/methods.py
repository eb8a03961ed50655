"""From the methods' settings to the scene that is drawn; made again only when something changed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from facemorph.core.arrays import Float32
from facemorph.core.glow import glow_of
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import MOST_PARTNERS, Partner, Scene
from facemorph.deform.controls import METHODS, BoundControls, Controls
from facemorph.deform.regions import RegionSet
from facemorph.errors import FacemorphError

if TYPE_CHECKING:
    from facemorph.ui.state import App

# What the present face is called in a mixture of people, whatever its own name: names of others may be alike.
OWN = "this face"


@dataclass
class Methods:
    """What is bound to the present face, and the scene made last.

    people   rigs of other people by name, loaded when a mixture first asks for them
    hovered  the slider under the pointer, as weights of what it would move; empty for none
    """

    people: dict[str, Rig] = field(default_factory=dict)
    hovered: Mapping[str, float] = field(default_factory=dict)
    _bound: BoundControls | None = None
    _painted: RegionSet | None = None
    _key: tuple[object, ...] = ()
    _scene: Scene | None = None
    _glow: tuple[tuple[tuple[str, float], ...], Float32 | None] = ((), None)

    def scene(self, app: App) -> Scene:
        """What to draw now. A method that cannot do what it is set to is switched off, and says why."""
        if app.face is None:
            return Scene(app.pose)
        self._bind(app.face.rig, app.painted)
        key = (app.face, app.shown_pose, app.controls, tuple(self.people))
        if self._scene is None or key != self._key:
            self._scene, self._key = self._made(app, app.shown_pose), key
        lit = app.on_face.glow
        return replace(self._scene, glow=self._lit(app.face.rig) if lit is None else lit)

    def bound(self, app: App) -> BoundControls:
        """The methods bound to the present face, which must be there."""
        assert app.face is not None
        return self._bind(app.face.rig, app.painted)

    def made(self, bound: BoundControls, pose: Pose, controls: Controls) -> Scene:
        """The scene of a pose with any settings. Raises what the methods raise."""
        return Scene.moved(pose, bound(pose, controls), self._partners(bound.rig, controls))

    def forget(self) -> None:
        """Nothing of what was bound holds any longer: people were loaded, or regions painted."""
        self._bound, self._key = None, ()

    def _bind(self, rig: Rig, painted: RegionSet | None) -> BoundControls:
        if self._bound is None or self._bound.rig is not rig or self._painted is not painted:
            self._bound, self._painted = BoundControls(rig, OWN, self.people, painted), painted
            self._key = ()
        return self._bound

    def _made(self, app: App, pose: Pose) -> Scene:
        assert self._bound is not None
        while True:
            try:
                return self.made(self._bound, pose, app.controls)
            except FacemorphError as error:
                failing = self._failing(pose, app.controls)
                if failing == "":
                    raise
                app.controls = replace(app.controls, off=app.controls.off | {failing})
                self._tell(app, failing, error)

    def _failing(self, pose: Pose, controls: Controls) -> str:
        """The first method that cannot do alone what it is set to."""
        assert self._bound is not None
        for method in METHODS:
            alone = replace(controls, off=frozenset(METHODS) - {method} | controls.off)
            try:
                self._bound(pose, alone)
            except FacemorphError:
                return method
        # Somebody in the mixture lacks what another method asks for.
        mixing = controls.on("people") and controls.people.mix is not None
        return "people" if mixing else ""

    def _tell(self, app: App, method: str, error: FacemorphError) -> None:
        app.messages.fail(f"{tab_title(method)} is switched off. {error}")

    def _partners(self, rig: Rig, controls: Controls) -> list[Partner]:
        """Whose colours are mixed in, as the people are mixed; those of weight 0 too, who may get some."""
        mix = controls.people.mix
        if mix is None or not controls.on("people") or not controls.people.skins:
            return []
        weights = mix.weights()
        others = {n: self.people[n] for n in (*mix.source, mix.target) if n in self.people}
        partners = [Partner(other, weights.get(n, 0.0)) for n, other in others.items() if other is not rig]
        return sorted(partners, key=lambda partner: -partner.weight)[:MOST_PARTNERS]

    def _lit(self, rig: Rig) -> Float32 | None:
        """Where the face lights up for the hovered slider."""
        wanted = tuple(sorted(self.hovered.items()))
        if wanted != self._glow[0]:
            known = {name: weight for name, weight in wanted if name in rig.names}
            self._glow = (wanted, glow_of(rig, known) if known else None)
        return self._glow[1]


def tab_title(method: str) -> str:
    """What a method's page is called."""
    return "FACS" if method == "facs" else method.capitalize()
