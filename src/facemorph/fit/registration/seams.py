"""Seams of a template, where its surface faces itself across a narrow gap: lips, lids, nostrils.

A seam is kept when what faced each other still does. A lip laid on the other one's side has gone through it.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float64, Int64
from facemorph.fit.registration.surface import ScanSurface
from facemorph.fit.registration.turning import point_normals

# Parts of the template's diagonal: how wide a gap may be to be a seam, and what has gone through by no more
# than this touches; lips pressed together do, and many a template's own lips overlap by as much.
_NARROW = 0.01
_THROUGH = 0.003
_TURN = 0.005
_FACING = 0.5
_CANDIDATES = 8


def crossed(before: Float64, after: Float64, triangles: Int64, size: float) -> Int64:
    """Vertices of points (V, 3) that have gone through what they faced, from `before` to `after`, (n,)."""
    normals = point_normals(before, triangles)
    surface = ScanSurface(before, triangles, _TURN * size)
    hits = surface.nearest_alike(before, -normals, _CANDIDATES)
    gap = ((hits.points - before) * normals).sum(axis=1)
    facing = (hits.normals * normals).sum(axis=1) < -_FACING
    seam = np.flatnonzero((gap > -_THROUGH * size) & (hits.distances < _NARROW * size) & facing)
    faced = np.einsum("nc,nci->ni", hits.weights[seam], after[surface.triangles[hits.triangles[seam]]])
    offsets = faced - after[seam]
    now = (offsets * point_normals(after, triangles)[seam]).sum(axis=1)
    near = np.linalg.norm(offsets, axis=1) < _NARROW * size
    return np.asarray(seam[(now < np.minimum(gap[seam], 0.0) - _THROUGH * size) & near])
