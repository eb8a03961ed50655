"""The rings of vertices around the openings of the eyes, and the thickness that lids get there.

MakeHuman's lids are thin skins that dive into the eyeball. Pushed out ring by ring, their edges become a
shelf: what the eye knows as the pink line between the lashes and the ball.
"""

import numpy as np
from scipy.spatial import cKDTree

from .cage import HEAD, SOCKET_A, Cage, undirected_edges
from .parts_eyes_ball import EYE_VERTICES, SCALE, fit_sphere
from .parts_eyes_lids import lash_grids
from .source import BASE_VERTICES, BaseMesh
from .strips import catmull_rom

RINGS = 4
# How far above the ball each ring has to be, in decimetres, from the innermost on; None: as it is.
THICKNESS = (None, None, 0.008, 0.015, 0.019)
# How wet each of the first rings is.
WET = (1.0, 1.0, 0.8, 0.5)
# Lashes grow so far from the third to the fourth ring, above the cage.
ROOTS, ABOVE_SKIN, FINER = 0.9, 0.002, 60
# So far from the opening the skin follows, in decimetres, and after so many steps smoothly.
REACH, SMOOTHING_STEPS = 0.065, 40


class LidRings:
    """columns[side]: (n, RINGS) base-mesh vertices from the lids' inner rim outwards, around the opening.

    lashes[side]: the grids of the upper and the lower lashes, the row on the lid first.
    """

    def __init__(self, cage: Cage, base: BaseMesh):
        self._edges = undirected_edges(cage.faces)
        self._head = cage.faces[cage.island == HEAD]
        socket = self._socket = np.unique(cage.faces[cage.island >= SOCKET_A])
        rims = np.intersect1d(self._head, socket)
        sides = [rims[base.points[rims, 0] > 0], rims[base.points[rims, 0] < 0]]
        self.lashes = [lash_grids(base, side) for side in (0, 1)]
        self._rings = [self._grown(rim, socket) for rim in sides]
        self.columns = [self._columns(rings, base.points, side) for side, rings in enumerate(self._rings)]

    def _grown(self, rim: np.ndarray, socket: np.ndarray) -> list[np.ndarray]:
        """The rim, and ring by ring the vertices around it."""
        rings, seen = [rim], np.union1d(rim, socket)
        for _ in range(len(THICKNESS) - 1):
            touching = self._head[np.isin(self._head, rings[-1]).any(1)]
            rings.append(np.setdiff1d(touching, seen))
            seen = np.union1d(seen, rings[-1])
        return rings

    def _columns(self, rings: list, points: np.ndarray, side: int) -> np.ndarray:
        """One row for each vertex of the rim, around the eye from its middle's left, against the clock."""
        from_middle = points[rings[0]] - points[rings[0]].mean(0)
        order = np.argsort(np.arctan2(from_middle[:, 1], from_middle[:, 0]), kind="stable")
        both = np.concatenate([self._edges, self._edges[:, ::-1]])
        columns = [rings[0][order]]
        for ring in rings[1:RINGS]:
            steps = both[np.isin(both[:, 0], columns[-1]) & np.isin(both[:, 1], ring)]
            outwards = dict(steps.tolist())
            columns.append(np.array([outwards[vertex] for vertex in columns[-1].tolist()]))
        return np.stack(columns, 1)

    def edges(self) -> np.ndarray:
        """How much each base-mesh vertex (19158,) belongs to the lids' wet edges, 0..1."""
        shares = np.zeros(BASE_VERTICES)
        for rings in self._rings:
            for ring, share in zip(rings, WET, strict=False):
                shares[ring] = share
        shares[self._socket] = 1.0
        return shares

    def thickened(self, points: np.ndarray) -> np.ndarray:
        """A copy of (19158, 3) points, a neutral, whose lids stand off the balls."""
        points = points.copy()
        for side in (0, 1):
            centre, radius = fit_sphere(points[EYE_VERTICES[side]])
            away = points - centre
            distance = np.maximum(np.linalg.norm(away, axis=1), 1e-9)
            lift = np.zeros(len(points))
            for ring, least in zip(self._rings[side], THICKNESS, strict=True):
                if least is not None:
                    lift[ring] = np.maximum(radius * SCALE + least - distance[ring], 0)
            lift = self._spread(lift, points, side)
            points += (lift / distance)[:, None] * away
            self._root_lashes(points, side, centre)
        return points

    def _spread(self, lift: np.ndarray, points: np.ndarray, side: int) -> np.ndarray:
        """Relax the lift over the skin around the rings."""
        rings = np.concatenate(self._rings[side])
        near = cKDTree(points[rings]).query(points[self._edges.ravel()])[0] < REACH
        free = np.setdiff1d(self._edges.ravel()[near], rings)
        free = free[np.isin(free, self._head)]
        here, there = np.concatenate([self._edges, self._edges[:, ::-1]]).T
        count = np.maximum(np.bincount(here, minlength=len(points)), 1)
        for _ in range(SMOOTHING_STEPS):
            mean = np.bincount(here, lift[there], minlength=len(points)) / count
            lift[free] = mean[free]
        return lift

    def _root_lashes(self, points: np.ndarray, side: int, centre: np.ndarray):
        """Move lashes, in place, until they grow on the edges of the thickened lids."""
        ring, outer = (points[self.columns[side][:, k]] for k in (2, 3))
        edge = (1 - ROOTS) * ring + ROOTS * outer
        edge += ABOVE_SKIN * (edge - centre) / np.linalg.norm(edge - centre, axis=1, keepdims=True)
        closed = np.concatenate([edge, edge[:1]])
        finer = (
            catmull_rom(len(closed), np.linspace(0, len(edge), FINER * len(edge), endpoint=False)) @ closed
        )
        for grid in self.lashes[side]:
            roots = points[grid[0]]
            turn = np.unwrap(cKDTree(finer).query(roots)[1] * 2 * np.pi / len(finer))
            # As far apart as they were: the nearest places would bunch in the corners.
            steps = np.cumsum([0, *np.linalg.norm(np.diff(roots, axis=0), axis=1)])
            turn = turn[0] + (turn[-1] - turn[0]) * steps / steps[-1]
            place = np.round(turn * len(finer) / (2 * np.pi)).astype(int) % len(finer)
            points[grid] += finer[place] - roots
