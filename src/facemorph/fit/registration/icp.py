"""Non-rigid ICP: again and again the nearest places on the scan, then a smooth surface through them.

After Amberg, Romdhani and Vetter (2007), with the bi-Laplacian in place of their affine maps, and with
Sumner and Popovic's (2004) rejections. The stiffness falls geometrically; what a place must fulfil to pull:

    its normal turns from the vertex's by no more than an angle, and is sought by that too: the lower
    lip's surface is no candidate for the upper lip's, however near
    it is nearer than a bound, which falls with the stiffness
    it is not on an open edge of the scan, where the surface goes on unseen
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float64, Int64
from facemorph.core.progress import Progress, silent
from facemorph.fit.registration.smooth import SmoothSurface
from facemorph.fit.registration.surface import Hits, ScanSurface
from facemorph.fit.registration.turning import Neighbourhoods, point_normals

# The last steps start from the surface as it is by then, which takes away what smoothness still holds back.
_LAST_STEPS = 1
# Where triangles have turned over, the scan pulls less in each of so many steps more, and the surface is
# asked for the template's own form, turned as its neighbourhood has turned.
_UNFOLDING_STEPS = 8
_YIELD = 0.05
_USUAL_TIMES = 5.0
_SOME = 0.5


@dataclass(frozen=True)
class Schedule:
    """How the laying-on proceeds.

    steps       how often nearest places are sought while the stiffness falls; a few more follow
    stiffness   from and to, falling geometrically; no unit. 100 bends like a sheet of rubber over half a
                head, 0.3 follows a scan's every wrinkle
    reach       from and to, as parts of the template's diagonal: places farther off do not pull
    angle_deg   a place whose normal turns farther from the vertex's does not pull
    landmarks   how much a pair of landmarks counts at first beside a nearest place; it falls as the
                stiffness does, since picked places are less exact than the surface
    """

    steps: int = 12
    stiffness: tuple[float, float] = (100.0, 0.3)
    reach: tuple[float, float] = (0.1, 0.01)
    angle_deg: float = 60.0
    landmarks: float = 3.0


@dataclass(frozen=True, eq=False)
class Anchors:
    """Vertices (n,) that belong to places (n, 3) on the scan."""

    vertices: Int64
    places: Float64


@dataclass(frozen=True, eq=False)
class Laid:
    """A surface laid on a scan: points (V, 3), and which vertices found their place, (V,)."""

    points: Float64
    found: Bool


def laid_on(
    points: Float64,
    triangles: Int64,
    scan: ScanSurface,
    anchors: Anchors,
    schedule: Schedule,
    size: float,
    progress: Progress = silent,
) -> Laid:
    """Points (V, 3) of the template near the scan, all part of triangles (T, 3), laid on it.

    `size` is the template's diagonal, which reaches are parts of.
    """
    laying = _Laying(points, triangles, scan, anchors, schedule, size)
    total = schedule.steps + _LAST_STEPS + _UNFOLDING_STEPS
    for step in range(total):
        progress(step / total, f"laying the template on the scan, step {step + 1} of {total}")
        if step < schedule.steps:
            laying.follow(step)
        elif not laying.settle() and step >= schedule.steps + _LAST_STEPS - 1:
            break
    return Laid(laying.points, laying.found)


class _Laying:
    """A surface on its way: `points` (V, 3) is where it is, `found` (V,) what has its place on the scan."""

    def __init__(
        self,
        points: Float64,
        triangles: Int64,
        scan: ScanSurface,
        anchors: Anchors,
        schedule: Schedule,
        size: float,
    ) -> None:
        self.points, self.found = points, np.zeros(len(points), bool)
        self._begun, self._triangles, self._scan, self._anchors = points, triangles, scan, anchors
        self._schedule = schedule
        self._surface = SmoothSurface(triangles, len(points))
        self._near = Neighbourhoods(points, triangles)
        self._stiffness = np.geomspace(*schedule.stiffness, schedule.steps)
        self._bounds = size * np.geomspace(*schedule.reach, schedule.steps)
        self._yielding = np.ones(len(points))

    def follow(self, step: int) -> None:
        """One step of the schedule: smooth is the displacement from where the surface began."""
        pull, targets = self._pulled(step)
        self.points = self._surface.moved(self._begun, targets, pull, float(self._stiffness[step]))

    def settle(self) -> bool:
        """One more step from where the surface is, unfolding what has turned over. Whether anything has."""
        rotations = self._near.rotations(self.points)
        over = self._near.turned_over(self.points, rotations)
        self._yielding[self._near.around(self._triangles[over])] *= _YIELD
        soft = self._yielding < 1.0
        wanted = np.einsum("vij,vj->vi", rotations, self._surface.bends(self._begun))
        bend = np.where(soft[:, None], wanted - self._surface.bends(self.points), 0.0)
        pull, targets = self._pulled(self._schedule.steps - 1)
        self.points = self._surface.moved(
            self.points, targets, pull * self._yielding, float(self._stiffness[-1]), bend
        )
        return bool(over.any())

    def _pulled(self, step: int) -> tuple[Float64, Float64]:
        """How much each vertex is pulled, (V,), and where to, (V, 3)."""
        hits, self.found = places_of(
            self.points, self._triangles, self._scan, float(self._bounds[step]), self._schedule.angle_deg
        )
        weight = self._schedule.landmarks * float(self._stiffness[step] / self._stiffness[0])
        return _with_anchors(self.found, hits, self._anchors, weight)


def places_of(
    points: Float64,
    triangles: Int64,
    scan: ScanSurface,
    bound: float,
    angle_deg: float,
    *,
    usual: bool = True,
) -> tuple[Hits, Bool]:
    """The place of each vertex on the scan, and whether it may pull, (V,).

    `usual`: not where it is many times farther off than most.
    """
    normals = point_normals(points, triangles)
    hits = scan.nearest_alike(points, normals)
    alike = (hits.normals * normals).sum(axis=1) > np.cos(np.radians(angle_deg))
    found = alike & ~hits.border & (hits.distances < bound)
    if usual and found.any():
        # A scan seen badly still gives most vertices a place nearby; the few far off are other things.
        median = float(np.median(hits.distances[found]))
        found &= hits.distances < max(_USUAL_TIMES * median, _SOME * bound)
    return hits, np.asarray(found)


def _with_anchors(found: Bool, hits: Hits, anchors: Anchors, weight: float) -> tuple[Float64, Float64]:
    """How much each vertex is pulled, (V,), and where to, (V, 3), with the landmarks."""
    pull, targets = found.astype(np.float64), hits.points.copy()
    held = anchors.vertices
    both = pull[held] + weight
    targets[held] = (pull[held, None] * targets[held] + weight * anchors.places) / both[:, None]
    pull[held] = both
    return pull, targets
