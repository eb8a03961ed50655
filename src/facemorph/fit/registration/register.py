"""A template wrapped on a scan of another topology.

A similarity on the landmarks, a biharmonic field through what that leaves, the landmarks brought home over
the surface itself (so that lips may part), then non-rigid ICP, and the quality of what came of it.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, get_args

import numpy as np

from facemorph.core.arrays import Bool, Float64, Int32, Int64
from facemorph.core.landmark_pair import LandmarkPair
from facemorph.core.mesh import Mesh
from facemorph.core.progress import Progress, silent
from facemorph.errors import OptionError
from facemorph.fit.align import diagonal_of
from facemorph.fit.parts import connected_parts
from facemorph.fit.registration.checks import (
    around,
    check_on_surface,
    checked_scan,
    checked_schedule,
    checked_template,
)
from facemorph.fit.registration.field import SmoothField
from facemorph.fit.registration.icp import Anchors, Laid, Schedule, laid_on, places_of
from facemorph.fit.registration.pairs import agreed_similarity, checked_pairs
from facemorph.fit.registration.quality import Quality, Wrapped, quality_of
from facemorph.fit.registration.riders import Carrier, carried
from facemorph.fit.registration.smooth import SmoothSurface
from facemorph.fit.registration.surface import ScanSurface
from facemorph.fit.registration.turning import only, point_normals
from facemorph.fit.threads import one_thread

Parts = Literal["main", "present"]
PARTS: tuple[Parts, ...] = get_args(Parts)

# Moves of landmarks nearer to each other than about this part of their spread are averaged by the field
# through space; what that leaves is brought home over the surface, where two lips are far apart.
LOOSE = 0.1
_OVER_SURFACE = 0.3
# Parts of the template's diagonal.
TURN = 0.006
_MARGIN = 0.25
_PRESENT_WITHIN = 0.01
_PRESENT_SHARE = 0.9
_PRESENT = Schedule(steps=8, stiffness=(10.0, 0.3), reach=(0.02, 0.005))


@dataclass(frozen=True, eq=False)
class Registered:
    """A template wrapped on a scan.

    mesh     the template's polygons, uvs, parts and materials, in the scan's place and unit
    quality  distances to the scan, and triangles turned over
    seconds  time by stage: "align", "wrap", "ride" and "measure"
    """

    mesh: Mesh
    quality: Quality
    seconds: Mapping[str, float] = field(default_factory=dict)


def register(
    template: Mesh,
    scan: Mesh,
    pairs: Sequence[LandmarkPair],
    *,
    parts: str = "main",
    steps: int = 12,
    stiffness: tuple[float, float] = (100.0, 0.3),
    reach: tuple[float, float] = (0.1, 0.01),
    angle_deg: float = 60.0,
    landmark_weight: float = 3.0,
    progress: Progress = silent,
) -> Registered:
    """The template's topology wrapped on `scan`, a surface of any topology, place, turn and unit.

    pairs            which place of the scan belongs to which vertex; the usual 68 and three on each ear are
                     best, four do where the faces are alike
    parts            "main": the connected part with most landmarks is laid on the scan, all others ride
                     along; "present": those others of which the scan has nearly all the surface as well
    steps            how often nearest places are sought while the stiffness falls
    stiffness        from and to, falling geometrically; no unit. 100 bends like rubber over half a head,
                     0.3 follows every wrinkle; end at 3 or 10 for noisy scans
    reach            from and to, parts of the template's diagonal: surface farther off does not pull
    angle_deg        surface whose normal turns farther from the template's does not pull
    landmark_weight  how much a pair counts at first beside a place on the surface; it falls as the
                     stiffness does, since picked places are less exact than the surface

    Raises `FitError` for input that cannot be used, naming pair or vertex, and `OptionError`; what
    `progress` raises passes through.
    """
    if parts not in PARTS:
        raise OptionError(f"parts are {' or '.join(PARTS)}, not {parts!r}.")
    schedule = checked_schedule(Schedule(steps, stiffness, reach, angle_deg, landmark_weight))
    clock = _Clock()
    with one_thread():
        progress(0.0, "placing the template by its landmarks")
        work = _Work(template, scan, pairs)
        clock.lap("align")
        found = work.wrap(schedule, lambda done, doing: progress(0.05 + 0.75 * done, doing))
        clock.lap("wrap")
        progress(0.8, "carrying what the scan does not have")
        work.ride()
        if parts == "present":
            found |= work.lay_present(schedule.angle_deg)
        clock.lap("ride")
        progress(0.9, "measuring the distances")
        quality = work.quality(found)
        clock.lap("measure")
    progress(1.0, "done")
    return Registered(template.with_positions(work.points.astype(np.float32)), quality, clock.seconds)


class _Work:
    """One registration under way. `points` (V, 3) float64 are the template's, in the scan's place."""

    def __init__(self, template: Mesh, scan: Mesh, pairs: Sequence[LandmarkPair]) -> None:
        """Placed by a similarity."""
        rest, self.triangles = checked_template(template)
        surface = checked_scan(scan)
        pairs = checked_pairs(template, pairs)
        vertices, places = pair_arrays(pairs)
        way = agreed_similarity(rest[vertices], places, pairs)
        self.points = self.placed = way.points(rest)
        self.part = connected_parts(self.triangles.astype(np.int32), len(rest))
        self.matched = self.part == main_part(self.part, vertices)
        self.anchors = _anchors(self.matched, vertices, places)
        # The template's own box, turned with it: a scan lying on its side is treated no differently.
        self.size = way.scale * diagonal_of(rest[self.matched])
        self.scan = scan_around(surface, self.placed, self.matched, self.triangles, self.size)
        self.diagonal = diagonal_of(self.scan.points[np.unique(self.scan.triangles)])
        check_on_surface(self.scan, places, pairs, self.size)

    def wrap(self, schedule: Schedule, progress: Progress) -> Bool:
        """Lay the main part on the scan; which vertices (V,) found their place."""
        triangles = only(self.triangles, self.matched)
        begun = brought_home(self.points[self.matched], triangles, self.anchors)
        laid = laid_on(begun, triangles, self.scan, self.anchors, schedule, self.size, progress)
        return self._take(self.matched, laid)

    def ride(self) -> None:
        """Carry the other parts along."""
        main, rest = self.matched, ~self.matched
        carrier = Carrier(self.placed[main], self.points[main], only(self.triangles, main))
        self.points = self.points.copy()
        self.points[rest] = carried(self.placed[rest], self.part[rest], carrier)

    def lay_present(self, angle_deg: float) -> Bool:
        """Lay those parts on the scan too whose surface it has; which of their vertices (V,) found it."""
        bound = _PRESENT_WITHIN * self.size
        _, near = places_of(self.points, self.triangles, self.scan, bound, angle_deg, usual=False)
        count = np.maximum(np.bincount(self.part), 1)
        share = np.bincount(self.part, near) / count
        has_area = np.bincount(self.part[self.triangles[:, 0]], minlength=len(count)) > 0
        chosen = (share >= _PRESENT_SHARE)[self.part] & has_area[self.part] & ~self.matched
        if not chosen.any():
            return np.asarray(chosen)
        none = Anchors(np.zeros(0, np.int64), np.zeros((0, 3)))
        schedule = replace(_PRESENT, angle_deg=angle_deg)
        laid = laid_on(
            self.points[chosen], only(self.triangles, chosen), self.scan, none, schedule, self.size
        )
        self.matched = self.matched | chosen
        return self._take(chosen, laid)

    def quality(self, found: Bool) -> Quality:
        """Of the template as it lies now."""
        wrapped = Wrapped(self.placed, self.points, self.triangles)
        return quality_of(wrapped, self.scan, self.matched, found, self.diagonal)

    def _take(self, chosen: Bool, laid: Laid) -> Bool:
        self.points = self.points.copy()
        self.points[chosen] = laid.points
        found = np.zeros(len(self.points), bool)
        found[chosen] = laid.found
        return found


def brought_home(points: Float64, triangles: Int64, anchors: Anchors) -> Float64:
    """Points (V, 3) moved so that the anchors' vertices are at their places: through space, then over the
    surface (see `LOOSE`).
    """
    held = anchors.vertices
    if not len(held):
        return points
    points = points + SmoothField(points[held], anchors.places - points[held], LOOSE)(points)
    targets, pull = points.copy(), np.zeros(len(points))
    targets[held], pull[held] = anchors.places, 1.0
    return SmoothSurface(triangles, len(points)).moved(points, targets, pull, _OVER_SURFACE)


def scan_around(
    surface: tuple[Float64, Int64], placed: Float64, matched: Bool, triangles: Int64, size: float
) -> ScanSurface:
    """The part of a scan, points and triangles, around the template, with normals as the template's."""
    points, own = surface
    place = placed[matched]
    kept = around(points, own, place, _MARGIN * size)
    scan = ScanSurface(points, kept, TURN * size)
    hits = scan.nearest(place, exact=False)
    normals = point_normals(place, only(triangles, matched))
    near = hits.distances < _MARGIN * size
    if float(np.sign((hits.normals * normals).sum(axis=1))[near].sum()) < 0.0:
        return ScanSurface(points, kept, TURN * size, outward=-1.0)
    return scan


def main_part(part: Int32, vertices: Int64) -> int:
    """The number of the connected part that holds most landmarks, the largest of those that do."""
    landmarks = np.bincount(part[vertices], minlength=int(part.max()) + 1)
    sizes = np.bincount(part, minlength=len(landmarks))
    return int(np.lexsort((sizes, landmarks))[-1])


def pair_arrays(pairs: Sequence[LandmarkPair]) -> tuple[Int64, Float64]:
    """Vertices (n,) and places (n, 3) of pairs."""
    return np.array([pair.vertex for pair in pairs], np.int64), np.array(
        [pair.point for pair in pairs], np.float64
    )


def _anchors(matched: Bool, vertices: Int64, places: Float64) -> Anchors:
    """The pairs on the matched part, with vertices as numbered within it."""
    own = matched[vertices]
    number = np.cumsum(matched) - 1
    return Anchors(number[vertices[own]], places[own])


class _Clock:
    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._last = time.perf_counter()

    def lap(self, stage: str) -> None:
        now = time.perf_counter()
        self.seconds[stage] = now - self._last
        self._last = now
