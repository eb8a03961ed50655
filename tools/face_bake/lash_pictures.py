"""Pictures of short hairs: four tufts for brows, and the fringes of upper and lower lashes."""

import numpy as np
from PIL import Image

from .hair_atlas import linear
from .hair_strokes import Strokes
from .paintkit import smoothstep
from .people import Look

BROW_TILE, BROW_HEIGHT, BROW_TILES = 128, 192, 4
# How closely hairs stand in each tile, next to the densest part of a brow.
BROW_DENSITY = (1.22, 1.06, 0.90, 0.68)
LASH_WIDTH, LASH_HEIGHT = 512, 96


def brow_material(look: Look) -> tuple:
    """Colour (linear light), shine, exponent and picture."""
    # Hairs as fine as these let light through: softer and warmer than what grows on the head.
    return _dyed(np.clip(np.array(look.brow) * (1.40, 1.24, 1.10) + (0.028, 0.020, 0.016), 0, 1), "brow.png")


def lash_material(look: Look) -> tuple:
    """As dark as brows get, or darker."""
    return _dyed(np.minimum(np.array(look.brow) * 0.5, 0.09), "lash.png")


def _dyed(srgb: np.ndarray, picture: str) -> tuple:
    return tuple(np.round(linear(srgb), 4).tolist()), 0.012, 20, picture


def _picture(strokes: Strokes) -> Image.Image:
    """Grey and opacity in 16 steps each, which is all that hairs a pixel wide need."""
    bands = [np.round(np.clip(band, 0, 1) * 15) * 17 for band in (strokes.tone, strokes.opacity)]
    return Image.fromarray(np.stack(bands, -1).astype(np.uint8), "LA")


def brow_picture(look: Look) -> Image.Image:
    """Tiles of hairs that grow downwards in the picture and taper to their tips."""
    rng, whole = np.random.default_rng(31), Strokes(BROW_TILE * BROW_TILES, BROW_HEIGHT, ground=0.8)
    for tile in range(BROW_TILES):
        hairs = round(30 * look.brow_density * BROW_DENSITY[tile])
        for k in range(hairs):
            rows = whole.rows
            at = (k + rng.uniform(0.2, 0.8)) / hairs
            # Hairs at a tile's sides are short and faint, so that tufts run into each other.
            side = smoothstep(0.0, 0.3, min(at, 1 - at))
            start, length = rng.uniform(-0.08, 0.45), rng.uniform(0.34, 0.78) * (0.7 + 0.3 * side)
            t = (rows - start) / length
            bend = rng.normal(0, 11) * np.clip(t, 0, 1) ** 2 + rng.normal(0, 10) * np.clip(t, 0, 1)
            x = tile * BROW_TILE + 3 + at * (BROW_TILE - 6) + bend
            x = np.clip(x, tile * BROW_TILE + 2, (tile + 1) * BROW_TILE - 2)
            width = 3.1 * np.clip(1 - t, 0.05, 1) ** 0.6 * rng.uniform(0.55, 1.25)
            opacity = (
                (0.58 + 0.26 * side)
                * rng.uniform(0.7, 1.15)
                * smoothstep(0.0, 0.10, t)
                * smoothstep(1.0, 0.75, t)
            )
            tone = 0.54 + 0.22 * np.clip(t, 0, 1) + rng.normal(0, 0.16)
            whole.strand(x, width, tone, opacity)
    return _picture(whole)


def lash_picture(look: Look) -> Image.Image:
    """Upper lashes above, lower ones below, from the inner corner (left) to the outer; roots at the top."""
    rng, half = np.random.default_rng(33), LASH_HEIGHT // 2
    fringes = [
        _fringe(rng, half, clumps=round(34 * look.lash_density), reach=0.95, width=3.4),
        _fringe(rng, half, clumps=round(24 * look.lash_density), reach=0.8, width=2.2),
    ]
    whole = Strokes(LASH_WIDTH, LASH_HEIGHT, ground=0.9)
    whole.tone = np.concatenate([fringe.tone for fringe in fringes])
    whole.opacity = np.concatenate([fringe.opacity for fringe in fringes])
    return _picture(whole)


def _fringe(rng: np.random.Generator, height: int, clumps: int, reach: float, width: float) -> Strokes:
    """Lashes in groups of one to three whose tips meet."""
    strokes = Strokes(LASH_WIDTH, height, ground=0.9)
    rows = strokes.rows
    for k in range(clumps):
        along = (k + rng.uniform(0.25, 0.75)) / clumps
        # Hardly any grow beside the caruncle.
        envelope = np.interp(
            along, [0, 0.10, 0.20, 0.38, 0.75, 0.93, 1], [0.06, 0.14, 0.52, 0.85, 1, 0.8, 0.4]
        )
        fan = (along - 0.45) * 34
        for member in range(rng.integers(1, 4)):
            root = along * LASH_WIDTH + (member - 1) * rng.uniform(3.0, 5.0)
            tip = along * LASH_WIDTH + fan + rng.normal(0, 2.0) + (member - 1) * 1.2
            length = reach * envelope * rng.uniform(0.78, 1.0) * (1 if member == 0 else 0.9)
            t = rows / max(length, 0.05)
            x = np.clip(root + (tip - root) * np.clip(t, 0, 1) ** 1.5, 1, LASH_WIDTH - 2)
            thick = width * np.clip(1 - t, 0.04, 1) ** 0.75
            opacity = 0.95 * smoothstep(1.0, 0.8, t)
            strokes.strand(x, thick, 0.35 + 0.4 * np.clip(t, 0, 1), opacity)
    return strokes
