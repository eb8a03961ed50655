"""Names and numbers of the landmarks, and how to find those outside the 68-point markup."""

import numpy as np

from .dentition import MIDDLE_EDGE, MIDDLE_NECK
from .parts_tongue import TONGUE_CENTRE, TONGUE_LEFT, TONGUE_RIGHT, TONGUE_TIP


def _jaw_names() -> list[str]:
    right = [f"jaw line right {8 - i}" for i in range(8)]
    return right + ["chin bottom"] + [f"jaw line left {i + 1}" for i in range(8)]


_BROW = ["outer end", "outer half", "middle", "inner half", "inner end"]
_EYE = ["upper lid outer", "upper lid inner", "lower lid inner", "lower lid outer"]

IBUG_NAMES = [
    *_jaw_names(),
    *(f"right brow {part}" for part in _BROW),
    *(f"left brow {part}" for part in reversed(_BROW)),
    "nose root",
    "nose bridge upper",
    "nose bridge lower",
    "nose tip",
    "right nostril base outer",
    "right nostril base inner",
    "nose base",
    "left nostril base inner",
    "left nostril base outer",
    "right eye outer corner",
    "right upper lid outer",
    "right upper lid inner",
    "right eye inner corner",
    "right lower lid inner",
    "right lower lid outer",
    "left eye inner corner",
    "left upper lid inner",
    "left upper lid outer",
    "left eye outer corner",
    "left lower lid outer",
    "left lower lid inner",
    "mouth right corner",
    "upper lip right",
    "upper lip right peak",
    "upper lip middle",
    "upper lip left peak",
    "upper lip left",
    "mouth left corner",
    "lower lip left outer",
    "lower lip left",
    "lower lip middle",
    "lower lip right",
    "lower lip right outer",
    "inner mouth right corner",
    "inner upper lip right",
    "inner upper lip middle",
    "inner upper lip left",
    "inner mouth left corner",
    "inner lower lip left",
    "inner lower lip middle",
    "inner lower lip right",
]

MPEG4_OF_IBUG = {
    4: "2.14",
    7: "2.12",
    8: "2.1",
    9: "2.11",
    12: "2.13",
    17: "4.6",
    19: "4.4",
    21: "4.2",
    22: "4.1",
    24: "4.3",
    26: "4.5",
    28: "9.12",
    30: "9.3",
    31: "9.4",
    33: "9.15",
    35: "9.5",
    36: "3.12",
    39: "3.8",
    42: "3.11",
    45: "3.7",
    48: "8.4",
    49: "8.6",
    50: "8.9",
    51: "8.1",
    52: "8.10",
    53: "8.5",
    54: "8.3",
    55: "8.7",
    57: "8.2",
    59: "8.8",
    60: "2.5",
    61: "2.7",
    62: "2.2",
    63: "2.6",
    64: "2.4",
    65: "2.8",
    66: "2.3",
    67: "2.9",
}


def _lid(side: int, upper: bool):
    """The middle of a lid's edge: the vertex of the lash row nearest to the pupil's line."""
    return lambda probe: _lid_middle(probe, side, upper)


def _lid_middle(probe, side: int, upper: bool) -> int:
    lashes = probe.head.lashes.rows[2 * (0 if side > 0 else 1) + (0 if upper else 1)]
    row = probe.head.source.base.points[lashes.lid]
    return probe.nearest(row[len(row) // 2])


def _ear(side: int, direction):
    def find(probe) -> int:
        return probe.best(probe.points @ np.array(direction), probe.ear & (probe.points[:, 0] * side > 0))

    return find


def _near(x: float, y: float, z: float):
    return lambda probe: probe.nearest((x, y, z))


def _first(group: str, offset: int = 0):
    return lambda probe: probe.head.group(group).first + offset


def _skull(direction):
    return lambda probe: probe.best(probe.points @ np.array(direction), probe.on_skull())


# Name, MPEG-4 number, and a function of the probe.
EXTRAS = [
    ("chin boss", "2.10", lambda probe: probe.midline(6.22, 6.30, by="front")),
    ("left upper lid middle", "3.1", _lid(1, True)),
    ("right upper lid middle", "3.2", _lid(-1, True)),
    ("left lower lid middle", "3.3", _lid(1, False)),
    ("right lower lid middle", "3.4", _lid(-1, False)),
    ("left pupil", "3.5", _first("eye_L")),
    ("right pupil", "3.6", _first("eye_R")),
    ("left cheek centre", "5.1", _near(0.46, 6.86, 1.24)),
    ("right cheek centre", "5.2", _near(-0.46, 6.86, 1.24)),
    ("left cheekbone", "5.3", _near(0.56, 7.10, 1.16)),
    ("right cheekbone", "5.4", _near(-0.56, 7.10, 1.16)),
    ("tongue tip", "6.1", _first("tongue", TONGUE_TIP)),
    ("tongue centre", "6.2", _first("tongue", TONGUE_CENTRE)),
    ("tongue left edge", "6.3", _first("tongue", TONGUE_LEFT)),
    ("tongue right edge", "6.4", _first("tongue", TONGUE_RIGHT)),
    ("left nostril side", "9.1", _near(0.175, 6.91, 1.51)),
    ("right nostril side", "9.2", _near(-0.175, 6.91, 1.51)),
    ("right nose bone upper edge", "9.6", _near(-0.10, 7.27, 1.45)),
    ("left nose bone upper edge", "9.7", _near(0.10, 7.27, 1.45)),
    ("left nose bone lower edge", "9.13", _near(0.10, 7.10, 1.52)),
    ("right nose bone lower edge", "9.14", _near(-0.10, 7.10, 1.52)),
    ("upper teeth top", "9.8", _first("teeth_upper", MIDDLE_NECK)),
    ("lower teeth bottom", "9.9", _first("teeth_lower", MIDDLE_NECK)),
    ("upper teeth edge", "9.10", _first("teeth_upper", MIDDLE_EDGE)),
    ("lower teeth edge", "9.11", _first("teeth_lower", MIDDLE_EDGE)),
    ("left ear top", "10.1", _ear(1, (0, 1, 0))),
    ("right ear top", "10.2", _ear(-1, (0, 1, 0))),
    ("left ear back", "10.3", _ear(1, (0, 0, -1))),
    ("right ear back", "10.4", _ear(-1, (0, 0, -1))),
    ("left ear lobe", "10.5", _ear(1, (0, -1, 0))),
    ("right ear lobe", "10.6", _ear(-1, (0, -1, 0))),
    ("forehead at the hair line", "11.1", lambda probe: probe.midline_at(8.0)),
    ("top of the skull", "11.4", _skull((0, 1, 0))),
    ("back of the skull", "11.6", _skull((0, 0, -1))),
]
