"""Shares of the colours: what each person of a mixture has of them."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.mesh import Mesh
from facemorph.core.rig import Rig
from facemorph.core.scene import Partner, colour_shares


def person() -> Rig:
    mesh = Mesh.from_triangles(np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32))
    return Rig(mesh, (), np.zeros((0, 3, 3), np.float32))


OWN, BEN, MEI, KOFI = (person() for _ in range(4))


def shares(*weights: tuple[Rig, float]) -> list[float]:
    """Of own, Ben, Mei and Kofi."""
    found = colour_shares(OWN.neutral, [Partner(rig, weight) for rig, weight in weights])
    assert next(iter(found)) is OWN.neutral
    return [found.get(rig.neutral, 0.0) for rig in (OWN, BEN, MEI, KOFI)]


def test_alone_all_is_ones_own() -> None:
    assert shares() == [1.0, 0.0, 0.0, 0.0]


@given(st.floats(0.0, 1.0))
def test_between_two_it_is_1_minus_s_and_s(s: float) -> None:
    assert shares((BEN, s)) == pytest.approx([1.0 - s, s, 0.0, 0.0], abs=1e-15)


@given(st.lists(st.floats(-3.0, 3.0), min_size=3, max_size=3))
def test_shares_are_none_below_0_together_1_and_the_same_in_any_order(weights: list[float]) -> None:
    pairs = list(zip((BEN, MEI, KOFI), weights, strict=True))
    found = shares(*pairs)
    assert min(found) >= 0.0
    assert sum(found) == pytest.approx(1.0)
    assert all(shares(*order) == found for order in permutations(pairs))


@given(st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3))
def test_weights_that_are_shares_already_stay(weights: list[float]) -> None:
    given_weights = [weight / 3.0 for weight in weights]
    wanted = [1.0 - sum(given_weights), *given_weights]
    assert shares(*zip((BEN, MEI, KOFI), given_weights, strict=True)) == pytest.approx(wanted, abs=1e-12)


def test_weights_beyond_the_people_end_at_them() -> None:
    assert shares((BEN, -0.5)) == [1.0, 0.0, 0.0, 0.0]
    assert shares((BEN, 1.7)) == [0.0, 1.0, 0.0, 0.0]
    # From a half-and-half mixture to Kofi, s = 1.2: what is left of the mixture is less than nothing.
    assert shares((BEN, -0.1), (KOFI, 1.2)) == [0.0, 0.0, 0.0, 1.0]
    assert shares((BEN, 1.5), (KOFI, 0.5)) == pytest.approx([0.0, 0.75, 0.0, 0.25])


def test_who_stands_there_twice_has_the_sum_and_oneself_is_oneself() -> None:
    assert shares((BEN, 0.2), (BEN, 0.3)) == shares((BEN, 0.5))
    assert shares((OWN, 0.4), (BEN, 0.5)) == shares((BEN, 0.5))
