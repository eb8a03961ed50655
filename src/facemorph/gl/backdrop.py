"""What is behind the face: a calm gradient of the look's colour, and the shadow that the bust stands in.

The gradient is made once for a size and colour and copied in from then on: on a software OpenGL it would
cost a tenth of the frame. Only where the shadow lies, which goes with the camera, it is drawn again. With
multisampling all of it is drawn instead, last, where nothing covers it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.camera import Camera
from facemorph.gl.programs import Programs

if TYPE_CHECKING:
    import moderngl

# The shadow, as parts of the bust's half width: how far it reaches, and how far its edge is blurred.
REACH, BLUR = 1.5, 0.42
STRENGTH = 0.5
# Where it lies, as a part of the height: a bust fades away above its end.
HEIGHT = 0.0
_NO_SHADOW = (0.0, 0.0, 0.0)
_UNIFORMS = (
    "background",
    "picture_size",
    "backdrop_depth",
    "shadow_centre",
    "shadow_shape",
    "shadow_strength",
)


class Backdrop:
    """The backdrop of one context's pictures."""

    def __init__(self, ctx: moderngl.Context, programs: Programs) -> None:
        self._ctx = ctx
        self._programs = programs
        self._array: moderngl.VertexArray | None = None
        self._kept: moderngl.Framebuffer | None = None
        self._key: tuple[object, ...] = ()

    def begin(self, framebuffer: moderngl.Framebuffer, scene: Mapping[str, object]) -> bool:
        """Clear `framebuffer` and put the backdrop in; True where `fill` is still to be called for it."""
        kept = None if framebuffer.samples else self._ready(framebuffer.size, scene)
        framebuffer.use()
        framebuffer.clear(0.0, 0.0, 0.0, 0.0)
        if kept is not None:
            self._ctx.copy_framebuffer(framebuffer, kept)
            framebuffer.use()
            self._lay_shadow(framebuffer, scene)
        return kept is None

    def _ready(self, size: tuple[int, int], scene: Mapping[str, object]) -> moderngl.Framebuffer:
        key = (size, scene["background"], scene["backdrop_depth"])
        if self._kept is None or key != self._key:
            self._release_kept()
            self._kept = self._ctx.framebuffer([self._ctx.texture(size, 4)])
            self._key = key
            self._kept.use()
            self._ctx.enable_only(self._ctx.NOTHING)
            self.fill({**scene, "shadow_strength": 0.0})
        return self._kept

    def _lay_shadow(self, framebuffer: moderngl.Framebuffer, scene: Mapping[str, object]) -> None:
        box = shadow_box(scene, framebuffer.size)
        if box is None:
            return
        self._ctx.enable_only(self._ctx.NOTHING)
        framebuffer.scissor = box
        self.fill(scene)
        framebuffer.scissor = None  # type: ignore[assignment]

    def fill(self, scene: Mapping[str, object]) -> None:
        """Draw the backdrop at the far end of the depth range into the framebuffer in use."""
        program = self._programs.get("backdrop.vert", "backdrop.frag")
        if self._array is None:
            self._array = self._ctx.vertex_array(program, [])
        for name in _UNIFORMS:
            program[name].value = scene[name]  # type: ignore[union-attr]
        self._array.render(self._ctx.TRIANGLES, vertices=3)

    def _release_kept(self) -> None:
        if self._kept is not None:
            self._kept.color_attachments[0].release()
            self._kept.release()
            self._kept = None

    def release(self) -> None:
        """Give everything back to the context."""
        self._release_kept()
        if self._array is not None:
            self._array.release()
            self._array = None


def shadow_uniforms(
    bounds: Float32, camera: Camera, size: tuple[int, int], strength: float
) -> dict[str, object]:
    """For `shaders/lib/backdrop.glsl`: the shadow under a box (2, 3), as an ellipse of the picture.

    A disc under the box is projected to its two half axes u and v in pixels; with the blur b, places p
    from its centre with p' (u u' + v v' + b b I)^-1 p < 1 are in the shadow.
    """
    low, high = bounds.astype(np.float64)
    half = 0.5 * (high - low)
    ground = 0.5 * (low + high)
    ground[1] = low[1] + HEIGHT * (high[1] - low[1])
    points = ground + REACH * np.array([[0.0, 0.0, 0.0], [half[0], 0.0, 0.0], [0.0, 0.0, half[2]]])
    seen = _in_pixels(points, camera, size)
    if seen is None or not half[0] > 0.0:
        return {"shadow_centre": (0.0, 0.0), "shadow_shape": _NO_SHADOW, "shadow_strength": 0.0}
    centre, axes = seen[0], (seen[1:] - seen[0]).T
    blur = BLUR * float(np.sqrt(np.square(axes).sum(axis=0).max()))
    shape = np.linalg.inv(axes @ axes.T + max(blur, 1.0) ** 2 * np.eye(2))
    return {
        "shadow_centre": (float(centre[0]), float(centre[1])),
        "shadow_shape": (float(shape[0, 0]), float(shape[0, 1]), float(shape[1, 1])),
        "shadow_strength": strength,
    }


def _in_pixels(points: Float64, camera: Camera, size: tuple[int, int]) -> Float64 | None:
    """Points (n, 3) as pixels (n, 2) from the picture's lower left; None where one is behind the camera."""
    clip = np.c_[points, np.ones(len(points))] @ camera.clip_from_model(size[0] / size[1]).T
    if not (clip[:, 3] > 1e-6).all():
        return None
    return np.asarray((clip[:, :2] / clip[:, 3:] * 0.5 + 0.5) * size, np.float64)


def shadow_box(scene: Mapping[str, object], size: tuple[int, int]) -> tuple[int, int, int, int] | None:
    """The pixels (x, y, width, height) that the shadow can reach, None where it reaches none."""
    shape, centre = scene["shadow_shape"], scene["shadow_centre"]
    background = scene["background"]
    assert isinstance(shape, tuple) and isinstance(centre, tuple) and isinstance(background, tuple)
    a, b, c = shape
    determinant = a * c - b * b
    if not scene["shadow_strength"] or not background[3] or not determinant > 0.0:
        return None
    reach = (math.sqrt(c / determinant), math.sqrt(a / determinant))
    low = [max(math.floor(centre[i] - reach[i]) - 1, 0) for i in range(2)]
    high = [min(math.ceil(centre[i] + reach[i]) + 1, size[i]) for i in range(2)]
    if low[0] >= high[0] or low[1] >= high[1]:
        return None
    return low[0], low[1], high[0] - low[0], high[1] - low[1]
