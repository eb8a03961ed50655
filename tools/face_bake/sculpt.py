"""Fields that the source lacks, modelled on its base head: lips moved as curves, skin at handles, folds.

A field is what a few muscles do to everybody alike, see field.py. Distances are in decimetres.
"""

from functools import cached_property
from itertools import pairwise

import numpy as np
from scipy.interpolate import PchipInterpolator

from .cage import HEAD, MOUTH, SOCKET_A, SOCKET_B, Cage
from .field import DOMAINS, Field, Fold
from .lips import BORDER, LipGrid
from .paintkit import smoothstep
from .subdivide import triangulate, vertex_normals
from .surface import CageSurface

# Rings of the lips that follow a curve exactly, and how much of `roll` each of them gets.
LED_RINGS = {0: -0.4, 3: 0.0, BORDER - 1: 1.0}
# The middle third of the face is shared by fields of one side.
SIDE_BLEND = 0.10
LINING_NEIGHBOURS, LINING_REACH = 8, 0.22
# Where the source's units crease (the corner of the mouth): place, radii, and the length that is smoothed.
SOFT = (((0.26, 6.61, 1.40), (0.10, 0.10, 0.14), 0.05),)


class Sculptor:
    """Makes fields (19158, 3) over the base mesh; each is solved once."""

    def __init__(self, cage: Cage, points: np.ndarray, fields: dict[str, Field]):
        self._cage, self._points, self._fields = cage, points, fields
        self.surface, self.lips = CageSurface(cage, points), LipGrid(cage, points)
        self._normals = vertex_normals(points, triangulate(cage.faces))
        self._outside = np.setdiff1d(cage.faces[cage.island == HEAD], self.lips.rings_of(range(BORDER)))
        self._made = {}

    def field(self, name: str) -> np.ndarray:
        """A field by its name, or half of it: 'smile' or 'smileLeft'."""
        if name not in self._fields:
            stem, side = (name.removesuffix("Left"), 1) if name.endswith("Left") else (name[:-5], -1)
            share = smoothstep(-SIDE_BLEND, SIDE_BLEND, side * self._points[:, 0])
            return self.field(stem) * share[:, None]
        if name not in self._made:
            self._made[name] = self._make(self._fields[name])
        return self._made[name]

    def soften(self, offsets: np.ndarray) -> np.ndarray:
        """A source's unit (19158, 3) without the creases that it has in places, see SOFT."""
        return self._softener(offsets)

    @cached_property
    def _softener(self):
        mirrored = self.surface.points * np.where(self.surface.points[:, :1] < 0, (-1, 1, 1), (1, 1, 1))
        length = np.zeros(len(mirrored))
        for place, radii, amount in SOFT:
            share = np.exp(-(((mirrored - place) / radii) ** 2).sum(1))
            length = np.maximum(length, amount * np.where(share > 0.002, share, 0))
        return self.surface.softener(length)

    def _make(self, spec: Field) -> np.ndarray:
        total = np.zeros_like(self._points)
        moves = self._lip_moves(spec) | self._skin_moves(spec) | self._slides(spec)
        if moves:
            moves = {vertex: np.zeros(3) for vertex in self._still(spec.domain)} | moves
            held = np.array(sorted(moves))
            wanted = np.array([moves[vertex] for vertex in held.tolist()])
            total = self._lined(self.surface.interpolated(self.surface.index_of(held), wanted))
        for bulge in spec.bulges:
            total = total + self._bulge(*bulge)
        for fold in spec.folds:
            total = total + self._fold(fold)
        return total

    def _still(self, domain: str) -> list[int]:
        """Vertices that a domain's fields do not move."""
        x, y, z = self._points[self.surface.used].T
        low, high = DOMAINS[domain]
        within = (np.abs(x) < 0.74) & (y > low) & (y < high) & (z > 0.68)
        sockets = np.isin(self._cage.island, (SOCKET_A, SOCKET_B))
        still = np.union1d(self.surface.used[~within], self._cage.faces[sockets])
        mouth = self._cage.faces[self._cage.island == MOUTH]
        deep = np.unique(mouth)[self._points[np.unique(mouth), 2] < 1.15]
        return np.union1d(still, deep).tolist()

    def _lined(self, field: np.ndarray) -> np.ndarray:
        """The mouth's lining goes with the lips and the chin before it, or it would come through them."""
        lining, skin, weights, share = self._lining
        field[lining] += share[:, None] * (np.einsum("nk,nkc->nc", weights, field[skin]) - field[lining])
        return field

    @cached_property
    def _lining(self):
        """Lining vertices (n,), skin near each (n, k), its weights, and how much they decide (n,)."""
        lining = np.setdiff1d(self._cage.faces[self._cage.island == MOUTH], self.lips.rings_of(LED_RINGS))
        skin = np.union1d(self._outside, self.lips.rings_of(range(2, BORDER)))
        places, line = self._points[lining], self._points[self.lips.upper[0, 0], 1]
        distance = np.linalg.norm(places[:, None] - self._points[skin], axis=2)
        other_lip = (places[:, None, 1] > line) != (self._points[skin, 1] > line)
        distance = distance + other_lip
        near = np.argsort(distance, axis=1, kind="stable")[:, :LINING_NEIGHBOURS]
        reach = np.take_along_axis(distance, near, 1)
        weights = 1 / (reach + 0.02)
        share = np.exp(-((reach[:, 0] / LINING_REACH) ** 4))
        return lining, skin[near], weights / weights.sum(1, keepdims=True), share

    def _lip_moves(self, spec: Field) -> dict[int, np.ndarray]:
        if spec.corner is None:
            return {}
        moves = {}
        halves = (
            (self.lips.upper, self.lips.upper_along, spec.upper, spec.upper_roll),
            (self.lips.lower, self.lips.lower_along, spec.lower, spec.lower_roll),
        )
        for rows, along, line, roll in halves:
            led = _curve({**line, 1.0: spec.corner}, along)
            rolled = _curve({**(roll or {0.0: (0, 0, 0)}), 1.0: (0, 0, 0)}, along)
            for ring, share in LED_RINGS.items():
                moves |= dict(zip(rows[ring].tolist(), led + share * rolled, strict=True))
        return moves

    def _skin_moves(self, spec: Field) -> dict[int, np.ndarray]:
        moves = {}
        for (x, y), move in (spec.skin or {}).items():
            for side in (-1, 1) if x else (1,):
                moves[self._front(side * x, y)] = np.array(move) * (side, 1, 1)
        return moves

    def _slides(self, spec: Field) -> dict[int, np.ndarray]:
        """Moves that keep to the head's own surface, as the forehead's skin does over the skull."""
        moves = {}
        for (x, y), (dx, dy, lift) in (spec.slides or {}).items():
            depth = self._depth([[x, y], [x + dx, y + dy]])
            for side in (-1, 1) if x else (1,):
                moves[self._front(side * x, y)] = np.array([side * dx, dy, depth[1] - depth[0] + lift])
        return moves

    def _depth(self, places) -> np.ndarray:
        """z of the head's front at places (n, 2), smoothed over a finger's breadth."""
        skin = self._points[self._outside]
        skin = skin[skin[:, 2] > 0.6]
        near = ((np.array(places)[:, None] - skin[:, :2]) ** 2).sum(-1)
        weight = np.exp(-near / 0.05**2)
        return (weight * skin[:, 2]).sum(1) / weight.sum(1)

    def _front(self, x: float, y: float) -> int:
        """The foremost outside vertex near (x, y)."""
        place = self._points[self._outside]
        aside = np.hypot(place[:, 0] - x, place[:, 1] - y)
        return int(self._outside[np.argmin(aside - 0.02 * place[:, 2] + 9.0 * (place[:, 2] < 0.6))])

    def _mirrored_xy(self) -> tuple[np.ndarray, np.ndarray]:
        return np.abs(self._points[:, 0]), self._points[:, 1]

    def _skin_only(self) -> np.ndarray:
        mask = np.zeros(len(self._points))
        mask[self._outside] = smoothstep(0.55, 0.85, self._points[self._outside, 2])
        return mask

    def _bulge(self, x, y, wide, tall, height) -> np.ndarray:
        across, up = self._mirrored_xy()
        share = np.exp(-(((across - x) / wide) ** 2) - ((up - y) / tall) ** 2) * self._skin_only()
        return self._normals * (height * share)[:, None]

    def _fold(self, fold: Fold) -> np.ndarray:
        across, up = self._mirrored_xy()
        here, line = np.stack([across, up], -1), np.array(fold.line)
        distance, along = signed_distance(here, line)
        u = distance / fold.width
        wave = np.where(u < 0, -np.exp(-(u**2) * 2), (2 * u - 1) * np.exp(-(np.maximum(u - 0.2, 0) ** 2)))
        ends = smoothstep(0.0, 0.25, along) * smoothstep(1.0, 0.75, along)
        share = wave * ends * np.exp(-((u / 2.2) ** 4)) * self._skin_only()
        return self._normals * (fold.height * share)[:, None]


def _curve(stops: dict, along: np.ndarray) -> np.ndarray:
    """Moves (columns, 3) at signed places, smooth and even about the middle, without overshoot."""
    places = sorted(stops)
    knots = [-p for p in reversed(places) if p > 0] + places
    values = [np.array(stops[p]) * (-1, 1, 1) for p in reversed(places) if p > 0]
    values += [np.array(stops[p], float) for p in places]
    return PchipInterpolator(knots, np.array(values))(along)


def signed_distance(points: np.ndarray, line: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Distance (n,) to a polyline, positive on its left (walking), and place along it, 0..1."""
    best, signed, along = np.full(len(points), np.inf), np.zeros(len(points)), np.zeros(len(points))
    lengths = np.linalg.norm(np.diff(line, axis=0), axis=1)
    start = np.concatenate([[0], np.cumsum(lengths)]) / lengths.sum()
    for k, (a, b) in enumerate(pairwise(line)):
        t = np.clip(((points - a) @ (b - a)) / lengths[k] ** 2, 0, 1)
        offset = points - (a + t[:, None] * (b - a))
        distance = np.linalg.norm(offset, axis=1)
        near = distance < best
        side = np.sign((b - a)[0] * offset[:, 1] - (b - a)[1] * offset[:, 0])
        best[near], signed[near] = distance[near], (side * distance)[near]
        along[near] = (start[k] + t * (start[k + 1] - start[k]))[near]
    return signed, along
