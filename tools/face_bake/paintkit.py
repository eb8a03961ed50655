"""Small tools for painting: noise in space, smooth steps and shapes drawn on a plane."""

import numpy as np
from PIL import Image, ImageDraw, ImageFilter
from scipy.ndimage import map_coordinates


class Noise:
    """Repeatable smooth noise over space; `points` are (..., 3), the result is (...)."""

    def __init__(self, seed: int, size: int = 64):
        self._grid = np.random.default_rng(seed).standard_normal((size, size, size)).astype(np.float32)

    def __call__(self, points: np.ndarray, frequency: float) -> np.ndarray:
        places = (points * frequency).reshape(-1, 3).T % len(self._grid)
        return map_coordinates(self._grid, places, order=1, mode="grid-wrap").reshape(points.shape[:-1])

    def layered(self, points: np.ndarray, frequency: float, octaves: int = 4) -> np.ndarray:
        """Octaves of noise, each twice as fine and half as strong."""
        layers = (self(points + 13.7 * k, frequency * 2**k) * 0.5**k for k in range(octaves))
        return sum(layers) / 1.5


def smoothstep(start: float, end: float, value: np.ndarray) -> np.ndarray:
    """0 before `start`, 1 after `end`, smooth between; `start` may be the larger."""
    t = np.clip((value - start) / (end - start), 0, 1)
    return t * t * (3 - 2 * t)


def mix(colour: np.ndarray, other: np.ndarray, amount: np.ndarray) -> np.ndarray:
    """Blend (n, 3) towards another colour by (n,)."""
    amount = amount[:, None]
    return colour * (1 - amount) + other * amount


def tint(colour: np.ndarray, amount: np.ndarray, factor) -> np.ndarray:
    """Multiply (n, 3) by a colour to the degree (n,)."""
    return colour * (1 + amount[:, None] * (np.asarray(factor, np.float32) - 1))


class Plane:
    """A grey picture of a rectangle of the plane; draw on it, then sample it anywhere."""

    def __init__(self, left, right, bottom, top, resolution, blur=0.0):
        self._left, self._top, self._resolution, self._blur = left, top, resolution, blur
        size = int((right - left) * resolution), int((top - bottom) * resolution)
        self._image = Image.new("L", size)
        self._pen = ImageDraw.Draw(self._image)

    def _pixels(self, points) -> list[tuple[float, float]]:
        return [((x - self._left) * self._resolution, (self._top - y) * self._resolution) for x, y in points]

    def polygon(self, points) -> "Plane":
        self._pen.polygon(self._pixels(points), fill=255)
        return self

    def ellipse(self, corner, opposite) -> "Plane":
        self._pen.ellipse(self._pixels([corner]) + self._pixels([opposite]), fill=255)
        return self

    def line(self, points, grey: int, width: int) -> "Plane":
        self._pen.line(self._pixels(points), fill=grey, width=width)
        return self

    def sampler(self):
        """A function of x and y giving 0..1, zero outside the rectangle."""
        image = self._image
        if self._blur:
            image = image.filter(ImageFilter.GaussianBlur(self._blur * self._resolution))
        grey = np.asarray(image, np.float32) / 255

        def sample(x, y):
            places = [(self._top - y) * self._resolution - 0.5, (x - self._left) * self._resolution - 0.5]
            return map_coordinates(grey, places, order=1, mode="constant")

        return sample
