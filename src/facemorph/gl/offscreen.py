"""`Offscreen`: pictures without a window, with a context of its own or one it is lent."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from types import TracebackType
from typing import TYPE_CHECKING

from facemorph.core.arrays import UInt8
from facemorph.core.camera import Camera
from facemorph.core.picture import Look, checked_size
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.gl.context import create_context
from facemorph.gl.legend import with_legend
from facemorph.gl.renderer import MorphPath, Renderer

if TYPE_CHECKING:
    import moderngl


class Offscreen:
    """Draws pictures of one face after another; use it in a `with` statement.

    It makes a context and releases it at the end. Where a window's context is current, lend that as
    `ctx`: a second one would take its place in the thread. The face drawn last stays loaded, so many
    pictures of one cost little. A context belongs to the thread that made it.
    Raises `GraphicsError` where no context can be had.
    """

    def __init__(self, *, ctx: moderngl.Context | None = None, morph: MorphPath = "auto") -> None:
        self._own = ctx is None
        self.ctx = create_context() if ctx is None else ctx
        self.renderer = Renderer(self.ctx, morph)
        self._rig: Rig | None = None

    def render(
        self,
        rig: Rig,
        pose: Scene | Pose | Mapping[str, float] | None = None,
        *,
        size: tuple[int, int] = (1280, 800),
        camera: Camera | str = "front",
        look: Look | None = None,
        legend: bool = True,
    ) -> UInt8:
        """A picture of `rig` as (H, W, 4) uint8 sRGB with straight alpha, top row first; `size` is (W, H).

        pose     a `Pose`, a whole `Scene`, or weights by shape name
        camera   a `Camera`, or a direction ("front", "AZIMUTH,ELEVATION") from which the face's frame is seen
        legend   whether a heat map gets its legend drawn in

        Raises what `Renderer.draw` does, `OptionError` and `GraphicsError`.
        """
        width, height = checked_size(size)
        if isinstance(camera, str):
            camera = Camera.of_face(rig, camera, width / height)
        with self._current():
            if rig is not self._rig:
                self.renderer.load(rig)
                self._rig = rig
            self.renderer.draw(pose or {}, camera, look or Look(), size, exactly=True)
            pixels = self.renderer.read()
        if legend and self.renderer.legend is not None:
            pixels = with_legend(pixels, self.renderer.legend)
        return pixels

    @property
    def problems(self) -> tuple[str, ...]:
        """What of the face drawn last could not be read or shown, a line each."""
        return self.renderer.problems

    def _current(self) -> AbstractContextManager[object]:
        """Makes a context of our own current for as long as it is needed; a lent one is already."""
        return self.ctx if self._own else nullcontext()

    def release(self) -> None:
        """Give back what is held, and the context if it is our own."""
        with self._current():
            self.renderer.release()
        if self._own:
            self.ctx.release()

    def __enter__(self) -> Offscreen:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()


def render(
    rig: Rig,
    pose: Scene | Pose | Mapping[str, float] | None = None,
    *,
    size: tuple[int, int] = (1280, 800),
    camera: Camera | str = "front",
    look: Look | None = None,
) -> UInt8:
    """One picture as `Offscreen.render` makes it, with a context made and released for it."""
    with Offscreen() as screen:
        return screen.render(rig, pose, size=size, camera=camera, look=look)
