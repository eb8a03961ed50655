"""What registration needs of its input, told by name where it is missing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.core.landmark_pair import LandmarkPair
from facemorph.core.mesh import Mesh
from facemorph.core.triangles import triangulated
from facemorph.errors import FitError, OptionError
from facemorph.fit.registration.icp import Schedule
from facemorph.fit.registration.surface import ScanSurface

MOST_TRIANGLES = 3_000_000
"""Most triangles of a scan round the face; more take minutes and add nothing."""
_FEWEST_TRIANGLES = 12
_MOST_STEPS = 200
_OFF_SURFACE = 0.1


def checked_template(template: Mesh) -> tuple[Float64, Int64]:
    """Positions (V, 3) and triangles (T, 3). Raises `FitError`."""
    return _checked_surface(template, "the template")


def checked_scan(scan: Mesh) -> tuple[Float64, Int64]:
    """Positions (V, 3) and triangles (T, 3) of those that have an area. Raises `FitError`."""
    points, triangles = _checked_surface(scan, "the scan")
    first, second, third = (points[triangles[:, corner]] for corner in range(3))
    solid = np.cross(second - first, third - first).any(axis=1)
    if np.count_nonzero(solid) < _FEWEST_TRIANGLES:
        raise FitError("the scan has no surface: all but a few of its triangles have no area.")
    return points, triangles[solid]


def _checked_surface(mesh: Mesh, name: str) -> tuple[Float64, Int64]:
    if not mesh.vertex_count:
        raise FitError(f"{name} is empty: it has no vertices.")
    points = mesh.positions.astype(np.float64)
    strange = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(strange):
        raise FitError(f"{name}: vertex {strange[0] + 1:,} has a position that is no finite number.")
    triangles = triangulated(mesh).vertices.astype(np.int64)
    if len(triangles) < _FEWEST_TRIANGLES:
        raise FitError(
            f"{name} has {mesh.vertex_count:,} vertices and {len(triangles)} triangles, so it is no surface. "
            "Points alone must be joined to triangles first, for instance by Poisson reconstruction."
        )
    return points, triangles


def around(points: Float64, triangles: Int64, place: Float64, margin: float) -> Int64:
    """Triangles of a scan within `margin` of the box around `place` (V, 3). Raises `FitError`."""
    low, high = place.min(axis=0) - margin, place.max(axis=0) + margin
    inside = ((points >= low) & (points <= high)).all(axis=1)[triangles].any(axis=1)
    kept = triangles[inside]
    if len(kept) < _FEWEST_TRIANGLES:
        raise FitError("the landmarks put the template where the scan has no surface; check their places.")
    if len(kept) > MOST_TRIANGLES:
        raise FitError(
            f"the scan has {len(kept):,} triangles around the face; at most {MOST_TRIANGLES:,} are taken. "
            "Thin it out first: 100,000 show all that a template can follow."
        )
    return np.asarray(kept)


def check_on_surface(scan: ScanSurface, places: Float64, pairs: Sequence[LandmarkPair], size: float) -> None:
    """Raises `FitError` where a pair's place is far from the scan's surface."""
    off = scan.nearest(places).distances
    worst = int(np.argmax(off))
    if off[worst] > _OFF_SURFACE * size:
        raise FitError(
            f"the pair {pairs[worst]} has its place {off[worst]:.3g} units off the scan's surface. "
            "Are the places in the scan's own unit?"
        )


def checked_schedule(schedule: Schedule) -> Schedule:
    """Raises `OptionError` where a parameter cannot be used."""
    if not 1 <= schedule.steps <= _MOST_STEPS:
        raise OptionError(f"registration takes 1 to {_MOST_STEPS} steps, not {schedule.steps}.")
    for name, ends in (("stiffness", schedule.stiffness), ("reach", schedule.reach)):
        if not all(np.isfinite(end) and end > 0.0 for end in ends):
            raise OptionError(
                f"{name} goes from one number above 0 to another, not {ends[0]:g} to {ends[1]:g}."
            )
    if not 0.0 < schedule.angle_deg <= 90.0:
        raise OptionError(f"the angle between normals is above 0 and at most 90, not {schedule.angle_deg:g}.")
    if not (np.isfinite(schedule.landmarks) and schedule.landmarks >= 0.0):
        raise OptionError(f"the landmarks' weight is a number of 0 or more, not {schedule.landmarks:g}.")
    return schedule
