"""The pieces of the bake that make hair, brows and lashes, on a skull that is an ellipsoid."""

from __future__ import annotations

import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.conftest import ROOT

TOOLS = ROOT / "tools"
if not (TOOLS / "face_bake").is_dir():
    pytest.skip("the bake's tools are not beside these tests", allow_module_level=True)
pytest.importorskip("embreex", reason="the bake's own packages are not installed (pip install -e '.[bake]')")
sys.path.insert(0, str(TOOLS))

from face_bake.brows import BrowsPart  # noqa: E402
from face_bake.hair import growth, paint_hair  # noqa: E402
from face_bake.hair_atlas import HEIGHT, MARGIN, OPACITIES, TILES, WIDTH, hair_picture, tile_box  # noqa: E402
from face_bake.hair_cuts import STYLES  # noqa: E402
from face_bake.hair_frame import CENTRE, Fitting, Skull, direction  # noqa: E402
from face_bake.hair_locks import LockValues, place_locks  # noqa: E402
from face_bake.hair_part import BODY, WISPS, HairPart  # noqa: E402
from face_bake.hair_shell import Sheet  # noqa: E402
from face_bake.lash_pictures import BROW_TILES, brow_picture, lash_picture  # noqa: E402
from face_bake.paintkit import Noise  # noqa: E402
from face_bake.people import ADA, KOFI, MEI, PEOPLE  # noqa: E402

RADII = np.array([0.75, 1.4, 0.95])


def skull() -> Skull:
    """An ellipsoid as long as a head with its neck, of quads."""
    azimuth, elevation = np.meshgrid(np.arange(0, 360, 10), np.arange(-80, 81, 8))
    points = CENTRE - [0, 0.4, 0] + direction(azimuth, elevation).reshape(-1, 3) * RADII
    index = np.arange(len(points)).reshape(azimuth.shape)
    beside, below = np.roll(index, -1, 1)[1:], index[:-1]
    quads = np.stack([index[1:], below, np.roll(below, -1, 1), beside], -1).reshape(-1, 4)
    middles = np.array([points[index[0]].mean(0), points[index[-1]].mean(0)])
    low, high = len(points), len(points) + 1
    caps = [[b, a, low, low] for a, b in ring(index[0])] + [[a, b, high, high] for a, b in ring(index[-1])]
    quads = np.concatenate([quads, caps])
    points = np.concatenate([points, middles])
    return Skull(points, quads, np.zeros(len(points), bool))


def ring(row: np.ndarray) -> list[tuple[int, int]]:
    return list(zip(row.tolist(), np.roll(row, -1).tolist(), strict=True))


SKULL = skull()


@pytest.mark.parametrize("name", STYLES)
def test_a_sheet_of_hair_lies_outside_the_skull(name: str) -> None:
    sheet = Sheet(STYLES[name], SKULL)
    away = sheet.points - CENTRE
    distance = np.linalg.norm(away, axis=-1)
    above = sheet.points[..., 1] > CENTRE[1]
    outside = distance - SKULL.radius(away / distance[..., None])
    assert np.isfinite(sheet.points).all()
    assert outside[above].min() > -0.01
    steps = np.linalg.norm(np.diff(sheet.points, axis=1), axis=-1)
    assert steps.max() < 0.3, "no column leaps"
    points = sheet.coarse()
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    for one, other in ((b - a, c - a), (c - a, d - a)):
        area = np.linalg.norm(np.cross(one, other), axis=-1)
        assert area.min() > 1e-8, "no triangle is flat"


@pytest.mark.parametrize("name", STYLES)
def test_the_same_polygons_hold_every_haircut(name: str) -> None:
    sheet, rng = Sheet(STYLES[name], SKULL), np.random.default_rng(1)
    for rows, count in ((STYLES[name].body, BODY), (STYLES[name].wisps, WISPS)):
        strips = place_locks(sheet, LockValues(rows, count, rng))
        assert strips.shape == (count, 6, 2, 3)
        width = np.linalg.norm(strips[:, :, 0] - strips[:, :, 1], axis=-1)
        assert (width > 0.02).all(), "every lock has an area"
        assert width.max() < 0.5


def test_hair_keeps_its_clearance_from_a_larger_head() -> None:
    larger = CENTRE + (SKULL.points - CENTRE) * 1.1
    above = SKULL.points[SKULL.bare] + 0.05 * SKULL.normals[SKULL.bare]
    fitted = Fitting(SKULL, larger)(above) - CENTRE
    distance = np.linalg.norm(fitted, axis=1)
    grown = Skull(larger, SKULL.quads, np.zeros(len(larger), bool))
    gap = distance - grown.radius(fitted / distance[:, None])
    assert gap.min() > 0.03
    assert 0.04 < np.median(gap) < 0.07


def test_hair_stays_where_the_skull_is() -> None:
    fine = SimpleNamespace(
        operator=np.eye(len(SKULL.points)),
        quads=SKULL.quads,
        on_head=np.ones(len(SKULL.points), bool),
    )
    part = HairPart(fine, SKULL.points, np.zeros(len(SKULL.points), bool))
    body = SimpleNamespace(person=ADA)
    rest = SimpleNamespace(body=body, shape=SKULL.points, neutral=SKULL.points)
    raised = SimpleNamespace(body=body, shape=SKULL.points + 0.2, neutral=SKULL.points)
    count = max(int(group.polygons.max()) for group in part.groups) + 1
    assert part.place(rest).shape == (count, 3)
    assert count <= 2600
    np.testing.assert_array_equal(part.place(rest), part.place(raised))
    other = SimpleNamespace(body=SimpleNamespace(person=MEI), shape=SKULL.points, neutral=SKULL.points)
    assert np.abs(part.place(other) - part.place(rest)).max() > 0.1, "another person, another haircut"
    for group in part.groups:
        corners = part.uv[group.uv_polygons]
        assert corners[..., 1].min() >= 0
        assert corners[..., 1].max() <= 1


@pytest.mark.parametrize("name", ["ada", "kofi"])
def test_the_hairs_picture_is_opaque_at_roots_and_ragged_at_tips(name: str) -> None:
    image = hair_picture(PEOPLE[name].look)
    assert image.size == (WIDTH, HEIGHT)
    alpha = np.asarray(image.convert("RGBA"))[..., 3]
    assert (alpha[:40] == 255).all(), "nothing shows through the middle of the sheet"
    assert len(np.unique(alpha)) <= OPACITIES
    for tile in range(TILES):
        left, bottom, right, top = tile_box(tile)
        own = alpha[
            int((1 - top) * HEIGHT) : int((1 - bottom) * HEIGHT), int(left * WIDTH) : int(right * WIDTH)
        ]
        assert own.max() > 200
        assert own[-3:].mean() < 60, "tips thin out"
    np.testing.assert_array_equal(alpha, np.asarray(hair_picture(PEOPLE[name].look).convert("RGBA"))[..., 3])


@pytest.mark.parametrize("name", ["ada", "zola"])
def test_locks_are_empty_below_their_tips_so_that_nothing_shows_from_across_the_border(name: str) -> None:
    alpha = np.asarray(hair_picture(PEOPLE[name].look).convert("RGBA"))[..., 3]
    assert (alpha[-MARGIN:] == 0).all()


@pytest.mark.parametrize("name", STYLES)
def test_no_lock_leaves_the_sheet_sideways(name: str) -> None:
    sheet, asked = Sheet(STYLES[name], SKULL), []
    real = sheet.at
    sheet.at = lambda c, t: asked.append(c) or real(c, t)
    place_locks(sheet, LockValues(STYLES[name].wisps, WISPS, np.random.default_rng(1)))
    assert min(c.min() for c in asked) > 0
    assert max(c.max() for c in asked) < 1


@pytest.mark.parametrize("name", ["ben", "kofi", "omar"])
def test_a_short_haircut_closes_gradually_at_the_temple(name: str) -> None:
    look, rng = PEOPLE[name].look, np.random.default_rng(2)
    azimuth = rng.uniform(50, 60, 4000)
    points = CENTRE + direction(azimuth, rng.uniform(-40, 60, 4000)) * 0.95
    inside = growth(points, look)
    skin = np.tile(np.array(look.skin, np.float32), (len(points), 1))
    painted = paint_hair(skin, points, np.zeros(len(points)), Noise(1), look)
    cover = np.linalg.norm(painted - skin, axis=1)
    steps = [cover[np.abs(inside - at) < 3].mean() for at in (-20, 0, 8, 16, 30)]
    assert steps[0] < 0.02 * steps[-1], "bare skin on one side"
    assert np.all(np.diff(steps[:4]) > 0), "ever closer hair on the way in"
    assert steps[4] > 0.85 * steps[3]
    assert steps[1] < 0.35 * steps[-1] < steps[3]


def test_hair_grows_on_the_crown_and_not_on_the_face() -> None:
    places = np.array([[0, 8.48, 0.5], [0, 7.9, -0.3], [0, 7.5, 1.5], [0, 6.6, 1.5]])
    for person in PEOPLE.values():
        inside = growth(places, person.look)
        assert (inside[:2] > 10).all()
        assert (inside[2:] < -10).all()


def test_brow_hairs_keep_their_length_when_the_skin_is_squeezed() -> None:
    part, skin = forehead()
    look = ADA.look
    body = SimpleNamespace(person=SimpleNamespace(id="a", look=look), fine_skin=lambda shape: skin)
    rest = part.place(SimpleNamespace(body=body, neutral=None, skin=skin))
    squeezed = skin * [0.6, 1, 1]
    moved = part.place(SimpleNamespace(body=body, neutral=None, skin=squeezed))

    def lengths(points: np.ndarray) -> np.ndarray:
        strips = points.reshape(-1, 3, 2, 3).mean(2)
        return np.linalg.norm(np.diff(strips, axis=1), axis=-1)

    np.testing.assert_allclose(lengths(moved), lengths(rest), rtol=0.05)
    widths = [
        np.linalg.norm(p.reshape(-1, 2, 3)[:, 0] - p.reshape(-1, 2, 3)[:, 1], axis=1) for p in (rest, moved)
    ]
    np.testing.assert_allclose(widths[0], widths[1], rtol=1e-6)
    roots = moved.reshape(-1, 3, 2, 3)[:, 0].mean(1)
    assert np.abs(roots[:, 2] - 1.4).max() < 0.02, "roots stay on the skin"
    assert np.abs(roots[:, 0]).max() < 0.6 * np.abs(rest[:, 0]).max() + 0.02, "and go with it"
    assert len(rest) <= 500


def forehead() -> tuple[BrowsPart, np.ndarray]:
    """A flat piece of skin in front of the brows."""
    x, y = np.meshgrid(np.linspace(-0.8, 0.8, 60), np.linspace(7.2, 7.75, 24))
    points = np.stack([x, y, np.full_like(x, 1.4)], -1).reshape(-1, 3)
    index = np.arange(len(points)).reshape(x.shape)
    a, b, c, d = index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]
    triangles = np.concatenate(
        [np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)]
    )
    return BrowsPart(SimpleNamespace(operator=np.eye(len(points)), triangles=triangles), points), points


def test_tufts_for_the_ends_of_a_brow_are_thinner() -> None:
    alpha = np.asarray(brow_picture(ADA.look))[..., 1].astype(float)
    cover = [tile.mean() for tile in np.split(alpha, BROW_TILES, axis=1)]
    assert np.all(np.diff(cover) < 0)
    assert cover[-1] < 0.75 * cover[0]


def test_denser_brows_and_lashes_cover_more() -> None:
    for paint, field in ((brow_picture, "brow_density"), (lash_picture, "lash_density")):
        thin, thick = (
            np.asarray(paint(replace(KOFI.look, **{field: value})))[..., 1].mean() for value in (0.6, 1.2)
        )
        assert thick > 1.2 * thin
