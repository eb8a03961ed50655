"""The renderer's promises: what is blended when, what is read, what is refused, what state is left."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facemorph.core.camera import Camera
from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.picture import SHADINGS, Look, Shading
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.errors import GraphicsError, OptionError, PoseError, UnknownNameError
from facemorph.gl import Offscreen, Renderer
from facemorph.gl.grids import grid_size
from facemorph.gl.materials import PLAIN
from tests.gl.heads import head_mesh, many_shapes

SIZE = (160, 120)
CLEAR = (0.0, 0.0, 0.0, 0.0)


@pytest.fixture
def camera(head: Rig) -> Camera:
    return Camera.framing(head.neutral.bounds, "front", SIZE[0] / SIZE[1])


def sheet_rig(colours: np.ndarray | None = None, **changes: object) -> Rig:
    """Two squares side by side facing +Z: left of the middle the first polygon, right the second."""
    corners = np.array([[x, y, 0.0] for y in (-1, 1) for x in (-1, 0, 1)], np.float32)
    quads = np.array([[0, 1, 4, 3], [1, 2, 5, 4]], np.int32)
    mesh = replace(Mesh.from_polygons(corners, quads), colours=colours, **changes)
    return still(mesh)


def still(mesh: Mesh) -> Rig:
    """A rig that cannot move."""
    return Rig(mesh, (), np.zeros((0, mesh.vertex_count, 3), np.float32))


FACING = Camera(distance=6.0, scene_radius=1.5)


def test_moving_the_camera_blends_nothing(renderer: Renderer, camera: Camera) -> None:
    pose = Pose.of({"smile": 0.7})
    for turn in range(5):
        for look in (Look(), Look(shading="wire"), Look(shading="normals")):
            renderer.draw(pose, camera.orbited(turn * 10.0, turn), look, SIZE)
    assert (renderer.stats.frames, renderer.stats.morphs) == (15, 1)


def test_only_changed_coefficients_blend(renderer: Renderer, camera: Camera) -> None:
    same = [
        Pose.of({"smile": 0.5}),
        Pose.between("neutral", "smile", 0.5),
    ]
    for pose in same:
        renderer.draw(pose, camera, Look(), SIZE)
    assert renderer.stats.morphs == 1, "two ways to say the same coefficients"
    renderer.draw(Pose.of({"smile": 0.51}), camera, Look(), SIZE)
    assert renderer.stats.morphs == 2


def test_equal_arguments_give_equal_pixels_whatever_was_drawn_before(
    renderer: Renderer, camera: Camera
) -> None:
    pose = Pose.of({"smile": 0.9, "brows": -0.3, "jaw": 1.2})
    renderer.draw(pose, camera, Look(), SIZE, exactly=True)
    first = renderer.read()
    for k in range(20):
        renderer.draw(pose.with_weight("smile", 0.05 * k), camera, Look(), SIZE)
    renderer.draw(pose, camera, Look(), SIZE, exactly=True)
    assert np.array_equal(renderer.read(), first)


def test_the_top_row_comes_first_and_left_is_left(screen: Offscreen) -> None:
    colours = np.array([[1, 0, 0]] * 3 + [[0, 0, 1]] * 3, np.float32)
    pixels = screen.render(sheet_rig(colours), size=(64, 64), camera=FACING)
    assert pixels[16, 32, 2] > 180 > pixels[16, 32, 0], "blue is above"
    assert pixels[47, 32, 0] > 180 > pixels[47, 32, 2], "red is below"
    sides = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1]] * 2, np.float32)
    pixels = screen.render(sheet_rig(sides), size=(64, 64), camera=FACING)
    assert pixels[32, 18, 0] > pixels[32, 18, 2], "red is at the left"
    assert pixels[32, 46, 2] > pixels[32, 46, 0], "blue is at the right"


@pytest.mark.parametrize("quality", ["full", "fast"])
def test_a_transparent_background_leaves_straight_alpha(
    renderer: Renderer, camera: Camera, quality: str
) -> None:
    renderer.draw(Pose(), camera, Look(background=CLEAR), SIZE, quality=quality)
    pixels = renderer.read()
    assert pixels[0, 0].tolist() == [0, 0, 0, 0]
    assert pixels[50, 80, 3] == 255
    renderer.draw(Pose(), camera, Look(background=(0.0, 0.0, 0.0, 1.0)), SIZE, quality=quality)
    opaque = renderer.read()
    assert (opaque[..., 3] == 255).all()
    edge = (pixels[..., 3] > 60) & (pixels[..., 3] < 200) & (np.arange(SIZE[1]) < 70)[:, None]
    if quality == "full":
        assert edge.any(), "full quality smooths edges"
        assert (pixels[edge][:, 0].astype(int) >= opaque[edge][:, 0]).all(), "not darkened by the backdrop"


def test_full_quality_is_smoother_than_fast(ctx: moderngl.Context, camera: Camera, head: Rig) -> None:
    renderer = Renderer(ctx)
    if not renderer.graphics.software:
        pytest.skip("only where OpenGL runs on the CPU does fast leave out the smoothing")
    renderer.load(head)
    shades = []
    for quality in ("fast", "full"):
        renderer.draw(Pose(), camera, Look(background=CLEAR), SIZE, quality=quality)
        alpha = renderer.read()[:70, :, 3]
        shades.append(int(((alpha > 0) & (alpha < 255)).sum()))
    assert shades[0] == 0
    assert shades[1] > 50
    renderer.release()


def test_both_qualities_show_the_same_backdrop(renderer: Renderer, camera: Camera) -> None:
    corners = []
    for quality in ("full", "fast", "full"):
        renderer.draw(Pose(), camera, Look(background=(0.3, 0.2, 0.6, 1.0)), SIZE, quality=quality)
        corners.append(renderer.read()[:12, :30])
    assert np.abs(corners[0].astype(int) - corners[1]).max() <= 1
    assert np.array_equal(corners[0], corners[2])


@pytest.mark.parametrize("shading", SHADINGS)
def test_fast_and_full_quality_differ_at_edges_only(
    renderer: Renderer, camera: Camera, shading: Shading
) -> None:
    pictures = []
    for quality in ("fast", "full"):
        renderer.draw(Pose.of({"jaw": 0.5}), camera, Look(shading=shading), SIZE, quality=quality)
        pictures.append(renderer.read().astype(int))
    assert np.mean(np.abs(pictures[0] - pictures[1]).max(axis=2) > 24) < (0.2 if shading == "wire" else 0.05)


def test_size_follows_what_is_asked(renderer: Renderer, camera: Camera) -> None:
    for size in ((64, 48), (200, 100), (1, 1), (33, 7)):
        renderer.draw(Pose(), camera, Look(), size)
        assert renderer.read().shape == (size[1], size[0], 4)
        assert renderer.texture.size == size


def test_open_surfaces_are_seen_from_both_sides_and_lit_on_both(screen: Offscreen) -> None:
    front = screen.render(sheet_rig(), size=(64, 64), camera=FACING)
    back = screen.render(sheet_rig(), size=(64, 64), camera=replace(FACING, azimuth_deg=180.0))
    assert np.abs(front[32, 32].astype(int) - back[32, 32]).max() < 40
    assert front[32, 32, 0] > 120


def test_a_see_through_material_lets_the_one_behind_show(screen: Offscreen) -> None:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    both = np.concatenate([corners + np.array([0, 0, 0.5], np.float32), corners])
    materials = {
        "glass": Material("glass", (0.0, 0.0, 0.9), opacity=0.4),
        "wall": Material("wall", (0.9, 0.0, 0.0)),
    }
    mesh = replace(
        Mesh.from_polygons(both, np.array([[0, 1, 2, 3], [4, 5, 6, 7]], np.int32)),
        materials_used=Labels(("glass", "wall"), np.array([0, 1], np.int32)),
        materials=materials,
    )
    pixels = screen.render(still(mesh), size=(64, 64), camera=FACING)
    red, green, blue = pixels[32, 32, :3].astype(int)
    assert red > 80
    assert blue > 60
    assert green < 60


def test_vertex_colours_show_where_there_is_no_texture(screen: Offscreen) -> None:
    green = np.tile(np.array([[0.1, 0.9, 0.1]], np.float32), (6, 1))
    assert np.argmax(screen.render(sheet_rig(green), size=(32, 32), camera=FACING)[16, 16, :3]) == 1


def test_a_mesh_without_materials_is_pleasantly_plain(screen: Offscreen) -> None:
    red, green, blue, alpha = screen.render(sheet_rig(), size=(32, 32), camera=FACING)[16, 16].astype(int)
    assert alpha == 255
    assert 230 > red > green > blue > 90, "warm, neither black nor burnt out"


@pytest.mark.parametrize("content", [b"", b"not a picture", b"\x89PNG\r\n\x1a\n" + b"\0" * 40])
def test_a_broken_texture_is_told_and_the_face_is_still_drawn(
    screen: Offscreen, folder: Path, content: bytes
) -> None:
    path = folder / "skin.png"
    path.write_bytes(content)
    mesh = head_mesh()
    skin = replace(mesh.materials["skin"], texture=path)
    rig = Rig(
        replace(mesh, materials={**mesh.materials, "skin": skin}),
        (),
        np.zeros((0, mesh.vertex_count, 3), np.float32),
    )
    pixels = screen.render(rig, size=(64, 64))
    assert pixels[30, 32].max() > 60
    assert len(screen.renderer.problems) == 1
    assert "skin.png" in screen.renderer.problems[0]


def test_a_texture_that_is_not_there_is_told(screen: Offscreen, folder: Path) -> None:
    mesh = head_mesh()
    skin = replace(mesh.materials["skin"], texture=folder / "none.png")
    rig = Rig(replace(mesh, materials={"skin": skin}), (), np.zeros((0, mesh.vertex_count, 3), np.float32))
    screen.render(rig, size=(32, 32))
    assert "none.png" in screen.renderer.problems[0]
    screen.render(many_shapes(1), size=(32, 32))
    assert screen.renderer.problems == (), "problems are the loaded face's"


def test_what_a_pose_cannot_be_is_refused_and_the_face_stays(renderer: Renderer, camera: Camera) -> None:
    renderer.draw(Pose(), camera, Look(), SIZE)
    before = renderer.read()
    with pytest.raises(UnknownNameError, match="smile"):
        renderer.draw(Pose.of({"smlie": 1.0}), camera, Look(), SIZE)
    with pytest.raises(PoseError):
        renderer.draw(Pose.of({"smile": float("nan")}), camera, Look(), SIZE)
    with pytest.raises(OptionError):
        renderer.draw(Pose(), camera, Look(), (0, 10))
    assert np.array_equal(renderer.read(), before)


def test_nothing_to_show_is_said(ctx: moderngl.Context, head: Rig) -> None:
    renderer = Renderer(ctx)
    with pytest.raises(GraphicsError, match="load"):
        renderer.draw(Pose(), Camera(), Look(), SIZE)
    renderer.load(head)
    with pytest.raises(GraphicsError, match="draw"):
        renderer.read()
    with pytest.raises(GraphicsError, match="draw"):
        renderer.pick(1.0, 1.0)
    with pytest.raises(OptionError, match="shader"):
        Renderer(ctx, "gpu")  # type: ignore[arg-type]


def test_the_context_is_left_as_others_expect_it(
    ctx: moderngl.Context, renderer: Renderer, camera: Camera
) -> None:
    outer = ctx.simple_framebuffer((50, 40))
    outer.use()
    renderer.draw(Pose.of({"smile": 0.4}), camera, Look(shading="wire"), SIZE)
    assert ctx.detect_framebuffer().glo == outer.glo
    assert ctx.viewport == (0, 0, 50, 40)
    assert ctx.polygon_offset == (0.0, 0.0)
    assert ctx.error == "GL_NO_ERROR"
    # Neither depth test nor culling nor blending is on: a far, backward, half-clear triangle covers all.
    program = ctx.program(
        vertex_shader="""#version 330 core
            void main() { vec2 c = vec2(gl_VertexID & 2, (gl_VertexID << 1) & 2);
                          gl_Position = vec4(c * 2.0 - 1.0, 0.999, 1.0); }""",
        fragment_shader="#version 330 core\nout vec4 c; void main() { c = vec4(0.5, 0.5, 0.5, 0.2); }",
    )
    ctx.vertex_array(program, []).render(ctx.TRIANGLES, vertices=3)
    assert set(outer.read(components=4)) == {128, 51}
    ctx.detect_framebuffer(0).use()
    outer.release()


def test_a_second_face_replaces_the_first(renderer: Renderer, camera: Camera, head: Rig) -> None:
    renderer.draw(Pose.of({"smile": 1.0}), camera, Look(), SIZE)
    renderer.load(many_shapes(2))
    renderer.draw(Pose.of({"s1": 1.0}), camera, Look(), SIZE)
    renderer.load(head)
    renderer.draw(Pose.of({"smile": 1.0}), camera, Look(), SIZE, exactly=True)
    assert renderer.stats.morphs == 1
    assert np.array_equal(renderer.positions(), head.positions({"smile": 1.0}))


def test_an_empty_mesh_draws_its_backdrop(screen: Offscreen) -> None:
    mesh = Mesh.from_triangles(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    for shading in ("skin", "wire", "heat"):
        assert (
            screen.render(still(mesh), size=(32, 32), look=Look(shading=shading), legend=False)[..., 3].min()
            == 255
        )


def test_a_face_that_opengl_cannot_hold_leaves_the_one_before(
    ctx: moderngl.Context, head: Rig, camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    renderer = Renderer(ctx, "shader")
    renderer.load(head)
    renderer.draw(Pose.of({"smile": 1.0}), camera, Look(), SIZE)
    before = renderer.read()
    monkeypatch.setattr("facemorph.gl.morph_shader.grid_size", lambda count, largest: grid_size(count, 16))
    with pytest.raises(GraphicsError, match="cpu"):
        renderer.load(many_shapes(2))
    monkeypatch.undo()
    renderer.draw(Pose.of({"smile": 1.0}), camera, Look(), SIZE)
    assert np.array_equal(renderer.read(), before)
    renderer.release()


@pytest.mark.parametrize("content", ["cut", None])
def test_a_lost_skin_is_drawn_in_a_skins_colour_and_not_white(
    screen: Offscreen, folder: Path, content: str | None
) -> None:
    mesh = head_mesh()
    skin = Material("skin", (1.0, 1.0, 1.0), texture_lost=content is None)
    if content is not None:
        noise = np.random.default_rng(0).integers(0, 256, (64, 64, 3), np.uint8)
        Image.fromarray(noise).save(folder / "skin.jpg")
        (folder / "skin.jpg").write_bytes((folder / "skin.jpg").read_bytes()[:1500])
        skin = replace(skin, texture=folder / "skin.jpg")
    no_shapes = np.zeros((0, mesh.vertex_count, 3), np.float32)
    lost = replace(mesh, materials={**mesh.materials, "skin": skin}, notes=("what is lost",))
    plain = replace(mesh, materials={**mesh.materials, "skin": Material("skin", PLAIN.diffuse)})
    pixels = screen.render(Rig(lost, (), no_shapes), size=(64, 64))
    assert screen.problems[0] == "what is lost"
    assert len(screen.problems) == (1 if content is None else 2)
    assert np.array_equal(pixels, screen.render(Rig(plain, (), no_shapes), size=(64, 64)))
    assert screen.problems == ()
