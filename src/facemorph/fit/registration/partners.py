"""While pairs are picked in two views: where the partner of the next one is likely to be.

The pairs there are place the template on the scan, by a similarity and a biharmonic field; a vertex's partner
is the nearest place of the scan with a like normal, and a scan's place has the nearest vertex.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from facemorph.core.arrays import Float64
from facemorph.core.landmark_pair import LandmarkPair
from facemorph.core.mesh import Mesh
from facemorph.fit.align import diagonal_of
from facemorph.fit.parts import connected_parts
from facemorph.fit.registration.checks import checked_scan, checked_template
from facemorph.fit.registration.field import SmoothField
from facemorph.fit.registration.pairs import agreed_similarity, checked_pairs
from facemorph.fit.registration.register import LOOSE, main_part, pair_arrays, scan_around
from facemorph.fit.registration.surface import ScanSurface
from facemorph.fit.registration.turning import point_normals

FEWEST_PAIRS = 4
"""Fewer say too little of where the next one is."""


class Partners:
    """Suggestions for the partner of a vertex or of a place on the scan, bound to a template and a scan.

    Asked again with the same pairs, it answers from what it placed; pairs that changed are placed anew.
    """

    def __init__(self, template: Mesh, scan: Mesh) -> None:
        """Raises `FitError` where either is no surface."""
        self._template = template
        self._rest, self._triangles = checked_template(template)
        self._part = connected_parts(self._triangles.astype(np.int32), len(self._rest))
        self._surface = checked_scan(scan)
        self._for: tuple[LandmarkPair, ...] = ()
        self._placed = self._rest
        self._scan: ScanSurface | None = None

    def place_of(self, vertex: int, pairs: Sequence[LandmarkPair]) -> tuple[float, float, float] | None:
        """Where on the scan the template's `vertex` is likely to be; None for fewer than four pairs.

        Raises `FitError` for pairs that cannot be used.
        """
        scan = self._bound(pairs)
        if scan is None:
            return None
        near = self._placed[[vertex]]
        normals = point_normals(self._placed, self._triangles)[[vertex]]
        x, y, z = scan.nearest_alike(near, normals, candidates=32).points[0].tolist()
        return x, y, z

    def vertex_of(self, point: tuple[float, float, float], pairs: Sequence[LandmarkPair]) -> int | None:
        """The vertex of the template's main part likely to be at a place of the scan; None as above."""
        scan = self._bound(pairs)
        if scan is None:
            return None
        place = np.asarray(point, np.float64)[None]
        own = np.flatnonzero(self._part == main_part(self._part, pair_arrays(self._for)[0]))
        away = ((self._placed[own] - place) ** 2).sum(axis=1)
        normal = scan.nearest(place).normals[0]
        turned = ((point_normals(self._placed, self._triangles)[own] - normal) ** 2).sum(axis=1)
        return int(own[np.argmin(away + scan.turn**2 * turned)])

    def _bound(self, pairs: Sequence[LandmarkPair]) -> ScanSurface | None:
        if len(pairs) < FEWEST_PAIRS:
            return None
        if tuple(pairs) != self._for or self._scan is None:
            self._place(checked_pairs(self._template, pairs))
            self._for = tuple(pairs)
        return self._scan

    def _place(self, pairs: tuple[LandmarkPair, ...]) -> None:
        vertices, places = pair_arrays(pairs)
        rest = agreed_similarity(self._rest[vertices], places, pairs).points(self._rest)
        self._placed = rest + _field(rest[vertices], places)(rest)
        if self._scan is None:
            matched = self._part == main_part(self._part, vertices)
            self._scan = scan_around(
                self._surface, rest, matched, self._triangles, diagonal_of(rest[matched])
            )


def _field(points: Float64, places: Float64) -> SmoothField:
    return SmoothField(points, places - points, LOOSE)
