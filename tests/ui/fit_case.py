"""A small head with shapes, another person of its topology, and files of both, for tests of the page Fit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from facemorph.core.mesh import Mesh
from facemorph.core.rig import FaceInfo, Landmark, Rig, Shape, plain_label
from facemorph.io import write_obj

RINGS, AROUND = 15, 28
NAMES = (
    ("happy", "expression"),
    ("sad", "expression"),
    ("AU1", "facs"),
    ("AU12", "facs"),
    ("jawOpen", "arkit"),
    ("browDown", "arkit"),
)
MARKS = (
    "nose tip",
    "left eye outer corner",
    "right eye outer corner",
    "chin bottom",
    "forehead",
    "left ear top",
)


def head_rig(name: str = "Template", seed: int = 1) -> Rig:
    """A head-sized egg (cm) without poles, open above and below, whose shapes push out bumps."""
    u, v = np.meshgrid(np.arange(AROUND) / AROUND * 2 * np.pi, np.linspace(0.12 * np.pi, 0.88 * np.pi, RINGS))
    points = np.stack([np.sin(v) * np.sin(u), np.cos(v), np.sin(v) * np.cos(u)], axis=-1).reshape(-1, 3)
    points *= (7.5, 10.5, 9.0)
    points[:, 2] += 2.0 * np.exp(-(((points - (0, 0, 9)) / 2.0) ** 2).sum(axis=1))
    i, j = np.meshgrid(np.arange(AROUND), np.arange(RINGS - 1))
    a, b = j * AROUND + i, j * AROUND + (i + 1) % AROUND
    quads = np.stack([a, a + AROUND, b + AROUND, b], axis=-1).reshape(-1, 4)
    random = np.random.default_rng(seed)
    deltas = np.zeros((len(NAMES), len(points), 3), np.float32)
    for k in range(len(NAMES)):
        centre = random.normal(size=3) * (1, 0.8, 0.2) + (0, 0, 1.2)
        centre *= 9.0 / np.linalg.norm(centre)
        near = np.exp(-(((points - centre) / 3.5) ** 2).sum(axis=1))
        near[near < 0.01] = 0.0
        deltas[k] = (points / 9.0) * near[:, None] * 2.5
    shapes = tuple(Shape(n, plain_label(n), s) for n, s in NAMES)
    mesh = Mesh.from_polygons(points.astype(np.float32), quads.astype(np.int32))
    places = ((0, 0, 11), (5, 4, 7), (-5, 4, 7), (0, -9, 4), (0, 8, 5), (7.5, 0, 0))
    marks = tuple(
        Landmark(n, int(np.argmin(((points - place) ** 2).sum(axis=1))))
        for n, place in zip(MARKS, places, strict=True)
    )
    return Rig(mesh, shapes, deltas, FaceInfo(name, unit="cm", landmarks=marks))


def person_rig(template: Rig) -> Rig:
    """Another person: a head of other proportions, whose shapes move otherwise where the template's do."""
    points = template.neutral.positions
    own = points * np.array([1.1, 0.95, 1.04], np.float32)
    own[:, 0] += 0.02 * own[:, 1]
    way = 1.0 + 0.3 * np.sin(points[:, 1] / 4.0) + 0.2 * np.cos(points[:, 0] / 3.0)
    return replace(
        template,
        neutral=template.neutral.with_positions(own),
        deltas=template.deltas * way[None, :, None].astype(np.float32),
    )


EXAMPLES = {"smile": {"happy": 0.9}, "grimace": {"AU12": 0.7, "browDown": 0.5}, "shout": {"jawOpen": 1.0}}


def person_files(person: Rig, folder: Path) -> Path:
    """The person's neutral and examples as files."""
    folder.mkdir(parents=True, exist_ok=True)
    write_obj(folder / "neutral.obj", person.neutral)
    for name, weights in EXAMPLES.items():
        write_obj(folder / f"{name}.obj", person.posed(weights))
    return folder


def shuffled(mesh: Mesh, seed: int = 3) -> Mesh:
    """The same surface with its vertices in another order."""
    order = np.random.default_rng(seed).permutation(mesh.vertex_count)
    number = np.empty_like(order)
    number[order] = np.arange(len(order))
    return Mesh(mesh.positions[order], mesh.polygon_starts, number[mesh.corner_vertices].astype(np.int32))


def scanned(mesh: Mesh, scale: float = 10.0) -> Mesh:
    """The surface as another mesh (each quad four triangles round its middle), in another unit and place."""
    quads = mesh.corner_vertices.reshape(-1, 4)
    middles = mesh.positions[quads].mean(axis=1)
    points = np.concatenate([mesh.positions, middles]) * scale + np.float32([5.0, 300.0, -40.0])
    centre = len(mesh.positions) + np.arange(len(quads))
    faces = np.concatenate([np.stack([quads[:, i], quads[:, (i + 1) % 4], centre], axis=1) for i in range(4)])
    return Mesh.from_triangles(points.astype(np.float32), faces.astype(np.int32))
