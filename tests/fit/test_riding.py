"""Parts that hang on nothing keep their motion: eyes turn, teeth go with the jaw, brows ride on the skin."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.fit import example_based, transfer
from tests.fit.faces import bumps, joined, octahedron, other, rig_of, sheet_rig, turned

DOWN = np.array([0.0, -0.5, 0.1])


@pytest.fixture(scope="module")
def face():
    """Skin; an eyeball that shape 0 turns, a tooth that shape 1 lowers, a brow that shape 2 carries along."""
    skin = sheet_rig(1).neutral
    points = skin.positions.astype(np.float64)
    over = points[np.argmin(np.linalg.norm(points[:, :2] - (0.3, 0.2), axis=1))]
    mesh, places = joined(
        skin, octahedron((-0.8, 0.2, -1.2), 0.35), octahedron((0.0, -0.6, -1.2), 0.2), octahedron(over, 0.08)
    )
    offsets = np.zeros((3, mesh.vertex_count, 3))
    offsets[:, : len(points)] = bumps(points, 3, 3)
    lift = np.exp(-((points[:, :2] - over[:2]) ** 2).sum(axis=1) / 0.5)
    lift *= np.clip(1.5 - np.abs(points[:, 1]), 0, 1) * np.clip(2.0 - np.abs(points[:, 0]), 0, 1)
    offsets[2, : len(points)] = lift[:, None] * (0.0, 0.3, 0.15)
    eye, tooth, brow = places
    ball = mesh.positions[eye] - mesh.positions[eye].mean(axis=0)
    offsets[0, eye] = ball @ turned(20.0).T - ball
    offsets[1, tooth] = DOWN
    offsets[2, brow] = offsets[2, : len(points)][np.argmin(((points - over) ** 2).sum(axis=1))]
    return rig_of(mesh, offsets), places


def _person(rig) -> np.ndarray:
    return other(rig.neutral.positions.astype(np.float64))


def _size(rig) -> float:
    return rig.neutral.diagonal


def test_an_eyeball_turns_where_it_is(face):
    rig, (eye, _, _) = face
    neutral = _person(rig)
    # The eyeball of the target is the template's, moved: what it does must be the same turn.
    neutral[eye] = rig.neutral.positions[eye] + (0.1, 0.05, 0.0)
    made = transfer(rig, neutral).rig
    moved = neutral[eye] + made.deltas[0, eye]
    np.testing.assert_allclose(moved.mean(axis=0), neutral[eye].mean(axis=0), atol=2e-3 * _size(rig))
    ball, still = moved - moved.mean(axis=0), neutral[eye] - neutral[eye].mean(axis=0)
    angle = np.degrees(np.arccos(np.clip((ball[0] @ still[0]) / 0.35**2, -1, 1)))
    assert angle == pytest.approx(20.0, abs=1.5)
    np.testing.assert_allclose(np.linalg.norm(ball, axis=1), 0.35, rtol=0.02)


def test_a_tooth_goes_as_far_as_in_the_template(face):
    rig, (_, tooth, _) = face
    made = transfer(rig, _person(rig)).rig
    np.testing.assert_allclose(made.deltas[1, tooth].mean(axis=0), DOWN, atol=0.1 * np.linalg.norm(DOWN))
    assert np.abs(made.deltas[0, tooth]).max() <= 1e-6 * _size(rig)


def test_a_brow_rides_on_the_targets_skin_not_the_templates(face):
    rig, (_, _, brow) = face
    neutral = _person(rig)
    # This skin is drawn out twice as far, so what it does under the brow is not what the template's did.
    neutral *= (1.0, 2.0, 1.0)
    made = transfer(rig, neutral).rig
    middle = neutral[brow].mean(axis=0)
    skin = np.arange(brow.start - 12)
    below = skin[np.argmin(((neutral[skin] - middle) ** 2).sum(axis=1))]
    apart = made.deltas[2, brow].mean(axis=0) - made.deltas[2, below]
    own = rig.deltas[2, brow].mean(axis=0) - made.deltas[2, below]
    assert np.linalg.norm(apart) < 0.15 * np.linalg.norm(made.deltas[2, below])
    assert np.linalg.norm(apart) < 0.5 * np.linalg.norm(own)


def test_examples_teach_a_tooth_how_far_this_person_opens(face):
    rig, (_, tooth, _) = face
    neutral = _person(rig)
    plain = transfer(rig, neutral).rig
    wide = neutral + plain.deltas[1]
    wide[tooth] += DOWN
    names = rig.names
    fitted = example_based(
        rig, neutral, [wide], [{names[1]: 1.0}], lambda_=(1e5, 1e5), alpha=(0.05, 0.01)
    ).rig
    went = fitted.deltas[1, tooth].mean(axis=0)
    assert np.linalg.norm(went - (plain.deltas[1, tooth].mean(axis=0) + DOWN)) < 0.2 * np.linalg.norm(DOWN)


@pytest.mark.parametrize("moved", ["every vertex", "none"])
def test_faces_that_move_altogether_or_not_at_all_are_transferred(moved):
    rig = sheet_rig(2, 6, 7)
    points = rig.neutral.positions.astype(np.float64)
    offsets = 0.2 * (points @ turned(10.0).T - points + 0.1) if moved == "every vertex" else 0.0 * points
    rig = rig_of(rig.neutral, np.array([offsets, 2.0 * offsets]))
    neutral = other(points)
    result = example_based(rig, neutral, [neutral + 0.05 * points[:, ::-1]], [{"smile": 0.5, "frown": 0.2}])
    assert np.isfinite(result.rig.deltas).all()
    own = transfer(rig, rig.neutral).rig
    np.testing.assert_allclose(own.deltas, rig.deltas, atol=1e-5 * rig.neutral.diagonal)


def test_a_rig_without_shapes_becomes_the_person_without_shapes():
    rig = rig_of(sheet_rig(1).neutral, np.zeros((0, sheet_rig(1).neutral.vertex_count, 3)))
    neutral = other(rig.neutral.positions.astype(np.float64))
    assert transfer(rig, neutral).rig.deltas.shape == (0, len(neutral), 3)
    result = example_based(rig, neutral, [neutral * 1.1])
    assert result.weights == ({},)
    assert result.examples[0].rms_percent > 0.0


def test_a_shape_without_motion_can_be_taught_by_an_example():
    rig = sheet_rig(2)
    offsets = rig.deltas.astype(np.float64)
    empty = rig_of(rig.neutral, np.array([offsets[0], 0.0 * offsets[1]]))
    neutral = rig.neutral.positions.astype(np.float64)
    assert not transfer(empty, neutral).rig.deltas[1].any()
    result = example_based(
        empty, neutral, [neutral + offsets[1]], [{"frown": 1.0}],
        alpha=(1e-4, 1e-4), lambda_=(1e6, 1e6), iterations=1,
    )  # fmt: skip
    # All but where the template never moves, which is held there.
    left = np.linalg.norm(result.rig.deltas[1] - offsets[1]) / np.linalg.norm(offsets[1])
    assert left < 0.2
