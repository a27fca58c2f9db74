"""Bits of numbers, written out field by field."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.coverage.number_formats import FLOATS, bit_pattern


@pytest.mark.parametrize(
    ("value", "layout", "expected"),
    [
        (0.0, "float16", "0 00000 0000000000"),
        (-0.0, "float16", "1 00000 0000000000"),
        (1.0, "float16", "0 01111 0000000000"),
        (-1.5, "float16", "1 01111 1000000000"),
        (1e9, "float16", "0 11111 0000000000"),
        (1.0, "float32", "0 01111111 " + "0" * 23),
        (0.1, "float32", "0 01111011 10011001100110011001101"),
        (1.0, "float64", "0 01111111111 " + "0" * 52),
        (1.5, "fixed-24.8", "0" * 23 + "1.10000000"),
        (-1 / 256, "fixed-24.8", "1" * 24 + ".11111111"),
        (40000.0, "fixed-16.16", "1001110001000000." + "0" * 16),
        (2.0**16 + 1, "fixed-16.16", "0" * 15 + "1." + "0" * 16),
        (3 / 512, "fixed-4.8", "0000.00000010"),
    ],
)
def test_patterns(value: float, layout: str, expected: str) -> None:
    assert bit_pattern(value, layout) == expected


@given(st.floats(allow_nan=False), st.sampled_from(sorted(FLOATS)))
def test_a_float_reads_back_from_its_bits(value: float, layout: str) -> None:
    number, integer, exponent, fraction = FLOATS[layout]
    sign, middle, last = bit_pattern(value, layout).split(" ")
    assert (len(sign), len(middle), len(last)) == (1, exponent, fraction)
    with np.errstate(over="ignore"):
        assert np.array(int(sign + middle + last, 2), integer).view(number) == number(value)


@given(st.integers(-(2**31), 2**31 - 1))
def test_a_fixed_point_number_reads_back_from_its_bits(units: int) -> None:
    bits = bit_pattern(units / 65536, "fixed-16.16").replace(".", "")
    assert np.array(int(bits, 2), np.uint32).view(np.int32) == units


def test_what_has_no_bits_is_refused() -> None:
    with pytest.raises(
        ValueError, match=r"layout must be one of float16, float32, float64 or fixed-n\.m, got exact"
    ):
        bit_pattern(1.0, "exact")
    with pytest.raises(ValueError, match="must be finite, got nan"):
        bit_pattern(float("nan"), "fixed-24.8")
