"""The texture layout of the skin: the face gets most of the picture."""

import numpy as np

from .cage import BUST, HEAD, MOUTH, SOCKET_A, SOCKET_B, Cage

# Left, bottom, right, top of each island in the picture.
BOXES = {
    HEAD: (0.004, 0.17, 0.996, 0.996),
    MOUTH: (0.01, 0.01, 0.17, 0.155),
    BUST: (0.33, 0.01, 0.99, 0.155),
    SOCKET_A: (0.18, 0.01, 0.245, 0.155),
    SOCKET_B: (0.255, 0.01, 0.32, 0.155),
}
FACE_CENTRE = np.array([0.885, 0.483])
FACE_RADIUS = 0.34


def _magnify_face(uv: np.ndarray) -> np.ndarray:
    """Turn MakeHuman's head island upright and enlarge it towards the face's centre."""
    offset = uv - FACE_CENTRE
    radius = np.linalg.norm(offset, axis=1, keepdims=True) / FACE_RADIUS
    warped = offset * (3.2 / (1 + 2.2 * radius))
    return np.stack([-warped[:, 1], -warped[:, 0]], -1)


def build_atlas(cage: Cage, source_uv: np.ndarray) -> np.ndarray:
    """New texture coordinates for every source uv that the cage uses; the rest stay zero."""
    atlas = np.zeros_like(source_uv)
    for island, box in BOXES.items():
        used = np.unique(cage.uv_faces[cage.island == island])
        flat = _magnify_face(source_uv[used]) if island == HEAD else source_uv[used]
        low, high = flat.min(0), flat.max(0)
        corner, opposite = np.array(box[:2]), np.array(box[2:])
        atlas[used] = corner + (flat - low) / (high - low) * (opposite - corner)
    return atlas
