"""Strands as strokes: painted one over another into a tone and an opacity, straight ones and coils."""

import numpy as np
from PIL import Image, ImageDraw

# Coils are drawn so many times larger, then averaged.
LARGER = 2


class Strokes:
    """Tone and opacity (rows, columns) under strands drawn one over another; both 0..1."""

    def __init__(self, columns: int, rows: int, *, wraps: bool = False, ground: float = 0.3):
        self.tone = np.full((rows, columns), ground, np.float32)
        self.opacity = np.zeros((rows, columns), np.float32)
        self._wraps = wraps

    @property
    def rows(self) -> np.ndarray:
        """0..1 from the top row to the bottom row."""
        return np.linspace(0, 1, len(self.tone))

    def strand(self, x: np.ndarray, width: np.ndarray, tone: np.ndarray, opacity: np.ndarray):
        """One strand down the picture; x, width in pixels, tone and opacity: (rows,)."""
        rows = np.flatnonzero(opacity > 0.01)
        x, width, tone, opacity = x[rows], width[rows], tone[rows], opacity[rows]
        for offset in range(-2, 3):
            column = np.floor(x).astype(int) + offset
            cover = np.clip(width / 2 + 0.5 - np.abs(x - column - 0.5), 0, 1) * np.minimum(width, 1) * opacity
            if self._wraps:
                inside = np.arange(len(x))
                column = column % self.tone.shape[1]
            else:
                inside = np.flatnonzero((column >= 0) & (column < self.tone.shape[1]))
                column, cover = column[inside], cover[inside]
            row = rows[inside]
            was = self.tone[row, column]
            self.tone[row, column] = was + (tone[inside] - was) * cover
            self.opacity[row, column] = np.maximum(self.opacity[row, column], cover)


class Coils:
    """A picture that coiled strands are drawn on, larger than it will be."""

    def __init__(self, columns: int, rows: int, *, wraps: bool = False):
        self._size = columns * LARGER, rows * LARGER
        self._tone, self._opacity = Image.new("L", self._size, 20), Image.new("L", self._size, 0)
        self._pens = ImageDraw.Draw(self._tone), ImageDraw.Draw(self._opacity)
        self._wraps = wraps

    def coil(self, start, step, radii, turns: float, tone: float, width: float, rng: np.random.Generator):
        """A helix from the side: start, step (over its whole length) and radii in pixels, (x, y) each."""
        phase, lit = rng.uniform(0, 2 * np.pi, 2)
        angle = np.linspace(0, 2 * np.pi * turns, max(int(turns * 9), 4)) + phase
        along = (angle - phase) / (2 * np.pi * turns)
        x = (start[0] + step[0] * along + radii[0] * np.cos(angle)) * LARGER
        y = (start[1] + step[1] * along + radii[1] * np.sin(angle)) * LARGER
        # The near half of each turn catches light, the far half lies in its shadow.
        level = np.clip(tone * (0.62 + 0.38 * np.sin(angle + lit)), 0, 1)
        wide = max(round(width * LARGER), 1)
        for k in range(len(x) - 1):
            for shift in self._copies(x[k]):
                line = [(x[k] + shift, y[k]), (x[k + 1] + shift, y[k + 1])]
                self._pens[0].line(line, fill=int(255 * level[k]), width=wide)
                self._pens[1].line(line, fill=255, width=wide)

    def _copies(self, x: float) -> list[float]:
        if not self._wraps:
            return [0.0]
        width, near = self._size[0], 60
        return [0.0, *([width] if x < near else []), *([-width] if x > width - near else [])]

    def strokes(self) -> Strokes:
        columns, rows = (side // LARGER for side in self._size)
        result = Strokes(columns, rows)
        result.tone, result.opacity = (
            np.asarray(image.resize((columns, rows), Image.Resampling.BOX), np.float32) / 255
            for image in (self._tone, self._opacity)
        )
        return result


def swing(rows: np.ndarray, rng: np.random.Generator, amount: float) -> np.ndarray:
    """A slow sideways wander along a strand, in units of `amount`."""
    waves = [(rng.uniform(0.4, 1.4), 1.0), (rng.uniform(1.5, 3.5), 0.35)]
    return amount * sum(a * np.sin(2 * np.pi * (f * rows + rng.uniform(0, 1))) for f, a in waves)


def ragged(width: int, share: float, rng: np.random.Generator) -> np.ndarray:
    """Where tips end (width,), 0..1 down the picture: by the lock, and within it by the strand."""
    at = np.arange(width)
    broad = np.interp(at, np.linspace(0, width, 47), rng.uniform(0, 1, 47), period=width)
    fine = np.interp(at, np.arange(0, width, 3), rng.uniform(0, 1, -(-width // 3)), period=width)
    return 0.995 - share * (0.68 * broad + 0.32 * fine)
