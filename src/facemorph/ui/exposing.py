"""Equal luminance in the window: the exposure is sought while the face is still, and kept while it moves."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.core.scene import Scene
from facemorph.errors import OptionError
from facemorph.gl.luminance import LIT, SMALL_SIDE, EqualLuminance

if TYPE_CHECKING:
    from facemorph.gl.renderer import Renderer
    from facemorph.ui.split_view import DrawsFaces


class Exposing:
    """Turns a look's luminance into its exposure, for one view. `problem` says why that was not possible."""

    def __init__(self) -> None:
        self.problem = ""
        self._solver: tuple[DrawsFaces, EqualLuminance] | None = None
        self._key: tuple[object, ...] = ()
        self._exposure = 1.0

    def forget(self) -> None:
        """Another face: nothing holds any more."""
        self._solver, self._key, self.problem = None, (), ""

    def look(
        self,
        renderer: DrawsFaces,
        scene: Scene,
        camera: Camera,
        look: Look,
        size: tuple[int, int],
        *,
        moving: bool,
        exactly: bool = False,
    ) -> Look:
        """`look` as it is to be drawn. Seeking the exposure leaves another picture in the renderer.

        A moving camera or pose keeps the exposure that it began with: seeking takes several pictures. They
        are small ones, whose luminance is that of `size` within two or three percent, unless it is wanted
        `exactly`.
        """
        plain = replace(look, luminance=None)
        if look.luminance is None or look.shading not in LIT:
            self.problem = ""
            return plain
        from facemorph.gl.renderer import Renderer

        if not isinstance(renderer, Renderer):
            return plain
        key = (look.luminance, look.luminance_of, look.light, look.shading)
        if not (moving and key == self._key):
            pixels = size if exactly else _small(size)
            self._key, self._exposure = key, self._sought(renderer, scene, camera, look, pixels)
        return replace(plain, exposure=self._exposure)

    def _sought(
        self, renderer: Renderer, scene: Scene, camera: Camera, look: Look, size: tuple[int, int]
    ) -> float:
        if self._solver is None or self._solver[0] is not renderer:
            self._solver = (renderer, EqualLuminance(renderer))
        try:
            settled = self._solver[1].settled(scene, camera, look, size)
        except OptionError as error:
            self.problem = str(error)
            return look.exposure
        self.problem = ""
        return settled.exposure


def _small(size: tuple[int, int]) -> tuple[int, int]:
    scale = min(SMALL_SIDE / max(size), 1.0)
    return max(round(size[0] * scale), 1), max(round(size[1] * scale), 1)
