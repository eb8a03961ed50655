"""Small pictures of the present face that a page shows: one drawn a frame, the latest kept."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import TYPE_CHECKING, Generic, TypeVar

from imgui_bundle import imgui

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.errors import FacemorphError
from facemorph.ui.portraits import PORTRAIT_LOOK, SIDE, halved, portrait
from facemorph.ui.split_view import DrawsFaces
from facemorph.ui.state import App

if TYPE_CHECKING:
    import moderngl

Key = TypeVar("Key", bound=Hashable)


class Pictures(Generic[Key]):
    """Draws what a page wants with the window's own renderer: the face lies loaded there.

    wanted     what the page shows: all that a picture depends on -> what makes its scene
    show       hands the page its textures; a picture that could not be drawn has none
    most_kept  so many stay while the head does, and all that are on show

    Whoever asks for a step must draw the face anew where one was done.
    """

    def __init__(
        self,
        wanted: Callable[[App, Rig], Mapping[Key, Callable[[], Scene]]],
        show: Callable[[App, Rig, dict[Key, int]], None],
        most_kept: int,
    ) -> None:
        self._wanted, self._show, self._most_kept = wanted, show, most_kept
        self._head: Mesh | None = None
        self._textures: dict[Key, moderngl.Texture | None] = {}
        self._old: list[moderngl.Texture] = []

    def busy(self, app: App) -> bool:
        """Whether a frame soon has a picture to draw."""
        return app.rig is not None and bool(self._missing(app, app.rig))

    def step(self, app: App, renderer: DrawsFaces) -> bool:
        """Draw one picture that is wanted and not there; True where the renderer was used for it."""
        rig = app.rig
        if rig is None:
            return False
        self._release_old()
        if rig.neutral is not self._head:
            self._forget()
            self._head = rig.neutral
        missing = self._missing(app, rig)
        # While the hand moves something, every frame belongs to that.
        drawn = bool(missing) and not imgui.is_any_item_active() and not app.drag
        if drawn:
            key, scene = next(iter(missing.items()))
            self._textures[key] = _drawn(rig, scene, renderer)
            self._let_go(self._wanted(app, rig))
        self._show(app, rig, {key: texture.glo for key, texture in self._textures.items() if texture})
        return drawn

    def release(self) -> None:
        """Give the textures back."""
        self._forget()
        self._release_old()

    def _missing(self, app: App, rig: Rig) -> dict[Key, Callable[[], Scene]]:
        kept = self._textures if rig.neutral is self._head else {}
        return {key: scene for key, scene in self._wanted(app, rig).items() if key not in kept}

    def _let_go(self, wanted: Mapping[Key, object]) -> None:
        """The oldest go, but none that is on show."""
        spare = [key for key in self._textures if key not in wanted]
        for key in spare[: max(len(self._textures) - self._most_kept, 0)]:
            self._retire(self._textures.pop(key))

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


def _drawn(rig: Rig, scene: Callable[[], Scene], renderer: DrawsFaces) -> moderngl.Texture | None:
    try:
        renderer.draw(scene(), portrait(rig), PORTRAIT_LOOK, (2 * SIDE, 2 * SIDE))
        pixels = halved(renderer.read())
    except FacemorphError:
        # What has no picture still has its words.
        return None
    from facemorph.gl import texture_of

    return texture_of(renderer.texture.ctx, pixels)
