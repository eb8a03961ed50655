"""The hair as a part of the head: everybody has the same polygons, a haircut is where they are.

It rides on the skull, which no expression moves; so brows may rise and skin may slide beneath it.
"""

import numpy as np

from .finemesh import FineMesh
from .hair_atlas import SHEET_REPEATS, SHEET_ROWS, tile_box
from .hair_cuts import STYLES
from .hair_frame import Fitting, Skull
from .hair_locks import PAIRS, LockValues, place_locks
from .hair_shell import COLUMNS, ROWS, Sheet
from .parts import PartGroup, Posed
from .source import Source, mask_at

BODY, WISPS = 96, 54
# Which tiles of the picture the locks of each kind take turns in.
BODY_TILES, WISP_TILES = (0, 1, 2, 3), (4, 5, 6, 7)


class HairPart:
    """Sheet first, then locks from the inside out: see-through texels are blended in this order."""

    def __init__(self, fine: FineMesh, base_points: np.ndarray, ears: np.ndarray):
        """ears: (n,) bool of the fine vertices."""
        points = fine.operator @ base_points
        self._skull = Skull(points, fine.quads[fine.on_head[fine.quads].all(1)], ears)
        self._operator = fine.operator
        self._kept = {}
        sheet, sheet_uv = _grid(COLUMNS + 1, ROWS + 1), _sheet_uv()
        locks, lock_uv = _lock_polygons(BODY + WISPS), _lock_uv()
        first, first_uv = (COLUMNS + 1) * (ROWS + 1), len(sheet_uv)
        self.groups = [
            PartGroup("hair", "hair", sheet, sheet),
            PartGroup("hair_locks", "hair_lock", locks + first, locks + first_uv),
        ]
        self.uv = np.concatenate([sheet_uv, lock_uv])

    @classmethod
    def of(cls, fine: FineMesh, source: Source) -> "HairPart":
        uv_of = np.zeros(fine.operator.shape[0], int)
        uv_of[fine.quads.ravel()] = fine.uv_quads.ravel()
        ears = mask_at(source.mask("mpfb_ears.jpg"), 1, fine.source_uv[uv_of]) > 0.4
        return cls(fine, source.base.points, ears)

    def place(self, posed: Posed) -> np.ndarray:
        """The same places for every shape: they belong to the skull."""
        person = posed.body.person
        if person.id not in self._kept:
            self._kept = {person.id: self._placed(person.look.hair_style, self._operator @ posed.neutral)}
        return self._kept[person.id]

    def _placed(self, style_name: str, rest: np.ndarray) -> np.ndarray:
        style, rng = STYLES[style_name], np.random.default_rng(17)
        sheet = Sheet(style, self._skull)
        locks = [
            place_locks(sheet, LockValues(rows, count, rng))
            for rows, count in ((style.body, BODY), (style.wisps, WISPS))
        ]
        points = [sheet.coarse(), *locks]
        return Fitting(self._skull, rest)(np.concatenate([p.reshape(-1, 3) for p in points]))


def _grid(columns: int, rows: int) -> np.ndarray:
    """Quads (m, 4) that face outwards."""
    index = np.arange(columns * rows).reshape(columns, rows)
    corners = [index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]]
    return np.stack(corners, -1).reshape(-1, 4)


def _sheet_uv() -> np.ndarray:
    c, t = np.meshgrid(np.linspace(0, 1, COLUMNS + 1), np.linspace(0, 1, ROWS + 1), indexing="ij")
    top, bottom = SHEET_ROWS
    return np.stack([c * SHEET_REPEATS, top + (bottom - top) * t], -1).reshape(-1, 2)


def _lock_polygons(count: int) -> np.ndarray:
    strip = np.array([[2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2] for k in range(PAIRS - 1)])
    return (strip + 2 * PAIRS * np.arange(count)[:, None, None]).reshape(-1, 4)


def _lock_uv() -> np.ndarray:
    tiles = [BODY_TILES[k % len(BODY_TILES)] for k in range(BODY)]
    tiles += [WISP_TILES[k % len(WISP_TILES)] for k in range(WISPS)]
    s = np.linspace(0, 1, PAIRS)
    strips = []
    for tile in tiles:
        left, bottom, right, top = tile_box(tile)
        v = top + (bottom - top) * s
        strips.append(np.stack([np.stack([0 * s + x, v], -1) for x in (left, right)], 1))
    return np.stack(strips).reshape(-1, 2)
