"""Parts that ride on the skin: brows, lashes, a beard. They hang on nothing, yet move as the skin below does.

Where a part goes in the template says where it should go only as long as both people's skins move alike. What
followed the skin in the template follows the skin of the target; an eyeball, under lids that move, does not.
"""

from __future__ import annotations

import numpy as np

from facemorph.core.arrays import Float32, Float64, Int32, Int64
from facemorph.core.rig import Rig
from facemorph.fit.parts import Anchoring, PartMeans

# A part whose mean motion differs from the skin's by more than this part of it goes its own way.
_UNLIKE = 0.4
# This part of its vertices, those nearest to the skin, are where it grows from.
_ROOTS = 0.3


class Riding:
    """Which floating parts follow the skin, and the skin's vertex below each of their vertices."""

    def __init__(self, template: Rig, anchoring: Anchoring) -> None:
        from scipy.spatial import cKDTree

        positions = template.neutral.positions.astype(np.float64)
        skin = np.flatnonzero(anchoring.main)
        vertices = np.flatnonzero(anchoring.drifting & ~anchoring.main)
        distance, nearest = cKDTree(positions[skin]).query(positions[vertices])
        part = anchoring.part[vertices]
        below = skin[nearest][_roots(positions[vertices], distance, part)]
        means = PartMeans(part, len(anchoring.floating))
        unlike, moved = np.zeros(means.count), np.zeros(means.count)
        for delta in template.deltas:
            skins = means(delta[below].T)
            unlike += ((means(delta[vertices].T) - skins) ** 2).sum(axis=0)
            moved += (skins**2).sum(axis=0)
        follows = ((moved > 0.0) & (unlike < _UNLIKE**2 * moved))[part]
        self._riders, self._below = vertices[follows], below[follows]
        self._part = part[follows]
        self._means = PartMeans(self._part, means.count)

    def carry(self, found: Float64, deltas: Float32) -> None:
        """Move riding parts of `found` (K, 3, V), in place, by what the skin below them does otherwise than
        the template's, `deltas` (K, V, 3): their mean, so that they keep their form.
        """
        if not len(self._riders):
            return
        for shape, delta in zip(found, deltas, strict=True):
            further = self._means(shape[:, self._below] - delta[self._below].T)
            shape[:, self._riders] += further[:, self._part]


def _roots(points: Float64, distance: Float64, part: Int32) -> Int64:
    """For each of `points` (n, 3) the nearest root of its part, an index (n,): those close to the skin.

    The tips of lashes may be nearer to the other lid than to the one they grow from.
    """
    from scipy.spatial import cKDTree

    roots = np.arange(len(points))
    order = np.argsort(part, kind="stable")
    for members in np.split(order, np.flatnonzero(np.diff(part[order])) + 1):
        if len(members):
            near = members[distance[members] <= np.quantile(distance[members], _ROOTS)]
            roots[members] = near[cKDTree(points[near]).query(points[members])[1]]
    return roots
