"""A wrapped template follows its scan: when the scan's own vertices move, so does what lies on it.

So one registration, of the neutral, serves every expression that has the neutral scan's topology.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64
from facemorph.core.correspondence import difference
from facemorph.core.mesh import Mesh
from facemorph.errors import CorrespondenceError, FitError
from facemorph.fit.align import diagonal_of
from facemorph.fit.parts import connected_parts
from facemorph.fit.registration.checks import checked_scan, checked_template
from facemorph.fit.registration.register import scan_around
from facemorph.fit.registration.riders import Carrier, carried
from facemorph.fit.registration.turning import only, point_normals
from facemorph.fit.threads import one_thread

# Vertices farther from the scan than this part of the diagonal lie over a hole, and ride along.
_ON_SCAN = 0.01
_LEAST_ON_SCAN = 0.1


def followed(wrapped: Mesh, scan: Mesh, moved: Mesh) -> Float32:
    """Positions (V, 3) of `wrapped`, a template laid on `scan`, when the scan moves to `moved`.

    moved  has the vertices and polygons of `scan`
    What lies on the scan keeps its place on its triangle, and turns with it; parts of which the scan has
    nothing ride along. Raises `CorrespondenceError` and `FitError`.
    """
    unlike = difference(scan, moved)
    if unlike is not None:
        problem = unlike.problem.replace("the neutral", "the scan")
        raise CorrespondenceError("the moved scan", problem, cause=unlike.cause)
    points, triangles = checked_template(wrapped)
    part = connected_parts(triangles.astype(np.int32), len(points))
    main = part == np.bincount(part).argmax()
    size = diagonal_of(points[main])
    _check_finite(moved)
    with one_thread():
        surface = scan_around(checked_scan(scan), points, main, triangles, size)
        hits = surface.nearest_alike(points[main], point_normals(points[main], only(triangles, main)))
        on_scan = main.copy()
        on_scan[main] = hits.distances < _ON_SCAN * size
        if np.count_nonzero(on_scan) < _LEAST_ON_SCAN * np.count_nonzero(main):
            raise FitError("the template does not lie on the scan it should follow; wrap it on that first.")
        corners = surface.triangles[hits.triangles]
        before, after = surface.points[corners], moved.positions.astype(np.float64)[corners]
        there = np.einsum("nc,nci->ni", hits.weights, after)
        there += _turned(points[main] - hits.points, before, after)
        gone = points.copy()
        gone[main] = there
        carrier = Carrier(points[on_scan], gone[on_scan], only(triangles, on_scan))
        gone[~on_scan] = carried(points[~on_scan], part[~on_scan], carrier)
    return gone.astype(np.float32)


def _check_finite(moved: Mesh) -> None:
    strange = np.flatnonzero(~np.isfinite(moved.positions).all(axis=1))
    if len(strange):
        raise FitError(f"the moved scan: vertex {strange[0] + 1:,} has a position that is no finite number.")


def _turned(offsets: Float64, before: Float64, after: Float64) -> Float64:
    """Offsets (n, 3) from triangles `before` (n, 3, 3) turned as these turn to `after`."""
    old, new = _frames(before), _frames(after)
    return np.asarray(np.einsum("nfi,nf->ni", new, np.einsum("nfi,ni->nf", old, offsets)))


def _frames(triangles: Float64) -> Float64:
    """Three unit vectors (n, 3, 3) along the first side of triangles, across it and upright; the axes where
    a triangle has no area.
    """
    side, other = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    upright = np.cross(side, other)
    frames = np.stack([side, np.cross(upright, side), upright], axis=1)
    lengths = np.linalg.norm(frames, axis=2, keepdims=True)
    flat = (lengths == 0.0).any(axis=(1, 2))
    frames[flat], lengths[flat] = np.eye(3), 1.0
    return np.asarray(frames / lengths)
