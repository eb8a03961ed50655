"""How far the upper lids travel in a blink: just to the lower lids, whoever's eye it is.

MakeHuman's blink moves every lid by the same offsets, 12 mm at its middle, and nobody's eye is open so
far. Here the offsets are scaled along the lid until the edges meet, so that half a blink is half closed.
"""

import numpy as np
from scipy.interpolate import PchipInterpolator

from .parts_eyes_ball import EYE_VERTICES
from .source import BaseMesh, Source
from .strips import grid_of

BLINK, BLINK_SIDES = "eyeBlink", ("eyeBlinkLeft", "eyeBlinkRight")
LASH_STRIPS = ("helper-{side}-eyelashes-2", "helper-{side}-eyelashes-1")
# The closed upper lid laps over the lower one by so much, in decimetres.
OVERLAP = 0.004
# Beyond these the offsets would not be a blink any more; below that share of the largest they tell nothing.
LEAST, MOST, TELLING = 0.2, 1.3, 0.12
# The ring of vertices along a lid that is its edge.
EDGE_RING = 2

# What MakeHuman's look units lack: lids go with the eye, so much of another unit for each of theirs.
FOLLOW = {"eyeLookUp": ("eyeWide", 0.45), "eyeLookDown": (BLINK, 0.13)}


def with_lids(recipe: dict) -> dict:
    """A recipe whose lids follow the eyes that it turns up or down."""
    full = dict(recipe)
    for term, weight in recipe.items():
        for look, (unit, share) in FOLLOW.items():
            if term.startswith(f"arkit:{look}"):
                moved = f"arkit:{unit}{term.removeprefix(f'arkit:{look}')}"
                full[moved] = full.get(moved, 0.0) + share * weight
    return full


def lash_grids(base: BaseMesh, side: int) -> list[np.ndarray]:
    """Base-mesh vertices (rows, columns) of the upper and the lower lashes of a side; roots first."""
    centre, grids = base.points[EYE_VERTICES[side]].mean(0), []
    for name in LASH_STRIPS:
        grid = grid_of(base.faces[name.format(side="lr"[side])])
        reach = np.linalg.norm(base.points[grid] - centre, axis=-1).mean(1)
        grid = grid if reach[0] < reach[-1] else grid[::-1]
        grids.append(grid[:, np.argsort(base.points[grid[0], 0])])
    return grids


def edges_of(base: BaseMesh, columns: np.ndarray) -> list[np.ndarray]:
    """Base-mesh vertices of the upper and the lower lid's edge, right to left, from a side's columns."""
    rim = base.points[columns[:, 0], 1]
    edge = columns[:, EDGE_RING]
    halves = (edge[rim >= rim.mean()], edge[rim < rim.mean()])
    return [half[np.argsort(base.points[half, 0])] for half in halves]


class BlinkFit:
    """Blinks that close any shape of any person's lids."""

    def __init__(self, source: Source, columns: list[np.ndarray]):
        """columns: of each side's lids as `LidRings` has them."""
        self._moves = [source.arkit(name) for name in BLINK_SIDES]
        self._rows = [edges_of(source.base, rings) for rings in columns]

    def offsets(self, weights: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Offsets (19158, 3) of both sides' blinks, from a shape (19158, 3) with whatever else moves it."""
        return sum(weights[side] * self._fitted(side, start) for side in (0, 1) if weights[side])

    def _fitted(self, side: int, start: np.ndarray) -> np.ndarray:
        """The blink's offsets, scaled along the lid by what closes it at each place."""
        upper, lower = self._rows[side]
        edge, drop = start[upper], -self._moves[side][upper, 1]
        below = start[lower][np.argsort(start[lower, 0], kind="stable")]
        floor = np.interp(edge[:, 0], below[:, 0], below[:, 1])
        share = (edge[:, 1] - floor + OVERLAP) / np.maximum(drop, 1e-4)
        telling = np.flatnonzero(drop > TELLING * drop.max())
        order, first = np.unique(edge[telling, 0], return_index=True)
        along = PchipInterpolator(order, np.clip(share[telling][first], LEAST, MOST))
        return self._moves[side] * along(np.clip(start[:, 0], order[0], order[-1]))[:, None]
