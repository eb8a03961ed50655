"""What is behind the face: a calm gradient of the look's colour.

Made once for a size and colour and copied in from then on: on a software OpenGL its gradient would
cost a tenth of the frame. With multisampling it is drawn instead, last, where nothing covers it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from facemorph.gl.programs import Programs

if TYPE_CHECKING:
    import moderngl


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
        return kept is None

    def _ready(self, size: tuple[int, int], scene: Mapping[str, object]) -> moderngl.Framebuffer:
        key = (size, scene["background"])
        if self._kept is None or key != self._key:
            self._release_kept()
            self._kept = self._ctx.framebuffer([self._ctx.texture(size, 4)])
            self._key = key
            self._kept.use()
            self._ctx.enable_only(self._ctx.NOTHING)
            self.fill(scene)
        return self._kept

    def fill(self, scene: Mapping[str, object]) -> None:
        """Draw the backdrop at the far end of the depth range into the framebuffer in use."""
        program = self._programs.get("backdrop.vert", "backdrop.frag")
        if self._array is None:
            self._array = self._ctx.vertex_array(program, [])
        for name in ("background", "picture_size"):
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
