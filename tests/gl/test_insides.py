"""Insides that are left out while something moves: only those that nobody would see."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facemorph.core.camera import Camera
from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Scene
from facemorph.core.triangles import triangulated
from facemorph.gl import Renderer
from facemorph.gl.hem import hem_of
from facemorph.gl.shell import outwardness, shell_of
from tests.gl.heads import head_mesh, head_rig
from tests.ui.harness import ball_rig

SIZE = (240, 240)


def closed_ball() -> Mesh:
    """The test ball, its doubled vertices joined and its flat triangles gone."""
    mesh = ball_rig().neutral
    places, joined = np.unique(mesh.positions.round(4), axis=0, return_inverse=True)
    corners = joined.ravel()[mesh.corner_vertices].reshape(-1, 3)
    solid = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    return Mesh.from_triangles(places.astype(np.float32), corners[solid].astype(np.int32))


def turned_over(mesh: Mesh, polygons: slice = slice(None)) -> Mesh:
    """A mesh of triangles, some of them wound the other way."""
    corners = mesh.corner_vertices.reshape(-1, 3).copy()
    corners[polygons] = corners[polygons, ::-1]
    return Mesh.from_triangles(mesh.positions, corners)


def without(mesh: Mesh, gone: np.ndarray) -> Mesh:
    """A mesh of triangles without those."""
    return Mesh.from_triangles(mesh.positions, mesh.corner_vertices.reshape(-1, 3)[~gone])


def high(mesh: Mesh, above: float) -> np.ndarray:
    """Triangles whose every corner lies above a height."""
    triangles = mesh.corner_vertices.reshape(-1, 3)
    return np.asarray((mesh.positions[triangles, 1] > above).all(axis=1))


def in_front(mesh: Mesh, of: float) -> np.ndarray:
    """Triangles whose every corner lies in front of a depth."""
    return np.asarray((mesh.positions[mesh.corner_vertices.reshape(-1, 3), 2] > of).all(axis=1))


def rig_of(mesh: Mesh, move: np.ndarray | None = None) -> Rig:
    """One shape, `moved`, whose deltas are `move` (V, 3)."""
    shapes = {} if move is None else {"moved": (mesh.positions + move).astype(np.float32)}
    return Rig.from_arrays(mesh, shapes)


# The shell of a mesh


def test_a_closed_ball_is_a_shell_without_rims() -> None:
    mesh = closed_ball()
    shell = shell_of(mesh.positions, triangulated(mesh).vertices)
    assert shell is not None
    assert shell.triangles.all()
    assert len(shell.caps) == 0


@pytest.mark.parametrize("holes", [1, 3])
def test_caps_close_every_rim(holes: int) -> None:
    mesh = closed_ball()
    triangles = mesh.corner_vertices.reshape(-1, 3)
    centres = mesh.positions[triangles].mean(axis=1)
    gone = np.zeros(len(triangles), bool)
    for place in np.eye(3)[:holes] * 9.0:
        gone |= np.linalg.norm(centres - place, axis=1) < 4.0
    open_ball = without(mesh, gone)
    kept = triangulated(open_ball).vertices
    shell = shell_of(open_ball.positions, kept)
    assert shell is not None
    assert shell.triangles.all()
    assert len(shell.caps) > 8 * holes
    assert every_edge_has_its_reverse(np.concatenate([kept, shell.caps]))
    assert not every_edge_has_its_reverse(kept)


def every_edge_has_its_reverse(triangles: np.ndarray) -> bool:
    """Whether each edge is run through as often one way as the other: the surface has no border."""
    balance: dict[tuple[int, int], int] = {}
    for triangle in triangles.tolist():
        for i in range(3):
            a, b = triangle[i], triangle[(i + 1) % 3]
            if a == b:
                continue
            balance[min(a, b), max(a, b)] = balance.get((min(a, b), max(a, b)), 0) + (1 if a < b else -1)
    return not any(balance.values())


def test_what_is_wound_inwards_or_both_ways_or_small_is_no_shell() -> None:
    mesh = closed_ball()
    whole = triangulated(mesh).vertices
    assert shell_of(mesh.positions, whole) is not None
    assert shell_of(mesh.positions, whole[:, ::-1].copy()) is None
    assert shell_of(mesh.positions, triangulated(turned_over(mesh, slice(0, 5))).vertices) is None
    assert shell_of(mesh.positions, np.concatenate([whole, whole[:1]])) is None, "a triangle twice"
    assert shell_of(mesh.positions, whole[:100]) is None
    assert shell_of(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32)) is None


def test_of_two_balls_the_one_wound_inwards_is_left_out() -> None:
    mesh = closed_ball()
    whole = triangulated(mesh).vertices
    positions = np.concatenate([mesh.positions, mesh.positions + np.float32(40.0)])
    both = np.concatenate([whole, whole[:, ::-1] + mesh.vertex_count])
    shell = shell_of(positions, both.astype(np.int32))
    assert shell is not None
    assert shell.triangles.tolist() == [True] * len(whole) + [False] * len(whole)


def test_a_busts_hem_is_no_part_of_the_shell() -> None:
    mesh = head_mesh()
    triangles = triangulated(mesh).vertices
    hem = hem_of(mesh, triangles)
    assert hem is not None
    shell = shell_of(mesh.positions, triangles, hem.triangles)
    assert shell is not None
    assert not shell.triangles[hem.triangles].any()
    assert shell.triangles.sum() > 0.6 * len(triangles)
    lowest = mesh.positions[shell.caps[:, 1:]][..., 1].max()
    assert lowest < mesh.bounds[0, 1] + 0.3 * (mesh.bounds[1, 1] - mesh.bounds[0, 1]), "the neck's cap"


def test_outwardness_turns_with_the_surface(head: Rig) -> None:
    positions, normals = head.positions({}), head.normals({})
    assert outwardness(positions, normals) > 0.4
    assert outwardness(positions, -normals) == pytest.approx(-outwardness(positions, normals))
    assert outwardness(positions + np.float32(100), normals) == pytest.approx(
        outwardness(positions, normals), abs=1e-3
    )
    assert outwardness(np.zeros((2, 3), np.float32), normals[:2]) == 0.0


# Pictures


def mirrored() -> tuple[Rig, Scene]:
    """A shape that turns the whole ball inside out."""
    mesh = closed_ball()
    return rig_of(mesh, mesh.positions * [-2.0, 0.0, 0.0]), Scene(Pose.of({"moved": 1.0}))


def pierced() -> tuple[Rig, Scene]:
    """A shape that pushes the back of the ball out through its front: its inside is what is seen there."""
    mesh = closed_ball()
    x, y, z = mesh.positions.T
    back = np.exp(-((x / 3.0) ** 2 + (y / 3.0) ** 2)) * (z < 0)
    return rig_of(mesh, back[:, None] * [0.0, 0.0, 26.0]), Scene(Pose.of({"moved": 1.0}))


def seen_through(opacity: float) -> tuple[Rig, Scene]:
    mesh = closed_ball()
    labels = Labels(
        ("front", "back"),
        (mesh.positions[mesh.corner_vertices.reshape(-1, 3), 2].mean(axis=1) < 0).astype(np.int32),
    )
    materials = {"front": Material("front", (0.2, 0.5, 0.3), opacity=opacity), "back": Material("back")}
    return rig_of(replace(mesh, materials_used=labels, materials=materials)), Scene(Pose())


KINDS: dict[str, Callable[[], tuple[Rig, Scene]]] = {
    "head": lambda: (head_rig(), Scene(Pose.of({"jaw": 1.0}))),
    "ball": lambda: (rig_of(closed_ball()), Scene(Pose())),
    "inverted": lambda: (rig_of(turned_over(closed_ball())), Scene(Pose())),
    "wound both ways": lambda: (rig_of(turned_over(closed_ball(), slice(0, None, 3))), Scene(Pose())),
    "open above": lambda: (rig_of(without(closed_ball(), high(closed_ball(), 4.0))), Scene(Pose())),
    "open in front": lambda: (rig_of(without(closed_ball(), in_front(closed_ball(), 5.0))), Scene(Pose())),
    "turned inside out by a pose": mirrored,
    "pushed through itself": pierced,
    "glass": lambda: seen_through(0.5),
}  # fmt: skip
CAMERAS = ("front", "20,50", "10,-60", "180,0", "90,10")


def both_ways(ctx: moderngl.Context, rig: Rig, scene: Scene, cameras: list[Camera], look: Look) -> list[int]:
    """How many pixels differ between frames that may leave out insides and those that never do."""
    hurried, plain = Renderer(ctx, "cpu"), Renderer(ctx, "cpu")
    away = []
    for renderer in (hurried, plain):
        renderer.load(rig)
    plain.surface._shell_sought = True  # type: ignore[union-attr]
    for camera in cameras:
        for renderer in (hurried, plain):
            for _ in range(3):
                renderer.draw(scene, camera, look, SIZE, quality="fast")
        away.append(int((hurried.read() != plain.read()).any(axis=2).sum()))
    assert plain.surface.insides is None  # type: ignore[union-attr]
    hurried.release()
    plain.release()
    return away


@pytest.mark.parametrize("kind", KINDS)
def test_frames_while_something_moves_show_what_they_would_with_all_insides_drawn(
    ctx: moderngl.Context, kind: str
) -> None:
    rig, scene = KINDS[kind]()
    bounds = Scene.of(scene).positions(rig)
    box = np.stack([bounds.min(axis=0), bounds.max(axis=0)])
    cameras = [Camera.framing(box, name, 1.0) for name in CAMERAS]
    near = [replace(cameras[0], distance=cameras[0].distance * share) for share in (0.5, 0.3, 0.1)]
    away = both_ways(ctx, rig, scene, [*cameras, *near], Look())
    # Where a surface turns away, a pixel may fall to its front or its back.
    assert max(away) <= 12, away


def test_holes_in_a_texture_show_the_inside(ctx: moderngl.Context, folder: Path) -> None:
    path = folder / "holes.png"
    pixels = np.full((64, 64, 4), 200, np.uint8)
    pixels[..., 3] = np.where(np.add.outer(np.arange(64) // 8, np.arange(64) // 8) % 2, 255, 0)
    Image.fromarray(pixels).save(path)
    mesh = closed_ball()
    uvs = (mesh.positions[:, :2] / 25.0 + 0.5).astype(np.float32)
    mesh = replace(
        mesh,
        uvs=uvs,
        corner_uvs=mesh.corner_vertices,
        materials_used=Labels(("net",), np.zeros(mesh.polygon_count, np.int32)),
        materials={"net": Material("net", texture=path)},
    )
    rig = rig_of(mesh)
    camera = Camera.framing(mesh.bounds, "front", 1.0)
    assert max(both_ways(ctx, rig, Scene(Pose()), [camera], Look())) <= 12


def drawn_triangles(renderer: Renderer, rig: Rig, quality: str, pose: str = "front") -> int:
    """How many triangles one frame hands to OpenGL."""
    count = 0
    painter = renderer._painter
    draw = painter._draw_part

    def counted(surface: object, part: object, *rest: object) -> None:
        nonlocal count
        count += part.count  # type: ignore[attr-defined]
        draw(surface, part, *rest)  # type: ignore[arg-type]

    painter._draw_part = counted  # type: ignore[method-assign,assignment]
    renderer.draw(Pose(), Camera.framing(rig.neutral.bounds, pose, 1.0), Look(), SIZE, quality=quality)  # type: ignore[arg-type]
    painter._draw_part = draw  # type: ignore[method-assign]
    return count


def test_hidden_insides_are_left_out_while_something_moves_and_looked_for_now_and_then(
    ctx: moderngl.Context,
) -> None:
    rig = rig_of(closed_ball())
    renderer = Renderer(ctx, "cpu")
    if not renderer.graphics.software:
        pytest.skip("a graphics card draws every frame in full")
    renderer.load(rig)
    whole = rig.neutral.polygon_count
    assert drawn_triangles(renderer, rig, "full") == 2 * whole
    frames = [drawn_triangles(renderer, rig, "fast") for _ in range(40)]
    assert frames[0] == 2 * whole, "the first is watched"
    assert frames.count(2 * whole) == 3
    assert set(frames) == {whole, 2 * whole}
    assert drawn_triangles(renderer, rig, "full") == 2 * whole, "a still frame has everything"
    renderer.release()


def test_a_busts_insides_are_drawn_when_one_looks_in_from_below(ctx: moderngl.Context) -> None:
    rig = head_rig()
    renderer = Renderer(ctx, "cpu")
    if not renderer.graphics.software:
        pytest.skip("a graphics card draws every frame in full")
    renderer.load(rig)
    for _ in range(3):
        above, below = (drawn_triangles(renderer, rig, "fast", pose) for pose in ("0,30", "0,-60"))
    assert above < 0.75 * below
    assert below == 2 * len(rig.triangles)
    renderer.release()
