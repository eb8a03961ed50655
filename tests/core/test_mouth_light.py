"""Light inside the mouth: Lambert's formula against rays cast at random, and what must hold of any mouth."""

from __future__ import annotations

import numpy as np
import pytest

from facemorph.core.mouth_light import APERTURE, DIM, Aperture, light_through, mouth_light

FORWARD = np.array([0.0, 0.0, 1.0])
ON_AXIS = np.array([[0.0, 0.0, -1.5], [0.0, 0.0, -4.0]])


def mouth(height: float = 1.0, bulge: float = 0.0) -> Aperture:
    """Half as wide as 2, half as high as `height`; the lips' middles stand `bulge` before the corners."""
    turn = np.pi - 2.0 * np.pi * np.arange(APERTURE) / APERTURE
    edge = np.stack([2.0 * np.cos(turn), height * np.sin(turn), bulge * np.abs(np.sin(turn))], -1)
    return Aperture.between(edge, FORWARD)


def by_rays(aperture: Aperture, position: np.ndarray, normal: np.ndarray, count: int = 400_000) -> float:
    """Share of cosine-weighted rays that leave through a flat aperture."""
    rng = np.random.default_rng(4)
    rays = rng.standard_normal((count, 3))
    rays /= np.linalg.norm(rays, axis=1, keepdims=True)
    cosines = np.maximum(rays @ normal, 0.0)
    ahead = rays[:, 2] > 1e-6
    way = -position[2] / np.where(ahead, rays[:, 2], 1.0)
    hits = position[:2] + rays[:, :2] * way[:, None]
    inside = ahead.copy()
    for k in range(APERTURE):
        a, b = aperture.edge[k - 1, :2], aperture.edge[k, :2]
        inside &= (b - a)[0] * (hits - a)[:, 1] - (b - a)[1] * (hits - a)[:, 0] < 0.0
    return float((cosines * inside).sum() / cosines.sum())


@pytest.mark.parametrize(
    ("position", "normal"),
    [
        ((0.0, 0.0, -1.5), (0.0, 0.0, 1.0)),
        ((0.8, -0.4, -1.0), (0.0, 0.0, 1.0)),
        ((0.3, 0.2, -3.0), (0.0, 0.6, 0.8)),
    ],
)
def test_lamberts_formula_is_what_rays_find(position: tuple[float, ...], normal: tuple[float, ...]) -> None:
    aperture, place, unit = mouth(), np.array(position), np.array(normal)
    field, _ = light_through(aperture, place[None], FORWARD)
    assert field[0] @ unit == pytest.approx(by_rays(aperture, place, unit), abs=0.004)


def test_deeper_is_darker_and_a_wider_mouth_is_brighter() -> None:
    facing = np.tile(FORWARD, (2, 1))
    near, deep = mouth_light(mouth(), ON_AXIS, facing, FORWARD)[:, 0]
    wider = mouth_light(mouth(2.0), ON_AXIS, facing, FORWARD)[:, 0]
    assert near > deep > DIM
    assert (wider > [near, deep]).all()


@pytest.mark.parametrize("height", [0.0, -0.3])
def test_a_mouth_that_is_shut_or_whose_lips_overlap_lets_no_light_in(height: float) -> None:
    shares = mouth_light(mouth(height), ON_AXIS, np.tile(FORWARD, (2, 1)), FORWARD)
    assert shares[:, 0] == pytest.approx(DIM, abs=1e-3)


def test_a_tongue_before_the_lips_is_in_full_light() -> None:
    before = np.array([[0.0, 0.0, 1.0], [0.5, -0.2, 3.0]])
    assert mouth_light(mouth(bulge=0.3), before, np.tile(FORWARD, (2, 1)), FORWARD) == pytest.approx(1.0)


def test_the_key_comes_in_along_the_axis_and_not_from_above() -> None:
    from_above = np.array([0.0, 1.0, 0.0])
    ahead, above = (
        mouth_light(mouth(), ON_AXIS[:1], FORWARD[None], towards)[0, 1] for towards in (FORWARD, from_above)
    )
    assert ahead > 0.9
    assert above == 0.0


def test_the_light_does_not_depend_on_the_unit_of_length() -> None:
    small, large = mouth(), Aperture.between(mouth().edge * 10.0, FORWARD)
    facing = np.tile(FORWARD, (2, 1))
    assert mouth_light(large, ON_AXIS * 10.0, facing, FORWARD) == pytest.approx(
        mouth_light(small, ON_AXIS, facing, FORWARD)
    )


def test_lips_in_one_point_make_no_trouble() -> None:
    aperture = Aperture.between(np.zeros((APERTURE, 3)), FORWARD)
    assert aperture.size == 0.0
    assert np.isfinite(aperture.normal).all()
