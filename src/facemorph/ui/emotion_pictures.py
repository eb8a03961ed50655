"""Pictures of the present face in its expressions for the emotion map: one a frame, kept for the head."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from imgui_bundle import imgui

from facemorph.core.arrays import Float32, UInt8
from facemorph.core.camera import Camera
from facemorph.core.mesh import Mesh
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig, Shape
from facemorph.errors import FacemorphError
from facemorph.ui.handles import MADE
from facemorph.ui.split_view import DrawsFaces
from facemorph.ui.state import App

if TYPE_CHECKING:
    import moderngl

SIDE = 128
BACKGROUND = (0.20, 0.21, 0.23, 1.0)
_LANDMARKS = 12  # so many, and they tell where the face on the head is


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
            look = Look(background=BACKGROUND)
            renderer.draw(Pose.of({shape.name: 1.0}), portrait(rig), look, large)
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


def portrait(rig: Rig) -> Camera:
    """A camera that sees the face from brows to chin where the rig tells where they are, else the whole."""
    vertices = [landmark.vertex for landmark in rig.info.landmarks]
    if len(vertices) < _LANDMARKS:
        return Camera.framing(rig.neutral.bounds)
    points: Float32 = rig.neutral.positions[vertices]
    camera = Camera.framing(np.stack([points.min(axis=0), points.max(axis=0)]))
    low = camera.target[1] - 0.07 * float(np.ptp(points[:, 1]))  # jaws drop
    whole = Camera.framing(rig.neutral.bounds)
    return replace(
        camera,
        target=(camera.target[0], low, camera.target[2]),
        distance=camera.distance * 0.94,
        scene_radius=whole.scene_radius,
    )


def _source(rig: Rig, shape: Shape) -> object:
    """What a picture holds for: the head, but the very rig for a shape that was made and may be made anew."""
    return rig if shape.set == MADE else rig.neutral


def halved(pixels: UInt8) -> UInt8:
    """Every four pixels as one, (2H, 2W, 4) to (H, W, 4)."""
    height, width, channels = pixels.shape
    blocks = pixels.reshape(height // 2, 2, width // 2, 2, channels).astype(np.float32)
    return np.ascontiguousarray(blocks.mean(axis=(1, 3)).round().astype(np.uint8))
