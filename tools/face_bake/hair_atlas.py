"""The hair's picture: strands for the sheet above, eight tiles of locks with ragged tips below.

Strands run down the picture, so that a PNG's rows resemble each other and the file stays small. It has
a palette of tones at eight opacities. Tones are relative to the lightest strand of a person, whose colour
is the material's: a renderer can tell strands apart by them on the blackest hair.
"""

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter

from .hair_cuts import STYLES
from .hair_strokes import Coils, Strokes, ragged, swing
from .hair_styles import Texture
from .paintkit import smoothstep
from .people import Look

WIDTH, SHEET_HEIGHT, TILE_HEIGHT = 1024, 512, 256
HEIGHT = SHEET_HEIGHT + TILE_HEIGHT
TILES = 8
# The sheet's picture goes round the head so many times.
SHEET_REPEATS = 3.0
# v of the sheet's roots and tips; the border keeps mip levels of the tiles apart.
BORDER = 4
# Below a lock's tips it is empty, so that no mip level shows what lies on the other side of the border.
MARGIN = 16
SHEET_ROWS = 1 - BORDER / HEIGHT, 1 - (SHEET_HEIGHT - BORDER) / HEIGHT
TONES, OPACITIES = 32, 8
# Tiles from dense to thin: strands, and how much of half the tile they fill.
DENSITY = (120, 105, 95, 80, 52, 44, 36, 28)
SPREAD = (0.40, 0.38, 0.36, 0.34, 0.32, 0.29, 0.27, 0.22)
CLUMPS = 46


def tile_box(tile: int) -> tuple[float, float, float, float]:
    """Left, bottom, right and top of a tile of locks."""
    width = WIDTH / TILES
    left, right = tile * width + BORDER, (tile + 1) * width - BORDER
    return left / WIDTH, MARGIN / HEIGHT, right / WIDTH, (TILE_HEIGHT - BORDER) / HEIGHT


def _straight_sheet(texture: Texture, rng: np.random.Generator) -> Strokes:
    """Broad locks, then strands; dark at the roots and between locks, ragged at the tips."""
    strokes = Strokes(WIDTH, SHEET_HEIGHT, wraps=True)
    rows, wave = strokes.rows, texture.wave
    light = 0.24 + 0.26 * smoothstep(0.0, 0.30, rows)
    clump_tone = rng.uniform(-0.15, 0.15, CLUMPS)
    # Short hair does not gather in locks.
    gathers = 1.0 if texture.strand >= 1 else 0.35
    clump_swing = [swing(rows, rng, 7 * wave) for _ in range(CLUMPS)]
    short = texture.strand < 1
    strokes.opacity[:] = (
        texture.cover * smoothstep(1 - 0.45 * texture.ragged, 1 - texture.ragged, rows)[:, None]
        if short
        else 1
    )
    strokes.tone[:] = (0.6 * light)[:, None]
    for _ in range(int(1500 / texture.strand)):
        x0 = rng.uniform(0, WIDTH)
        clump = int(x0 / WIDTH * CLUMPS)
        x = x0 + clump_swing[clump] + swing(rows, rng, 2.5)
        # Between two locks it is darker.
        depth = 0.22 * gathers * abs((x0 / WIDTH * CLUMPS) % 1 - 0.5) * 2
        tone = light + gathers * clump_tone[clump] + rng.normal(0, 0.13 * texture.contrast) - depth
        width, opacity = np.full(SHEET_HEIGHT, rng.uniform(0.8, 2.4)), np.full(SHEET_HEIGHT, 0.8)
        if short:
            length = texture.strand * rng.uniform(0.7, 1.2)
            start = rng.uniform(-texture.strand, 1)
            # Towards the hairline single hairs are left, and ever fewer.
            if (start + length - 1) / texture.ragged + 0.80 > rng.uniform():
                continue
            t = (rows - start) / length
            # A short hair comes out of the dark and ends in a light tip over the next ones.
            opacity = 0.85 * smoothstep(0, 0.35, t) * smoothstep(1.0, 0.93, t)
            tone = tone - 0.10 + 0.22 * np.clip(t, 0, 1)
            x = x + 14 * texture.wave * (t - 0.5) * rng.normal(0, 1)
        strokes.strand(x, width, tone, opacity)
    reach = ragged(WIDTH, texture.ragged * (0.25 if short else 1.0), rng)
    strokes.opacity *= smoothstep(0.0, -0.04, rows[:, None] - reach[None])
    return strokes


def _straight_tile(tile: int, texture: Texture, rng: np.random.Generator) -> Strokes:
    """A lock: many strands that gather towards the tip; later tiles are thinner."""
    width = WIDTH // TILES
    strokes = Strokes(width, TILE_HEIGHT)
    rows, spread, wave = strokes.rows, SPREAD[tile], texture.wave
    gather, shared = rng.uniform(0.35, 0.65), swing(rows, rng, 5 * wave)
    dark = rng.uniform(-0.05, 0.05)
    points = rng.uniform(-1, 1, 3) * spread * 0.7
    for _ in range(round(DENSITY[tile] * texture.density)):
        at = rng.uniform(-1, 1) * spread
        goal = points[np.argmin(np.abs(points - at))]
        place = at + (goal - at) * gather * rows**1.5
        x = width * (0.5 + place) + shared + swing(rows, rng, 1.2 + 2 * wave) * rows
        length = np.clip(rng.normal(0.80, 0.08), 0.45, 0.92) - 0.16 * abs(at / spread)
        thick = rng.uniform(1.0, 2.0) * np.clip(1.25 - rows / max(length, 0.1) * 0.7, 0.55, 1)
        tone = 0.27 + 0.15 * smoothstep(0, 0.4, rows) + dark + rng.normal(0, 0.12 * texture.contrast)
        # Short hair grows out of the skin where it is seen: no two hairs of a lock begin side by side.
        begins = rng.uniform(0, 0.40) if texture.strand < 1 else 0.0
        grown = smoothstep(begins, begins + 0.10 + 0.35 * rng.uniform(), rows)
        opacity = smoothstep(length, length - 0.22, rows) * grown
        strokes.strand(x, thick, tone, opacity)
    return strokes


def _coiled_sheet(texture: Texture, rng: np.random.Generator) -> Strokes:
    """Coils in every direction, the upper ones lighter; between them it is dark."""
    coils, radius = Coils(WIDTH, SHEET_HEIGHT, wraps=True), texture.curl
    # Coils gather in tufts that catch light on top and leave it dark between them.
    tufts = gaussian_filter(rng.standard_normal((SHEET_HEIGHT, WIDTH)), (9, 18), mode=("nearest", "wrap"))
    even = texture.contrast
    tufts = np.clip(0.85 + 0.42 * even * tufts / tufts.std(), 0.22, 1.5)
    # Tighter coils are finer and more.
    more, wide = max(1.0, (7 / radius) ** 2), np.clip(radius / 5, 0.9, 1.4)
    for layer, count in enumerate((1100, 1000, 800)):
        for _ in range(int(count * more)):
            start = rng.uniform(0, WIDTH), rng.uniform(-20, SHEET_HEIGHT)
            step = rng.normal(0, 1.2 * radius), rng.normal(0, 1.0 * radius)
            size = radius * rng.uniform(0.6, 1.2)
            tone = (0.48, 0.50 + 0.20 * even, 0.54 + 0.38 * even)[layer] * rng.uniform(0.75, 1.2)
            coils.coil(start, step, (size, size * 0.55), rng.uniform(1.5, 3.5), tone, wide, rng)
    strokes = coils.strokes()
    strokes.tone *= tufts
    strokes.opacity[:] = 1
    # Towards the tips only the upper coils are left, one by one.
    past = (strokes.rows - 1) / texture.ragged + 1
    strokes.opacity *= smoothstep(
        0.0, 0.12, strokes.tone - (0.30 + 0.32 * even) * np.clip(past, -1, 1)[:, None]
    )
    strokes.opacity[-BORDER * 2 :] = 0
    return strokes


def _coiled_tile(tile: int, texture: Texture, rng: np.random.Generator) -> Strokes:
    """A tuft of coils, closest in its middle; single ones stand out of its outline all round."""
    width = WIDTH // TILES
    coils, radius = Coils(width, TILE_HEIGHT), 5 + 0.45 * texture.curl
    count = 60 + DENSITY[tile] // 2
    for k in range(count):
        away, angle = 0.98 * rng.beta(1.5, 1.5), rng.uniform(0, 2 * np.pi)
        start = (
            width * (0.5 + 0.34 * away * np.cos(angle)),
            TILE_HEIGHT * (0.44 + 0.34 * away * np.sin(angle)),
        )
        step = rng.normal(0, 6), rng.normal(0, 12)
        tone = (0.40 + 0.45 * texture.contrast * k / count) * rng.uniform(0.8, 1.2)
        size = radius * rng.uniform(0.7, 1.2)
        coils.coil(start, step, (size, size * 1.6), rng.uniform(1.0, 2.0), tone, 2.6, rng)
    strokes = coils.strokes()
    across = (np.arange(width) + 0.5) / width - 0.5
    away = np.hypot(across[None] / 0.46, (strokes.rows[:, None] - 0.44) / 0.46)
    strokes.opacity *= smoothstep(1.0, 0.55, away)
    return strokes


def hair_picture(look: Look) -> Image.Image:
    """The picture of a person's hair, with a palette."""
    rng, texture = np.random.default_rng(5), STYLES[look.hair_style].texture
    paint_sheet, paint_tile = (
        (_coiled_sheet, _coiled_tile) if texture.curl else (_straight_sheet, _straight_tile)
    )
    sheet = paint_sheet(texture, rng)
    tiles = [paint_tile(tile, texture, rng) for tile in range(TILES)]
    tone = np.concatenate([sheet.tone, np.concatenate([t.tone for t in tiles], 1)])
    opacity = np.concatenate([sheet.opacity, np.concatenate([t.opacity for t in tiles], 1)])
    return _with_palette(tone, opacity, look)


def _with_palette(tone: np.ndarray, opacity: np.ndarray, look: Look) -> Image.Image:
    tones = np.clip(np.round(tone * (TONES - 1)), 0, TONES - 1).astype(np.uint8)
    # The top level is exactly opaque, so that the sheet has no veil over what lies behind it.
    levels = np.clip(np.round(opacity * (OPACITIES - 1)), 0, OPACITIES - 1).astype(np.uint8)
    image = Image.fromarray(levels * TONES + tones, "P")
    relative = _shades(look) / linear(lightest(look))
    image.putpalette(np.tile(np.round(255 * stored(relative)).astype(np.uint8), (OPACITIES, 1)).tobytes())
    alpha = np.repeat(np.round(np.linspace(0, 255, OPACITIES)), TONES).astype(np.uint8)
    image.info["transparency"] = alpha.tobytes()
    return image


def lightest(look: Look) -> np.ndarray:
    """The lightest strand's colour (3,), sRGB 0..1."""
    # Coils turn some of their strands to every lamp: no sheen, but no part of them is quite black either.
    lifted = 0.17 if STYLES[look.hair_style].texture.curl else 0.06
    return np.clip(np.array(look.hair) * 1.75 + lifted, 0, 1)


def hair_material(look: Look) -> tuple:
    """Colour (linear light), shine, exponent and picture."""
    colour = tuple(np.round(linear(lightest(look)), 4).tolist())
    return colour, 0.3 * STYLES[look.hair_style].texture.gloss, 40, "hair.png"


def linear(srgb: np.ndarray) -> np.ndarray:
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def stored(light: np.ndarray) -> np.ndarray:
    """sRGB of linear light, 0..1."""
    return np.where(light <= 0.0031308, light * 12.92, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)


def _shades(look: Look) -> np.ndarray:
    """Linear colours (TONES, 3) from the depth between locks to the lightest strand."""
    hair, level = np.array(look.hair), np.linspace(0, 1, TONES)[:, None]
    dark, light = hair * (0.28 + 1.44 * level), hair + (lightest(look) - hair) * (2 * level - 1)
    return linear(np.where(level < 0.5, dark, light))
