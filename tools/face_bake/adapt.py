"""Choose which faces of the skin keep their subdivision, and stitch them to the coarse rest.

Every vertex of the result is a vertex of the fine mesh, so whatever moves the fine mesh moves this one.
"""

from dataclasses import dataclass

import numpy as np

from .cage import BUST, MOUTH
from .finemesh import FineMesh
from .polygons import padded, renumbered

# Extra weight, place and radii on the base head (|x|, y, z in decimetres): mouth, eyes, nose, brows, jaw.
ATTRACTIVE = [
    (6.0, (0.10, 6.62, 1.55), (0.30, 0.20, 0.30)),
    (6.0, (0.31, 7.29, 1.35), (0.24, 0.13, 0.25)),
    (2.5, (0.08, 6.92, 1.55), (0.16, 0.16, 0.25)),
    (1.5, (0.30, 7.47, 1.40), (0.35, 0.12, 0.30)),
    (1.5, (0.25, 6.20, 1.25), (0.40, 0.12, 0.30)),
]
# The inside of the nose bends much but is hardly seen.
NOSTRIL = (0.10, 6.885, 1.55), (0.05, 0.025, 0.05)


@dataclass(frozen=True)
class AdaptiveMesh:
    """pick, pick_uv: which fine vertices and uvs are kept; polygons, uv_polygons: (m, 4) into them, -1
    for no fourth corner; island: (m,) of each polygon."""

    pick: np.ndarray
    pick_uv: np.ndarray
    polygons: np.ndarray
    uv_polygons: np.ndarray
    island: np.ndarray


def bulge(fine: FineMesh, points: np.ndarray) -> np.ndarray:
    """How far (m,) each coarse quad's subdivided surface leaves the flat quad, for fine points (n, 3)."""
    corners = points[fine.coarse]
    middles = 0.5 * (corners + np.roll(corners, -1, 1))
    edges = np.linalg.norm(points[fine.smooth.edge_of] - middles, axis=-1).max(1)
    centre = np.linalg.norm(points[fine.smooth.face_of] - corners.mean(1), axis=-1)
    return np.maximum(edges, centre)


def _gaussian(points, centre, radii) -> np.ndarray:
    """1 at the centre, falling off; left and right alike."""
    mirrored = np.stack([np.abs(points[:, 0]), points[:, 1], points[:, 2]], -1)
    return np.exp(-(((mirrored - centre) / radii) ** 2).sum(1))


def attention(fine: FineMesh, points: np.ndarray) -> np.ndarray:
    """How much (m,) the eye cares about each coarse face of the base head, in decimetres."""
    centre = points[fine.coarse].mean(1)
    weight = 0.6 + sum(extra * _gaussian(centre, place, radii) for extra, place, radii in ATTRACTIVE)
    weight *= 1 - 0.7 * _gaussian(centre, *NOSTRIL)
    weight[centre[:, 2] < 0.3] *= 0.5
    weight[fine.coarse_island == BUST] *= 0.35
    weight[fine.coarse_island == MOUTH] *= 0.25
    weight[fine.coarse_island > BUST] *= 0.5
    return weight


def rank_faces(fine: FineMesh, shapes: list[np.ndarray], base_points: np.ndarray) -> np.ndarray:
    """Score (m,) of each coarse face: its worst bulge over the base head's shapes, times attention."""
    worst = np.zeros(len(fine.coarse))
    for shape in shapes:
        worst = np.maximum(worst, bulge(fine, fine.operator @ shape))
    return worst * attention(fine, fine.operator @ base_points)


def choose_faces(fine: FineMesh, score: np.ndarray, budget: int) -> np.ndarray:
    """The most deserving faces (m,) bool whose mesh has at most `budget` vertices."""
    order = np.argsort(-score, kind="stable")
    low, high = 0, len(order)
    while low < high:
        middle = (low + high + 1) // 2
        if _vertex_count(fine, _with_first(order, middle)) <= budget:
            low = middle
        else:
            high = middle - 1
    return _with_first(order, low)


def _with_first(order: np.ndarray, count: int) -> np.ndarray:
    chosen = np.zeros(len(order), bool)
    chosen[order[:count]] = True
    return chosen


def _vertex_count(fine: FineMesh, chosen: np.ndarray) -> int:
    chosen, split = _close(fine, chosen)
    corners = len(np.unique(fine.coarse))
    return corners + len(np.unique(fine.smooth.edge_of[split])) + int((chosen | _bent(split)).sum())


def _close(fine: FineMesh, chosen: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Split edges (m, 4) around the chosen faces; a face with three or more split edges is chosen too."""
    chosen = chosen.copy()
    edge_of = fine.smooth.edge_of
    while True:
        is_split = np.zeros(fine.smooth.operator.shape[0], bool)
        is_split[edge_of[chosen]] = True
        split = is_split[edge_of]
        grown = chosen | (split.sum(1) >= 3)
        if (grown == chosen).all():
            return chosen, split
        chosen = grown


def _bent(split: np.ndarray) -> np.ndarray:
    """Faces split on exactly two neighbouring sides: they need their middle vertex."""
    return (split.sum(1) == 2) & (split & np.roll(split, -1, 1)).any(1)


def _patches(corner, edge, middle, split, chosen) -> list[list[int]]:
    """The polygons of one coarse face; its sides are split where a neighbour is finer."""
    count = int(split.sum())
    if chosen:
        return [[corner[i], edge[i], middle, edge[i - 1]] for i in range(4)]
    if count == 0:
        return [corner]
    if count == 2 and not (split & np.roll(split, -1)).any():
        i = 0 if split[0] else 1
        a, b, c, d = (corner[(i + k) % 4] for k in range(4))
        return [[a, edge[i], edge[i + 2], d], [edge[i], b, c, edge[i + 2]]]
    if count == 2:
        i = next(k for k in range(4) if split[k] and split[(k + 1) % 4])
        j = (i + 1) % 4
        a, b, c, d = (corner[(i + k) % 4] for k in range(4))
        return [[edge[i], b, edge[j], middle], [a, edge[i], middle, d], [d, middle, edge[j], c]]
    i = int(np.flatnonzero(split)[0])
    a, b, c, d = (corner[(i + k) % 4] for k in range(4))
    return [[edge[i], b, c, d], [edge[i], d, a]]


def _polygons(coarse, refinement, split, chosen) -> tuple[np.ndarray, np.ndarray]:
    """Polygons (m, 4), and the coarse face (m,) of each."""
    result, owner = [], []
    for k in range(len(coarse)):
        patches = _patches(
            coarse[k].tolist(),
            refinement.edge_of[k].tolist(),
            int(refinement.face_of[k]),
            split[k],
            bool(chosen[k]),
        )
        result += patches
        owner += [k] * len(patches)
    return padded(result), np.array(owner)


def build_adaptive_mesh(fine: FineMesh, chosen: np.ndarray) -> AdaptiveMesh:
    chosen, split = _close(fine, chosen)
    polygons, owner = _polygons(fine.coarse, fine.smooth, split, chosen)
    uv_polygons, _ = _polygons(fine.coarse_uv, fine.flat, split, chosen)
    pick, polygons = renumbered(polygons)
    pick_uv, uv_polygons = renumbered(uv_polygons)
    return AdaptiveMesh(pick, pick_uv, polygons, uv_polygons, fine.coarse_island[owner])
