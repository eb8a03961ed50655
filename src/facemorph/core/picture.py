"""What a picture shows, apart from the face and its pose: shading, size, backdrop, the heat map's range."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

from facemorph.errors import OptionError

Shading = Literal["skin", "clay", "wire", "normals", "heat"]
SHADINGS: tuple[Shading, ...] = get_args(Shading)
LARGEST_SIDE = 8192
SUBDIVISIONS = (0, 1, 2)
# What textures may be; Pillow would hand others, such as EPS, to other programs.
PICTURE_FORMATS = ("PNG", "JPEG", "BMP", "TGA", "TIFF", "WEBP")


@dataclass(frozen=True)
class Look:
    """How a face is drawn.

    shading      skin (textured), clay (one grey), wire (clay with the polygons' edges), normals, heat
                 (distance of each vertex from neutral)
    wire         the polygons' edges over any shading
    background   sRGB 0..1, with alpha; alpha 0 leaves the picture transparent there
    heat_max     distance at the heat map's red end in model units; None takes the largest in the pose
    subdivision  levels of Catmull-Clark that the surface is refined by, 0 to 2; 0 draws the file's own
    """

    shading: Shading = "skin"
    wire: bool = False
    background: tuple[float, float, float, float] = (0.16, 0.17, 0.19, 1.0)
    heat_max: float | None = None
    subdivision: int = 0


def checked_shading(name: str) -> Shading:
    """`name` as a `Shading`. Raises `OptionError` naming the choices."""
    for shading in SHADINGS:
        if name == shading:
            return shading
    raise OptionError(f"no shading is called {name!r}. There are: {', '.join(SHADINGS)}.")


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
