"""Pictures of teeth, gums and tongue."""

import numpy as np
from PIL import Image

from .paintkit import Noise, smoothstep
from .people import Look
from .tooth_shapes import FRONT_AROUND, FRONT_COLUMNS

TEETH = 14
IVORY, ROOT, EDGE = (
    np.array([0.985, 0.925, 0.815]),
    np.array([0.93, 0.81, 0.64]),
    np.array([0.86, 0.855, 0.825]),
)
AGED = np.array([0.97, 0.935, 0.87])
GUM, LINING, PALATE = np.array([0.80, 0.50, 0.47]), np.array([0.66, 0.27, 0.26]), np.array([0.76, 0.46, 0.43])
PIGMENT = np.array([0.62, 0.52, 0.50])
TONGUE, TONGUE_TIP = np.array([0.66, 0.38, 0.37]), np.array([0.65, 0.34, 0.34])


def _picture(colours: np.ndarray) -> Image.Image:
    return Image.fromarray((np.clip(colours, 0, 1) * 255).astype(np.uint8))


def _grid(width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    """u and v (height, width) of the pixels' middles."""
    v, u = np.mgrid[0:height, 0:width]
    return (u + 0.5) / width, 1 - (v + 0.5) / height


def teeth_picture(look: Look, width: int = 896, height: int = 192) -> Image.Image:
    """Fourteen crowns side by side, each once around; upper ones in the upper half, edges upwards."""
    noise = Noise(11)
    u, v = _grid(width, height)
    tooth, turn = np.floor(u * TEETH), u * TEETH % 1
    crown = np.clip((v % 0.5 - 0.01) / 0.48, 0, 1) * 1.12 - 0.12
    places = np.arange(FRONT_COLUMNS) / len(FRONT_AROUND)
    across = np.interp(turn, places, FRONT_AROUND[:FRONT_COLUMNS])
    behind = smoothstep(0.5, 0.56, turn) * smoothstep(1.0, 0.94, turn)
    root, edge = smoothstep(0.42, -0.02, crown), smoothstep(0.76, 1.0, crown)
    front_tooth = smoothstep(4.6, 3.6, np.abs(tooth - 6.5))
    colours = IVORY * (1 - root[..., None]) + ROOT * root[..., None]
    colours = _blend(colours, EDGE, 0.65 * edge * front_tooth)
    # Canines are darker and warmer than incisors, and no tooth is quite like its neighbour.
    canine = np.isin(tooth, (4, 9))[..., None]
    own = noise(np.stack([tooth * 1.7, np.floor(v * 2) * 3.1, 0 * u], -1), 1)[..., None]
    colours = (
        colours * np.where(canine, [0.98, 0.955, 0.91], 1.0) * (1 + own * np.array([0.008, 0.011, 0.018]))
    )
    grain = noise(np.stack([across * 6 + tooth * 5, crown * 1.3, v], -1), 1)
    clouds = noise(np.stack([across * 1.5 + tooth * 9, crown * 3, v * 2], -1), 1)
    colours = colours * (1 + 0.010 * grain + 0.016 * clouds)[..., None]
    # Where crowns touch, and round their necks, little light comes in; what does is red from the gums.
    contact = smoothstep(0.84, 1.0, np.where(turn > 0.5, np.abs(4 * turn - 3), np.abs(across)))
    neck = smoothstep(0.16, 0.0, crown)
    colours = colours * (1 - (0.44 * contact * smoothstep(1.02, 0.85, crown))[..., None] * [0.8, 1.0, 1.08])
    colours = colours * (1 - (0.40 * neck)[..., None] * [0.55, 1.0, 1.05])
    # Cheeks and tongue keep light from the back teeth.
    hidden = 1 - (1 - 0.14 * behind) * (1 - 0.38 * smoothstep(3.0, 6.0, np.abs(tooth - 6.5)))
    colours = colours * (1 - hidden[..., None] * [0.85, 1.0, 1.05])
    return _picture(colours * AGED**look.tooth_age)


def _blend(colours: np.ndarray, other: np.ndarray, amount: np.ndarray) -> np.ndarray:
    return colours + (other - colours) * amount[..., None]


def gum_picture(look: Look, width: int = 640, height: int = 160) -> Image.Image:
    """Across the arch; downwards lip's side, margin, tongue's side (to 0.4), then the palate."""
    noise = Noise(12)
    u, v = _grid(width, height)
    at = np.stack([u * 60, v * 26, 0 * u], -1)
    cloud, stipple = noise.layered(at * 0.5, 1, 3), noise(at * 4, 1)
    colours = _blend(np.broadcast_to(GUM, (*u.shape, 3)), LINING, smoothstep(0.86, 0.97, v + 0.012 * cloud))
    colours = _blend(colours, GUM * [1.03, 0.98, 0.98], smoothstep(0.10, 0.0, np.abs(v - 0.70)))
    palate = smoothstep(0.47, 0.40, v)
    colours = _blend(colours, PALATE, palate)
    dark = np.clip(look.gum_pigment * (0.75 + 0.5 * cloud), 0, 1) * smoothstep(0.38, 0.55, v)
    colours = colours * (1 + dark[..., None] * (PIGMENT - 1))
    colours = colours * (1 + 0.045 * cloud + 0.02 * stipple)[..., None]
    # Folds across the front of the palate, and its seam.
    folds = (
        np.cos(v * 150 + 5 * np.abs(u - 0.5) + cloud) * smoothstep(0.24, 0.30, v) * smoothstep(0.38, 0.34, v)
    )
    seam = np.exp(-(((u - 0.5) / 0.02) ** 2)) * smoothstep(0.36, 0.30, v)
    colours = colours * (1 + 0.06 * folds - 0.10 * seam)[..., None]
    return _picture(_blend(colours, LINING, smoothstep(0.16, 0.0, v)))


def tongue_picture(look: Look, size: int = 256) -> Image.Image:
    """Across and from root (0) to tip (1); a strip on the left is the lower side."""
    noise = Noise(13)
    u, v = _grid(size, size)
    across = (u - 0.535) / 0.445
    at = np.stack([u * 40, v * 40, 0 * u], -1)
    cloud, papillae = noise.layered(at * 0.2, 1, 3), noise(at * 2.2, 1)
    red = smoothstep(0.70, 1.0, np.maximum(v, np.abs(across)))
    colours = _blend(np.broadcast_to(TONGUE, (*u.shape, 3)), TONGUE_TIP, red)
    coat = 0.30 * smoothstep(0.9, 0.3, v) * smoothstep(0.8, 0.2, np.abs(across)) * (1 + 0.5 * cloud)
    colours = _blend(colours, np.array([0.80, 0.60, 0.56]), coat)
    dots = np.clip(papillae - 0.6, 0, 1) * smoothstep(0.3, 0.6, v)
    colours = (
        colours
        * (1 + 0.05 * papillae + 0.04 * cloud)[..., None]
        * (1 + dots[..., None] * [0.06, -0.05, -0.05])
    )
    groove = np.exp(-(((across + 0.03 * cloud) / 0.17) ** 2)) * smoothstep(0.95, 0.6, v)
    colours = colours * (1 - groove[..., None] * [0.08, 0.12, 0.12])
    below = smoothstep(0.085, 0.075, u)
    colours = _blend(colours, np.array([0.68, 0.30, 0.31]), below)
    return _picture(colours * (1 - 0.18 * look.gum_pigment * (1 - below))[..., None])
