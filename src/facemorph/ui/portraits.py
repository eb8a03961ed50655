"""Small pictures of faces, as the pages show them: where they are seen from, and pixels of half the size."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from facemorph.core.arrays import Float32, UInt8
from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.core.rig import Rig

SIDE = 128
PORTRAIT_LOOK = Look(background=(0.20, 0.21, 0.23, 1.0))
_LANDMARKS = 12  # so many, and they tell where the face on the head is


def portrait(rig: Rig) -> Camera:
    """A camera that sees the face from brows to chin where the rig tells where they are, else the whole."""
    vertices = [landmark.vertex for landmark in rig.info.landmarks]
    if len(vertices) < _LANDMARKS:
        return Camera.of_face(rig)
    points: Float32 = rig.neutral.positions[vertices]
    camera = Camera.framing(np.stack([points.min(axis=0), points.max(axis=0)]))
    low = camera.target[1] - 0.07 * float(np.ptp(points[:, 1]))  # jaws drop
    whole = Camera.framing(rig.neutral.bounds)
    return replace(
        camera,
        target=(camera.target[0], low, camera.target[2]),
        distance=camera.distance * 0.94,
        scene_radius=whole.scene_radius,
    )


def halved(pixels: UInt8) -> UInt8:
    """Every four pixels as one, (2H, 2W, 4) to (H, W, 4)."""
    height, width, channels = pixels.shape
    blocks = pixels.reshape(height // 2, 2, width // 2, 2, channels).astype(np.float32)
    return np.ascontiguousarray(blocks.mean(axis=(1, 3)).round().astype(np.uint8))
