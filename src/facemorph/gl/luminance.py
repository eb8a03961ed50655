"""Equal luminance for stimuli: the exposure at which a face's skin has a wanted mean luminance.

Luminance is CIE 1931 Y of the picture as a screen of sRGB shows it, relative to its white: each channel
decoded by the standard's formula (IEC 61966-2-1), then Y = 0.2126 R + 0.7152 G + 0.0722 B. The mean is over
the pixels that show nothing but skin: no backdrop, eyes, teeth, hair or brows, nor a bust's fading end. It is
the whole skin in the picture, so it says nothing of how light is spread over it.

Highlights roll off, so that luminance is no multiple of exposure. Their logarithms lie nearly on a line,
which the secant method follows; small pictures first, the last steps in the picture's own size.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from facemorph.core.arrays import Bool, Float64, UInt8
from facemorph.core.camera import Camera
from facemorph.core.picture import Look, checked_luminance
from facemorph.core.pose import Pose
from facemorph.core.scene import Scene
from facemorph.errors import OptionError

if TYPE_CHECKING:
    from facemorph.gl.renderer import Renderer

WEIGHTS = (0.2126, 0.7152, 0.0722)
# Solved to within this part of the target; 0.005 is promised.
CLOSE = 0.001
SMALL_SIDE = 320
_MOST_STEPS = 12
_MOST_KEPT = 256
_MOST_EXPOSURE = 64.0
_USUAL_SLOPE = 0.8  # of log luminance over log exposure
_BLACK = (0.0, 0.0, 0.0, 1.0)
LIT = ("skin", "clay")


def mean_luminance(pixels: UInt8, where: Bool) -> float:
    """Mean Y, 0..1, of pixels (H, W, 4) sRGB over those `where` (H, W); nan where there are none."""
    if not where.any():
        return math.nan
    linear = _decoded(np.arange(256) / 255.0)
    return float(np.mean(linear[pixels[where][:, :3]] @ WEIGHTS))


def _decoded(stored: Float64 | np.float64) -> Float64:
    """Linear values of stored sRGB ones, 0..1 (IEC 61966-2-1)."""
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


class EqualLuminance:
    """Settles exposures for one renderer; those of faces are kept, for all their expressions."""

    def __init__(self, renderer: Renderer) -> None:
        self._renderer = renderer
        self._kept: dict[tuple[object, ...], float] = {}

    def forget(self) -> None:
        """Another face: nothing holds any more."""
        self._kept.clear()

    def settled(self, scene: Scene, camera: Camera, look: Look, size: tuple[int, int]) -> Look:
        """`look` with the exposure that gives its luminance. Leaves another picture in the framebuffer.

        Raises `OptionError` for a luminance that no face has or that light cannot bring this one to, for
        shadings that do not depend on light, and where no skin is in the picture.
        """
        assert look.luminance is not None
        target = checked_luminance(look.luminance)
        if look.shading not in LIT:
            raise OptionError(
                f"equal luminance is for the shadings {' and '.join(LIT)}; {look.shading} knows no light."
            )
        plain = replace(look, luminance=None, background=_BLACK, wire=False)
        if look.luminance_of == "picture":
            found = self._solved(replace(scene, glow=None), camera, plain, size, target)
        else:
            found = self._of_face(scene, camera, plain, size, target)
        return replace(look, luminance=None, exposure=found)

    def _of_face(
        self, scene: Scene, camera: Camera, look: Look, size: tuple[int, int], target: float
    ) -> float:
        people = tuple((id(partner.rig), partner.weight) for partner in scene.partners)
        key = (camera, look, size, target, people)
        if key not in self._kept:
            if len(self._kept) >= _MOST_KEPT:
                self._kept.clear()
            neutral = Scene(Pose(), partners=scene.partners)
            self._kept[key] = self._solved(neutral, camera, look, size, target)
        return self._kept[key]

    def _solved(
        self, scene: Scene, camera: Camera, look: Look, size: tuple[int, int], target: float
    ) -> float:
        scale = min(SMALL_SIDE / max(size), 1.0)
        small = (max(round(size[0] * scale), 1), max(round(size[1] * scale), 1))
        found, slope = look.exposure, _USUAL_SLOPE
        for pixels in dict.fromkeys((small, size)):
            measure = self._measure(scene, camera, look, pixels)
            found, slope = solved(measure, target, found, slope)
        return found

    def _measure(
        self, scene: Scene, camera: Camera, look: Look, size: tuple[int, int]
    ) -> Callable[[float], float]:
        renderer = self._renderer
        where: list[Bool] = []

        def luminance(exposure: float) -> float:
            renderer.draw(scene, camera, replace(look, exposure=exposure), size, exactly=True)
            pixels = renderer.read()
            if not where:
                where.append(renderer.skin_pixels())
            return mean_luminance(pixels, where[0])

        return luminance


def _half_step(luminance: float) -> float:
    """Half of what one step of an 8-bit grey of this luminance changes it by (IEC 61966-2-1)."""
    stored = 1.055 * max(luminance, 0.0031308) ** (1.0 / 2.4) - 0.055
    return float(_decoded(np.float64(stored + 0.5 / 255.0)) - luminance)


def solved(
    measure: Callable[[float], float], target: float, start: float, slope: float = _USUAL_SLOPE
) -> tuple[float, float]:
    """The exposure at which `measure` gives `target`, sought from `start` on; and the last slope.

    Raises `OptionError` where it cannot be reached.
    """
    exposure, before = start, (0.0, 0.0)
    nearest = (math.inf, start)
    for step in range(_MOST_STEPS):
        found = measure(exposure)
        if not found > 0.0:
            raise OptionError("equal luminance is the skin's; no skin is to be seen in the picture.")
        if abs(found / target - 1.0) <= CLOSE:
            return exposure, slope
        nearest = min(nearest, (abs(found - target), exposure))
        here = (math.log(exposure), math.log(found))
        if step and here[0] != before[0]:
            slope = min(max((here[1] - before[1]) / (here[0] - before[0]), 0.2), 2.0)
        before = here
        exposure = math.exp(here[0] + (math.log(target) - here[1]) / slope)
        if exposure > _MOST_EXPOSURE:
            break
    # Skin of one colour has no values between those of 8 bits.
    if nearest[0] <= _half_step(target):
        return nearest[1], slope
    raise OptionError(
        f"light cannot bring this face to a luminance of {target:g}; the nearest was {found:.3f}. "
        "Ask for one that all your faces reach."
    )
