"""A head made by formula: quads, a texture seam, eyes, an open neck; tests need no bundled face."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.rig import FaceInfo, Rig, Shape

SHAPES = ("smile", "brows", "jaw")


def head_mesh(folder: Path | None = None, rows: int = 36, columns: int = 48) -> Mesh:
    """A head of about 20 model units with two eyeballs; with `folder`, its texture is written there."""
    skin, skin_quads, skin_uvs, skin_uv_quads = _skull(rows, columns)
    positions, quads, uvs, uv_quads = [skin], [skin_quads], [skin_uvs], [skin_uv_quads]
    parts = [np.zeros(len(skin_quads), np.int32)]
    for x in (-3.0, 3.0):
        eye, eye_quads, eye_uvs, eye_uv_quads = _ball(12, 16)
        start, uv_start = sum(map(len, positions)), sum(map(len, uvs))
        positions.append(eye * 1.35 + np.array([x, 1.5, 6.2]))
        quads.append(eye_quads + start)
        uvs.append(eye_uvs)
        uv_quads.append(eye_uv_quads + uv_start)
        parts.append(np.ones(len(eye_quads), np.int32))
    corners = np.concatenate(quads).astype(np.int32)
    return Mesh(
        np.concatenate(positions).astype(np.float32),
        np.arange(0, corners.size + 1, 4, dtype=np.int32),
        corners.ravel(),
        np.concatenate(uvs).astype(np.float32),
        np.concatenate(uv_quads).astype(np.int32).ravel(),
        materials_used=Labels(("skin", "eye"), np.concatenate(parts)),
        materials={
            "skin": Material("skin", (1.0, 1.0, 1.0), texture=_texture(folder) if folder else None)
            if folder
            else Material("skin", (0.6, 0.42, 0.34)),
            "eye": Material("eye", (0.75, 0.78, 0.8)),
        },
    )


def head_rig(folder: Path | None = None, rows: int = 36, columns: int = 48, unit: str = "cm") -> Rig:
    """The head with a smile, raised brows and a dropped jaw; only the skin moves, and the jaw a lot."""
    mesh = head_mesh(folder, rows, columns)
    x, y, z = mesh.positions.T.astype(np.float64)
    skin = np.arange(mesh.vertex_count) < rows * columns + 1
    deltas = np.zeros((3, mesh.vertex_count, 3))
    corner = np.exp(-(((np.abs(x) - 2.6) / 1.8) ** 2 + ((y + 4.0) / 1.6) ** 2)) * (z > 0) * skin
    deltas[0] = corner[:, None] * np.stack([np.sign(x) * 0.9, np.full_like(x, 1.1), np.full_like(x, -0.3)], 1)
    brow = np.exp(-(((np.abs(x) - 3.0) / 2.0) ** 2 + ((y - 4.2) / 1.2) ** 2)) * (z > 0) * skin
    deltas[1, :, 1] = brow * 1.2
    jaw = np.exp(-((x / 4.0) ** 2 + ((y + 6.0) / 2.5) ** 2)) * (z > 0) * skin
    deltas[2] = jaw[:, None] * np.array([0.0, -2.0, -0.8])
    shapes = tuple(Shape(name, name.title()) for name in SHAPES)
    return Rig(mesh, shapes, deltas.astype(np.float32), FaceInfo("Test head", unit=unit))


def partner_rig(folder: Path, rows: int = 36, columns: int = 48) -> Rig:
    """Another person on the same polygons: dark skin and brown eyes, the seam at another place.

    Its texture coordinates are turned by a third round the head, so that every one is another.
    """
    rig = head_rig(folder, rows, columns)
    mesh = rig.neutral
    path = folder / "partner.png"
    with Image.open(mesh.materials["skin"].texture) as own:
        pixels = np.roll(np.asarray(own, np.float64), -own.width // 3, axis=1)
    Image.fromarray((pixels * [0.52, 0.44, 0.40]).round().astype(np.uint8)).save(path)
    uvs = mesh.uvs - np.array([1.0 / 3.0, 0.0], np.float32)
    materials = {
        "skin": Material("skin", (1.0, 1.0, 1.0), texture=path),
        "eye": Material("eye", (0.20, 0.10, 0.05)),
    }
    return Rig(
        replace(mesh, uvs=uvs, materials=materials), rig.shapes, rig.deltas, FaceInfo("Partner", unit="cm")
    )


def many_shapes(count: int, seed: int = 5) -> Rig:
    """The head with `count` noisy shapes of local support, called s0, s1, ..."""
    mesh = head_mesh()
    random = np.random.default_rng(seed)
    centres = mesh.positions[random.integers(0, mesh.vertex_count, count)]
    deltas = np.empty((count, mesh.vertex_count, 3), np.float32)
    for k, centre in enumerate(centres):
        near = np.exp(-((mesh.positions - centre) ** 2).sum(axis=1) / 18.0)
        deltas[k] = near[:, None] * random.normal(size=3) * 0.9
    shapes = tuple(Shape(f"s{k}", f"Shape {k}") for k in range(count))
    return Rig(mesh, shapes, deltas, FaceInfo("Many"))


def _ball(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A closed unit ball of quads with its pole along +Z; the last row and the first meet at a uv seam."""
    v = (np.arange(rows + 1) / rows)[:, None]
    u = (np.arange(columns) / columns)[None, :]
    angle, turn = np.broadcast_arrays(v * np.pi, u * 2 * np.pi)
    points = np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], -1)
    quads, uvs, uv_quads = _grid(rows + 1, columns)
    return points.reshape(-1, 3), quads, uvs, uv_quads


def _skull(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Skull, face and an open neck as one sheet around the Y axis; the seam is at the back."""
    v = (np.arange(rows) / (rows - 1))[:, None]
    u = (np.arange(columns) / columns)[None, :]
    turn = (u - 0.5) * 2 * np.pi
    height = 10.0 - 24.0 * v
    ball = np.sqrt(np.clip(1.0 - ((height - 0.5) / 9.8) ** 2, 0.004, 1.0))
    neck = 0.52 + 0.30 * np.clip((v - 0.86) / 0.14, 0.0, 1.0) ** 2
    radius = np.maximum(ball, np.where(v > 0.62, neck, 0.0))
    x, z = 7.2 * radius * np.sin(turn), 8.4 * radius * np.cos(turn)
    front = np.exp(-((turn / 0.16) ** 2)) * np.exp(-(((height + 0.8) / 1.6) ** 2))
    lips = np.exp(-((turn / 0.30) ** 2)) * np.exp(-(((height + 4.2) / 0.8) ** 2))
    sockets = np.exp(-(((np.abs(turn) - 0.42) / 0.20) ** 2)) * np.exp(-(((height - 1.5) / 1.3) ** 2))
    z = z + 1.8 * front + 0.5 * lips - 0.9 * sockets
    points = np.stack(np.broadcast_arrays(x, height, z), -1).reshape(-1, 3)
    points = np.concatenate([points, [[0.0, 10.4, 0.0]]])
    quads, uvs, uv_quads = _grid(rows, columns)
    across = np.arange(columns)
    # The cap's triangles are written as quads with a doubled corner: such files exist and must draw.
    top = np.full(columns, rows * columns)
    cap = np.stack([top, across, (across + 1) % columns, top], 1)
    cap_uv = np.stack([across, across, across + 1, across], 1)
    return points, np.concatenate([quads, cap]), uvs, np.concatenate([uv_quads, cap_uv])


def _grid(rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Quads of rows x columns points that close around, uvs (one column more) and their quads."""
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns), indexing="ij")
    a, b = (i * columns + j).ravel(), (i * columns + (j + 1) % columns).ravel()
    quads = np.stack([a, a + columns, b + columns, b], 1)
    ua, ub = (i * (columns + 1) + j).ravel(), (i * (columns + 1) + j + 1).ravel()
    uv_quads = np.stack([ua, ua + columns + 1, ub + columns + 1, ub], 1)
    v, u = np.meshgrid(1.0 - np.arange(rows) / (rows - 1), np.arange(columns + 1) / columns, indexing="ij")
    return quads, np.stack([u.ravel(), v.ravel()], 1), uv_quads


def _texture(folder: Path) -> Path:
    """A skin-like picture with a darker cap of hair, 128 x 128."""
    row = np.arange(128)[:, None] / 127.0
    column = np.arange(128)[None, :] / 127.0
    skin = np.array([214.0, 164.0, 138.0])
    hair = np.array([70.0, 46.0, 34.0])
    line = 0.13 + 0.22 * np.clip(np.abs(column - 0.5) * 4.0 - 0.6, 0.0, 1.0)
    share = 1.0 / (1.0 + np.exp(-(row - line) * 60.0))
    pixels = hair + (skin - hair) * share[..., None]
    path = folder / "skin.png"
    Image.fromarray(pixels.round().astype(np.uint8)).save(path)
    return path
