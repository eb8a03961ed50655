"""Scenes: offsets on both morph paths, the lit-up region, differences, and a partner's colours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facemorph.core.camera import Camera
from facemorph.core.glow import glow_of
from facemorph.core.mesh import Labels, Material, Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.picture import SHADINGS, Look, Shading
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import Partner, Scene
from facemorph.errors import CorrespondenceError, MeshDataError, PoseError
from facemorph.gl import Offscreen, Renderer
from facemorph.gl.colours import encoded
from facemorph.gl.counterpart import corresponding_corners
from tests.gl.heads import head_mesh, head_rig, partner_rig

SIZE = (160, 160)
POSE = Pose.of({"smile": 0.8, "jaw": 0.3})
CLEAR = Look(background=(0.0, 0.0, 0.0, 0.0))


@pytest.fixture
def camera(head: Rig) -> Camera:
    return Camera.framing(head.neutral.bounds, "front", 1.0)


@pytest.fixture(scope="session")
def partner(tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """The test head with darker skin in another picture, whose texture coordinates are others."""
    return partner_rig(tmp_path_factory.mktemp("partner"))


def offsets_of(rig: Rig, size: float = 0.6) -> np.ndarray:
    """A smooth wave through the face, (V, 3)."""
    x, y, z = rig.neutral.positions.T
    wave = np.stack([np.sin(y), np.cos(x * 0.7), np.sin(x + z)], axis=1)
    return (wave * size).astype(np.float32)


def drawn(renderer: Renderer) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions and normals (G, 3) as they would be drawn, and the vertex each belongs to."""
    surface = renderer.surface
    assert surface is not None
    values = np.frombuffer(surface.morphed.read(), np.float32).reshape(-1, 6)
    return values[:, :3], values[:, 3:], surface.position_of


def wearing(rig: Rig, colours: Rig) -> Rig:
    """The shape of one with all colours, materials and texture coordinates of the other."""
    mesh = colours.neutral.with_positions(rig.neutral.positions)
    return Rig(mesh, rig.shapes, rig.deltas, rig.info)


# Offsets


def test_offsets_are_added_to_the_morphed_positions_and_normals_are_of_the_sum(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    for pose, offsets in [
        (POSE, offsets_of(head)),
        (Pose.between("smile", "brows", 0.3, "cosine"), offsets_of(head, -0.4)),
        (Pose(), offsets_of(head)),
        (POSE, None),
    ]:
        scene = Scene(pose, offsets)
        renderer.draw(scene, camera, Look(), SIZE)
        positions, normals, of = drawn(renderer)
        wanted = scene.positions(head)
        assert np.linalg.norm(positions - wanted[of], axis=1).max() < 1e-5 * head.neutral.diagonal
        true = vertex_normals(wanted, head.triangles)[of]
        assert np.einsum("gi,gi->g", normals, true).min() > 1.0 - 1e-4
        assert np.abs(renderer.positions() - wanted).max() < 1e-5 * head.neutral.diagonal


def test_only_other_offsets_or_coefficients_morph(renderer: Renderer, head: Rig, camera: Camera) -> None:
    one, other = offsets_of(head), offsets_of(head, 0.1)
    draws: list[tuple[Scene, int]] = [
        (Scene(POSE, one), 1),
        (Scene(POSE, one), 1),
        (Scene(POSE, one, glow=np.ones(head.neutral.vertex_count, np.float32)), 1),
        (Scene(POSE, one, reference=head.neutral.positions), 1),
        (Scene(POSE, other), 2),
        (Scene(POSE), 3),
        (Scene(Pose.of(POSE.weights)), 3),
        (Scene(Pose(), one), 4),
    ]
    for scene, morphs in draws:
        renderer.draw(scene, camera.orbited(morphs, 0.0), Look(shading="heat"), SIZE)
        assert renderer.stats.morphs == morphs


def test_offsets_are_uploaded_once_while_the_pose_changes(
    ctx: moderngl.Context, head: Rig, camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    renderer = Renderer(ctx, "shader")
    renderer.load(head)
    offsets = offsets_of(head)
    renderer.draw(Scene(POSE, offsets), camera, Look(), SIZE)
    uploads: list[int] = []
    write = moderngl.Texture.write

    def counted(texture: moderngl.Texture, data: bytes, *rest: object) -> None:
        uploads.append(len(data))
        write(texture, data, *rest)

    monkeypatch.setattr(moderngl.Texture, "write", counted)
    for smile in (0.1, 0.5):
        renderer.draw(Scene(POSE.with_weight("smile", smile), offsets), camera, Look(), SIZE)
    assert max(uploads) < 1000, "weights only"
    renderer.draw(Scene(POSE, offsets_of(head, 0.2)), camera, Look(), SIZE)
    assert max(uploads) >= head.neutral.vertex_count * 16
    renderer.release()


def test_a_picture_made_exactly_does_not_depend_on_what_was_drawn_before(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    scene = Scene(POSE, offsets_of(head))
    renderer.draw(scene, camera, Look(), SIZE, exactly=True)
    first = renderer.read()
    for k in range(20):
        renderer.draw(
            Scene(POSE.with_weight("smile", k * 0.05), offsets_of(head, k * 0.1)), camera, Look(), SIZE
        )
    renderer.draw(scene, camera, Look(), SIZE, exactly=True)
    assert np.array_equal(renderer.read(), first)


def test_picking_finds_the_moved_surface(renderer: Renderer, head: Rig, camera: Camera) -> None:
    renderer.draw(Scene(Pose()), camera, Look(), SIZE)
    before = renderer.pick(80.0, 70.0)
    forward = np.zeros_like(head.neutral.positions)
    forward[:, 2] = 2.5
    renderer.draw(Scene(Pose(), forward), camera, Look(), SIZE)
    after = renderer.pick(80.0, 70.0)
    assert before is not None
    assert after is not None
    assert before.distance - after.distance == pytest.approx(2.5, abs=0.5)


def test_a_pose_a_mapping_and_a_bare_scene_are_one(renderer: Renderer, camera: Camera) -> None:
    pictures = []
    for what in (POSE, dict(POSE.weights), Scene(POSE)):
        renderer.draw(what, camera, Look(), SIZE, exactly=True)
        pictures.append(renderer.read())
    assert np.array_equal(pictures[0], pictures[1])
    assert np.array_equal(pictures[0], pictures[2])


def test_scenes_that_do_not_fit_are_refused_and_the_face_stays(
    renderer: Renderer, head: Rig, partner: Rig, camera: Camera
) -> None:
    renderer.draw(Scene(POSE), camera, Look(), SIZE)
    before = renderer.read()
    few = np.zeros((3, 3), np.float32)
    endless = np.full_like(head.neutral.positions, np.inf)
    refused: list[tuple[Scene, type[Exception], str]] = [
        (Scene(POSE, offsets=few), MeshDataError, "offsets"),
        (Scene(POSE, glow=few), MeshDataError, "glow"),
        (Scene(POSE, reference=few), MeshDataError, "reference"),
        (Scene(POSE, offsets=endless), PoseError, "offsets"),
        (Scene(POSE, reference=endless), PoseError, "reference"),
        (Scene(POSE, glow=endless[:, 0]), PoseError, "glow"),
        (Scene(POSE, partners=(Partner(partner, float("nan")),)), PoseError, "weights must be"),
        (Scene(POSE, partners=(Partner(head_rig(rows=20), 0.5),)), CorrespondenceError, "vertices"),
    ]
    for scene, error, words in refused:
        with pytest.raises(error, match=words):
            renderer.draw(scene, camera, Look(), SIZE)
    renderer.draw(Scene(POSE), camera, Look(), SIZE)
    assert np.array_equal(renderer.read(), before)
    assert renderer.stats.morphs == 1


def test_a_partner_with_its_polygons_turned_over_is_refused(
    renderer: Renderer, head: Rig, partner: Rig, camera: Camera
) -> None:
    mesh = partner.neutral
    turned = mesh.corner_vertices.reshape(-1, 4)[:, ::-1].ravel().copy()
    other = Rig(replace(mesh, corner_vertices=turned), partner.shapes, partner.deltas, partner.info)
    with pytest.raises(CorrespondenceError, match="turned over"):
        renderer.draw(Scene(Pose(), partners=(Partner(other, 0.0),)), camera, Look(), SIZE)


# The lit-up region


@pytest.mark.parametrize("shading", ["skin", "clay", "wire"])
@pytest.mark.parametrize("tone", [(0.72, 0.50, 0.40), (0.065, 0.032, 0.02)], ids=["pale", "dark"])
def test_a_region_lights_up_on_pale_and_dark_skin_and_nowhere_else(
    screen: Offscreen, head: Rig, shading: Shading, tone: tuple[float, float, float]
) -> None:
    materials = {"skin": Material("skin", tone), "eye": Material("eye", (0.7, 0.7, 0.7))}
    rig = Rig(replace(head.neutral, materials=materials), head.shapes, head.deltas, head.info)
    look = Look(shading=shading)
    glow = glow_of(rig, {"smile": 1.0})
    plain = screen.render(rig, Scene(Pose()), size=SIZE, look=look).astype(int)
    lit = screen.render(rig, Scene(Pose(), glow=glow), size=SIZE, look=look).astype(int)
    change = np.abs(lit - plain).max(axis=2)
    camera = Camera.framing(rig.neutral.bounds, "front", 1.0)
    most = rig.neutral.positions[glow > 0.9]
    clip = np.concatenate([most, np.ones((len(most), 1))], axis=1) @ camera.clip_from_model(1.0).T
    x, y = ((clip[:, 0] / clip[:, 3] + 1) * 80).astype(int), ((1 - clip[:, 1] / clip[:, 3]) * 80).astype(int)
    assert np.median(change[y, x]) > 20
    bluer = (lit[..., 2] - lit[..., 0] - plain[..., 2] + plain[..., 0])[y, x]
    assert np.median(bluer) > 15, "in the accent's hue"
    assert change[:60].max() == 0, "the forehead stays"
    assert 0.005 < (change > 6).mean() < 0.15


@pytest.mark.parametrize("shading", SHADINGS)
def test_no_light_anywhere_is_no_light(screen: Offscreen, head: Rig, shading: Shading) -> None:
    look = Look(shading=shading)
    dark = Scene(POSE, glow=np.zeros(head.neutral.vertex_count, np.float32))
    full = Scene(POSE, glow=np.ones(head.neutral.vertex_count, np.float32))
    plain = screen.render(head, POSE, size=SIZE, look=look)
    assert np.abs(screen.render(head, dark, size=SIZE, look=look).astype(int) - plain).max() <= 1
    unlit = np.array_equal(screen.render(head, full, size=SIZE, look=look), plain)
    assert unlit == (shading in ("normals", "heat")), "those show numbers, which light would falsify"


def test_light_that_moves_on_is_seen_and_goes_out(renderer: Renderer, head: Rig, camera: Camera) -> None:
    pictures = []
    for glow in (None, glow_of(head, {"smile": 1}), glow_of(head, {"brows": 1}), None):
        renderer.draw(Scene(Pose(), glow=glow), camera, Look(), SIZE)
        pictures.append(renderer.read())
    assert np.array_equal(pictures[0], pictures[3])
    changed = [np.flatnonzero((picture != pictures[0]).any(axis=(1, 2))).mean() for picture in pictures[1:3]]
    assert changed[0] > changed[1] + 20, "first the mouth, then the brows"


# Differences


def test_heat_measures_from_the_reference(screen: Offscreen, head: Rig) -> None:
    look = Look(shading="heat")
    screen.render(head, POSE, size=SIZE, look=look)
    assert screen.renderer.legend is not None
    assert screen.renderer.legend.title == "Displacement"
    still = screen.render(head, Pose(), size=SIZE, look=look, legend=False)
    same = Scene(POSE, reference=head.positions(POSE))
    level = screen.render(head, same, size=SIZE, look=look, legend=False)
    assert screen.renderer.legend is not None
    assert screen.renderer.legend.title == "Difference"
    cool = screen.renderer.legend.colours[0].astype(int)
    middle = level[30:130, 60:100, :3].astype(int)
    assert np.ptp(middle @ [1, -1, 0]) < 40, "one hue"
    assert np.argmax(middle.mean(axis=(0, 1))) == np.argmax(cool)
    assert not np.array_equal(still, level), "the form is the pose's"
    ahead = replace(same, reference=head.positions(POSE) + np.float32(0.5))
    screen.render(head, ahead, size=SIZE, look=look)
    assert screen.renderer.legend.high == pytest.approx(0.5 * 3**0.5, rel=0.4)
    screen.render(head, Pose(), size=SIZE, look=look)
    assert np.array_equal(screen.render(head, Pose(), size=SIZE, look=look, legend=False), still)


def test_two_methods_alike_differ_nowhere_and_unlike_where_they_do(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    moved = np.where(head.neutral.positions[:, 1:2] < -2.0, np.float32(0.4), np.float32(0.0))
    scene = Scene(POSE, np.broadcast_to(moved, (len(moved), 3)).copy(), reference=head.positions(POSE))
    renderer.draw(scene, camera, Look(shading="heat", heat_max=0.4), SIZE)
    pixels = renderer.read().astype(int)
    assert pixels[60, 80, 2] > pixels[60, 80, 0], "cool above"
    assert pixels[125, 80, 0] > pixels[125, 80, 2] + 40, "hot below"


# A partner's colours


@pytest.mark.parametrize("quality", ["full", "fast"])
def test_at_0_it_is_the_face_itself_and_at_1_it_has_the_partners_colours(
    renderer: Renderer, ctx: moderngl.Context, head: Rig, partner: Rig, camera: Camera, quality: str
) -> None:
    scene = Scene(POSE, offsets_of(head, 0.1))
    pictures = []
    renderer.draw(scene, camera, Look(), SIZE, quality=quality, exactly=True)
    pictures.append(renderer.read())
    for s in (0.0, 1.0):
        renderer.draw(replace(scene, partners=(Partner(partner, s),)), camera, Look(), SIZE, quality=quality)
        pictures.append(renderer.read())
    alone = Renderer(ctx, renderer.path)
    alone.load(wearing(head, partner))
    alone.draw(scene, camera, Look(), SIZE, quality=quality)
    assert np.array_equal(pictures[1], pictures[0])
    assert np.abs(pictures[2].astype(int) - alone.read()).max() <= 1
    assert np.abs(pictures[2].astype(int) - pictures[0]).max() > 60
    alone.release()


def test_each_colour_is_looked_up_at_its_own_coordinate(screen: Offscreen, head: Rig, tmp_path: Path) -> None:
    """The face's own picture mirrored, with texture coordinates mirrored: blending changes nothing."""
    path = head.neutral.materials["skin"].texture
    assert path is not None
    mirrored = tmp_path / "mirrored.png"
    Image.open(path).transpose(Image.Transpose.FLIP_LEFT_RIGHT).save(mirrored)
    uvs = head.neutral.uvs * np.float32([-1, 1]) + np.float32([1, 0])
    order = np.random.default_rng(1).permutation(len(uvs))
    assert head.neutral.corner_uvs is not None
    mesh = replace(
        head.neutral,
        uvs=uvs[order],
        corner_uvs=np.argsort(order)[head.neutral.corner_uvs].astype(np.int32),
        materials={**head.neutral.materials, "skin": Material("skin", (1, 1, 1), texture=mirrored)},
    )
    own = screen.render(head, POSE, size=SIZE).astype(int)
    for s in (0.3, 1.0):
        scene = Scene(POSE, partners=(Partner(Rig(mesh, head.shapes, head.deltas), s),))
        assert np.abs(screen.render(head, scene, size=SIZE) - own).max() <= 2


def test_polygons_in_another_order_that_begin_elsewhere_lend_the_same_colours(
    screen: Offscreen, head: Rig, partner: Rig
) -> None:
    mesh = partner.neutral
    random = np.random.default_rng(2)
    order = random.permutation(mesh.polygon_count)
    turn = (random.integers(0, 4, mesh.polygon_count)[:, None] + np.arange(4)) % 4
    corners = np.take_along_axis(np.arange(len(mesh.corner_vertices)).reshape(-1, 4), turn, axis=1)[order]
    assert mesh.materials_used is not None
    assert mesh.corner_uvs is not None
    other = replace(
        mesh,
        corner_vertices=mesh.corner_vertices[corners.ravel()],
        corner_uvs=mesh.corner_uvs[corners.ravel()],
        materials_used=Labels(mesh.materials_used.names, mesh.materials_used.index[order]),
    )
    pictures = [
        screen.render(
            head, Scene(POSE, partners=(Partner(Rig(m, partner.shapes, partner.deltas), 0.6),)), size=SIZE
        )
        for m in (mesh, other)
    ]
    assert np.array_equal(pictures[0], pictures[1])
    found = corresponding_corners(mesh, other)
    assert np.array_equal(other.corner_vertices[found], mesh.corner_vertices)
    assert len(np.unique(found)) == len(found)


def test_seams_that_lie_elsewhere_split_vertices_by_both(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    """A partner none of whose polygons share a texture coordinate, each a hair from the face's own."""
    mesh = head.neutral
    assert mesh.corner_uvs is not None
    corners = np.arange(len(mesh.corner_uvs), dtype=np.int32)
    shifts = (1e-6 * (corners[:, None] % 97 + 1)).astype(np.float32)
    loose = replace(mesh, uvs=mesh.uvs[mesh.corner_uvs] + shifts, corner_uvs=corners)
    renderer.draw(POSE, camera, Look(), SIZE, exactly=True)
    own, count = renderer.read(), len(drawn(renderer)[2])
    scene = Scene(POSE, partners=(Partner(Rig(loose, head.shapes, head.deltas), 0.5),))
    renderer.draw(scene, camera, Look(), SIZE, exactly=True)
    positions, _, of = drawn(renderer)
    assert len(of) > 2 * count
    assert np.abs(positions - scene.positions(head)[of]).max() < 1e-5 * head.neutral.diagonal
    assert np.abs(renderer.read().astype(int) - own).max() <= 2
    renderer.draw(replace(scene, partners=()), camera, Look(), SIZE, exactly=True)
    assert np.array_equal(renderer.read(), own)


def test_sliding_s_uploads_and_morphs_nothing(
    renderer: Renderer, head: Rig, partner: Rig, camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    offsets = offsets_of(head)
    scene = Scene(POSE, offsets, glow=glow_of(head, {"smile": 1.0}))
    renderer.draw(replace(scene, partners=(Partner(partner, 0.2),)), camera, Look(), SIZE)
    morphs, partners = renderer.stats.morphs, renderer.stats.partners
    written: list[str] = []
    for kind in (moderngl.Buffer, moderngl.Texture):
        monkeypatch.setattr(kind, "write", lambda self, *a, **k: written.append(type(self).__name__))
    monkeypatch.setattr(renderer.ctx, "buffer", lambda *a, **k: written.append("new"), raising=False)
    pictures = []
    for s in (0.3, 0.6, 1.0):
        renderer.draw(replace(scene, partners=(Partner(partner, s),)), camera, Look(), SIZE)
        pictures.append(renderer.read())
    renderer.draw(scene, camera, Look(), SIZE)
    assert not written
    assert (renderer.stats.morphs, renderer.stats.partners) == (morphs, partners)
    assert not np.array_equal(pictures[0], pictures[1])


Sides = tuple[Rig, Rig]


def _plain(colour: tuple[float, float, float], opacity: float = 1.0, **changes: object) -> Rig:
    """A square facing +Z of one colour."""
    corners = np.array([[x, y, 0.0] for y in (-1, 1) for x in (-1, 1)], np.float32)
    mesh = Mesh.from_polygons(corners, np.array([[0, 1, 3, 2]], np.int32))
    mesh = replace(
        mesh,
        uvs=corners[:, :2] * 0.4 + 0.5,
        corner_uvs=np.array([0, 1, 3, 2], np.int32),
        materials_used=Labels(("cloth",), np.zeros(1, np.int32)),
        materials={"cloth": Material("cloth", colour, opacity=opacity)},
        **changes,
    )
    return Rig(mesh, (), np.zeros((0, 4, 3), np.float32))


def _coloured(stored: tuple[int, int, int]) -> Rig:
    colours = np.tile(np.float32(stored) / np.float32(255), (4, 1))
    return _plain((0.3, 0.3, 0.3), colours=colours)


def _textured(folder: Path, stored: tuple[int, int, int]) -> Rig:
    path = folder / f"{stored}.png"
    Image.new("RGB", (8, 8), stored).save(path)
    rig = _plain((1.0, 1.0, 1.0))
    materials = {"cloth": Material("cloth", (1.0, 1.0, 1.0), texture=path)}
    return Rig(replace(rig.neutral, materials=materials), (), rig.deltas)


def _linear(stored: int) -> float:
    c = stored / 255
    return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878)


PALE, DARK, HALF = (220, 180, 160), (40, 60, 100), (130, 120, 130)
FACING = Camera(distance=4.0, scene_radius=1.5)
KINDS: dict[str, Callable[[Path, tuple[int, int, int]], Rig]] = {
    "texture": _textured,
    "vertex colours": lambda folder, stored: _coloured(stored),
    "diffuse colour": lambda folder, stored: _plain(tuple(_linear(v) for v in stored)),
}


@pytest.mark.parametrize("own", KINDS)
@pytest.mark.parametrize("other", KINDS)
def test_colours_of_every_kind_blend_as_they_are_stored(
    screen: Offscreen, folder: Path, own: str, other: str
) -> None:
    pale, dark = KINDS[own](folder, PALE), KINDS[other](folder, DARK)
    half = KINDS["texture"](folder, HALF)
    for s, alone in ((0.0, pale), (0.5, half), (1.0, dark)):
        mixed = screen.render(pale, Scene(Pose(), partners=(Partner(dark, s),)), size=(40, 40), camera=FACING)
        wanted = screen.render(alone, {}, size=(40, 40), camera=FACING)
        assert np.abs(mixed.astype(int) - wanted).max() <= 1, s


def test_encoding_undoes_the_shaders_decoding() -> None:
    for stored in range(0, 256, 5):
        assert encoded(_linear(stored)) * 255 == pytest.approx(stored, abs=1e-4)
    assert encoded(-1.0) == 0.0


def test_a_partner_seen_through_lets_the_backdrop_through_by_its_share(screen: Offscreen) -> None:
    solid, glass = _plain((0.5, 0.4, 0.3)), _plain((0.5, 0.4, 0.3), opacity=0.2)
    for s, alpha in ((0.0, 255), (0.5, 153), (1.0, 51)):
        scene = Scene(Pose(), partners=(Partner(glass, s),))
        pixels = screen.render(solid, scene, size=(40, 40), camera=FACING, look=CLEAR)
        assert abs(int(pixels[20, 20, 3]) - alpha) <= 1


def test_what_a_cut_out_hides_lends_no_colour(screen: Offscreen, folder: Path) -> None:
    """Under a texture's clear texels lies black, as painters leave it; it must not darken the mixture."""
    path = folder / "clear.png"
    Image.new("RGBA", (8, 8), (0, 0, 0, 0)).save(path)
    rig = _plain((1.0, 1.0, 1.0))
    clear = Rig(
        replace(rig.neutral, materials={"cloth": Material("cloth", (1, 1, 1), texture=path)}), (), rig.deltas
    )
    own = _textured(folder, PALE)
    alone = screen.render(own, {}, size=(40, 40), camera=FACING, look=CLEAR)
    mixed = screen.render(
        own, Scene(Pose(), partners=(Partner(clear, 0.5),)), size=(40, 40), camera=FACING, look=CLEAR
    )
    assert abs(int(mixed[20, 20, 3]) - 128) <= 1
    assert np.abs(mixed[20, 20, :3].astype(int) - alone[20, 20, :3]).max() <= 3


def test_s_beyond_its_ends_is_taken_for_them(screen: Offscreen, head: Rig, partner: Rig) -> None:
    for beyond, end in ((-0.5, 0.0), (1.7, 1.0)):
        scenes = [Scene(POSE, partners=(Partner(partner, s),)) for s in (beyond, end)]
        pictures = [screen.render(head, scene, size=SIZE) for scene in scenes]
        assert np.array_equal(pictures[0], pictures[1])


def test_a_partners_texture_that_cannot_be_read_is_told(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    materials = {"skin": Material("skin", (0.1, 0.2, 0.3), texture=Path("/nowhere/at-all.png"))}
    other = Rig(replace(head.neutral, materials=materials), head.shapes, head.deltas)
    renderer.draw(Scene(POSE, partners=(Partner(other, 0.5),)), camera, Look(), SIZE)
    assert [("at-all.png" in problem) for problem in renderer.problems] == [True]
    renderer.draw(Scene(POSE, partners=(Partner(head_rig(), 0.5),)), camera, Look(), SIZE)
    assert not renderer.problems, "of a partner that is gone nothing is told"


def test_partners_come_and_go_and_the_face_is_itself_again(
    renderer: Renderer, head: Rig, partner: Rig, camera: Camera
) -> None:
    renderer.draw(POSE, camera, Look(), SIZE, exactly=True)
    own = renderer.read()
    second = head_rig()
    for other in (partner, second, partner):
        renderer.draw(Scene(POSE, partners=(Partner(other, 1.0),)), camera, Look(), SIZE)
        renderer.draw(POSE, camera, Look(), SIZE, exactly=True)
        assert np.array_equal(renderer.read(), own)
    assert renderer.stats.partners == 3


def test_partner_colours_show_in_skin_only(screen: Offscreen, head: Rig, partner: Rig) -> None:
    for shading in ("clay", "wire", "normals", "heat"):
        look = Look(shading=shading)
        own = screen.render(head, POSE, size=SIZE, look=look)
        assert np.array_equal(
            screen.render(head, Scene(POSE, partners=(Partner(partner, 1.0),)), size=SIZE, look=look), own
        )


# Two views


def test_two_renderers_in_one_context_do_not_disturb_each_other(
    ctx: moderngl.Context, head: Rig, partner: Rig, camera: Camera
) -> None:
    scenes = [
        Scene(POSE, offsets_of(head), partners=(Partner(partner, 0.5),)),
        Scene(Pose(), glow=glow_of(head, {"jaw": 1})),
    ]
    alone = []
    for scene in scenes:
        one = Renderer(ctx)
        one.load(head)
        one.draw(scene, camera, Look(), SIZE)
        alone.append(one.read())
        one.release()
    views = [Renderer(ctx), Renderer(ctx)]
    for view in views:
        view.load(head)
    for turn in (20.0, 10.0, 0.0):
        for view, scene in zip(views, scenes, strict=True):
            view.draw(scene, camera.orbited(turn, 0.0), Look(), SIZE)
    for view, picture in zip(views, alone, strict=True):
        assert np.array_equal(view.read(), picture)
        assert view.stats.morphs == 1, "turning both cameras morphs neither"
    for view in views:
        view.release()


def test_the_heads_of_these_tests_differ_in_their_coordinates(head: Rig, partner: Rig) -> None:
    own, other = head_mesh(), partner.neutral
    assert np.array_equal(own.corner_vertices, other.corner_vertices)
    assert own.corner_uvs is not None
    assert other.corner_uvs is not None
    assert not np.array_equal(own.uvs[own.corner_uvs], other.uvs[other.corner_uvs])
    assert not np.array_equal(head.neutral.materials["eye"], other.materials["eye"])
