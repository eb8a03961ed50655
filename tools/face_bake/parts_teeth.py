"""A row of teeth in its gums, set on the person's arch."""

from weakref import WeakKeyDictionary

import numpy as np

from .dentition import crowns, placed, sides
from .mouth_fit import MouthFit
from .parts import PartGroup, Posed
from .parts_gums import (
    PALATE_COLUMNS,
    PALATE_ROWS,
    ROWS,
    TEETH,
    gum_columns,
    gum_points,
    gum_polygons,
    palate_points,
    palate_polygons,
)
from .polygons import NONE, shifted


class Teeth:
    """One arch: the upper one is fixed to the skull, the lower one moves rigidly with the jaw."""

    def __init__(self, upper: bool):
        self._upper = upper
        name = "upper" if upper else "lower"
        teeth, teeth_uv, uv = self._teeth()
        gums, gum_uv = self._gums()
        gum_polygons_in_part = shifted(gums, int(teeth.max()) + 1)
        self.groups = [
            PartGroup(f"teeth_{name}", "teeth", teeth, teeth_uv),
            PartGroup(f"gums_{name}", "gum", gum_polygons_in_part, shifted(gums, len(uv))),
        ]
        self.uv = np.concatenate([uv, gum_uv])
        self._at_rest: WeakKeyDictionary[MouthFit, np.ndarray] = WeakKeyDictionary()

    def _teeth(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Polygons, uv: the teeth lie across the picture, each once around, upper ones in its upper half."""
        polygons, uv_polygons, uv, first, first_uv = [], [], [], 0, 0
        for k, (crown, side) in enumerate(zip(crowns(self._upper), sides(), strict=True)):
            # Left and right mirror each other, and so do up and down.
            turned = (side > 0) == self._upper
            own, own_uv = crown.polygons(), crown.uv_polygons()
            polygons.append(shifted(_reversed(own) if turned else own, first))
            uv_polygons.append(shifted(_reversed(own_uv) if turned else own_uv, first_uv))
            around, height = crown.uv.T
            uv.append(np.stack([(k + around) / TEETH, 0.01 + 0.48 * height + 0.5 * self._upper], -1))
            first, first_uv = first + len(crown.points), first_uv + len(crown.uv)
        return np.concatenate(polygons), np.concatenate(uv_polygons), np.concatenate(uv)

    def _gums(self) -> tuple[np.ndarray, np.ndarray]:
        columns = gum_columns()
        across = np.linspace(0, 1, columns)
        uv = np.stack(np.broadcast_arrays(across, np.linspace(1, 0.4, ROWS)[:, None]), -1).reshape(-1, 2)
        polygons = gum_polygons(columns, reverse=not self._upper)
        if not self._upper:
            return polygons, uv
        aside = np.linspace(0, 1, PALATE_COLUMNS)
        palate = np.stack(np.broadcast_arrays(aside, np.linspace(0.36, 0, PALATE_ROWS)[:, None]), -1)
        return (
            np.concatenate([polygons, shifted(palate_polygons(), len(uv))]),
            np.concatenate([uv, palate.reshape(-1, 2)]),
        )

    def place(self, posed: Posed) -> np.ndarray:
        """Points (n, 3) in base-mesh space."""
        fit = posed.body.mouth
        if fit not in self._at_rest:
            self._at_rest[fit] = self._rest(fit, posed.body.person.id)
        points = self._at_rest[fit]
        if self._upper:
            return points
        rotation, offset = fit.jaw(posed.shape)
        return points @ rotation.T + offset

    def _rest(self, fit: MouthFit, person: str) -> np.ndarray:
        arch = fit.upper if self._upper else fit.lower
        teeth = placed(arch, person, self._upper)
        points = [tooth.world(tooth.crown.points) for tooth in teeth]
        points.append(gum_points(teeth, arch, self._upper))
        if self._upper:
            points.append(palate_points(arch))
        return np.concatenate(points)


def _reversed(polygons: np.ndarray) -> np.ndarray:
    """The same polygons seen from behind; a triangle's -1 stays last."""
    flipped = polygons[:, ::-1].copy()
    triangle = polygons[:, 3] == NONE
    flipped[triangle] = polygons[triangle][:, [2, 1, 0, 3]]
    return flipped
