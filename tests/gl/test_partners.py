"""Colours of several people in one face: the sum of what each has, looked up at its own coordinates."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import Image

from facemorph.core.camera import Camera
from facemorph.core.mesh import Labels, Material
from facemorph.core.picture import Look
from facemorph.core.pose import Pose
from facemorph.core.rig import Rig
from facemorph.core.scene import MOST_PARTNERS, Partner, Scene
from facemorph.deform.controls import Controls, PeopleControl
from facemorph.deform.people import PeopleMix
from facemorph.errors import CorrespondenceError, PoseError
from facemorph.gl import Offscreen, Renderer
from facemorph.gl.colours import blended_opacity
from facemorph.ui.methods import OWN, Methods
from facemorph.ui.state import App, Face
from tests.gl.heads import head_rig
from tests.gl.test_scenes import FACING, KINDS, POSE, SIZE, drawn

EYES = ((0.75, 0.78, 0.80), (0.20, 0.10, 0.05), (0.10, 0.25, 0.50), (0.05, 0.30, 0.10))


def painted(head: Rig, folder: Path, pixels: np.ndarray, name: str, eye: tuple[float, float, float]) -> Rig:
    """The test head with another skin, pixels (H, W, 3), and eyes of a plain colour."""
    path = folder / f"{name}.png"
    Image.fromarray(pixels.round().astype(np.uint8)).save(path)
    materials = {"skin": Material("skin", (1.0, 1.0, 1.0), texture=path), "eye": Material("eye", eye)}
    mesh = replace(head.neutral, materials=materials)
    return Rig(mesh, head.shapes, head.deltas, replace(head.info, name=name))


def turned(rig: Rig, folder: Path, by: float) -> Rig:
    """The same looks by another picture: its texels turned round the head, and the coordinates with them."""
    path = rig.neutral.materials["skin"].texture
    assert path is not None
    pixels = np.asarray(Image.open(path))
    rolled = folder / f"turned-{path.name}"
    Image.fromarray(np.roll(pixels, round(-by * pixels.shape[1]), axis=1)).save(rolled)
    materials = {**rig.neutral.materials, "skin": Material("skin", (1.0, 1.0, 1.0), texture=rolled)}
    uvs = rig.neutral.uvs - np.array([by, 0.0], np.float32)
    return Rig(replace(rig.neutral, uvs=uvs, materials=materials), rig.shapes, rig.deltas, rig.info)


def skins(count: int) -> list[np.ndarray]:
    """Smooth pictures (128, 128, 3), each unlike the others and without a seam at the sides."""
    v, u = np.mgrid[0:128, 0:128] / 128.0
    found = []
    for k in range(count):
        waves = [np.sin(2 * np.pi * ((k + 1) * u + c / 3)) * np.cos(np.pi * (k + 2) * v) for c in range(3)]
        found.append(np.stack(waves, axis=-1) * 40.0 + 70.0 + 110.0 * ((k * 0.37) % 1.0))
    return found


@pytest.fixture(scope="session")
def pictures() -> list[np.ndarray]:
    return [picture.round() for picture in skins(MOST_PARTNERS + 1)]


@pytest.fixture(scope="session")
def people(head: Rig, tmp_path_factory: pytest.TempPathFactory, pictures: list[np.ndarray]) -> list[Rig]:
    """Nine people of one head, each with skin and eyes of their own."""
    folder = tmp_path_factory.mktemp("people")
    return [painted(head, folder, picture, f"person {k}", EYES[k % 4]) for k, picture in enumerate(pictures)]


@pytest.fixture
def camera(head: Rig) -> Camera:
    return Camera.framing(head.neutral.bounds, "front", 1.0)


def mixed(people: list[Rig], weights: list[float]) -> Scene:
    """The first person with the others' colours by their weights."""
    pairs = zip(people[1:], weights, strict=True)
    return Scene(POSE, partners=tuple(Partner(rig, weight) for rig, weight in pairs))


def far(one: np.ndarray, other: np.ndarray) -> int:
    return int(np.abs(one.astype(int) - other).max())


@pytest.mark.parametrize("count", [2, 3, 6, MOST_PARTNERS + 1])
@pytest.mark.parametrize("own_coordinates", [False, True], ids=["shared coordinates", "own coordinates"])
def test_the_skin_is_the_sum_of_everybodys_pictures(
    screen: Offscreen, head: Rig, people: list[Rig], pictures: list[np.ndarray], folder: Path, count: int,
    own_coordinates: bool,
) -> None:  # fmt: skip
    """Mixed on the card against one picture mixed in numpy."""
    weights = np.random.default_rng(count).dirichlet(np.ones(count))
    kept = people[:count]
    if own_coordinates:
        kept = [kept[0], *(turned(rig, folder, k / 8) for k, rig in enumerate(kept[1:], start=1))]
    whole = np.einsum("k,khwc->hwc", weights, np.stack(pictures[:count]))
    wanted = painted(head, folder, whole, "whole", EYES[0])
    skin = screen.render(wanted, POSE, size=SIZE).astype(int)
    found = screen.render(kept[0], mixed(kept, weights[1:].tolist()), size=SIZE)
    eyes = screen.render(painted(head, folder, whole, "other eyes", (0, 0, 0)), POSE, size=SIZE)
    away = np.abs(found.astype(int) - skin).max(axis=2)[(eyes == skin).all(axis=2)]
    assert away.max() <= 2


def test_three_peoples_eyes_are_the_sum_of_what_they_store(screen: Offscreen, folder: Path) -> None:
    """Each of another kind: texture, vertex colours, diffuse colour; in every place."""
    stored = np.array([(220, 180, 160), (40, 60, 100), (90, 200, 30)])
    weights = np.array([0.5, 0.3, 0.2])
    wanted = KINDS["texture"](folder, tuple((weights @ stored).round().astype(int).tolist()))
    picture = screen.render(wanted, {}, size=(40, 40), camera=FACING)
    for order in permutations(KINDS):
        rigs = [KINDS[k](folder, tuple(c)) for k, c in zip(order, stored.tolist(), strict=True)]
        scene = replace(mixed(rigs, weights[1:].tolist()), pose=Pose())
        assert far(screen.render(rigs[0], scene, size=(40, 40), camera=FACING), picture) <= 1, order


def test_the_order_of_people_changes_nothing(
    screen: Offscreen, ctx: moderngl.Context, people: list[Rig], camera: Camera
) -> None:
    partners = [Partner(rig, weight) for rig, weight in zip(people[1:4], (0.4, 0.15, 0.25), strict=True)]
    pictures = [
        screen.render(people[0], Scene(POSE, partners=order), size=SIZE) for order in permutations(partners)
    ]
    assert all(np.array_equal(picture, pictures[0]) for picture in pictures)
    other = Renderer(ctx)
    other.load(people[0])
    other.draw(Scene(POSE, partners=tuple(partners[::-1])), camera, Look(), SIZE, exactly=True)
    assert far(other.read(), pictures[0]) <= 1
    other.release()


def test_at_a_corner_of_the_mixture_it_is_that_person(screen: Offscreen, people: list[Rig]) -> None:
    for k in range(4):
        weights = [float(k == i) for i in range(1, 4)]
        alone = screen.render(people[k], POSE, size=SIZE)
        assert far(screen.render(people[0], mixed(people[:4], weights), size=SIZE), alone) <= 1


def test_turning_to_a_third_person_changes_no_pixel(screen: Offscreen, people: list[Rig]) -> None:
    """(2.11)-(2.12): what the window draws before and after re-basing, and again and again."""
    app = App()
    app.face = Face(people[0], ("own",))
    app.methods = Methods(people=dict(zip("bcd", people[1:4], strict=True)))
    own = OWN
    mix = PeopleMix({own: 1.0}, "b", 0.6)
    before = None
    for goal in ("c", own, "d", "b"):
        pictures = []
        for shown in (mix, mix.rebased(goal)):
            app.controls = replace(Controls(), people=PeopleControl(shown))
            pictures.append(screen.render(people[0], app.scene(), size=SIZE))
        assert not app.controls.off
        assert far(*pictures) <= 1, goal
        assert before is None or far(pictures[0], before) > 10, "s does change the picture"
        before = pictures[0]
        mix = mix.rebased(goal).at(0.45)


def test_weights_between_several_people_upload_and_rebuild_nothing(
    renderer: Renderer, people: list[Rig], camera: Camera, monkeypatch: pytest.MonkeyPatch
) -> None:
    renderer.load(people[0])
    renderer.draw(mixed(people[:6], [0.1] * 5), camera, Look(), SIZE)
    assert renderer.stats.partners == 1
    written: list[str] = []
    for kind in (moderngl.Buffer, moderngl.Texture):
        monkeypatch.setattr(kind, "write", lambda self, *a, **k: written.append(type(self).__name__))
    monkeypatch.setattr(renderer.ctx, "buffer", lambda *a, **k: written.append("new"), raising=False)
    for s in (0.0, 0.3, 1.0):
        renderer.draw(mixed(people[:6], [0.0, s, 0.0, 0.0, 1.0 - s]), camera, Look(), SIZE)
    assert not written
    assert (renderer.stats.morphs, renderer.stats.partners) == (1, 1)


def test_people_of_one_set_of_coordinates_split_no_vertex(
    renderer: Renderer, head: Rig, people: list[Rig], folder: Path, camera: Camera
) -> None:
    renderer.draw(POSE, camera, Look(), SIZE)
    count = len(drawn(renderer)[2])
    renderer.draw(Scene(POSE, partners=tuple(Partner(rig, 0.1) for rig in people[:5])), camera, Look(), SIZE)
    assert len(drawn(renderer)[2]) == count
    surface = renderer.surface
    assert surface is not None
    assert all(surface.shares_uvs(i) for i in range(5))
    loose = turned(people[1], folder, 0.3)
    renderer.draw(Scene(POSE, partners=(Partner(people[0], 0.2), Partner(loose, 0.2))), camera, Look(), SIZE)
    surface = renderer.surface
    assert surface is not None
    assert [surface.shares_uvs(i) for i in range(2)] == [True, False]


def test_polygons_are_drawn_with_each_ones_own_materials(screen: Offscreen, people: list[Rig]) -> None:
    """One of the others has the eyes' material all over the face."""
    mesh = people[1].neutral
    assert mesh.materials_used is not None
    everywhere = Labels(mesh.materials_used.names, np.ones(mesh.polygon_count, np.int32))
    plain = Rig(replace(mesh, materials_used=everywhere), people[1].shapes, people[1].deltas)
    alone = screen.render(plain, POSE, size=SIZE, look=Look(shading="skin"))
    found = screen.render(
        people[0], Scene(POSE, partners=(Partner(people[2], 0.0), Partner(plain, 1.0))), size=SIZE
    )
    skin = screen.render(people[0], POSE, size=SIZE)
    middle = (slice(45, 60), slice(60, 100))
    colour, wanted, own = (np.median(p[middle][..., :3], axis=(0, 1)) for p in (found, alone, skin))
    assert np.abs(colour - wanted).max() < 30
    assert np.abs(colour - own).max() > 20


def test_opaque_people_stay_opaque_whatever_their_shares_sum_to_in_floats(
    screen: Offscreen, people: list[Rig]
) -> None:
    clear = Look(background=(0.0, 0.0, 0.0, 0.0), shading="clay")
    own = screen.render(people[0], POSE, size=SIZE, look=clear)
    for count in (3, 6, 7, 9):
        scene = mixed(people[:count], [1.0 / count] * (count - 1))
        assert np.array_equal(screen.render(people[0], scene, size=SIZE, look=clear), own)
        assert blended_opacity([Material("a")] * count, [1.0 / count] * count) == 1.0


def test_more_people_than_can_be_mixed_and_others_heads_are_refused(
    renderer: Renderer, people: list[Rig], camera: Camera
) -> None:
    crowd = [*people, head_rig()]
    renderer.load(people[0])
    with pytest.raises(PoseError, match=rf"at most {MOST_PARTNERS} other people.*not of {MOST_PARTNERS + 1}"):
        renderer.draw(mixed(crowd, [0.05] * (len(crowd) - 1)), camera, Look(), SIZE)
    with pytest.raises(CorrespondenceError, match="vertices"):
        renderer.draw(mixed([*people[:2], head_rig(rows=20)], [0.1, 0.1]), camera, Look(), SIZE)
    with pytest.raises(PoseError, match="weights must be numbers"):
        renderer.draw(mixed(people[:3], [0.1, float("inf")]), camera, Look(), SIZE)
    renderer.draw(POSE, camera, Look(), SIZE)
