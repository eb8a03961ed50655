"""What verify_faces.py asks of eyes: they close in a blink, keep their size, and stay behind their lids."""

from pathlib import Path

import numpy as np

from eye_gaps import Opening

# Centimetres.
WIDEST_CLOSED, MOST_PIERCED, MOST_SHRUNK = 0.01, 0.021, 0.005
CLOSED = (("AU43",), ("AU43", "AU7"), ("eyeBlinkLeft", "eyeBlinkRight"))
SIDES = ("eye_L", "eye_R")


class Shapes:
    """The offsets of a folder's shapes.npz, and their straight sums."""

    def __init__(self, folder: Path, neutral: np.ndarray):
        with np.load(folder / "shapes.npz", allow_pickle=False) as data:
            self._data = {key: data[key] for key in data.files}
        self.names, self._neutral = self._data["names"].tolist(), neutral

    def posed(self, names: tuple[str, ...]) -> np.ndarray:
        """Positions (V, 3) with these shapes at 1."""
        positions = self._neutral.copy()
        for k in map(self.names.index, names):
            own = slice(*self._data["starts"][k : k + 2])
            positions[self._data["index"][own].astype(int)] += (
                self._data["delta"][own] * self._data["scale"][k]
            )
        return positions

    def plain(self) -> list[str]:
        """Those that have a weight of their own."""
        sets = self._data["sets"].tolist()
        return [name for name, kind in zip(self.names, sets, strict=True) if kind in ("facs", "arkit")]


def check_eyes(folder: Path, report, states: dict[str, np.ndarray], groups: dict[str, np.ndarray]):
    """states: positions (V, 3) of neutral and expressions, in cm; groups: name -> triangles (t, 3)."""
    neutral = states["neutral"]
    shapes = Shapes(folder, neutral)
    for side in SIDES:
        skin, ball = groups["skin"], np.unique(groups[side])
        opening = Opening(skin, groups[side], neutral)
        for names in CLOSED:
            gap = opening.height(shapes.posed(names))
            report.require(gap <= WIDEST_CLOSED, f"{folder}: {side} is open by {gap:.3f} cm in {names}")
        opening = Opening(skin, groups[side], neutral, pitch=0.15, step=0.01)
        poses = {name: shapes.posed((name,)) for name in shapes.plain()} | states
        for name, pose in poses.items():
            if np.abs(pose - neutral)[opening.vertices].max() < MOST_SHRUNK:
                continue
            shrunk = np.abs(_spread(pose[ball]) - _spread(neutral[ball])).max()
            report.require(shrunk <= MOST_SHRUNK, f"{folder}: {side} changes by {shrunk:.3f} cm in {name}")
            through = opening.piercing(pose)
            report.require(through <= MOST_PIERCED, f"{folder}: {side} pierces a lid in {name}")


def _spread(points: np.ndarray) -> np.ndarray:
    """Distances (n,) of an eye's vertices from their mean, which turning does not change."""
    return np.linalg.norm(points - points.mean(0), axis=1)
