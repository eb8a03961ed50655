"""Soft regions of the face, so that its parts can wear different expressions."""

import numpy as np
from scipy.spatial import cKDTree

from .brows import strip_places
from .head import Head
from .paintkit import smoothstep
from .people import ADA

# Per region a few soft spots on the base head's front: |x|, y and their radii, in decimetres.
SPOTS = {
    "brows": [(0.28, 7.52, 0.40, 0.13), (0.0, 7.56, 0.20, 0.16), (0.20, 7.85, 0.60, 0.25)],
    "eyes": [(0.31, 7.28, 0.20, 0.10), (0.50, 7.28, 0.12, 0.09)],
    "nose": [(0.0, 7.10, 0.10, 0.20), (0.0, 6.90, 0.19, 0.13)],
    "cheeks": [(0.44, 6.98, 0.20, 0.20), (0.66, 7.05, 0.18, 0.26)],
    "mouth": [(0.0, 6.61, 0.34, 0.15), (0.26, 6.62, 0.14, 0.17)],
    "jaw": [(0.0, 6.22, 0.40, 0.19), (0.48, 6.40, 0.22, 0.24), (0.68, 6.62, 0.14, 0.28)],
}
PARTS = {
    "eye_L": "eyes",
    "eye_R": "eyes",
    "tears": "eyes",
    "teeth_lower": "jaw",
    "tongue": "jaw",
    "lashes": "eyes",
}
FULL = 255
# Higher powers of the claims make narrower borders.
SHARPNESS = 1.5


def _front(points: np.ndarray) -> np.ndarray:
    """1 on the front of the face, 0 on the ears, the neck and the back of the head."""
    _, y, z = points.T
    return smoothstep(0.60, 0.98, z) * smoothstep(5.92, 6.18, y) * smoothstep(8.12, 7.86, y)


def _shares(points: np.ndarray) -> np.ndarray:
    """What each region claims (n, R) of every point; the claims add up to 1."""
    across, up = np.abs(points[:, 0]), points[:, 1]
    claims = [
        sum(np.exp(-(((across - x) / a) ** 2) - ((up - y) / b) ** 2) for x, y, a, b in spots)
        for spots in SPOTS.values()
    ]
    # The tiny constant keeps points far from every spot defined.
    claims = np.stack(claims, -1) ** SHARPNESS + 1e-30
    return claims / claims.sum(1, keepdims=True)


def round_to_total(values: np.ndarray, totals: np.ndarray) -> np.ndarray:
    """Integers (n, R) near `values` whose rows add up to `totals` exactly (largest remainders)."""
    floor = np.floor(values + 1e-9)
    missing = (totals - floor.sum(1)).astype(int)
    rank = np.argsort(np.argsort(floor - values, axis=1, kind="stable"), axis=1, kind="stable")
    return (floor + (rank < missing[:, None])).astype(np.uint8)


def build_regions(head: Head) -> dict[str, np.ndarray]:
    """Region name -> weights (V,) uint8; the rest up to 255 belongs to the rest of the head."""
    names = list(SPOTS)
    weights = np.zeros((head.vertex_count, len(names)), np.uint8)
    points = (head.fine.operator @ head.source.base.points)[head.skin.pick]
    totals = np.round(FULL * _front(points))
    weights[: len(points)] = round_to_total(_shares(points) * totals[:, None], totals)
    for group_name, region in PARTS.items():
        group = head.group(group_name)
        weights[group.first : group.first + group.count, names.index(region)] = FULL
    # Hairs of a brow move with the skin that they are rooted in.
    brows, front = head.group("brows"), np.flatnonzero(points[:, 2] > 0.9)
    nearest = cKDTree(points[front, :2]).query(strip_places(ADA.look))[1]
    weights[brows.first : brows.first + brows.count] = weights[front[nearest]]
    return {name: weights[:, k] for k, name in enumerate(names)}
