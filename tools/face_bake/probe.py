"""Look for vertices of the finished mesh by where they lie on the base head."""

import numpy as np

from .brows import BrowCurve
from .head import Head
from .people import ADA
from .source import mask_at
from .subdivide import compact, vertex_normals

MIDLINE = 1e-4
# The face ends behind here; below the jaw it ends at a plane through the throat (y, z).
FACE_BACK, THROAT, THROAT_SLOPE = 0.74, (6.16, 1.16), 0.55


class SkinProbe:
    """Indices are those of the file; the skin comes first in it."""

    def __init__(self, head: Head):
        self.head, fine = head, head.fine
        points = fine.operator @ head.source.base.points
        self.points = points[head.skin.pick]
        self.normals = vertex_normals(points, fine.triangles)[head.skin.pick]
        used, _ = compact(head.cage.faces)
        kept = enumerate(head.skin.pick.tolist())
        self._index = {int(used[place]): k for k, place in kept if place < len(used)}
        self.outside = fine.on_head[head.skin.pick]
        self.ear = self._ear_mask()
        self.face = self._face_mask()

    def _ear_mask(self) -> np.ndarray:
        """MakeHuman's own mask of the ears, by vertex."""
        fine = self.head.fine
        uv_of = np.zeros(fine.operator.shape[0], int)
        uv_of[fine.quads.ravel()] = fine.uv_quads.ravel()
        uv = fine.source_uv[uv_of[self.head.skin.pick]]
        strength = mask_at(self.head.source.mask("mpfb_ears.jpg"), 1, uv)
        return self.outside & (strength > 0.5)

    def of_base(self, vertex: int) -> int:
        """The vertex that stands for a vertex of MakeHuman's base mesh."""
        return self._index[int(vertex)]

    def nearest(self, place) -> int:
        """The outside vertex nearest to a place on the base head."""
        distance = np.linalg.norm(self.points - np.asarray(place), axis=1)
        return int(np.argmin(np.where(self.outside, distance, np.inf)))

    def mirrored(self, vertex: int) -> int:
        return self.nearest(self.points[vertex] * [-1, 1, 1])

    def best(self, score: np.ndarray, among: np.ndarray) -> int:
        """The vertex with the highest score where `among` is true."""
        return int(np.argmax(np.where(among, score, -np.inf)))

    def on_midline(self) -> np.ndarray:
        return self.outside & (np.abs(self.points[:, 0]) < MIDLINE) & (self.points[:, 2] > 0)

    def on_skull(self) -> np.ndarray:
        """The midline above the neck, front and back."""
        return self.outside & (np.abs(self.points[:, 0]) < MIDLINE) & (self.points[:, 1] > 6.9)

    def midline(self, low: float, high: float, by: str) -> int:
        """The midline vertex furthest to the front or back between two heights."""
        up = self.points[:, 1]
        among = self.on_midline() & (up > low) & (up < high) & (self.normals[:, 2] > 0)
        return self.best(self.points[:, 2] * (1 if by == "front" else -1), among)

    def midline_at(self, height: float) -> int:
        return self.best(-np.abs(self.points[:, 1] - height), self.on_midline() & (self.points[:, 2] > 1.0))

    def on_brow(self, u: float) -> int:
        """On the left brow, a fraction of the way from its inner end."""
        x, y = BrowCurve(ADA.look).at(u)
        aside = np.hypot(self.points[:, 0] - x, self.points[:, 1] - y)
        return self.best(-aside, self.outside & (self.points[:, 2] > 0.95))

    def outline(self, centre: np.ndarray, outwards: np.ndarray) -> int:
        """Where a ray from the face's middle, seen from the front, leaves the face."""
        offset = self.points[:, :2] - centre
        along = offset @ outwards
        aside = np.abs(offset @ [-outwards[1], outwards[0]])
        return self.best(along - 3 * aside, self.face & (aside < 0.03 + 0.03 * along))

    def _face_mask(self) -> np.ndarray:
        """In front of the ears and of the plane from the throat to the ear lobes."""
        _, y, z = self.points.T
        before_neck = z > THROAT[1] - THROAT_SLOPE * (y - THROAT[0])
        return self.outside & ~self.ear & (z > FACE_BACK) & before_neck
