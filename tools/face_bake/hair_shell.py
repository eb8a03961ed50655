"""The sheet of hair around the base head: columns from the parting to the tips, given body by its style."""

import numpy as np
from scipy.ndimage import gaussian_filter1d

from .hair_frame import CENTRE, Skull, direction, slerp, unit
from .hair_styles import Style
from .paintkit import Noise, smoothstep

COLUMNS, ROWS = 44, 14
# The sheet is worked out so many times finer, for locks to follow.
FINER = 4
STEPS = 72
ON_SKULL = 44
# What a head of coils is grown around, and how much narrower than a ball it is.
BALL_CENTRE, BALL_SHAPE = np.array([0.0, 7.80, 0.45]), np.array([1.10, 0.97, 1.03])
# A hanging sheet may draw in by so much for each decimetre that it falls.
DRAW_IN = 0.10
# How far the ends of a sheet that goes all around lie apart, dm.
APART = 0.010
# Above this height no ear reaches.
TENT_TOP = 7.9


class Sheet:
    """Points (C, R, 3) of a fine sheet in base-mesh space, t evenly along each column."""

    def __init__(self, style: Style, skull: Skull):
        self.style = style
        count = COLUMNS * FINER + 1
        self.c = np.linspace(0, 1, count)
        rows = np.array(style.columns, float)
        self._key = {n: np.interp(self.c, rows[:, 0], rows[:, k + 1]) for k, n in enumerate(_NAMES)}
        base, path = self._paths(skull)
        self.t = np.linspace(0, 1, ROWS * FINER + 1)
        lumped = self._with_body(base, path)
        self.points = _resampled(lumped, len(self.t))
        self.normals = self._normals()

    def coarse(self) -> np.ndarray:
        """The sheet as the file has it, (COLUMNS + 1, ROWS + 1, 3)."""
        return self.points[::FINER, ::FINER]

    def _roots(self) -> np.ndarray:
        """Unit vectors (C, 3) from the centre to where each column begins."""
        line = np.array(self.style.parting)
        at = self._key["root"] * (len(line) - 1)
        x = np.interp(at, np.arange(len(line)), line[:, 0])
        over = np.radians(np.interp(at, np.arange(len(line)), line[:, 1]))
        side = np.where(self.c < 0.5, 1, -1) * self.style.gap * np.clip(np.abs(self.c - 0.5) * 12, 0, 1)
        return unit(np.stack([x + side, 0.92 * np.sin(over), 0.92 * np.cos(over)], -1))

    def _paths(self, skull: Skull) -> tuple[np.ndarray, np.ndarray]:
        """On the bare head: points (C, STEPS, 3), and outward unit vectors."""
        key = self._key
        roots, tips = self._roots(), direction(key["azimuth"], key["elevation"])
        t = np.linspace(0, 1, ON_SKULL)
        directions = slerp(roots[:, None], tips[:, None], t[None])
        radius = gaussian_filter1d(skull.radius(directions), 1.5, axis=0, mode="nearest")
        on_skull = CENTRE + directions * radius[..., None]
        if not (key["bottom"] > 0).all():
            return on_skull, directions
        on_skull = self._over_ears(skull, on_skull)
        hanging = self._hanging(skull, on_skull[:, -1], tips)
        points = np.concatenate([on_skull, hanging], 1)
        outward = np.concatenate([directions, np.repeat(tips[:, None], hanging.shape[1], 1)], 1)
        outward[:, ON_SKULL:, 1] *= 0.3
        return self._cut(points), unit(outward)

    @staticmethod
    def _over_ears(skull: Skull, points: np.ndarray) -> np.ndarray:
        """Hair that will cover the ears leaves the head above them."""
        out = points - CENTRE
        rho = np.hypot(out[..., 0], out[..., 2])
        tent = skull.tent(np.degrees(np.arctan2(out[..., 0], out[..., 2])), points[..., 1])
        grown = np.maximum(rho, np.where(points[..., 1] < TENT_TOP, tent, 0)) / np.maximum(rho, 1e-6)
        return CENTRE + out * np.stack([grown, np.ones_like(grown), grown], -1)

    def _hanging(self, skull: Skull, start: np.ndarray, tips: np.ndarray) -> np.ndarray:
        """From where the head is widest straight down; the sheet never passes through ears or jaw."""
        count = STEPS - ON_SKULL
        end = np.minimum(self._key["bottom"], start[:, 1] - 1e-3)
        fall = np.linspace(0, 1, count + 1)[1:]
        y = start[:, 1:2] + (end - start[:, 1])[:, None] * fall
        azimuth = np.repeat(self._key["azimuth"][:, None], count, 1)
        rho = np.hypot(start[:, 0], start[:, 2] - CENTRE[2])
        result = np.empty((len(start), count))
        for k in range(count):
            step = np.abs(y[:, k] - (start[:, 1] if k == 0 else y[:, k - 1]))
            rho = np.maximum(skull.tent(azimuth[:, k], y[:, k]), rho - DRAW_IN * step)
            result[:, k] = rho
        for axis, width in ((0, 2.0), (1, 1.5)):
            result = gaussian_filter1d(result, width, axis=axis, mode="nearest")
        result = result - self.style.under * fall**3
        a = np.radians(azimuth)
        return np.stack([result * np.sin(a), y, result * np.cos(a) + CENTRE[2]], -1)

    def _cut(self, points: np.ndarray) -> np.ndarray:
        """End each column at its tips' height, where that is above the path's end."""
        bottom = self._key["bottom"]
        result = points.copy()
        for k in range(len(points)):
            y = points[k, :, 1]
            below = np.flatnonzero((y < bottom[k]) & (np.arange(len(y)) > 5))
            if not len(below) or below[0] >= len(y) - 1:
                continue
            stop = below[0] - (y[below[0]] - bottom[k]) / min(y[below[0]] - y[below[0] - 1], -1e-6)
            places = np.linspace(0, stop, len(y))
            for axis in range(3):
                result[k, :, axis] = np.interp(places, np.arange(len(y)), points[k, :, axis])
        return result

    def _with_body(self, base: np.ndarray, outward: np.ndarray) -> np.ndarray:
        """Lift by the style's fullness, unevenly as hair is."""
        t = _lengths(base)
        share = np.interp(t, *zip(*self.style.profile, strict=True))
        amount, frequency = self.style.lumps
        noise = Noise(21)
        # Along the hair the lumps are long, across it short: locks, not hills.
        turn = 2 * np.pi * self.c[:, None] + 0 * t
        around = np.stack([np.cos(turn), np.sin(turn), t * 0.6], -1)
        lumps = noise.layered(around + 3.1, frequency, 3) * smoothstep(0.03, 0.35, t)
        full = np.repeat(self._key["full"][:, None], t.shape[1], 1)
        if self.style.ball:
            full = np.maximum(
                self.style.ball - np.linalg.norm((base - BALL_CENTRE) * BALL_SHAPE, axis=-1), 0.08
            )
        azimuth = self._key["azimuth"] % 360
        start = np.interp(np.minimum(azimuth, 360 - azimuth), *zip(*self.style.taper, strict=True))[:, None]
        thinning = 1 - 0.92 * np.clip((t - start) / (1.0001 - start), 0, 1)
        lift = (full * share + amount * lumps * np.clip(full / 0.06, 0, 1)) * thinning
        # Where the sheet's ends reach over each other, one lies above.
        between_ends = smoothstep(0.0, 0.2, t) * smoothstep(0.95, 0.6, t)
        lift = lift + APART * smoothstep(0.06, 0.02, self.c)[:, None] * between_ends
        return base + np.maximum(lift, 0.006)[..., None] * outward

    def _normals(self) -> np.ndarray:
        along, across = np.gradient(self.points, axis=1), np.gradient(self.points, axis=0)
        normals = unit(np.cross(along, across))
        flipped = (normals * (self.points - CENTRE)).sum(-1).mean() < 0
        normals = -normals if flipped else normals
        # Columns may cross where they begin; what grows there stands up like its neighbours.
        normals[:, : FINER + 1] = normals[:, FINER + 1 : FINER + 2]
        return normals

    def at(self, c: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Points, normals and the directions along the hair (..., 3); beyond an end it goes on straight."""
        i, j = c * (len(self.c) - 1), np.clip(t, 0, 1) * (len(self.t) - 1)
        points, normals = _bilinear(self.points, i, j), unit(_bilinear(self.normals, i, j))
        back, forth = np.maximum(j - 2, 0), np.minimum(j + 2, len(self.t) - 1)
        step = _bilinear(self.points, i, forth) - _bilinear(self.points, i, back)
        along = unit(step)
        length = np.linalg.norm(np.diff(_bilinear_columns(self.points, i), axis=-2), axis=-1).sum(-1)
        beyond = (t - np.clip(t, 0, 1)) * length
        return points + along * beyond[..., None], normals, along


_NAMES = ("root", "azimuth", "elevation", "bottom", "full")


def _lengths(points: np.ndarray) -> np.ndarray:
    """Share of each column's length (C, n) at its points."""
    steps = np.linalg.norm(np.diff(points, axis=1), axis=-1)
    total = np.concatenate([np.zeros((len(points), 1)), np.cumsum(steps, 1)], 1)
    return total / np.maximum(total[:, -1:], 1e-9)


def _resampled(points: np.ndarray, count: int) -> np.ndarray:
    at, places = np.linspace(0, 1, count), _lengths(points)
    columns = [
        np.stack([np.interp(at, place, column[:, k]) for k in range(3)], -1)
        for place, column in zip(places, points, strict=True)
    ]
    return np.stack(columns)


def _bilinear(grid: np.ndarray, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    low_i = np.clip(np.floor(i).astype(int), 0, grid.shape[0] - 2)
    low_j = np.clip(np.floor(j).astype(int), 0, grid.shape[1] - 2)
    u, v = (i - low_i)[..., None], (j - low_j)[..., None]
    upper = grid[low_i, low_j] * (1 - v) + grid[low_i, low_j + 1] * v
    lower = grid[low_i + 1, low_j] * (1 - v) + grid[low_i + 1, low_j + 1] * v
    return upper * (1 - u) + lower * u


def _bilinear_columns(grid: np.ndarray, i: np.ndarray) -> np.ndarray:
    """Whole columns (..., R, 3) at fractional places."""
    low = np.clip(np.floor(i).astype(int), 0, grid.shape[0] - 2)
    u = (i - low)[..., None, None]
    return grid[low] * (1 - u) + grid[low + 1] * u
