"""Picking: the point, vertex and polygon under a pixel are those that the picture shows there."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.camera import Camera
from facemorph.core.picture import Look
from facemorph.core.rig import Rig
from facemorph.core.triangles import triangulated
from facemorph.gl import Offscreen, pick
from tests.gl.heads import head_mesh

SIZE = (160, 120)


def seen_from(direction: str) -> Camera:
    return Camera.framing(head_mesh().bounds, direction, SIZE[0] / SIZE[1])


@pytest.mark.parametrize("direction", ["front", "three-quarter", "left", "-120,40", "10,-60"])
def test_the_point_lies_on_the_sight_line_and_on_the_surface(direction: str) -> None:
    mesh = head_mesh()
    triangles = triangulated(mesh)
    camera = seen_from(direction)
    hits = 0
    for x, y in [(80.0, 60.0), (70.3, 40.9), (95.5, 71.25), (60.0, 30.0)]:
        hit = pick(mesh.positions, triangles, camera, SIZE, x, y)
        if hit is None:
            continue
        hits += 1
        clip = camera.clip_from_model(SIZE[0] / SIZE[1]) @ [*hit.point, 1.0]
        assert np.allclose((clip[0] / clip[3] * 0.5 + 0.5) * SIZE[0], x, atol=1e-6)
        assert np.allclose((0.5 - clip[1] / clip[3] * 0.5) * SIZE[1], y, atol=1e-6)
        corners = mesh.positions[triangles.vertices[hit.triangle]].astype(float)
        assert np.allclose(np.array(hit.weights) @ corners, hit.point, atol=1e-5)
        assert min(hit.weights) > -1e-9
        assert hit.polygon == triangles.polygon[hit.triangle]
        assert hit.vertex in triangles.vertices[hit.triangle]
        assert np.isclose(np.linalg.norm(camera.position() - hit.point), hit.distance)
    assert hits >= 2


def test_what_is_picked_is_what_is_drawn(screen: Offscreen, head: Rig) -> None:
    """Beside the face nothing is picked, on it the picked normal is the pixel's."""
    camera, pose = seen_from("three-quarter"), {"jaw": 1.0}
    look = Look(shading="normals", background=(0.0, 0.0, 0.0, 0.0))
    pixels = screen.render(head, pose, size=SIZE, camera=camera, look=look).astype(int)
    normals = head.normals(pose)
    random = np.random.default_rng(3)
    on, beside = 0, 0
    for x, y in random.integers((0, 0), (160, 95), (300, 2)):
        hit = screen.renderer.pick(x + 0.5, y + 0.5)
        around = pixels[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2, 3]
        if hit is None:
            assert around.min() == 0
            beside += 1
        elif around.min() == 255:
            triangle = head.triangles[hit.triangle]
            n = np.array(hit.weights) @ normals[triangle]
            shown = (n / np.linalg.norm(n) * 0.5 + 0.5) * 255.0
            on += int(np.abs(shown - pixels[y, x, :3]).max() < 30)
    assert beside > 50
    assert on > 60


def test_the_nearest_of_several_layers_is_picked() -> None:
    mesh = head_mesh()
    camera = seen_from("front")
    hit = pick(mesh.positions, triangulated(mesh), camera, SIZE, 80.0, 60.0)
    assert hit is not None
    assert hit.point[2] > 0.0


def test_what_is_behind_the_camera_is_not_picked() -> None:
    mesh = head_mesh()
    camera = Camera(target=(0.0, 0.0, 40.0), distance=20.0, scene_radius=10.0, azimuth_deg=180.0)
    # Looking along +Z from z = 20: the head lies behind.
    assert pick(mesh.positions, triangulated(mesh), camera, SIZE, 80.0, 60.0) is None


def test_an_empty_surface_gives_nothing() -> None:
    mesh = head_mesh()
    none = triangulated(type(mesh).from_triangles(mesh.positions, np.zeros((0, 3), np.int32)))
    assert pick(mesh.positions, none, seen_from("front"), SIZE, 80.0, 60.0) is None
