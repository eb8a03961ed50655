"""Wrinkles: their rule, their areas, and what a `face.toml` may say of them."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig, Shape
from facemorph.core.wrinkles import MOST_WRINKLES, Wrinkle, WrinkleWeights, set_weights
from facemorph.errors import MeshDataError

LEFT = Wrinkle("left", "red", (0.1, 0.2, 0.5, 0.8), 0.1, 0.2, {"up": 0.5, "frown": 1.0, "nowhere": 9.0})
RIGHT = Wrinkle("right", "red", (0.5, 0.2, 0.9, 0.8), 0.1, shapes={"up": 1.0})
NAMES = ("up", "frown")


def test_a_weight_is_the_rest_and_what_the_shapes_add_within_0_and_1() -> None:
    weigh = WrinkleWeights(NAMES, (LEFT, RIGHT))
    assert weigh(np.zeros(2)) == pytest.approx([0.2, 0.0])
    assert weigh(np.array([0.6, 0.1])) == pytest.approx([0.2 + 0.3 + 0.1, 0.6])
    assert weigh(np.array([9.0, 9.0])) == pytest.approx([1.0, 1.0])


def test_shapes_below_0_show_nothing_and_hide_nothing() -> None:
    weigh = WrinkleWeights(NAMES, (LEFT, RIGHT))
    assert weigh(np.array([-1.0, 0.3])) == pytest.approx(weigh(np.array([0.0, 0.3])))


def test_two_areas_that_meet_are_a_whole_at_their_edge() -> None:
    across = np.stack([np.linspace(0.2, 0.8, 61), np.full(61, 0.5)], axis=1)
    found = set_weights((LEFT, RIGHT), np.ones(2), across)
    assert found[:, 0] == pytest.approx(np.ones(61))
    assert not found[:, 1:].any()


def test_an_area_ends_half_its_border_outside_its_edges() -> None:
    places = np.array([[0.04, 0.5], [0.10, 0.5], [0.16, 0.5], [0.3, 0.14], [0.3, 0.86]])
    found = set_weights((LEFT,), np.ones(1), places)[:, 0]
    assert found == pytest.approx([0.0, 0.5, 1.0, 0.0, 0.0])


def test_one_sided_shapes_show_one_side_only() -> None:
    sided = (
        Wrinkle("left", "blue", (0.1, 0.2, 0.5, 0.8), shapes={"browLeft": 1.0, "AU4": 1.0}),
        Wrinkle("right", "blue", (0.5, 0.2, 0.9, 0.8), shapes={"browRight": 1.0, "AU4": 1.0}),
    )
    weigh = WrinkleWeights(("browLeft", "browRight", "AU4"), sided)
    assert weigh(np.array([1.0, 0.0, 0.0])).tolist() == [1.0, 0.0]
    assert weigh(np.array([0.0, 0.0, 0.7])).tolist() == [0.7, 0.7]


@pytest.mark.parametrize(
    ("wrinkle", "told"),
    [
        (Wrinkle("w", "alpha", (0, 0, 1, 1)), "there are red, green, blue"),
        (Wrinkle("w", "red", (0.5, 0, 0.5, 1)), "must grow"),
        (Wrinkle("w", "red", (0, 1, 1, 0)), "must grow"),
        (Wrinkle("w", "red", (0, 0, 1, 1), soft=0.0), "wider than 0"),
    ],
)
def test_a_rig_refuses_a_wrinkle_that_is_none(wrinkle: Wrinkle, told: str) -> None:
    with pytest.raises(MeshDataError, match=told):
        _rig((wrinkle,))


def test_a_rig_refuses_more_wrinkles_than_are_drawn() -> None:
    with pytest.raises(MeshDataError, match="32 wrinkles, not 33"):
        _rig((LEFT,) * (MOST_WRINKLES + 1))


def _rig(wrinkles: tuple[Wrinkle, ...]) -> Rig:
    mesh = Mesh.from_triangles(np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32))
    deltas = np.zeros((2, 3, 3), np.float32)
    return Rig(mesh, tuple(Shape(name, name) for name in NAMES), deltas, wrinkles=wrinkles)
