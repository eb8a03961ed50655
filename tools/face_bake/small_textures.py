"""Pictures of the eye."""

import numpy as np
from PIL import Image

from .paintkit import Noise, smoothstep
from .parts_eyes import TEXTURE_EDGE

IRIS_EDGE = 27.0


def _picture(colours: np.ndarray) -> Image.Image:
    return Image.fromarray((np.clip(colours, 0, 1) * 255).astype(np.uint8))


def _white(degrees, turn, noise: Noise) -> np.ndarray:
    """The white with a few veins, redder towards the back."""
    veins = noise(np.stack([np.cos(turn) * 9 + 12, np.sin(turn) * 9 + 12, degrees * 0.05], -1), 1)
    veins = np.clip(veins - 1.1, 0, 1) * smoothstep(40, 80, degrees)
    red = (veins * 0.5 + 0.16 * smoothstep(45, 95, degrees))[..., None]
    return np.array([0.93, 0.91, 0.89]) * (1 - red * np.array([0.05, 0.55, 0.55]))


def _iris(colour, degrees, turn, noise: Noise) -> np.ndarray:
    """Fibres, a dark rim and a warmer ring around the pupil."""
    coarse = noise(np.stack([np.cos(turn) * 14 + 20, np.sin(turn) * 14 + 20, degrees * 0.10], -1), 1)
    fine = noise(np.stack([np.cos(turn) * 30 + 40, np.sin(turn) * 30 + 40, degrees * 0.06], -1), 1)
    fibres = 1 + 0.28 * (coarse * 0.6 + fine * 0.5)
    fading = 0.72 + 0.5 * smoothstep(IRIS_EDGE, IRIS_EDGE * 0.45, degrees)
    brightness = fibres * fading * (1 - 0.62 * smoothstep(IRIS_EDGE * 0.80, IRIS_EDGE, degrees))
    ring = (np.exp(-(((degrees - IRIS_EDGE * 0.48) / 4) ** 2)) * 0.35)[..., None]
    warm = np.array(colour) * np.array([1.5, 1.2, 0.8])
    return np.array(colour) * brightness[..., None] * (1 - ring) + warm * ring


def eye_picture(iris, size: int = 512) -> Image.Image:
    """The pupil is in the middle; the distance from it is the angle from the line of sight."""
    noise = Noise(0)
    y, x = (np.mgrid[0:size, 0:size] + 0.5) / size * 2 - 1
    degrees, turn = np.hypot(x, y) * TEXTURE_EDGE, np.arctan2(y, x)
    colours = _white(degrees, turn, noise)
    inside = smoothstep(IRIS_EDGE + 1.3, IRIS_EDGE - 1.0, degrees)[..., None]
    colours = colours * (1 - inside) + _iris(iris, degrees, turn, noise) * inside
    pupil = smoothstep(IRIS_EDGE * 0.36 + 0.8, IRIS_EDGE * 0.36 - 0.8, degrees)[..., None]
    colours = colours * (1 - pupil) + 0.012 * pupil
    lid_shadow = 0.42 * smoothstep(-0.02, -0.26, y + 0.05 * x * x)
    return _picture(colours * (1 - lid_shadow[..., None]))
