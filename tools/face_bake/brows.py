"""Eyebrows: where they lie on the base head's front, small strips of hairs on the skin, and their shade.

Each strip is rooted in a triangle of the fine skin. In an expression root and tip go where their skin
goes, but the strip keeps its length and its width: hairs slide and turn, they do not shear.
"""

import numpy as np
import trimesh

from .finemesh import FineMesh
from .paintkit import Noise, Plane
from .parts import PartGroup, Posed
from .people import Look
from .subdivide import vertex_normals

# x and y of the brow's middle line from the nose outwards, how much of the arch each point takes,
# and how much of the lowering (or raising) of the inner end.
CURVE = np.array(
    [(0.090, 7.452), (0.16, 7.464), (0.25, 7.474), (0.34, 7.486), (0.43, 7.484), (0.50, 7.460), (0.56, 7.428)]
)
ARCH = np.array([0, 0, 0.4, 1, 1, 0.5, 0])
INNER = np.array([1, 0.7, 0.3, 0, 0, 0, 0])
HALF_WIDTH = ([0, 0.16, 0.5, 0.75, 1], [0.015, 0.028, 0.027, 0.019, 0.006])
# Degrees from the brow's line: hairs stand up near the nose and lie along the brow further out; those of
# the upper rows turn down towards the others.
LEAN = ([0, 0.14, 0.3, 0.6, 1], [80, 62, 36, 17, 4])
UPPER_TURN = ([0, 0.2, 0.4, 1], [12, 30, 34, 16])
# Strips a brow: places along it times rows across it; each is so many pairs of vertices long.
PLACES, ROWS, PAIRS = 20, 2, 3
TILES = 4
# How much longer than the step to the next strip, and how far strips stand off at root and tip, dm.
LENGTH = ([0, 0.15, 0.6, 1], [0.040, 0.066, 0.064, 0.050])
# Half of a strip's width, dm.
STRIP_WIDTH = ([0, 0.10, 0.25, 0.6, 1], [0.010, 0.024, 0.036, 0.032, 0.016])
# Where along the brow hairs stand how closely: from the strip's tiles, and in the shade below them.
TILE_OF = ([0, 0.12, 0.30, 0.55, 0.75, 1], [3.2, 1.9, 0.5, 0.3, 1.1, 2.4])
SHADE = ([0, 0.10, 0.32, 0.58, 0.80, 1], [0.10, 0.45, 1.0, 0.95, 0.62, 0.25])
# The shade below is darker and warmer than the hairs.
UNDER = np.array([0.80, 0.66, 0.58], np.float32)
LIFT = np.array([0.002, 0.009, 0.012])


class BrowCurve:
    """The middle line of one brow, by a parameter 0 (inner end) to 1."""

    def __init__(self, look: Look):
        rise = look.brow_arch * ARCH + look.brow_inner * INNER
        self._points = CURVE + np.stack([np.zeros(len(CURVE)), rise], -1)
        self._thickness = look.brow_thickness

    def at(self, u) -> tuple[np.ndarray, np.ndarray]:
        steps = np.linspace(0, 1, len(CURVE))
        return np.interp(u, steps, self._points[:, 0]), np.interp(u, steps, self._points[:, 1])

    def direction(self, u) -> np.ndarray:
        """Unit vectors (..., 2) along the brow."""
        (x0, y0), (x1, y1) = self.at(np.maximum(u - 0.04, 0)), self.at(np.minimum(u + 0.04, 1))
        along = np.stack([x1 - x0, y1 - y0], -1)
        return along / np.linalg.norm(along, axis=-1, keepdims=True)

    def half_width(self, u) -> np.ndarray:
        return np.interp(u, *HALF_WIDTH) * self._thickness


class BrowsPart:
    """Strips of both brows, the left ones first, from below upwards as hairs overlap."""

    def __init__(self, fine: FineMesh, base_points: np.ndarray):
        points = fine.operator @ base_points
        self._triangles = _front_triangles(points, fine.triangles)
        self._base = trimesh.Trimesh(points, self._triangles, process=False)
        self._kept = {}
        count = 2 * PLACES * ROWS
        strip = np.array([[2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2] for k in range(PAIRS - 1)])
        polygons = (strip + 2 * PAIRS * np.arange(count)[:, None, None]).reshape(-1, 4)
        self.groups = [PartGroup("brows", "brow", polygons, polygons)]
        self.uv = _uv(count)

    def place(self, posed: Posed) -> np.ndarray:
        person = posed.body.person
        if person.id not in self._kept:
            self._kept = {person.id: _Rooted(self, person.look, posed.body.fine_skin(posed.neutral))}
        return self._kept[person.id].place(posed.skin)

    def anchors(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Triangles (n, 3) of the fine skin and weights (n, 3) in front of places (n, 2) on the base head."""
        origins = np.c_[places, np.full(len(places), 4.0)]
        hits, ray, triangle = self._base.ray.intersects_location(
            origins, np.tile([0.0, 0.0, -1.0], (len(places), 1)), multiple_hits=True
        )
        order = np.lexsort((-hits[:, 2], ray))
        first = order[np.unique(ray[order], return_index=True)[1]]
        if len(first) != len(places):
            raise ValueError("a brow leaves the face")
        corners = self._triangles[triangle[first]]
        return corners, trimesh.triangles.points_to_barycentric(self._base.vertices[corners], hits[first])


class _Rooted:
    """The strips of one person."""

    def __init__(self, part: BrowsPart, look: Look, rest: np.ndarray):
        lines, self._half = _lines(look)
        self._corners, self._weights = part.anchors(lines.reshape(-1, 2))
        self._triangles, self._shape = part._triangles, lines.shape[:2]
        self._used = np.unique(self._triangles)
        spine, _ = self._on_skin(rest)
        self._steps = np.linalg.norm(np.diff(spine, axis=1), axis=-1, keepdims=True)

    def _on_skin(self, skin: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Middle lines of the strips and the skin's normals there, (strips, PAIRS, 3)."""
        normals = vertex_normals(skin, self._triangles)
        spine, normal = (
            (values[self._corners] * self._weights[..., None]).sum(1).reshape(*self._shape, 3)
            for values in (skin, normals)
        )
        return spine, normal / np.linalg.norm(normal, axis=-1, keepdims=True)

    def place(self, skin: np.ndarray) -> np.ndarray:
        """Vertices (n, 3) on the skin in a shape."""
        spine, normal = self._on_skin(skin)
        steps = np.diff(spine, axis=1)
        # The skin says which way a hair points, its own length how far.
        steps = steps / np.maximum(np.linalg.norm(steps, axis=-1, keepdims=True), 1e-9) * self._steps
        spine = spine[:, :1] + np.concatenate([np.zeros_like(steps[:, :1]), np.cumsum(steps, 1)], 1)
        along = np.gradient(spine, axis=1)
        side = np.cross(normal, along)
        side /= np.linalg.norm(side, axis=-1, keepdims=True)
        rank = 0.0015 * np.arange(len(spine))[:, None] % PLACES / PLACES
        raised = spine + (LIFT + rank)[..., None] * normal
        return np.stack([raised + self._half * side, raised - self._half * side], 2).reshape(-1, 3)


def _front_triangles(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Those around the brows, with room for every shape of them."""
    middle = points[triangles].mean(1)
    return triangles[(np.abs(middle[:, 1] - 7.46) < 0.3) & (middle[:, 2] > 0.9)]


def _lines(look: Look) -> tuple[np.ndarray, np.ndarray]:
    """Middle lines (strips, PAIRS, 2) on the base head's front and half widths (strips, 1, 1), dm."""
    rng, curve = np.random.default_rng(7), BrowCurve(look)
    lines, halves = [], []
    # Tips lie over the roots of the next hairs outwards and upwards, so those come first.
    for row in reversed(range(ROWS)):
        u = (np.arange(PLACES)[::-1] + 0.5 * row + rng.uniform(0.0, 0.5, PLACES)) / PLACES
        # The inner end frays: its upper hairs begin further out, and all at any height.
        u = u + 0.12 * row * (1 - u) ** 2
        fray = np.interp(u, [0, 0.25], [0.42, 0.16]) * (1 - 0.5 * row)
        across = (-0.60, np.interp(u, [0, 0.2], [-0.15, 0.10]))[row] + fray * rng.uniform(-1, 1, PLACES)
        lean = np.interp(u, *LEAN) - row * np.interp(u, *UPPER_TURN) + rng.uniform(-13, 13, PLACES)
        length = np.interp(u, *LENGTH) * look.brow_thickness**0.6 * rng.uniform(0.72, 1.15, PLACES)
        tangent, half = curve.direction(u), curve.half_width(u)
        normal = np.stack([-tangent[:, 1], tangent[:, 0]], -1)
        root = np.stack(curve.at(u), -1) + normal * (half * across)[:, None]
        # The tail thins out: its last hairs must not reach past the brow's end.
        root = root - tangent * (0.6 * length * u**3)[:, None]
        turns = np.radians(lean[:, None] - np.array([0.0, 14.0]))
        steps = [np.stack([np.cos(turn), np.sin(turn)], -1) * length[:, None] / 2 for turn in turns.T]
        steps = [step[:, :1] * tangent + step[:, 1:] * normal for step in steps]
        lines.append(np.stack([root, root + steps[0], root + steps[0] + steps[1]], 1))
        halves.append(np.interp(u, *STRIP_WIDTH) * look.brow_thickness * rng.uniform(0.7, 1.1, PLACES))
    one, half = np.concatenate(lines), np.concatenate(halves)
    return np.concatenate([one, one * [-1, 1]]), np.concatenate([half, half])[:, None, None]


def strip_places(look: Look) -> np.ndarray:
    """Where on the base head's front (n, 2) each vertex of the strips lies."""
    lines, _ = _lines(look)
    return np.repeat(lines.reshape(-1, 2), 2, axis=0)


def _uv(count: int) -> np.ndarray:
    """Strips take turns in the picture's tiles; roots at its top. The right brow mirrors the left."""
    strips = []
    for k in range(count):
        tile, inset = _tile(k % (count // 2), k), 0.02
        sides = (tile + inset) / TILES, (tile + 1 - inset) / TILES
        left, right = sides if k < count // 2 else sides[::-1]
        v = np.linspace(0.98, 0.02, PAIRS)
        strips.append(np.stack([np.c_[np.full(PAIRS, left), v], np.c_[np.full(PAIRS, right), v]], 1))
    return np.stack(strips).reshape(-1, 2)


def _tile(strip: int, number: int) -> int:
    """Which tile a strip of one brow shows: the sparser ones at its ends, yet no two neighbours alike."""
    u = 1 - (strip % PLACES) / (PLACES - 1)
    wanted = np.interp(u, *TILE_OF) + ((number * 5) % 7 - 3) * 0.28
    return int(np.clip(np.round(wanted), 0, TILES - 1))


def paint_brows(colour, points, look: Look) -> np.ndarray:
    """The soft shade under the hairs, over the skin colours (n, 3)."""
    curve, u = BrowCurve(look), np.linspace(0, 1, 50)
    (x, y), half = curve.at(u), curve.half_width(u) * 0.62
    outline = np.concatenate([np.c_[x, y + half], np.c_[x, y - half][::-1]])
    shadow = Plane(0, 0.7, 7.3, 7.7, 700, blur=0.017).polygon(outline).sampler()
    front = points[:, 2] > 0.95
    # Ends are single hairs, which shade nothing; between them no two places are alike.
    closely = np.interp(np.abs(points[:, 0]), x, np.interp(u, *SHADE))
    closely = closely * np.clip(0.85 + 0.30 * Noise(43).layered(points, 20, 2), 0.3, 1.2)
    soft = np.clip(shadow(np.abs(points[:, 0]), points[:, 1]) * 0.68 * closely, 0, 1)
    soft = (soft * front)[:, None]
    under = np.array(look.brow, np.float32) * UNDER
    return colour * (1 - soft) + (0.40 * colour + 0.40 * under) * soft
