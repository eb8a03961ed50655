"""Named points on the mesh, found by topology and geometry on the base head.

The numbers are those of the 68-point markup ("ibug") and of MPEG-4's facial feature points
(ISO/IEC 14496-2). Left is the person's own left, +X. All six people share the vertices.
"""

from dataclasses import dataclass

import numpy as np

from .cage import HEAD, MOUTH, SOCKET_A, SOCKET_B, undirected_edges
from .head import Head
from .landmark_names import EXTRAS, IBUG_NAMES, MPEG4_OF_IBUG
from .probe import SkinProbe
from .seal import walk_loop

# Rings of edges around the mouth's rim, which lies behind the lips: where the closed lips meet as seen
# from the front (the six people's mean gap is least there), and where their red ends.
CONTACT_RING, LIP_EDGE_RING = 3, 7
# From the ear (degrees above the horizontal, seen from the front) down to the chin.
JAW_CENTRE, JAW_TOP = np.array([0.0, 6.95]), 25.0


@dataclass(frozen=True)
class Landmark:
    name: str
    vertex: int
    mpeg4: str | None = None
    ibug: int | None = None


def _rings(head: Head, start: np.ndarray, count: int) -> list[np.ndarray]:
    """Loops of base-mesh vertices on the head's outside: the start, then each next ring of neighbours."""
    faces = head.cage.faces[head.cage.island == HEAD]
    rings, seen = [np.unique(start)], set(start.tolist())
    for _ in range(count):
        touching = faces[np.isin(faces, rings[-1]).any(1)]
        fresh = np.array(sorted(set(touching.ravel().tolist()) - seen))
        seen.update(fresh.tolist())
        rings.append(fresh)
    return rings


class _Loop:
    """A closed loop of vertices cut at its two corners into an upper and a lower half."""

    def __init__(self, head: Head, ring: np.ndarray):
        points = head.source.base.points
        self._x = points[:, 0]
        # On a tie the first vertex wins, which keeps the choice repeatable.
        self.right, self.left = ring[np.argmin(points[ring, 0])], ring[np.argmax(points[ring, 0])]
        halves = walk_loop(undirected_edges(head.cage.faces), ring, self.right, self.left)
        self._upper, self._lower = sorted(halves, key=lambda half: -points[half, 1].mean())

    def at(self, t: float, upper: bool) -> int:
        """The vertex nearest to a fraction of the way from the right corner to the left."""
        half = self._upper if upper else self._lower
        wanted = self._x[self.right] + t * (self._x[self.left] - self._x[self.right])
        return half[np.argmin(np.abs(self._x[half] - wanted))]


def _jaw(probe: SkinProbe) -> dict[int, int]:
    """Points 0..16: on each ray from the face's middle, where the face ends."""
    found = {}
    for i in range(9):
        angle = np.radians(-90 + (90 + JAW_TOP) * i / 8)
        outwards = np.array([np.cos(angle), np.sin(angle)])
        vertex = probe.outline(JAW_CENTRE, outwards)
        found[8 + i] = vertex
        found[8 - i] = probe.mirrored(vertex)
    return found


def _brows(probe: SkinProbe) -> dict[int, int]:
    left = {22 + k: probe.on_brow(u) for k, u in enumerate((0.04, 0.27, 0.52, 0.76, 0.96))}
    return left | {43 - number: probe.mirrored(vertex) for number, vertex in left.items()}


def _nose(probe: SkinProbe) -> dict[int, int]:
    tip = probe.midline(6.8, 7.1, by="front")
    root = probe.midline(7.2, 7.5, by="back")
    base = probe.nearest((0, 6.80, 1.57))
    top, bottom = probe.points[root, 1], probe.points[tip, 1]
    found = {27: root, 30: tip, 33: base}
    for number, t in ((28, 1 / 3), (29, 2 / 3)):
        found[number] = probe.midline_at(top + t * (bottom - top))
    found[35] = probe.nearest((0.150, 6.848, 1.505))
    found[34] = probe.nearest((0.078, 6.823, 1.537))
    found[31], found[32] = probe.mirrored(found[35]), probe.mirrored(found[34])
    return found


def _eyes(head: Head) -> dict[int, int]:
    cage, base, found = head.cage, head.source.base.points, {}
    outside = cage.faces[cage.island == HEAD]
    for socket in (SOCKET_A, SOCKET_B):
        rim = np.intersect1d(outside, cage.faces[cage.island == socket])
        loop = _Loop(head, rim)
        first = 36 if base[rim, 0].mean() < 0 else 42
        third, two_thirds = 1 / 3, 2 / 3
        vertices = [
            loop.right,
            loop.at(third, True),
            loop.at(two_thirds, True),
            loop.left,
            loop.at(two_thirds, False),
            loop.at(third, False),
        ]
        found |= {first + k: vertex for k, vertex in enumerate(vertices)}
    return found


def _lips(head: Head) -> dict[int, int]:
    cage = head.cage
    rim = np.intersect1d(cage.faces[cage.island == HEAD], cage.faces[cage.island == MOUTH])
    rings = _rings(head, rim, LIP_EDGE_RING)
    outer, inner = _Loop(head, rings[LIP_EDGE_RING]), _Loop(head, rings[CONTACT_RING])
    found = {48: outer.right, 54: outer.left, 60: inner.right, 64: inner.left}
    for k, t in enumerate((0.19, 0.38, 0.5, 0.62, 0.81)):
        found[49 + k] = outer.at(t, True)
    for k, t in enumerate((0.78, 0.64, 0.5, 0.36, 0.22)):
        found[55 + k] = outer.at(t, False)
    for k, t in enumerate((0.27, 0.5, 0.73)):
        found[61 + k] = inner.at(t, True)
        found[67 - k] = inner.at(t, False)
    return found


def find_landmarks(head: Head) -> list[Landmark]:
    """All 68 points in order, then the MPEG-4 points that are not among them."""
    probe = SkinProbe(head)
    found = _jaw(probe) | _brows(probe) | _nose(probe)
    found |= {number: probe.of_base(vertex) for number, vertex in (_eyes(head) | _lips(head)).items()}
    marks = [Landmark(IBUG_NAMES[n], int(found[n]), MPEG4_OF_IBUG.get(n), n) for n in range(68)]
    return marks + [Landmark(name, int(find(probe)), mpeg4) for name, mpeg4, find in EXTRAS]
