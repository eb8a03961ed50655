"""What a shape lights up: where it moves the face, as much as it moves it there."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.glow import glow_of
from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig, Shape
from facemorph.errors import UnknownNameError


def made_rig() -> Rig:
    mesh = Mesh.from_triangles(np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32))
    deltas = np.zeros((3, 3, 3), np.float32)
    deltas[0] = [[3, 4, 0], [0, 0, 1], [0, 0, 0]]
    deltas[1] = [[-3, -4, 0], [0, 0, 1], [0, 0, 0]]
    return Rig(mesh, tuple(Shape(name, name) for name in "abc"), deltas)


def test_it_is_the_displacement_by_its_largest() -> None:
    assert np.allclose(glow_of(made_rig(), {"a": 1.0}), [1.0, 0.2, 0.0])


@pytest.mark.parametrize("weight", [0.01, 7.0, -2.0])
def test_how_much_of_one_shape_does_not_matter(weight: float) -> None:
    assert np.allclose(glow_of(made_rig(), {"a": weight}), glow_of(made_rig(), {"a": 1.0}))


def test_shapes_move_together() -> None:
    assert np.allclose(glow_of(made_rig(), {"a": 1.0, "b": 1.0}), [0.0, 1.0, 0.0])


def test_what_moves_nothing_lights_nothing() -> None:
    for weights in ({}, {"c": 1.0}, {"a": 0.0}):
        glow = glow_of(made_rig(), weights)
        assert glow.dtype == np.float32
        assert glow.tolist() == [0.0, 0.0, 0.0]


def test_shapes_nobody_knows_are_refused() -> None:
    with pytest.raises(UnknownNameError, match="smirk"):
        glow_of(made_rig(), {"smirk": 1.0})
