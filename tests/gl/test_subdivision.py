"""A refined surface is drawn: numpy's refined face in both morph paths, and nothing more per frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from facemorph.core import subdivision
from facemorph.core.camera import Camera
from facemorph.core.correctives import Corrective, Hat
from facemorph.core.mesh import Labels, Mesh
from facemorph.core.normals import vertex_normals
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.refinement import Refinement
from facemorph.core.rig import Rig
from facemorph.core.scene import Partner, Scene
from facemorph.errors import OptionError
from facemorph.gl import Offscreen, Renderer
from facemorph.gl import renderer as renderer_module
from facemorph.gl.draw_clock import DrawClock
from facemorph.gl.form import Form
from facemorph.gl.surface import Surface
from tests.gl.heads import head_mesh, many_shapes

SIZE = (160, 128)
COUNT = 24
RULES = (
    Corrective("s21", ("s1", "s2")),
    Corrective("s22", hats=(Hat("s2"),)),
    Corrective("s23", ("s4",), (Hat("s9", -0.5, 0.4, 0.9),)),
)
POSES = {
    "neutral": Pose(),
    "all, of both signs": Pose.of({f"s{k}": (-1.0) ** k * 0.4 for k in range(COUNT)}),
    "mixtures on their way": Pose(
        {"s1": 1.0, "s4": -0.5}, {"s4": 1.7, "s9": 0.6}, 0.65, "cosine", {"s1": -0.4, "s20": 2.5}
    ),
}
levels = pytest.mark.parametrize("level", [1, 2])


@pytest.fixture
def camera(head: Rig) -> Camera:
    return Camera.framing(head.neutral.bounds, "three-quarter", SIZE[0] / SIZE[1])


@pytest.fixture(params=["cpu", "shader"])
def many(ctx: moderngl.Context, request: pytest.FixtureRequest) -> Iterator[Renderer]:
    """A renderer of a head of many shapes, some of them correctives."""
    made = Renderer(ctx, request.param)
    made.load(replace(many_shapes(COUNT), correctives=RULES))
    yield made
    made.release()


def drawn(renderer: Renderer) -> tuple[np.ndarray, np.ndarray, Surface]:
    """Positions and normals (G, 3) as they are drawn, and the surface."""
    surface = renderer.surface
    assert surface is not None
    values = np.frombuffer(surface.morphed.read(), np.float32).reshape(-1, 6)
    return values[:, :3], values[:, 3:], surface


@levels
@pytest.mark.parametrize("pose", POSES.values(), ids=POSES.keys())
@pytest.mark.parametrize("offset", [False, True], ids=["", "with offsets"])
def test_what_is_drawn_is_the_refined_face_of_numpy(
    many: Renderer, pose: Pose, level: int, offset: bool
) -> None:
    rig, _ = many._loaded()
    offsets = (np.sin(rig.neutral.positions[:, ::-1]) * 0.4).astype(np.float32) if offset else None
    scene = Scene(pose, offsets)
    camera = Camera.framing(rig.neutral.bounds, "front", 1.25)
    many.draw(scene, camera, Look(subdivision=level), SIZE)
    positions, normals, surface = drawn(many)
    refinement = Refinement.of(rig.neutral, level)
    wanted = refinement.apply(scene.positions(rig).astype(np.float64))
    away = np.linalg.norm(positions - wanted[surface.position_of], axis=1)
    assert away.max() < 1e-5 * rig.neutral.diagonal
    exact = vertex_normals(wanted.astype(np.float32), surface.triangles.vertices)[surface.position_of]
    assert (np.einsum("gi,gi->g", normals, exact) > np.cos(np.radians(2.0))).mean() >= 0.99
    assert surface.mesh.vertex_count == refinement.fine.vertex_count


def test_a_frame_of_a_refined_face_morphs_only_what_a_plain_one_does(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    look = Look(subdivision=1)
    renderer.draw({"smile": 1.0}, camera, look, SIZE)
    morphs = renderer.stats.morphs
    first = drawn(renderer)[0].copy()
    for turn in range(4):
        renderer.draw({"smile": 1.0}, camera.orbited(10.0 * turn, 0.0), look, SIZE)
    assert renderer.stats.morphs == morphs
    assert np.array_equal(drawn(renderer)[0], first)


def test_a_level_is_made_once_and_the_files_own_stays_beside_it(
    renderer: Renderer, head: Rig, camera: Camera
) -> None:
    plain = picture(renderer, camera, Look())
    surfaces = []
    for level in (0, 1, 0, 1, 2, 0):
        renderer.draw(Pose(), camera, Look(subdivision=level), SIZE, exactly=True)
        surfaces.append(renderer.surface)
    assert surfaces[0] is surfaces[2] is surfaces[5]
    assert surfaces[1] is surfaces[3]
    assert sorted(renderer._stages) == [0, 2], "one refined surface at a time"
    assert np.array_equal(picture(renderer, camera, Look()), plain)


def picture(renderer: Renderer, camera: Camera, look: Look, scene: Scene | None = None) -> np.ndarray:
    renderer.draw(scene or Pose.of({"smile": 0.7}), camera, look, SIZE, exactly=True)
    return renderer.read().copy()


def test_a_form_made_elsewhere_is_drawn_as_it_is(
    renderer: Renderer, head: Rig, camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    form = Form.of(head.neutral, 1, ahead=renderer.graphics)
    other = Form.of(head_mesh(), 2)
    wanted = picture(renderer, camera, Look(subdivision=1))
    renderer.load(head)

    def none_made(*_: object, **__: object) -> Form:
        raise AssertionError("a form is made in the frame")

    monkeypatch.setattr(renderer_module.Form, "of", none_made)
    renderer.take(form)
    renderer.take(other)
    assert np.array_equal(picture(renderer, camera, Look(subdivision=1)), wanted)
    with pytest.raises(AssertionError, match="in the frame"):
        picture(renderer, camera, Look(subdivision=2))
    # The same head with other shapes keeps what was made of it.
    renderer.load(replace(head, shapes=head.shapes[:1], deltas=head.deltas[:1]))
    assert np.array_equal(picture(renderer, camera, Look(subdivision=1)), wanted)


def test_both_paths_make_the_same_picture(ctx: moderngl.Context, head: Rig, camera: Camera) -> None:
    pictures = []
    for path in ("cpu", "shader"):
        made = Renderer(ctx, path)  # type: ignore[arg-type]
        made.load(head)
        pictures.append(picture(made, camera, Look(subdivision=2)).astype(int))
        made.release()
    assert (np.abs(pictures[0] - pictures[1]) > 8).any(axis=2).mean() < 0.002


def test_picking_and_measuring_stay_with_the_file(renderer: Renderer, head: Rig, camera: Camera) -> None:
    found = []
    for level in (0, 1, 2):
        renderer.draw({"jaw": 1.0}, camera, Look(subdivision=level), SIZE)
        found.append(renderer.pick(SIZE[0] / 2, SIZE[1] / 2))
        assert renderer.positions().shape == head.neutral.positions.shape
    assert found[0] is not None
    assert found == [found[0]] * 3


@levels
def test_what_comes_by_vertex_is_refined_with_the_mesh(
    renderer: Renderer, head: Rig, camera: Camera, level: int
) -> None:
    glow = (head.neutral.positions[:, 1] > 0.0).astype(np.float32)
    reference = head.neutral.positions + np.float32(0.3)
    renderer.draw(Scene(Pose(), glow=glow), camera, Look(subdivision=level), SIZE)
    scene = Scene(Pose(), reference=reference)
    renderer.draw(scene, camera, Look(shading="heat", subdivision=level), SIZE)
    surface = renderer.surface
    assert surface is not None
    refined = Refinement.of(head.neutral, level).apply
    for name, values in (("glow", glow), ("reference", reference)):
        held = np.frombuffer(surface._buffer(name).read(), np.float32).reshape(surface.drawn_count, -1)
        wanted = refined(values).reshape(-1, held.shape[1])[surface.position_of]
        assert np.allclose(held, wanted, atol=1e-5)


def shuffled(mesh: Mesh) -> Mesh:
    """The same face, its polygons in another order and begun at other corners."""
    rng = np.random.default_rng(5)
    order = rng.permutation(mesh.polygon_count)
    corners = (order[:, None] * 4 + (rng.integers(0, 4, len(order))[:, None] + np.arange(4)) % 4).ravel()
    labels = mesh.materials_used
    assert labels is not None
    assert mesh.corner_uvs is not None
    return replace(
        mesh,
        corner_vertices=mesh.corner_vertices[corners],
        corner_uvs=mesh.corner_uvs[corners],
        materials_used=Labels(labels.names, labels.index[order]),
    )


@levels
def test_partners_are_refined_whatever_the_order_of_their_polygons(
    renderer: Renderer, head: Rig, camera: Camera, level: int
) -> None:
    colours = np.abs(np.sin(head.neutral.positions)).astype(np.float32)
    turned = replace(head.neutral, uvs=head.neutral.uvs[:, ::-1].copy(), colours=colours)
    pictures = []
    for mesh in (turned, shuffled(turned)):
        scene = Scene(Pose(), partners=(Partner(replace(head, neutral=mesh), 0.6),))
        pictures.append(picture(renderer, camera, Look(subdivision=level), scene))
    own = picture(renderer, camera, Look(subdivision=level), Scene(Pose()))
    assert (pictures[0] != own).any(axis=2).mean() > 0.05
    assert np.array_equal(*pictures)


@levels
def test_lines_are_the_files_polygons(renderer: Renderer, head: Rig, camera: Camera, level: int) -> None:
    def lines(at: int) -> int:
        renderer.draw(Pose(), camera, Look(shading="wire", subdivision=at), SIZE)
        assert renderer.surface is not None
        bits = np.frombuffer(renderer.surface.polygon_edges().read(), np.uint8)
        return int(np.unpackbits(bits).sum())

    assert lines(level) == lines(0) * 2**level


def test_an_outline_grows_rounder(screen: Offscreen) -> None:
    ring = np.arange(8) / 8 * 2 * np.pi
    tall = np.array([-1.0, 0.0, 1.0])
    points = np.stack([np.tile(np.cos(ring), 3), np.tile(np.sin(ring), 3), np.repeat(tall, 8)], 1)
    quads = [
        [8 * z + k, 8 * z + (k + 1) % 8, 8 * z + 8 + (k + 1) % 8, 8 * z + 8 + k]
        for z in (0, 1)
        for k in range(8)
    ]
    rig = Rig.from_arrays(Mesh.from_polygons(points.astype(np.float32), np.array(quads, np.int32)), {})
    uneven = []
    for level in (0, 1, 2):
        look = Look("clay", background=(0.0, 0.0, 0.0, 0.0), subdivision=level)
        pixels = screen.render(rig, size=(256, 256), camera="front", look=look)
        y, x = np.nonzero(pixels[..., 3] > 127)
        away = np.hypot(x - x.mean(), y - y.mean())
        sector = np.digitize(np.arctan2(y - y.mean(), x - x.mean()), np.linspace(-np.pi, np.pi, 33)[1:-1])
        radius = np.array([away[sector == k].max() for k in range(32)])
        uneven.append(radius.std() / radius.mean())
    assert uneven[1] < 0.5 * uneven[0]
    assert uneven[2] < uneven[1]


def test_what_cannot_be_drawn_leaves_what_was(
    renderer: Renderer, head: Rig, camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = picture(renderer, camera, Look(subdivision=1))
    monkeypatch.setattr(subdivision, "MOST_VERTICES", 100)
    for level, words in ((2, "at most 100 vertices"), (3, "0 to 2 levels, not 3")):
        with pytest.raises(OptionError, match=words):
            renderer.draw(Pose(), camera, Look(subdivision=level), SIZE)
    assert np.array_equal(picture(renderer, camera, Look(subdivision=1)), before)


def test_a_frames_drawing_is_timed_one_frame_later(ctx: moderngl.Context) -> None:
    clock = DrawClock(ctx)
    target = ctx.simple_framebuffer((8, 8))
    for _ in range(2):
        with clock.running():
            target.clear(1.0)
    assert clock.secs is not None
    assert clock.secs >= 0.0
    target.release()
