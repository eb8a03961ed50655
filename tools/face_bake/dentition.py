"""A person's teeth of one arch as points, and where on them the gums cling."""

import zlib
from dataclasses import dataclass

import numpy as np

from .mouth_fit import Arch
from .tooth_shapes import (
    BACK_AROUND,
    BACK_HEIGHTS,
    FRONT_AROUND,
    FRONT_HEIGHTS,
    FRONT_TEETH,
    LOWER,
    UPPER,
    Crown,
)

MILLIMETRE = 0.01
# Contacts lie inside of the arch's outline, where a turn is shorter.
SPREAD = 0.995
# How far a tooth strays: turned and tilted (degrees), set in or out and longer or shorter (millimetres).
STRAY = (2.6, 1.3, 0.14, 0.16)

# The vertex on the midline side of the left middle incisor: at its neck and its edge.
_BACK, _FRONT = (
    len(around) * len(rings) for around, rings in ((BACK_AROUND, BACK_HEIGHTS), (FRONT_AROUND, FRONT_HEIGHTS))
)
MIDDLE_NECK = (len(UPPER) - FRONT_TEETH) * _BACK + FRONT_TEETH * _FRONT
MIDDLE_EDGE = MIDDLE_NECK + _FRONT - len(FRONT_AROUND)


@dataclass(frozen=True)
class ToothPlace:
    """How a crown's millimetres become decimetres of base-mesh space: origin at the middle of its edge."""

    crown: Crown
    origin: np.ndarray
    across: np.ndarray
    up: np.ndarray
    out: np.ndarray

    def world(self, points: np.ndarray) -> np.ndarray:
        """(n, 3) across, up, out -> (n, 3)."""
        return self.origin + points * MILLIMETRE @ np.stack([self.across, self.up, self.out])


def crowns(upper: bool) -> list[Crown]:
    """Fourteen, from the right end of the arch to its left."""
    half = [Crown(kind, k < FRONT_TEETH) for k, kind in enumerate(UPPER if upper else LOWER)]
    return half[::-1] + half


def sides() -> np.ndarray:
    """-1 for the teeth on the right, 1 on the left (14,)."""
    return np.repeat([-1.0, 1.0], len(UPPER))


def placed(arch: Arch, person: str, upper: bool) -> list[ToothPlace]:
    """The teeth on their arch, each a little astray; the same for every shape of a person."""
    rng = np.random.default_rng([zlib.crc32(person.encode()), int(upper)])
    row, kinds = crowns(upper), UPPER if upper else LOWER
    width = np.array([kind.width for kind in kinds]) * MILLIMETRE * SPREAD * arch.scale
    middle = np.cumsum(width) - width / 2
    along = np.concatenate([-middle[::-1], middle])
    places, outs = arch.at(along)
    kinds, result = [*kinds[::-1], *kinds], []
    for k, (place, out, side) in enumerate(zip(places, outs, sides(), strict=True)):
        turn, tilt, step, extra = rng.uniform(-1, 1, 4) * STRAY
        turned = _turned(out, np.radians(turn))
        across = np.array([turned[1] * side, 0, -turned[0] * side])
        outwards = np.array([turned[0], 0, turned[1]])
        crownwards = np.array([0, -1.0 if upper else 1.0, 0]) + np.tan(np.radians(tilt)) * across
        height = arch.edge_at(place[1]) - (kinds[k].lift + extra) * MILLIMETRE * crownwards[1]
        origin = np.array([place[0], height, place[1]]) + outwards * (step + kinds[k].ahead) * MILLIMETRE
        scale = arch.scale
        result.append(ToothPlace(row[k], origin, across * scale, crownwards * scale, outwards * scale))
    return result


def _turned(out: np.ndarray, angle: float) -> np.ndarray:
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([cos * out[0] - sin * out[1], sin * out[0] + cos * out[1]])


def on_crown(tooth: ToothPlace, across: float, height: float, *, ahead: bool) -> np.ndarray:
    """One point (3,) of a tooth's surface, in decimetres."""
    local = tooth.crown.at(np.array([across]), np.array([height]), np.array([ahead]))
    return tooth.world(local)[0]
