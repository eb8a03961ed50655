"""Pictures of the present face in its expressions, for the poles of the emotion map."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from weakref import ref

from facemorph.core.mesh import Mesh
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, Shape
from facemorph.core.scene import Scene
from facemorph.ui.emotion_poles import MOST_POLES
from facemorph.ui.handles import MADE
from facemorph.ui.pictures import Pictures
from facemorph.ui.state import App

# The pole's name, and what its picture holds for: the head, but the very rig for a shape that was made
# and may be made anew. Rigs are large: a picture must not keep one that nobody else needs.
PoleKey = tuple[str, ref[Mesh] | ref[Rig]]


def pole_pictures() -> Pictures[PoleKey]:
    """Fills `EmotionPage.pictures`."""
    return Pictures(_wanted, _show, MOST_POLES)


def _wanted(app: App, rig: Rig) -> dict[PoleKey, Callable[[], Scene]]:
    return {
        _key(rig, shape): partial(Scene, Pose.of({shape.name: 1.0})) for shape in app.pages.emotion.wanted
    }


def _key(rig: Rig, shape: Shape) -> PoleKey:
    return shape.name, ref(rig) if shape.set == MADE else ref(rig.neutral)


def _show(app: App, rig: Rig, textures: dict[PoleKey, int]) -> None:
    page, held = app.pages.emotion, (ref(rig), ref(rig.neutral))
    page.pictures = {name: texture for (name, of), texture in textures.items() if of in held}
    page.pictured = rig.neutral
