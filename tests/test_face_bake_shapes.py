"""The pieces of the bake that model expressions, on small meshes of their own."""

from __future__ import annotations

import sys
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

from facemorph.core.correctives import hat
from tests.conftest import ROOT

TOOLS = ROOT / "tools"
if not (TOOLS / "face_bake").is_dir():
    pytest.skip("the bake's tools are not beside these tests", allow_module_level=True)
sys.path.insert(0, str(TOOLS))

from face_bake.correctives import HALF_WAY_PAIRS, JAW_OVER, JAW_SHARE, PAIRS  # noqa: E402
from face_bake.creases import Creases  # noqa: E402
from face_bake.recipes import (  # noqa: E402
    EXPRESSIONS,
    FACS,
    LEAD,
    LEADERS,
    arkit_recipe,
    half_way_recipe,
)
from face_bake.sculpt import signed_distance  # noqa: E402
from face_bake.surface import CageSurface  # noqa: E402
from face_bake.write import NECK, frame_lines  # noqa: E402

SIDE = 9


@pytest.fixture
def sheet() -> CageSurface:
    """A flat sheet of 9 x 9 vertices, one apart; the body's vertices 0..9 are no part of it."""
    faces = quads() + 10
    points = np.concatenate([np.full((10, 3), 7.0), plane()])
    return CageSurface(SimpleNamespace(faces=faces), points)


def plane() -> np.ndarray:
    across, up = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
    return np.stack([across, up, np.zeros_like(up)], -1).reshape(-1, 3).astype(float)


def quads() -> np.ndarray:
    here = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    corners = here[:-1, :-1], here[:-1, 1:], here[1:, 1:], here[1:, :-1]
    return np.stack(corners, -1).reshape(-1, 4)


def two_rings() -> np.ndarray:
    """The sheet's outermost two rings of vertices."""
    places = plane()[:, :2]
    return np.flatnonzero((np.minimum(places, SIDE - 1 - places) < 2).any(1))


def test_what_is_held_moves_as_told_and_the_rest_of_the_body_stays(sheet: CageSurface):
    held = np.append(two_rings(), 40)
    moves = np.zeros((len(held), 3))
    moves[-1] = [0, 0, 0.5]
    field = sheet.interpolated(held, moves)
    assert field.shape == (91, 3)
    assert not field[:10].any()
    np.testing.assert_allclose(field[10:][held], moves, atol=1e-12)
    heights = field[10:, 2].reshape(SIDE, SIDE)
    assert np.all(np.diff(heights[4, 1:5]) > 0), "it rises evenly to the held point"
    np.testing.assert_allclose(heights, heights[:, ::-1], atol=0.02)


def test_a_border_that_tilts_tilts_the_inside_alike(sheet: CageSurface):
    tilt = plane() @ np.array([[0.0, 0.0, 0.1], [0.0, 0.0, -0.2], [0.0, 0.0, 0.0]]) + [0.3, 0.0, 0.0]
    field = sheet.interpolated(two_rings(), tilt[two_rings()])
    np.testing.assert_allclose(field[10:], tilt, atol=1e-9)


def test_softening_takes_a_spike_away_only_where_it_is_asked_to(sheet: CageSurface):
    length = np.where(plane()[:, 0] < 4, 2.0, 0.0)
    spikes = np.zeros((91, 3))
    spikes[10 + 38, 2] = spikes[10 + 43, 2] = 1.0
    soft = sheet.softener(length)(spikes)
    assert abs(soft[10 + 38, 2]) < 0.4
    assert soft[10 + 43, 2] == pytest.approx(1.0, abs=1e-3)
    even = np.full((91, 3), 0.7)
    np.testing.assert_allclose(sheet.softener(length)(even)[10:], 0.7, atol=0.05)


def test_distance_to_a_line_is_positive_on_its_left_and_knows_the_place_along():
    line = np.array([[0.0, 0.0], [0.0, 1.0], [0.0, 3.0]])
    distance, along = signed_distance(np.array([[-0.5, 1.5], [0.25, 1.5], [0.0, 5.0]]), line)
    np.testing.assert_allclose(distance[:2], [0.5, -0.25])
    np.testing.assert_allclose(along, [0.5, 0.5, 1.0])


def test_a_fold_is_counted_and_a_turned_sheet_has_none():
    triangles = np.concatenate([quads()[:, [0, 1, 2]], quads()[:, [0, 2, 3]]])
    flat = plane()
    creases = Creases(flat, triangles)
    turned = flat @ np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert creases.folds(turned) == 0
    over = flat.copy()
    over[:, 0] = np.where(flat[:, 0] > 4, 8 - flat[:, 0], flat[:, 0])
    assert creases.folds(over) == SIDE - 1, "one edge of every row is a fold"


def test_one_sided_shapes_are_made_of_one_sided_fields():
    assert all(term.endswith("Left") for term in arkit_recipe("mouthSmileLeft"))
    assert all(term.endswith("Right") for term in arkit_recipe("noseSneerRight"))
    assert arkit_recipe("jawLeft") == {"arkit:jawLeft": 1.0}


def test_the_smiles_of_the_recipes_raise_cheeks():
    assert EXPRESSIONS["happy"]["sculpt:cheek"] > 0.5
    assert FACS["AU6"][1].keys() & EXPRESSIONS["happy"].keys() >= {"sculpt:cheek"}
    assert FACS["AU12"][1].keys() & EXPRESSIONS["happy"].keys() >= {"sculpt:smile"}


def test_a_picture_shows_the_head_and_some_neck_and_leaves_the_shoulders_out() -> None:
    # A head from -10 to 10 on a bust that is wider and goes down to -20; the chin is at -8.
    points = np.array([[-7, -10, -9], [7, 10, 9], [0, -8, 4], [-15, -20, -5], [15, -20, 5]], float)
    landmarks = [SimpleNamespace(vertex=vertex) for vertex in (1, 2)]
    lines = frame_lines(points, landmarks)
    frame = tomllib.loads("\n".join(lines))["frame"]
    assert frame["low"] == [-7.0, round(-8 - NECK * 18, 1), -9.0]
    assert frame["high"] == [7.0, 10.0, 9.0]


def test_half_way_to_an_expression_its_leaders_are_ahead_and_the_rest_is_half_way():
    for name, recipe in EXPRESSIONS.items():
        half = half_way_recipe(name, recipe)
        assert half.keys() == recipe.keys()
        for term, weight in recipe.items():
            share = 0.5 + (LEAD if term in LEADERS.get(name, ()) else 0.0)
            assert half[term] == pytest.approx(share * weight)
    assert half_way_recipe("AU4", FACS["AU4"][1])["sculpt:browDown"] == FACS["AU4"][1]["sculpt:browDown"] / 2


def test_what_leads_is_in_the_expressions_and_no_part_turns_back_on_the_way():
    """At weight c a leader has come c + 4 LEAD c (1 - c) of its way, which grows up to c = 1."""
    assert 0 < LEAD <= 0.25
    for name, leaders in LEADERS.items():
        assert len(EXPRESSIONS[name].keys() & set(leaders)) >= 3


def test_each_emotion_has_the_units_that_tell_it_from_the_others():
    sad, angry, surprised = (EXPRESSIONS[name] for name in ("sad", "angry", "surprised"))
    disgusted, afraid = EXPRESSIONS["disgusted"], EXPRESSIONS["afraid"]
    assert sad["sculpt:browInner"] > 1 > sad["sculpt:frown"] > 0.5, "AU1, AU15"
    assert angry["sculpt:browDown"] > 1 and angry["sculpt:press"] > 1, "AU4, AU24"
    assert angry["mh:eye-opened-up"] > 0.3, "AU5"
    assert disgusted["sculpt:sneer"] > 1 and disgusted["sculpt:upper"] > 0.5, "AU9, AU10"
    assert afraid["mh:eye-opened-up"] > surprised["mh:eye-opened-up"], "AU5"
    assert afraid["sculpt:stretch"] > 0.8 and "sculpt:stretch" not in surprised, "AU20"
    assert surprised["arkit:jawOpen"] > 2 * afraid["arkit:jawOpen"], "AU26, AU27"


def test_lips_close_on_the_jaw_as_far_as_it_is_open():
    """mouthClose as much as jawOpen: what the corrective adds to what mouthClose does alone is the whole."""
    alone = arkit_recipe("mouthClose")["arkit:mouthClose"]
    for opening in np.linspace(0.1, 1.0, 19):
        added = (1 - alone) * hat(opening, *JAW_OVER) / JAW_SHARE
        assert opening * (alone + added) == pytest.approx(opening, abs=0.05)
    assert hat(1.0, *JAW_OVER) == pytest.approx(JAW_SHARE)


def test_blinks_are_mended_half_way_to_where_lids_open_early_and_at_full():
    opened = {name for name, recipe in EXPRESSIONS.items() if recipe.get("arkit:eyeWide", 0) > 0}
    assert {mood for mood, _ in HALF_WAY_PAIRS} == opened & LEADERS.keys()
    assert set(HALF_WAY_PAIRS) <= set(PAIRS)
