"""Pictures of the present face in its expressions for the emotion map: one a frame, kept for the head."""

from __future__ import annotations

from typing import TYPE_CHECKING

from imgui_bundle import imgui

from facemorph.core.mesh import Mesh
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, Shape
from facemorph.errors import FacemorphError
from facemorph.ui.handles import MADE
from facemorph.ui.portraits import PORTRAIT_LOOK, SIDE, halved, portrait
from facemorph.ui.split_view import DrawsFaces
from facemorph.ui.state import App

if TYPE_CHECKING:
    import moderngl


class PolePictures:
    """Fills `EmotionPage.pictures`. The window's own renderer draws them: the face lies loaded there.

    Whoever asks for a step must draw the face anew where one was done.
    """

    def __init__(self) -> None:
        self._head: Mesh | None = None
        self._textures: dict[str, tuple[object, moderngl.Texture]] = {}
        self._failed: set[str] = set()
        self._old: list[moderngl.Texture] = []

    def busy(self, app: App) -> bool:
        """Whether a frame soon has a picture to draw."""
        return bool(self._missing(app))

    def step(self, app: App, renderer: DrawsFaces) -> bool:
        """Draw one picture that is wanted and not there; True where the renderer was used for it."""
        rig, page = app.rig, app.pages.emotion
        if rig is None:
            return False
        self._release_old()
        if rig.neutral is not self._head:
            self._forget()
            self._head = rig.neutral
        missing = self._missing(app)
        # While the hand moves something, every frame belongs to that.
        drawn = bool(missing) and not imgui.is_any_item_active() and not app.drag
        if drawn:
            self._draw(rig, missing[0], renderer)
        held = (rig, rig.neutral)
        page.pictures = {name: texture.glo for name, (of, texture) in self._textures.items() if of in held}
        page.pictured = rig.neutral
        return drawn

    def _missing(self, app: App) -> list[Shape]:
        rig = app.rig
        if rig is None:
            return []
        return [
            shape
            for shape in app.pages.emotion.wanted
            if rig.neutral is not self._head
            or (shape.name not in self._failed and self._kept(shape.name) is not _source(rig, shape))
        ]

    def _kept(self, name: str) -> object:
        return self._textures[name][0] if name in self._textures else None

    def _draw(self, rig: Rig, shape: Shape, renderer: DrawsFaces) -> None:
        try:
            large = (2 * SIDE, 2 * SIDE)
            renderer.draw(Pose.of({shape.name: 1.0}), portrait(rig), PORTRAIT_LOOK, large)
            pixels = halved(renderer.read())
        except FacemorphError:
            # A pole without a picture still has its name.
            self._failed.add(shape.name)
            return
        texture = renderer.texture.ctx.texture((SIDE, SIDE), 4, pixels.tobytes())
        texture.build_mipmaps()
        if shape.name in self._textures:
            self._old.append(self._textures[shape.name][1])
        self._textures[shape.name] = (_source(rig, shape), texture)

    def release(self) -> None:
        """Give the textures back."""
        self._forget()
        self._release_old()

    def _forget(self) -> None:
        # What is drawn of the interface in this frame may still show them.
        self._old.extend(texture for _, texture in self._textures.values())
        self._textures.clear()
        self._failed.clear()
        self._head = None

    def _release_old(self) -> None:
        for texture in self._old:
            texture.release()
        self._old.clear()


def _source(rig: Rig, shape: Shape) -> object:
    """What a picture holds for: the head, but the very rig for a shape that was made and may be made anew."""
    return rig if shape.set == MADE else rig.neutral
