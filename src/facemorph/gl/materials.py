"""How the parts of a face answer light: recipes by the material's name, the file's own numbers otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from facemorph.core.mesh import Material

Colour = tuple[float, float, float]


@dataclass(frozen=True)
class Finish:
    """What `shaders/lib/light.glsl` asks of a material; colours and strengths are linear.

    wrap       how far the key light reaches past the terminator, for red, green and blue
    gloss      strength of the highlight, `sharpness` its exponent
    sheen      how strongly the rim light shows at grazing angles
    recess     how much light the surroundings keep away: lids from an eye, the mouth from teeth
    relief     whether it is skin, with bumps and wrinkles: by pixel but while something moves
    catches    whether its highlight is an eye's catchlight
    shade      factor on the colour, for what lies inside the mouth
    matte      luminance of the colour below which nothing shines: hair and brows painted on skin
    shader     the fragment shader that draws it
    spill      in a mouth, how far light reaches it over the lips' edge, in half widths of the mouth
    one_sided  whether its inside need not be drawn: locks lie on other hair
    behind     whether it is drawn before what else is seen through: hair shows between lashes
    by_pixel   whether its light must be worked out a pixel even where a vertex would do for others
    """

    wrap: Colour
    gloss: float
    sharpness: float
    sheen: float
    recess: float = 0.0
    shade: float = 1.0
    matte: float = 0.0
    relief: bool = False
    catches: bool = False
    shader: str = "lit.frag"
    spill: float = 0.0
    by_pixel: bool = False
    one_sided: bool = False
    behind: bool = False


SKIN = Finish(
    wrap=(0.34, 0.17, 0.11),
    gloss=0.85,
    sharpness=26.0,
    sheen=0.9,
    matte=0.045,
    shader="skin.frag",
    relief=True,
)
EYE = Finish(
    wrap=(0.85, 0.78, 0.76),
    gloss=5.0,
    sharpness=520.0,
    sheen=0.0,
    recess=0.75,
    shade=0.9,
    catches=True,
    shader="eye.frag",
    by_pixel=True,
)
TEAR = Finish(
    wrap=(0.30, 0.28, 0.28),
    gloss=4.0,
    sharpness=200.0,
    sheen=0.0,
    catches=True,
    shader="tear.frag",
    by_pixel=True,
)
TEETH = Finish(
    wrap=(0.60, 0.54, 0.47),
    gloss=0.30,
    sharpness=150.0,
    sheen=0.0,
    shade=1.0,
    catches=True,
    shader="mouth.frag",
    by_pixel=True,
)
GUM = Finish(
    wrap=(0.40, 0.22, 0.20),
    gloss=0.12,
    sharpness=55.0,
    sheen=0.0,
    catches=True,
    shader="mouth.frag",
    by_pixel=True,
)
TONGUE = replace(GUM, gloss=0.22, sharpness=45.0)
MOUTH = replace(GUM, gloss=0.05, sharpness=45.0, spill=0.5)
LASH = Finish(wrap=(0.20, 0.20, 0.20), gloss=0.0, sharpness=8.0, sheen=0.0)
HAIR = Finish(wrap=(0.36, 0.30, 0.26), gloss=0.85, sharpness=40.0, sheen=0.9, shader="hair.frag", behind=True)
BROW = Finish(wrap=(0.36, 0.30, 0.26), gloss=0.15, sharpness=20.0, sheen=0.0, shader="hair.frag")
CLAY = Finish(wrap=(0.22, 0.20, 0.18), gloss=0.05, sharpness=18.0, sheen=1.0)

# A name contains the word; the first that fits is taken, so "eyelash" is a lash and no eye.
_BY_WORD: tuple[tuple[str, Finish], ...] = (
    ("lash", LASH),
    ("brow", BROW),
    ("hair", HAIR),
    ("teeth", TEETH),
    ("tooth", TEETH),
    ("tongue", TONGUE),
    ("gum", GUM),
    ("palate", GUM),
    ("mouth", MOUTH),
    ("tear", TEAR),
    ("eye", EYE),
    ("cornea", EYE),
    ("sclera", EYE),
    ("iris", EYE),
    ("skin", SKIN),
    ("face", SKIN),
    ("head", SKIN),
)

CLAY_COLOUR: Colour = (0.43, 0.41, 0.385)
# What a lit-up region is tinted with, linear: the interface's accent.
GLOW_COLOUR: Colour = (0.10, 0.56, 0.80)
# A mesh without any material: unpainted, but warm.
PLAIN = Material("", diffuse=(0.50, 0.375, 0.305))


_STAND_INS: Mapping[Finish, Colour] = MappingProxyType(
    {
        SKIN: PLAIN.diffuse,
        EYE: (0.62, 0.60, 0.58),
        TEETH: (0.62, 0.56, 0.46),
        TONGUE: (0.32, 0.06, 0.055),
        GUM: (0.40, 0.13, 0.12),
        MOUTH: (0.26, 0.06, 0.055),
        LASH: (0.010, 0.008, 0.007),
        BROW: (0.020, 0.013, 0.009),
        HAIR: (0.020, 0.013, 0.009),
    }
)
# From this factor on, a colour is no paint but lets its texture through unchanged.
_UNCHANGED = 0.75


def colour_without_texture(material: Material) -> Colour:
    """The linear colour of a material whose texture cannot be shown.

    Its own, where that is one; a factor near white would glare, so what the part is of takes its place.
    """
    if min(material.diffuse) < _UNCHANGED:
        return material.diffuse
    return _STAND_INS.get(finish_of(material), CLAY_COLOUR)


def finish_of(material: Material) -> Finish:
    """The recipe for a material's name, or one from its specular colour and exponent."""
    name = material.name.casefold()
    for word, finish in _BY_WORD:
        if word in name:
            return finish if finish is not HAIR else _hair_of(material)
    if material.name == "":
        return SKIN
    strength = sum(material.specular) / 3.0
    sharpness = min(max(material.shininess, 4.0), 400.0)
    return Finish(CLAY.wrap, min(max(strength, 0.0), 1.0) * 0.5, sharpness, CLAY.sheen)


def _hair_of(material: Material) -> Finish:
    """Hair that shines as its file says: coils scatter what straight hair throws back."""
    shine = min(max(sum(material.specular), 0.0), 1.5) / 0.9
    # Smooth locks lie on other hair, tufts of coils stand off it and are seen from behind too.
    one_sided = "lock" in material.name.casefold() and shine > 0.5
    return replace(HAIR, gloss=HAIR.gloss * shine, sheen=HAIR.sheen * min(shine, 1.0), one_sided=one_sided)
