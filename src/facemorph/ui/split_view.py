"""What draws faces, and the second view of the face beside the first: one camera, another renderer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np
from imgui_bundle import imgui

from facemorph.core.arrays import UInt8
from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.gl.describe import Graphics
from facemorph.gl.form import Form
from facemorph.gl.heat import Legend
from facemorph.ui.exposing import Exposing
from facemorph.ui.on_face import Split
from facemorph.ui.state import App, Face, Viewport

if TYPE_CHECKING:
    import moderngl

    from facemorph.gl.picking import Pick

Quality = Literal["full", "fast"]


class DrawsFaces(Protocol):
    """What the session needs of `gl.Renderer`; tests may put a stand-in here."""

    graphics: Graphics

    def load(self, rig: Rig) -> None:
        """Take a rig."""

    def take(self, form: Form) -> None:
        """Take a refined surface of the rig, for when its level is drawn; or the next rig's own."""

    @property
    def draw_secs(self) -> float | None:
        """What a graphics card lately took for a frame."""

    def draw(
        self,
        what: Scene | Pose,
        camera: Camera,
        look: Look,
        size: tuple[int, int],
        *,
        quality: Quality = "full",
    ) -> None:
        """Draw it."""

    def read(self) -> UInt8:
        """The picture drawn last."""

    @property
    def texture(self) -> moderngl.Texture:
        """The picture drawn last, for the window."""

    @property
    def legend(self) -> Legend | None:
        """Of the picture drawn last."""

    @property
    def problems(self) -> tuple[str, ...]:
        """What of the face cannot be shown."""

    def pick(self, x: float, y: float) -> Pick | None:
        """What lies at a pixel of the picture drawn last, from its top left."""

    def release(self) -> None:
        """Give everything back."""


class SplitView:
    """The right half of the viewport. Its renderer is made when it is first wanted."""

    def __init__(self, new_renderer: Callable[[], DrawsFaces]) -> None:
        self._new = new_renderer
        self.renderer: DrawsFaces | None = None
        self._loaded: Face | None = None
        self._exposing = Exposing()
        self._drawn: tuple[object, ...] = ()
        self._split: Split | None = None  # as drawn last; holding it keeps its arrays' identities

    def draw(self, app: App, split: Split, quality: Quality) -> bool:
        """Draw the second view; True where its legend is new and the interface must be built once more."""
        view, face = app.views()[1], split.face or app.shown_face
        if face is None:
            return False
        renderer = self._ready(app, face)
        look = replace(app.look, shading="heat") if split.heat else app.shown_look
        if app.shown_face is None or face.rig.neutral is not app.shown_face.rig.neutral:
            # Nobody refines the other face's surface beside the window.
            look = replace(look, subdivision=0)
        scene = split.right
        exactly = app.picture_path is not None and look.luminance is not None
        wanted = (
            face, scene.pose, id(scene.offsets), id(scene.reference), partner_key(scene), app.camera,
            look, view.size, exactly,
        )  # fmt: skip
        if (*wanted, quality) != self._drawn and (*wanted, "full") != self._drawn:
            self._split = split
            exposed = self._exposing.look(
                renderer, scene, app.camera, look, view.size, moving=quality == "fast", exactly=exactly
            )
            renderer.draw(scene, app.camera, exposed, view.size, quality=quality)
            self._drawn = (*wanted, quality)
        show(renderer, view)
        new_legend = app.second_legend is not renderer.legend
        app.second_legend = renderer.legend
        return new_legend

    def _ready(self, app: App, face: Face) -> DrawsFaces:
        if self.renderer is None:
            self.renderer = self._new()
        if self._loaded is not face:
            if face.form is not None:
                self.renderer.take(face.form)
            self.renderer.load(face.rig)
            self._loaded, self._drawn = face, ()
            self._exposing.forget()
        if app.form is not None:
            self.renderer.take(app.form)
        return self.renderer

    def release(self) -> None:
        """Give the second renderer back."""
        if self.renderer is not None:
            self.renderer.release()
        self.renderer = self._loaded = None


def side_by_side(left: DrawsFaces, right: DrawsFaces | None) -> UInt8:
    """Both views as one picture (H, W, 4) uint8, each with its legend."""
    from facemorph.gl.legend import with_legend

    views = []
    for renderer in (left, right):
        if renderer is not None:
            pixels = renderer.read()
            views.append(pixels if renderer.legend is None else with_legend(pixels, renderer.legend))
    return np.concatenate(views, axis=1)


def show(renderer: DrawsFaces, view: Viewport) -> None:
    """Put a renderer's picture into the window, under everything."""
    low, high = (view.x, view.y), (view.x + view.width, view.y + view.height)
    texture = imgui.ImTextureRef(renderer.texture.glo)
    imgui.get_background_draw_list().add_image(texture, low, high, (0, 1), (1, 0))


def partner_key(scene: Scene) -> tuple[tuple[object, float], ...]:
    """What tells whether the colours mixed in are the same."""
    return tuple((partner.rig, partner.weight) for partner in scene.partners)
