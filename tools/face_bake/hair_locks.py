"""Locks of hair: narrow strips along the sheet that break up its outline, hairline and shine."""

import numpy as np

from .hair_frame import unit
from .hair_shell import Sheet
from .hair_styles import Locks

# A lock is so many pairs of vertices long.
PAIRS = 6
# No lock leaves the sheet sideways: it would lie on bare skin.
ASIDE = 0.015


class LockValues:
    """What the rows of a style's locks draw, one value a lock."""

    def __init__(self, rows: tuple[Locks, ...], count: int, rng: np.random.Generator):
        counts = _shared_out([row.share for row in rows], count)
        names = ("c", "t", "reach", "root_lift", "tip_lift", "width", "drift", "wave", "roll", "fall")
        for name in names:
            limits = [getattr(row, name) for row in rows]
            drawn = [_spread(pair, n, rng, even=name == "c") for pair, n in zip(limits, counts, strict=True)]
            setattr(self, name, np.concatenate(drawn))
        self.phase = rng.uniform(0, 2 * np.pi, count)


def _shared_out(shares: list[float], count: int) -> list[int]:
    """Whole numbers in these proportions that add up to `count`."""
    ends = np.round(np.cumsum(shares) / sum(shares) * count).astype(int)
    return np.diff(ends, prepend=0).tolist()


def _spread(limits: tuple, count: int, rng: np.random.Generator, *, even: bool) -> np.ndarray:
    """Values between two limits; even ones leave no gap, yet none is quite where it should be."""
    low, high = sorted(limits)
    if not even:
        return rng.uniform(low, high, count)
    return low + (high - low) * (rng.permutation(count) + rng.uniform(0.15, 0.85, count)) / count


def place_locks(sheet: Sheet, values: LockValues) -> np.ndarray:
    """Strips (count, PAIRS, 2, 3) in the sheet's space."""
    s = np.linspace(0, 1, PAIRS)
    c = np.clip(values.c[:, None] + values.drift[:, None] * s**1.5, ASIDE, 1 - ASIDE)
    t = values.t[:, None] + values.reach[:, None] * s
    points, normals, along = sheet.at(c, t)
    lift = values.root_lift[:, None] * (1 - s) + values.tip_lift[:, None] * s**1.3
    swing = values.wave[:, None] * np.sin(values.phase[:, None] + s * 5.0) * s
    side = unit(np.cross(normals, along))
    spine = points + lift[..., None] * normals + swing[..., None] * side
    spine[..., 1] -= values.fall[:, None] * s**2
    along = unit(np.gradient(spine, axis=1))
    side = unit(np.cross(normals, along))
    roll = np.radians(values.roll)[:, None, None]
    side = side * np.cos(roll) + np.cross(along, side) * np.sin(roll)
    half = values.width[:, None] * np.interp(s, [0, 0.3, 1], [0.42, 0.5, 0.34])
    return np.stack([spine + half[..., None] * side, spine - half[..., None] * side], 2)
