"""Pictures of the four corners of the people's pad."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.deform.controls import Controls
from facemorph.ui import people
from facemorph.ui.people_page import Corner, PictureKey
from facemorph.ui.pictures import Pictures
from facemorph.ui.state import App

MOST_KEPT = 16


def corner_pictures() -> Pictures[PictureKey]:
    """Fills `PeoplePage.pictures`."""
    return Pictures(_wanted, _show, MOST_KEPT)


def _wanted(app: App, rig: Rig) -> dict[PictureKey, Callable[[], Scene]]:
    return {key: partial(_scene, app, corner) for corner, key in app.pages.people.wanted.items()}


def _scene(app: App, corner: Corner) -> Scene:
    kept, (s, t) = people.control(app), corner
    mix = kept.mix.at(float(s)) if kept.mix else None
    settings = Controls(people=replace(kept, mix=mix, t=float(t)))
    return app.methods.made(app.methods.bound(app), Pose(), settings)


def _show(app: App, rig: Rig, textures: dict[PictureKey, int]) -> None:
    app.pages.people.pictures = textures
