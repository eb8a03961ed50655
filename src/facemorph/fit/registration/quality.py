"""How well a template lies on a scan: distances, and triangles that were turned over."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float32, Float64, Int32, Int64
from facemorph.fit.align import diagonal_of
from facemorph.fit.registration.seams import crossed
from facemorph.fit.registration.surface import Hits, ScanSurface
from facemorph.fit.registration.turning import Neighbourhoods, areas_of, only, point_normals

# A vertex explains its nearest place on the scan unless the template has another so many times nearer to it.
_EXPLAINED = 3.0
# Places this near, as part of the diagonal, are one place.
_SAME_PLACE = 0.002
# A triangle that lies against the scan is turned over where its own side of it is farther off than this.
_OTHER_SIDE = 0.005


@dataclass(frozen=True, eq=False)
class Quality:
    """How well a template lies on a scan.

    distances  (V,) float32, from each vertex to the scan's surface, scan's unit: what a heat map shows
    judged     (V,) bool, vertices whose surface the scan has: of a matched part, not beyond an open edge of
               the scan, not hidden behind another part of the template (such as the inside of a mouth whose
               lips alone were scanned). Mean, p95 and largest are over these
    matched    (V,) bool, vertices of the parts that were laid on the scan; the others rode along
    flipped    (n,) int32, triangles turned over: against their own neighbourhood as it went from the
               template to the scan, or lying on the scan face down
    crossed    (n,) int32, vertices that went through the surface they faced in the template, where the scan's
               does not: a lip or lid laid on the other's side
    triangles  how many triangles there are
    diagonal   of the scan, or of the region of it that the template covers where it is much larger
    """

    distances: Float32
    judged: Bool
    matched: Bool
    flipped: Int32
    crossed: Int32
    triangles: int
    diagonal: float

    @property
    def mean(self) -> float:
        """Mean distance, scan's unit; 0 where nothing could be judged."""
        return float(self._told.mean()) if len(self._told) else 0.0

    @property
    def p95(self) -> float:
        """The distance that 95 % of the judged vertices are within, scan's unit."""
        return float(np.percentile(self._told, 95.0)) if len(self._told) else 0.0

    @property
    def largest(self) -> float:
        """Largest distance, scan's unit."""
        return float(self._told.max(initial=0.0))

    @property
    def mean_percent(self) -> float:
        """Mean distance in percent of the diagonal."""
        return self._percent(self.mean)

    @property
    def p95_percent(self) -> float:
        """The distance that 95 % of the judged vertices are within, in percent of the diagonal."""
        return self._percent(self.p95)

    @property
    def largest_percent(self) -> float:
        """Largest distance in percent of the diagonal."""
        return self._percent(self.largest)

    @property
    def flipped_percent(self) -> float:
        """Flipped triangles in percent of all."""
        return 100.0 * len(self.flipped) / max(self.triangles, 1)

    @property
    def judged_percent(self) -> float:
        """Judged vertices in percent of those matched: how much of the template the scan has."""
        return 100.0 * float(np.count_nonzero(self.judged)) / max(int(np.count_nonzero(self.matched)), 1)

    @property
    def _told(self) -> Float64:
        return self.distances[self.judged].astype(np.float64)

    def _percent(self, length: float) -> float:
        return 100.0 * length / self.diagonal if self.diagonal > 0.0 else 0.0


@dataclass(frozen=True, eq=False)
class Wrapped:
    """A template before and after: points (V, 3) each, in the scan's place, over triangles (T, 3)."""

    before: Float64
    after: Float64
    triangles: Int64


def quality_of(wrapped: Wrapped, scan: ScanSurface, matched: Bool, found: Bool, diagonal: float) -> Quality:
    """The quality of a wrapped template; `found` (V,) are the vertices that have their place on the scan."""
    rest = scan.nearest(wrapped.after, exact=False)
    hits = scan.nearest(wrapped.after[matched])
    distances = rest.distances.copy()
    distances[matched] = hits.distances
    judged = np.zeros(len(matched), bool)
    judged[matched] = ~hits.border & found[matched]
    open_rows = np.flatnonzero(~hits.border & ~found[matched])
    judged[np.flatnonzero(matched)[open_rows]] = _explaining(wrapped, hits, open_rows, diagonal)
    near = Neighbourhoods(wrapped.before, wrapped.triangles)
    turned = near.turned_over(wrapped.after, near.rotations(wrapped.after))
    flipped = turned | _face_down(wrapped, scan, judged, diagonal)
    return Quality(
        distances.astype(np.float32),
        judged,
        matched,
        np.flatnonzero(flipped).astype(np.int32),
        _crossed(wrapped, scan, matched, diagonal).astype(np.int32),
        len(wrapped.triangles),
        diagonal,
    )


def _crossed(wrapped: Wrapped, scan: ScanSurface, matched: Bool, diagonal: float) -> Int64:
    """Vertices (n,) that went through what they faced, but those that the scan itself has there."""
    before, after = wrapped.before[matched], wrapped.after[matched]
    triangles = only(wrapped.triangles, matched)
    through = crossed(before, after, triangles, diagonal_of(before))
    normals = point_normals(after, triangles)[through]
    hits = scan.nearest_alike(after[through], normals)
    own = ((hits.normals * normals).sum(axis=1) > 0.5) & (hits.distances < _SAME_PLACE * diagonal)
    return np.asarray(np.flatnonzero(matched)[through[~own]])


def _explaining(wrapped: Wrapped, hits: Hits, rows: Int64, diagonal: float) -> Bool:
    """Which of some hits (n,) of vertices no other place of the template explains far better."""
    if not len(rows):
        return np.zeros(0, bool)
    surface = ScanSurface(wrapped.after, wrapped.triangles, diagonal)
    nearest = surface.nearest(hits.points[rows], exact=False).distances
    return np.asarray(hits.distances[rows] <= np.maximum(_EXPLAINED * nearest, _SAME_PLACE * diagonal))


def _face_down(wrapped: Wrapped, scan: ScanSurface, judged: Bool, diagonal: float) -> Bool:
    """Triangles (T,) that lie on the scan while the side of it that faces as they do is elsewhere."""
    down = np.zeros(len(wrapped.triangles), bool)
    rows = np.flatnonzero(judged[wrapped.triangles].all(axis=1))
    if not len(rows):
        return down
    areas = areas_of(wrapped.after, wrapped.triangles[rows])
    normals = areas / np.maximum(np.linalg.norm(areas, axis=1, keepdims=True), 1e-300)
    middles = wrapped.after[wrapped.triangles[rows]].mean(axis=1)
    hits = scan.nearest(middles, exact=False)
    against = np.flatnonzero((hits.normals * normals).sum(axis=1) < 0.0)
    alike = scan.nearest_alike(middles[against], normals[against])
    same = (alike.normals * normals[against]).sum(axis=1) > 0.0
    near = alike.distances < hits.distances[against] + _OTHER_SIDE * diagonal
    down[rows[against[~(same & near)]]] = True
    return down
