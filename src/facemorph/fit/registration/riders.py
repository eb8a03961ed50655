"""Parts of the template that the scan has nothing of (eyes, teeth, tongue, lashes, hair) ride along.

A smooth field through the displacement of the surface near them carries them; what lies on the surface,
such as brows and lashes, follows the very place it lies on, so that it does not sink in. What is round
stays round: an eyeball goes by a similarity, and so does what it holds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from facemorph.core.arrays import Bool, Float64, Int32, Int64
from facemorph.fit.align import diagonal_of, similarity
from facemorph.fit.registration.field import SmoothField
from facemorph.fit.registration.surface import ScanSurface

_NEAR_POINTS, _SPREAD_POINTS = 400, 120
# Nearer to the surface than this part of the template's diagonal, a part follows it to the letter.
_ON_SURFACE = 0.004
# A part is a ball where its vertices are this near to one sphere, as part of the radius, on most sides of it.
_ROUND = 0.12
_ONE_SIDED = 0.75
_WITHIN = 1.3
_APART = 0.1
_FEWEST_OF_A_BALL = 24


@dataclass(frozen=True, eq=False)
class Carrier:
    """The main surface before and after: points (n, 3) each, over triangles (T, 3)."""

    before: Float64
    after: Float64
    triangles: Int64

    @property
    def size(self) -> float:
        """The diagonal of the box around it."""
        return diagonal_of(self.before)


def carried(points: Float64, part: Int32, carrier: Carrier) -> Float64:
    """Where points (N, 3), of the parts numbered by `part` (N,), go with the carrier, (N, 3)."""
    if not len(points):
        return points.copy()
    surface = ScanSurface(carrier.before, carrier.triangles, carrier.size)
    hits = surface.nearest(points, exact=False)
    moves = carrier.after - carrier.before
    there = np.einsum("nc,nci->ni", hits.weights, moves[surface.triangles[hits.triangles]])
    chosen = _centres(surface.triangles[hits.triangles, hits.weights.argmax(axis=1)], carrier.before)
    field = SmoothField(carrier.before[chosen], moves[chosen])
    # The field misses a little between its points; near the surface that is made good.
    missed = there - field(hits.points)
    nearness = np.exp(-((hits.distances / (_ON_SURFACE * carrier.size)) ** 2))
    gone = points + field(points) + nearness[:, None] * missed
    for ball in _balls(points, part, hits.distances):
        gone[ball] = similarity(points[ball], gone[ball]).points(points[ball])
    return np.asarray(gone)


def _centres(touched: Int64, points: Float64) -> Int64:
    """Vertices of the carrier for the field: many near the riders, some all over."""
    near = np.unique(touched)
    some = farthest_first(points[near], _NEAR_POINTS)
    spread = farthest_first(points, _SPREAD_POINTS)
    chosen = np.unique(np.concatenate([near[some], spread]))
    _, first = np.unique(points[chosen], axis=0, return_index=True)
    return np.asarray(chosen[np.sort(first)])


def farthest_first(points: Float64, count: int) -> Int64:
    """At most `count` of points (n, 3), each as far as can be from those before it."""
    chosen = [int(np.argmin(points.sum(axis=1)))]
    away = np.full(len(points), np.inf)
    while len(chosen) < min(count, len(points)):
        away = np.minimum(away, ((points - points[chosen[-1]]) ** 2).sum(axis=1))
        chosen.append(int(np.argmax(away)))
    return np.array(chosen)


def _balls(points: Float64, part: Int32, heights: Float64) -> list[Bool]:
    """For each ball which points (N,) are its own, those of parts inside it included."""
    parts = [part == number for number in np.unique(part)]
    spheres = [(own, sphere) for own in parts if (sphere := _sphere(points[own])) is not None]
    found: list[Bool] = []
    taken = np.zeros(len(points), bool)
    for own, (centre, radius) in sorted(spheres, key=lambda pair: -pair[1][1]):
        if taken[own].any():
            continue
        away = np.linalg.norm(points - centre, axis=1)
        held = own.copy()
        for other in parts:
            inside = away[other].max() < _WITHIN * radius and heights[other].mean() > _APART * radius
            if inside and not taken[other].any():
                held |= other
        taken |= held
        found.append(held)
    return found


def _sphere(points: Float64) -> tuple[Float64, float] | None:
    """Centre and radius of the sphere that points (n, 3) are on, or None where they are on none.

    |p|^2 = 2 c p + (r^2 - c^2) is linear in c and the last term.
    """
    if len(points) < _FEWEST_OF_A_BALL:
        return None
    middle = points.mean(axis=0)
    local = points - middle
    scale = float(np.abs(local).max())
    if scale == 0.0:
        return None
    local = local / scale
    found, _, rank, _ = np.linalg.lstsq(
        np.c_[2.0 * local, np.ones(len(local))], (local**2).sum(axis=1), rcond=1e-9
    )
    square = float(found[3] + found[:3] @ found[:3])
    if rank < 4 or square <= 0.0:
        return None
    radius = float(np.sqrt(square))
    offsets = local - found[:3]
    away = np.linalg.norm(offsets, axis=1)
    sided = float(np.linalg.norm((offsets / np.maximum(away, 1e-300)[:, None]).mean(axis=0)))
    if float(np.sqrt(((away - radius) ** 2).mean())) > _ROUND * radius or sided > _ONE_SIDED:
        return None
    return middle + scale * found[:3], radius * scale
