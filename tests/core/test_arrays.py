"""What arrays are asked for everywhere."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from facemorph.core.arrays import distinct


@given(st.lists(st.integers(-9, 9), max_size=40), st.sampled_from([np.int32, np.int64]))
def test_distinct_numbers_rise_and_are_those_that_occur(values: list[int], kind: type) -> None:
    found = distinct(np.array(values, kind))
    assert found.dtype == kind
    assert found.tolist() == sorted(set(values))


def test_distinct_numbers_of_a_table_are_those_of_all_its_rows() -> None:
    assert distinct(np.array([[3, 1], [1, 2]])).tolist() == [1, 2, 3]
