"""The pictures of the skin besides its colours: relief, roughness, wrinkles; what the files say of them."""

from pathlib import Path

from PIL import Image, ImageFilter

from .ageing import age_of
from .head import Body
from .people import Person
from .relief import ReliefPainter, relief_height
from .textures import Painter
from .wrinkle_rules import SET_NAMES
from .wrinkles import paint_wrinkles, wrinkle_height

RELIEF_QUALITY, ROUGHNESS_QUALITY, WRINKLE_QUALITY = 74, 85, 88
# Skin folds in round furrows, young skin in rounder ones: blurred by so many of 1024 pixels.
BLUR, YOUNG_BLUR = 0.8, 1.2
# Sides of the pictures as parts of the skin's.
RELIEF_PART, WRINKLE_PART = 0.5, 0.5


class SkinPictures:
    """Paints them for one person after the other; what all share is painted once."""

    def __init__(self, painter: Painter):
        self._painter = painter
        self._relief = ReliefPainter(painter.canvas, painter.raster)
        wrinkles, self._placed = paint_wrinkles(painter.canvas.points, painter.raster)
        self._wrinkles = _shrunk(wrinkles, WRINKLE_PART)

    def save(self, body: Body, folder: Path):
        """relief.jpg, roughness.jpg and wrinkles.jpg."""
        person = body.person
        relief = _shrunk(self._relief.relief(age_of(person)), RELIEF_PART)
        relief.save(folder / "relief.jpg", quality=RELIEF_QUALITY, optimize=True)
        rough = self._relief.roughness(self._painter.light(body), person.look)
        rough.save(folder / "roughness.jpg", quality=ROUGHNESS_QUALITY, optimize=True)
        # Colours are sets of wrinkles: their edges must stay where they are.
        soft = (BLUR + YOUNG_BLUR * (1 - age_of(person))) * self._wrinkles.width / 1024
        wrinkles = self._wrinkles.filter(ImageFilter.GaussianBlur(soft))
        wrinkles.save(folder / "wrinkles.jpg", quality=WRINKLE_QUALITY, subsampling=0, optimize=True)

    def toml_lines(self, person: Person) -> list[str]:
        """The [[wrinkles]] of a person's description."""
        age = age_of(person)
        lines = []
        for placed in self._placed:
            rule = placed.rule
            for side, area in placed.areas.items():
                shapes = rule.shapes | {name + side.capitalize(): gain for name, gain in rule.sided.items()}
                share = rule.young + (1 - rule.young) * age
                told = ", ".join(f"{_key(name)} = {share * gain:.3g}" for name, gain in shapes.items())
                lines += [
                    "",
                    "[[wrinkles]]",
                    f'name = "{rule.name}, {side}"',
                    f'set = "{SET_NAMES[rule.set]}"',
                    f"area = {area}",
                    f"soft = {rule.soft:g}",
                ]
                lines += [f"rest = {rule.ageing * age:.3g}"] if rule.ageing * age > 0.005 else []
                lines += [f"shapes = {{ {told} }}"]
        return lines


def skin_maps_text(person: Person) -> list[str]:
    """What the skin's material says of its further pictures."""
    return [
        f"map_Bump -bm {relief_height(age_of(person)):.4g} relief.jpg",
        "map_Pr roughness.jpg",
        f"map_wrinkles -bm {wrinkle_height(person):.4g} wrinkles.jpg",
    ]


def _shrunk(picture: Image.Image, part: float) -> Image.Image:
    side = round(picture.width * part)
    return picture.resize((side, side), Image.Resampling.BOX if part == 0.5 else Image.Resampling.LANCZOS)


def _key(name: str) -> str:
    """A shape's name as a key of TOML."""
    return name if name.isidentifier() else f'"{name}"'
