"""The eyes' driver: found by their layout, followed wherever they go, left alone elsewhere."""

from __future__ import annotations

from dataclasses import replace

import moderngl
import numpy as np

from facemorph.core.camera import Camera
from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.picture import Look
from facemorph.core.rig import Rig, Shape
from facemorph.gl.eyes import BALL_RADIUS, LIMBUS_IN_PICTURE, Eyes, NoEyes, eyes_of
from facemorph.gl.renderer import Renderer
from tests.gl.heads import head_rig

SEGMENTS, RADIUS = 16, 1.3
CENTRES = np.array([[3.0, 0.0, 0.0], [-3.0, 0.0, 0.0]])
DEGREES = np.array([0.01, 12.0, 23.5, 40.0, 75.0])


def ball() -> tuple[np.ndarray, np.ndarray]:
    """Points of a ball that looks along +Z, ring by ring, and where they are in its picture."""
    turn = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    around = np.stack([np.cos(turn), np.sin(turn)], -1)
    polar = np.radians(DEGREES)[:, None, None]
    points = np.concatenate(
        [np.sin(polar) * around, np.broadcast_to(np.cos(polar), (len(DEGREES), SEGMENTS, 1))], -1
    )
    out = LIMBUS_IN_PICTURE * np.sin(np.radians(np.minimum(DEGREES, 23.5))) / np.sin(np.radians(23.5))
    out = out + 0.002 * np.maximum(DEGREES - 23.5, 0)
    return RADIUS * points.reshape(-1, 3), (0.5 + out[:, None, None] * around).reshape(-1, 2)


def quads(rows: int, columns: int) -> np.ndarray:
    row, column = (a.ravel() for a in np.mgrid[: rows - 1, :columns])
    after = (column + 1) % columns
    here = row * columns
    return np.stack([here + column, here + columns + column, here + columns + after, here + after], -1)


def face() -> Rig:
    """Two eyes in a sheet of skin with an opening before each; shapes turn, blink and carry them off."""
    eye, uv = ball()
    lids = lid_points()
    positions = np.concatenate([lids + CENTRES[0], lids + CENTRES[1], eye + CENTRES[0], eye + CENTRES[1]])
    of_lids, of_eye = quads(2, SEGMENTS), quads(len(DEGREES), SEGMENTS)
    firsts = np.cumsum([0, len(lids), len(lids), len(eye)])
    polygons = [part + first for part, first in zip((of_lids, of_lids, of_eye, of_eye), firsts, strict=True)]
    names = np.repeat([0, 0, 1, 2], [len(part) for part in polygons])
    corners = np.concatenate(polygons).astype(np.int32)
    uvs = np.concatenate([np.zeros((2 * len(lids), 2)), uv, uv])
    mesh = Mesh(
        positions.astype(np.float32),
        np.arange(0, corners.size + 1, 4, dtype=np.int32),
        corners.ravel(),
        uvs.astype(np.float32),
        corners.ravel(),
        groups=Labels(("skin", "eye_L", "eye_R"), names.astype(np.int32)),
        materials_used=Labels(("skin", "eye"), np.minimum(names, 1).astype(np.int32)),
        materials={"skin": Material("skin", (0.6, 0.4, 0.3)), "eye": Material("eye", (0.7, 0.7, 0.7))},
    )
    deltas = np.zeros((3, len(positions), 3))
    turned = eye @ np.array([[np.cos(0.3), 0, np.sin(0.3)], [0, 1, 0], [-np.sin(0.3), 0, np.cos(0.3)]]).T
    deltas[0, firsts[2] :] = np.tile(turned - eye, (2, 1))
    upper = np.tile(lids[:, 1] > 0, 2)
    deltas[1, : firsts[2], 1] = np.where(upper, -0.4, 0.0)
    deltas[2] = [0.0, 2.0, -1.0]
    shapes = tuple(Shape(name, name) for name in ("turn", "blink", "away"))
    return Rig(mesh, shapes, deltas.astype(np.float32))


def lid_points() -> np.ndarray:
    """Two rings around an opening, the inner one close to the ball."""
    turn = 2 * np.pi * (np.arange(SEGMENTS) + 0.5) / SEGMENTS
    inner = np.stack([1.1 * np.cos(turn), 0.55 * np.sin(turn)], -1)
    depth = np.sqrt(np.maximum((1.05 * RADIUS) ** 2 - (inner**2).sum(1), 0.0))
    inner = np.c_[inner, depth]
    return np.concatenate([inner, inner * 1.4])


def told(rig: Rig, **weights: float) -> dict:
    coefficients = np.array([weights.get(name, 0.0) for name in rig.names])
    return dict(eyes_of(rig).uniforms(coefficients, None))


def test_eyes_are_found_where_they_are():
    rig = face()
    assert isinstance(eyes_of(rig), Eyes)
    rest = told(rig)
    np.testing.assert_allclose(rest["eye_centre"], CENTRES, atol=1e-3)
    np.testing.assert_allclose(rest["eye_forward"], [[0, 0, 1]] * 2, atol=1e-5)
    np.testing.assert_allclose(rest["eye_radius"], [RADIUS] * 2, rtol=1e-3)
    assert BALL_RADIUS > 2


def test_the_frame_turns_and_travels_with_the_eye():
    turned = told(face(), turn=1.0)
    np.testing.assert_allclose(turned["eye_forward"], [[np.sin(0.3), 0, np.cos(0.3)]] * 2, atol=1e-4)
    np.testing.assert_allclose(turned["eye_centre"], CENTRES, atol=1e-3)
    away = told(face(), away=1.0)
    np.testing.assert_allclose(away["eye_centre"], CENTRES + np.array([0, 2, -1]), atol=1e-3)
    np.testing.assert_allclose(away["upper_lid"], told(face())["upper_lid"], atol=1e-4)


def test_the_lids_edge_is_followed_through_a_blink():
    rest, shut = told(face()), told(face(), blink=1.0)
    for eye in (0, 1):
        assert rest["upper_lid"][eye][0] * RADIUS > 0.4
        assert rest["lower_lid"][eye][0] * RADIUS < -0.4
        dropped = (rest["upper_lid"][eye][0] - shut["upper_lid"][eye][0]) * RADIUS
        np.testing.assert_allclose(dropped, 0.4, atol=1e-3)
        assert shut["lower_lid"][eye] == rest["lower_lid"][eye]


def test_eyes_of_another_layout_are_let_be():
    rig = face()
    assert isinstance(eyes_of(head_rig()), NoEyes)
    other = replace(rig, neutral=replace(rig.neutral, uvs=rig.neutral.uvs * np.float32(0.8)))
    assert isinstance(eyes_of(other), NoEyes)
    assert told(other) == {"eyes_known": False}


def test_faces_with_and_without_such_eyes_are_drawn_after_each_other_alike(ctx: moderngl.Context) -> None:
    renderer, pictures = Renderer(ctx), []
    for rig in (head_rig(), face(), head_rig()):
        renderer.load(rig)
        renderer.draw({}, Camera.framing(rig.neutral.bounds, "front", 1.0), Look(), (96, 96))
        pictures.append(renderer.read())
    renderer.release()
    np.testing.assert_array_equal(pictures[0], pictures[2])
