"""The picture of a person's eyes: a fibrous iris, and a white that is not white."""

import numpy as np
from PIL import Image, ImageDraw, ImageFilter

from .paintkit import Noise, smoothstep
from .parts_eyes import LIMBUS_IN_PICTURE
from .people import Look

PUPIL = 0.33
WHITE, CORNER = np.array([0.850, 0.805, 0.770]), np.array([0.800, 0.600, 0.555])
LIMBUS_SHADE = np.array([0.62, 0.62, 0.66])
# What melanin leaves of the white, where there is most of it.
STAINED = np.array([0.87, 0.81, 0.765])
VEIN = np.array([0.68, 0.24, 0.21])
VEINS, VEIN_STEPS = 46, 34
# Veins are drawn so much larger, then blurred and reduced.
FINER = 2


class EyeBrush:
    """Polar coordinates of every pixel and noise around the pupil."""

    def __init__(self, size: int, seed: int):
        self.size, self._noise = size, Noise(seed)
        x, y = np.meshgrid(*[(np.arange(size) + 0.5) / size * 2 - 1] * 2)
        self.x, self.y, self.turn = x, -y, np.arctan2(-y, x)
        # Distance from the pupil's middle; 1 is the limbus.
        self.out = np.hypot(x, y) / 2 / LIMBUS_IN_PICTURE

    def around(self, cells: float, along: float, shift: float = 0.0, bend: np.ndarray | float = 0.0):
        """Noise with so many cells around the pupil and `along` of them from it to the limbus."""
        turn = self.turn + bend
        circle = cells / (2 * np.pi) * np.stack([np.cos(turn), np.sin(turn)], -1) + 31
        return self._noise(np.concatenate([circle, (self.out * along + shift)[..., None]], -1), 1)


def _ridges(values: np.ndarray) -> np.ndarray:
    """Thin bright lines, 0..1, where noise crosses zero."""
    return np.clip(1 - np.abs(values) / 0.9, 0, 1)


def _iris(brush: EyeBrush, look: Look) -> np.ndarray:
    """Fibres from the pupil to the limbus, the collarette's zigzag, crypts, and a dark soft rim."""
    out, outer, inner = brush.out, np.array(look.iris), np.array(look.iris_ring)
    bend = 0.055 * brush.around(16, 3.0) + 0.02 * brush.around(40, 7.0, 3)
    coarse, fine = _ridges(brush.around(58, 2.2, 5, bend)), _ridges(brush.around(130, 3.6, 9, bend))
    fibres = 0.50 * coarse + 0.50 * fine
    collarette = 0.50 + 0.035 * brush.around(22, 0.5, 11) + 0.02 * brush.around(60, 1.0, 13)
    within = smoothstep(0.10, -0.06, out - collarette)
    wedge = np.clip(0.5 + 0.35 * brush.around(9, 0.8, 17), 0, 1)
    warm = np.clip(within * 0.85 + 0.30 * smoothstep(0.85, 0.5, out) * wedge, 0, 1)[..., None]
    colour = outer * (1 - warm) + inner * warm
    ridge = np.exp(-(((out - collarette) / 0.045) ** 2))
    crypts = smoothstep(0.75, 1.6, brush.around(17, 2.6, 23, bend)) * smoothstep(0.42, 0.58, out)
    furrow = np.exp(-(((out - 0.80 - 0.012 * brush.around(7, 0.3, 29)) / 0.022) ** 2))
    light = 0.56 + 0.80 * fibres + 0.24 * ridge - 0.30 * crypts - 0.10 * furrow
    light *= 1 - 0.30 * smoothstep(PUPIL + 0.10, PUPIL, out)
    light *= 1 - 0.80 * smoothstep(0.78, 1.03, out + 0.02 * brush.around(30, 1.0, 37)) ** 1.3
    mottled = 1 + 0.07 * brush.around(11, 2.0, 41)
    return colour * (light * mottled)[..., None]


def _veins(size: int, rng: np.random.Generator) -> np.ndarray:
    """Strength (size, size) of branching veins that wander from the edge towards the limbus."""
    image = Image.new("L", (size * FINER, size * FINER))
    pen, scale = ImageDraw.Draw(image), size * FINER / 2
    for _ in range(VEINS):
        # Most come from the corners, left and right.
        turn = rng.choice([0, np.pi]) + rng.normal(0, 0.55)
        _vein(pen, scale, rng, turn, 1.0, rng.uniform(0.58, 0.80), rng.uniform(90, 230))
    blurred = image.filter(ImageFilter.GaussianBlur(FINER * 0.55)).resize((size, size), Image.Resampling.BOX)
    return np.asarray(blurred, np.float32) / 255


def _vein(pen, scale, rng, turn, start, end, grey):
    """A wandering line from radius `start` to `end` of the picture, fading, with a few twigs."""
    steps = max(int(VEIN_STEPS * (start - end) / 0.4), 4)
    drift, points = rng.normal(0, 0.012), []
    for radius in np.linspace(start, end, steps):
        drift = 0.75 * drift + rng.normal(0, 0.011)
        turn += drift
        points.append((scale * (1 + radius * np.cos(turn)), scale * (1 + radius * np.sin(turn))))
        if grey > 60 and rng.uniform() < 0.07:
            _vein(pen, scale, rng, turn + rng.normal(0, 0.03), radius, max(radius - 0.16, end), grey * 0.6)
    for k in range(steps - 1):
        fading = 1 - 0.75 * k / steps
        pen.line(points[k : k + 2], fill=int(grey * fading), width=FINER if grey > 120 else 1)


def _white(brush: EyeBrush, look: Look, rng: np.random.Generator) -> np.ndarray:
    """Warm white, pink towards the corners and the lids, with veins, greyer at the limbus."""
    edge = (brush.out * LIMBUS_IN_PICTURE - LIMBUS_IN_PICTURE) / (0.5 - LIMBUS_IN_PICTURE)
    aside = np.abs(np.cos(brush.turn))
    pink = smoothstep(0.10, 0.85, edge * (0.60 + 0.40 * aside)) * (1 + 0.12 * brush.around(14, 3.0, 43))
    colour = WHITE + (CORNER - WHITE) * np.clip(pink, 0, 1)[..., None]
    colour = colour * (1 + 0.012 * brush.around(30, 9.0, 47))[..., None]
    veins = (_veins(brush.size, rng) * smoothstep(0.02, 0.22, edge) * 1.0)[..., None]
    colour = colour * (1 - veins) + VEIN * veins
    colour = colour * STAINED**look.gum_pigment
    shade = np.exp(-(((brush.out - 1.0) / 0.07) ** 2))[..., None]
    return colour * (1 - shade * (1 - LIMBUS_SHADE))


def eye_picture(look: Look, size: int = 768) -> Image.Image:
    """The pupil is in the middle, the limbus at `LIMBUS_IN_PICTURE`, the back of the eye at the edge."""
    brush, rng = EyeBrush(size, look.iris_seed), np.random.default_rng(look.iris_seed)
    colours = _white(brush, look, rng)
    # The limbus is soft: white grows over the iris.
    inside = smoothstep(1.055, 0.925, brush.out + 0.008 * brush.around(40, 1.0, 53))[..., None]
    colours = colours * (1 - inside) + _iris(brush, look) * inside
    pupil = smoothstep(PUPIL + 0.022, PUPIL - 0.022, brush.out + 0.004 * brush.around(50, 0.4, 59))[..., None]
    colours = colours * (1 - pupil) + np.array([0.022, 0.017, 0.015]) * pupil
    return Image.fromarray((np.clip(colours, 0, 1) * 255 + 0.5).astype(np.uint8))
