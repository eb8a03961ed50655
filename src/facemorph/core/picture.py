"""What a picture shows, apart from the face and its pose: shading, light, backdrop, size, heat range."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, get_args

from facemorph.errors import OptionError, UnknownNameError

Shading = Literal["skin", "clay", "wire", "normals", "heat"]
SHADINGS: tuple[Shading, ...] = get_args(Shading)
LightRig = Literal["studio", "window", "flat"]
LIGHT_RIGS: tuple[LightRig, ...] = get_args(LightRig)
LuminanceOf = Literal["face", "picture"]
LUMINANCES_OF: tuple[LuminanceOf, ...] = get_args(LuminanceOf)
Rgba = tuple[float, float, float, float]
LARGEST_SIDE = 8192
SUBDIVISIONS = (0, 1, 2)
# What textures may be; Pillow would hand others, such as EPS, to other programs.
PICTURE_FORMATS = ("PNG", "JPEG", "BMP", "TGA", "TIFF", "WEBP")
DUSK: Rgba = (0.16, 0.17, 0.19, 1.0)
MID_GREY: Rgba = (128 / 255, 128 / 255, 128 / 255, 1.0)
# The luminance that pictures are brought to where none is named; all the built-in faces reach it.
LUMINANCE = 0.25
LEAST_LUMINANCE, MOST_LUMINANCE = 0.02, 0.7


@dataclass(frozen=True)
class Look:
    """How a face is drawn.

    shading       skin (textured), clay (one grey), wire (clay with the polygons' edges), normals, heat
                  (distance of each vertex from neutral)
    wire          the polygons' edges over any shading
    background    sRGB 0..1, with alpha; alpha 0 leaves the picture transparent there. None is the light's
                  own: mid grey for flat, dusk for others
    heat_max      distance at the heat map's red end in model units; None takes the largest in the pose
    subdivision   levels of Catmull-Clark that the surface is refined by, 0 to 2; 0 draws the file's own
    light         studio (key, fill and rim of a portrait), window (large and soft, from one side), flat
                  (even, from the front, a plain backdrop: for stimuli)
    exposure      factor on all light
    luminance     where it is set, `exposure` is settled so that the mean luminance of the skin's pixels
                  is this: CIE Y of the picture's sRGB made linear, 1 for white. For skin and clay only
    luminance_of  "face": the neutral face has that luminance, its expressions the same exposure;
                  "picture": each picture has it
    """

    shading: Shading = "skin"
    wire: bool = False
    background: Rgba | None = None
    heat_max: float | None = None
    subdivision: int = 0
    light: LightRig = "studio"
    exposure: float = 1.0
    luminance: float | None = None
    luminance_of: LuminanceOf = "face"

    @property
    def backdrop(self) -> Rgba:
        """The colour behind the face: the one asked for, or the light's own."""
        if self.background is not None:
            return self.background
        return MID_GREY if self.light == "flat" else DUSK


def checked_shading(name: str) -> Shading:
    """`name` as a `Shading`. Raises `OptionError` naming the choices."""
    for shading in SHADINGS:
        if name == shading:
            return shading
    raise OptionError(f"no shading is called {name!r}. There are: {', '.join(SHADINGS)}.")


def checked_light(name: str) -> LightRig:
    """`name` as a `LightRig`. Raises `UnknownNameError` naming the choices."""
    for light in LIGHT_RIGS:
        if name == light:
            return light
    raise UnknownNameError("light", name, LIGHT_RIGS)


def checked_luminance_of(name: str) -> LuminanceOf:
    """`name` as a `LuminanceOf`. Raises `OptionError` naming the choices."""
    for of in LUMINANCES_OF:
        if name == of:
            return of
    raise OptionError(f"equal luminance is of {' or '.join(LUMINANCES_OF)}; not {name!r}.")


def checked_luminance(luminance: float) -> float:
    """`luminance` if a face can be brought to it. Raises `OptionError`."""
    if not (math.isfinite(luminance) and LEAST_LUMINANCE <= luminance <= MOST_LUMINANCE):
        raise OptionError(
            f"equal luminance is a part of white's, {LEAST_LUMINANCE} to {MOST_LUMINANCE}; not {luminance:g}."
        )
    return luminance


def checked_subdivision(level: int | str) -> int:
    """`level`, or the one that a text means. Raises `OptionError` naming the choices."""
    for known in SUBDIVISIONS:
        if level in (known, str(known)):
            return known
    raise OptionError(f"subdivision is {SUBDIVISIONS[0]} to {SUBDIVISIONS[-1]} levels, not {level!r}.")


def picture_size(text: str) -> tuple[int, int]:
    """Width and height from "1280x800". Raises `OptionError`."""
    parts = text.lower().split("x")
    try:
        width, height = (int(part) for part in parts)
    except ValueError:
        raise OptionError(f"a size is WIDTHxHEIGHT in pixels, as 1280x800; not {text!r}.") from None
    return checked_size((width, height))


def checked_size(size: tuple[int, int]) -> tuple[int, int]:
    """`size` if a picture can have it. Raises `OptionError`."""
    width, height = size
    if not (1 <= width <= LARGEST_SIDE and 1 <= height <= LARGEST_SIDE):
        raise OptionError(f"a picture is 1 to {LARGEST_SIDE} pixels wide and high; {width}x{height} is not.")
    return size
