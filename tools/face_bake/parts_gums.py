"""Gums round the necks of a row of teeth, and the palate between them."""

import numpy as np

from .dentition import MILLIMETRE, ToothPlace, on_crown
from .mouth_fit import Arch

TEETH, MOLARS = 14, 2
FRONT_COLUMNS, MOLAR_COLUMNS = (-1.0, -0.75, -0.25, 0.25, 0.75), (-1.0, -0.4, 0.4)
MARGIN, PAPILLA = ((0.25, 0.75), (0.10, 0.17)), 0.36
ROWS = 7
# Away from the neck and outwards (millimetres) of the rows above the margin, at a tooth and between two.
BULGE, ROOT, FLANGE = (1.5, 0.75, 0.25), (5.0, 0.5, -0.35), (10.5, -1.4, -1.8)
LINGUAL = (7.0, -4.2)
LINGUAL_LOWER = (8.0, -0.8)
PALATE_ROWS, PALATE_COLUMNS = 9, 9


def _columns_of(tooth: int) -> tuple[float, ...]:
    """Across a tooth (0..13); the right one is shared with its neighbour, where a papilla fills the gap."""
    return MOLAR_COLUMNS if min(tooth, TEETH - 1 - tooth) < MOLARS else FRONT_COLUMNS


def gum_columns() -> int:
    return sum(len(_columns_of(k)) for k in range(TEETH)) + 1


def gum_points(teeth: list[ToothPlace], arch: Arch, upper: bool) -> np.ndarray:
    """Points (ROWS * columns, 3): from lip or cheek over the margins to the tongue's side."""
    columns = []
    for k, tooth in enumerate(teeth):
        inner = -1.0 if k >= len(teeth) // 2 else 1.0
        for place in _columns_of(k):
            neighbour = teeth[k - 1] if place == -1 and k > 0 else None
            columns.append(_column(tooth, neighbour, -inner * place, upper))
    last = teeth[-1]
    columns.append(_column(last, None, 1.0, upper))
    return np.array(columns).transpose(1, 0, 2).reshape(-1, 3)


def _column(tooth: ToothPlace, neighbour: ToothPlace | None, across: float, upper: bool) -> np.ndarray:
    """(ROWS, 3) beside a tooth, or where it meets its neighbour."""
    own = _own_column(tooth, across, upper)
    if neighbour is None:
        return own
    # On the midline both inner sides meet; elsewhere an outer side meets an inner one.
    facing = across if tooth.across @ neighbour.across < 0 and abs(tooth.origin[0]) < 0.1 else -across
    return 0.5 * (own + _own_column(neighbour, facing, upper))


def _own_column(tooth: ToothPlace, across: float, upper: bool) -> np.ndarray:
    between = abs(across) == 1
    height = PAPILLA if between else np.interp(abs(across), *MARGIN)
    neck = on_crown(tooth, 0.93 * across, 0.06, ahead=True)
    outwards, away = (axis / np.linalg.norm(axis) * MILLIMETRE for axis in (tooth.out, -tooth.up))
    rows = [
        neck + away * up + outwards * (out_between if between else out)
        for up, out, out_between in (FLANGE, ROOT, BULGE)
    ]
    front = on_crown(tooth, across, height, ahead=True)
    behind = on_crown(tooth, across, height, ahead=False)
    inner, thick = (1.1, 1.0) if between else (0.0, 0.28)
    middle = 0.5 * (front + behind)
    lingual = on_crown(tooth, across, 0.06, ahead=False)
    up, out = LINGUAL if upper else LINGUAL_LOWER
    return np.array(
        [
            *rows,
            front + outwards * thick,
            middle - away * inner,
            behind - outwards * thick,
            lingual + away * up + outwards * out,
        ]
    )


def gum_polygons(columns: int, *, reverse: bool) -> np.ndarray:
    i = np.arange(ROWS * columns).reshape(ROWS, columns)
    quads = np.stack([i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]], -1).reshape(-1, 4)
    return quads[:, ::-1] if reverse else quads


def palate_points(arch: Arch) -> np.ndarray:
    """Vault (PALATE_ROWS * PALATE_COLUMNS, 3) from behind the incisors to the soft palate's free edge."""
    back = np.linspace(0, 1, PALATE_ROWS)[:, None]
    across = np.linspace(-1, 1, PALATE_COLUMNS)[None]
    z = arch.front - 0.09 - 0.50 * back + 0 * across
    half = (arch.half_width_at(z) - 0.085).clip(0.05)
    vault = 0.125 * np.clip(back / 0.35, 0, 1) ** 0.6 * (1 - across**2) ** 0.75
    # The soft palate hangs down in an arch on two pillars, with the uvula in its middle.
    soft = np.clip((back - 0.72) / 0.28, 0, 1) ** 1.6
    hangs = 0.12 + 0.30 * np.abs(across) ** 3.5 + 0.035 * (across == 0) * (back == 1)
    roof = arch.edge_at(z) + 0.135 + vault - soft * hangs
    return np.stack([across * half, roof, z], -1).reshape(-1, 3)


def palate_polygons() -> np.ndarray:
    i = np.arange(PALATE_ROWS * PALATE_COLUMNS).reshape(PALATE_ROWS, PALATE_COLUMNS)
    return np.stack([i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]], -1).reshape(-1, 4)[:, ::-1]
