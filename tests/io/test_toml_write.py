"""What is written as TOML says the same when TOML is read."""

from __future__ import annotations

import math
import tomllib

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facemorph.io.toml_write import toml_text

TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=20)
NUMBERS = st.integers(-(10**12), 10**12) | st.floats(allow_nan=False, allow_infinity=False)
VALUES = TEXTS | NUMBERS | st.booleans() | st.lists(NUMBERS, max_size=4) | st.lists(TEXTS, max_size=4)
TABLES = st.dictionaries(TEXTS, VALUES | st.dictionaries(TEXTS, NUMBERS, max_size=3), max_size=4)


@given(TABLES, st.lists(TABLES, min_size=1, max_size=3))
def test_what_is_written_is_read_again(values, entries):
    values = {key: value for key, value in values.items() if key != "entries"}
    assert tomllib.loads(toml_text({**values, "entries": entries})) == {**values, "entries": entries}


@pytest.mark.parametrize(
    ("value", "read"),
    [(np.float32(0.1), 0.1), (np.float64(0.1), 0.1), (np.int16(-3), -3), (np.uint8(7), 7), (1e-30, 1e-30)],
)
def test_numbers_of_arrays_are_numbers(value, read):
    assert tomllib.loads(toml_text({"a": value, "b": [value]})) == {"a": read, "b": [read]}


def test_what_toml_has_no_word_for_is_left_out():
    values = {"none": None, "nan": math.nan, "list": [1.0, math.inf], "kept": 1}
    assert tomllib.loads(toml_text(values)) == {"kept": 1}


def test_half_a_letter_becomes_a_question_mark():
    assert tomllib.loads(toml_text({"name": "a\udcffb"})) == {"name": "a?b"}
