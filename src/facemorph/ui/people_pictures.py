"""Small pictures of the four corners of the people's pad: one a frame, the latest kept."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from imgui_bundle import imgui

from facemorph.core.mesh import Mesh
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.deform.controls import Controls
from facemorph.errors import FacemorphError
from facemorph.ui import people
from facemorph.ui.people_page import Corner, PictureKey
from facemorph.ui.portraits import PORTRAIT_LOOK, SIDE, halved, portrait
from facemorph.ui.split_view import DrawsFaces
from facemorph.ui.state import App

if TYPE_CHECKING:
    import moderngl

MOST_KEPT = 16


class CornerPictures:
    """Fills `PeoplePage.pictures`. The window's own renderer draws them: the face lies loaded there.

    Whoever asks for a step must draw the face anew where one was done.
    """

    def __init__(self) -> None:
        self._head: Mesh | None = None
        self._textures: dict[PictureKey, moderngl.Texture | None] = {}
        self._old: list[moderngl.Texture] = []

    def busy(self, app: App) -> bool:
        """Whether a frame soon has a picture to draw."""
        return app.rig is not None and bool(self._missing(app))

    def step(self, app: App, renderer: DrawsFaces) -> bool:
        """Draw one picture that is wanted and not there; True where the renderer was used for it."""
        rig, page = app.rig, app.pages.people
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
            key, corner = next(iter(missing.items()))
            self._textures[key] = self._drawn(app, rig, corner, renderer)
            self._let_go(page.wanted)
        page.pictures = {key: texture.glo for key, texture in self._textures.items() if texture}
        return drawn

    def _missing(self, app: App) -> dict[PictureKey, Corner]:
        wanted = app.pages.people.wanted
        return {key: corner for corner, key in wanted.items() if key not in self._textures}

    def _drawn(self, app: App, rig: Rig, corner: Corner, renderer: DrawsFaces) -> moderngl.Texture | None:
        kept, (s, t) = people.control(app), corner
        mix = kept.mix.at(float(s)) if kept.mix else None
        settings = Controls(people=replace(kept, mix=mix, t=float(t)))
        try:
            scene = app.methods.made(app.methods.bound(app), Pose(), settings)
            renderer.draw(scene, portrait(rig), PORTRAIT_LOOK, (2 * SIDE, 2 * SIDE))
            pixels = halved(renderer.read())
        except FacemorphError:
            # A corner without a picture still has its words.
            return None
        texture = renderer.texture.ctx.texture((SIDE, SIDE), 4, pixels.tobytes())
        texture.build_mipmaps()
        return texture

    def _let_go(self, wanted: dict[Corner, PictureKey]) -> None:
        """The oldest go, but none that is on show."""
        spare = [key for key in self._textures if key not in wanted.values()]
        for key in spare[: max(len(self._textures) - MOST_KEPT, 0)]:
            self._retire(self._textures.pop(key))

    def release(self) -> None:
        """Give the textures back."""
        self._forget()
        self._release_old()

    def _forget(self) -> None:
        for texture in self._textures.values():
            self._retire(texture)
        self._textures.clear()
        self._head = None

    def _retire(self, texture: moderngl.Texture | None) -> None:
        # What is drawn of the interface in this frame may still show it.
        if texture is not None:
            self._old.append(texture)

    def _release_old(self) -> None:
        for texture in self._old:
            texture.release()
        self._old.clear()
