"""The skin and the inside of the mouth: one surface, two groups."""

import numpy as np

from .adapt import AdaptiveMesh
from .cage import MOUTH
from .finemesh import FineMesh
from .parts import PartGroup, Posed


class SkinPart:
    """Those fine vertices that the adaptive mesh keeps."""

    def __init__(self, mesh: AdaptiveMesh, fine: FineMesh):
        self._pick, self.uv = mesh.pick, fine.uv[mesh.pick_uv]
        mouth = mesh.island == MOUTH
        self.groups = [
            PartGroup("skin", "skin", mesh.polygons[~mouth], mesh.uv_polygons[~mouth]),
            PartGroup("mouth", "mouth", mesh.polygons[mouth], mesh.uv_polygons[mouth]),
        ]

    def place(self, posed: Posed) -> np.ndarray:
        return posed.skin[self._pick]
