"""Where a person's dental arches lie: fitted to the inside of the lips and cheeks, in decimetres.

An arch seen from above is |x / a|^p + ((z - back) / b)^q = 1, which runs on straight behind its widest
place; q > p makes its sides straighter than its front. The upper one is fixed to the skull. The lower
one lies inside it and follows the jaw: the best rigid motion (Kabsch) of MakeHuman's helper teeth, so
that teeth never stretch.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np
from scipy.spatial import cKDTree

from .cage import MOUTH
from .finemesh import FineMesh
from .parts_eyes import rotation_between
from .seal import LipSeal

LOWER_HELPER = np.arange(14992, 15060)
# Upper teeth end this far below where the lips meet; lower ones reach so far above that edge.
SHOWN, OVERBITE = 0.026, 0.021
# Room between teeth and the inside of lips and cheeks; how far lower teeth lie behind and inside upper ones.
CLEARANCE, OVERJET, INSET = 0.010, 0.031, 0.018
# The walls beside upper and lower crowns, above the upper edge.
UPPER_BAND, LOWER_BAND = (-0.015, 0.09), (-0.065, 0.02)
DEPTH = 0.44
FRONT_POWERS, SIDE_POWERS = np.arange(1.8, 2.35, 0.1), np.arange(2.0, 3.3, 0.2)
# Half an arch of average size, from the midline to its widest place.
USUAL_LENGTH = 0.575
# The plane of the bite rises backwards.
RISE = np.tan(np.radians(7))


@dataclass(frozen=True)
class Arch:
    """half_width a, depth b, powers p and q; front: z of the foremost point; edge: y of its biting edge."""

    half_width: float
    depth: float
    powers: tuple[float, float]
    front: float
    edge: float

    @cached_property
    def scale(self) -> float:
        """Size of this person's teeth against the average."""
        return float(np.clip(self._walk[1][-2] / USUAL_LENGTH, 0.94, 1.05))

    @property
    def back(self) -> float:
        """z of the widest place."""
        return self.front - self.depth

    def edge_at(self, z: np.ndarray) -> np.ndarray:
        """Height of the plane of the bite."""
        return self.edge + RISE * (self.front - z)

    def half_width_at(self, z: np.ndarray) -> np.ndarray:
        ahead = np.clip((z - self.back) / self.depth, 0, 1)
        return self.half_width * (1 - ahead ** self.powers[1]) ** (1 / self.powers[0])

    def distance(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Signed distance (n,) of points (n, 3) outwards from the arch seen from above, and the unit
        direction (n, 3) outwards at the nearest place of the arch."""
        tree, places, outs = self._outline
        flat = points[:, [0, 2]]
        nearest = tree.query(flat)[1]
        distance = ((flat - places[nearest]) * outs[nearest]).sum(1)
        out = outs[nearest]
        return distance, np.stack([out[:, 0], np.zeros(len(out)), out[:, 1]], -1)

    @cached_property
    def _outline(self) -> tuple[cKDTree, np.ndarray, np.ndarray]:
        length = self._walk[1][-1]
        places, outs = self.at(np.linspace(-length, length, 1601))
        return cKDTree(places), places, outs

    @cached_property
    def _walk(self) -> tuple[np.ndarray, np.ndarray]:
        """Places (k, 2) as x, z along the left half, from the midline to far behind, and their arc length."""
        turn = np.linspace(0, np.pi / 2, 400)
        x = self.half_width * np.sin(turn) ** (2 / self.powers[0])
        z = self.back + self.depth * np.cos(turn) ** (2 / self.powers[1])
        path = np.concatenate([np.stack([x, z], -1), [[self.half_width, self.back - 0.3]]])
        steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
        return path, np.concatenate([[0], np.cumsum(steps)])

    def at(self, along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places and unit directions outwards, (n, 2) as x, z; `along` is arc length, + to the left."""
        path, length = self._walk
        mirrored = np.concatenate([path[:0:-1] * [-1, 1], path])
        signed = np.concatenate([-length[:0:-1], length])

        def place(at: np.ndarray) -> np.ndarray:
            return np.stack([np.interp(at, signed, mirrored[:, k]) for k in (0, 1)], -1)

        tangent = place(along + 0.02) - place(along - 0.02)
        out = np.stack([-tangent[:, 1], tangent[:, 0]], -1)
        return place(along), out / np.linalg.norm(out, axis=1, keepdims=True)


class MouthFit:
    """Both arches of one person, and how the lower one moves with the jaw."""

    def __init__(self, fine: FineMesh, seal: LipSeal, rest: np.ndarray, neutral: np.ndarray):
        """rest: fine skin (n, 3), neutral: base mesh (19158, 3), of the face at rest."""
        self._helper = neutral[LOWER_HELPER]
        rim = np.concatenate([seal.upper, seal.lower])
        middle = rim[np.argsort(np.abs(neutral[rim, 0]), kind="stable")[:2]]
        lips_meet = neutral[middle, 1].mean()
        wall = rest[np.unique(fine.quads[fine.island == MOUTH])]
        self.upper = _fitted(wall, float(lips_meet - SHOWN))
        self.lower = _inside(self.upper)

    def jaw(self, shape: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Rotation (3, 3) and offset (3,): point -> rotation @ point + offset."""
        moved = shape[LOWER_HELPER]
        rotation = rotation_between(self._helper, moved)
        return rotation, moved.mean(0) - rotation @ self._helper.mean(0)


def _fitted(wall: np.ndarray, edge: float) -> Arch:
    """The roomiest upper arch that keeps, with the lower one inside it, clear of the wall (n, 3)."""
    x, y, z = np.abs(wall[:, 0]), wall[:, 1], wall[:, 2]
    front = float(z[(x < 0.04) & (y > edge) & (y < edge + 0.09) & (z > z.max() - 0.25)].min() - CLEARANCE)
    level = y - edge - RISE * (front - z)
    around = (z > front - 0.45) & (x > 0.5 * (front - z)) & (wall[:, 0] >= 0)
    above, below = (wall[around & (level > low) & (level < high)] for low, high in (UPPER_BAND, LOWER_BAND))
    widest = x[around & (z < front - 0.22) & (np.abs(level) < 0.1)].min() - CLEARANCE
    best, largest = None, 0.0
    for half_width, p, q in product(np.arange(0.20, widest, 0.004), FRONT_POWERS, SIDE_POWERS):
        arch = Arch(float(half_width), DEPTH, (float(p), float(q)), front, edge)
        room = arch.half_width_at(np.linspace(front - DEPTH, front, 40)).mean()
        if room > largest and _is_clear(arch, above) and _is_clear(_inside(arch), below):
            best, largest = arch, room
    return best


def _is_clear(arch: Arch, wall: np.ndarray) -> bool:
    return bool(arch.distance(wall)[0].min() > 0.9 * CLEARANCE)


def _inside(upper: Arch) -> Arch:
    return Arch(
        upper.half_width - INSET,
        upper.depth - 0.01,
        upper.powers,
        upper.front - OVERJET,
        upper.edge + OVERBITE,
    )
