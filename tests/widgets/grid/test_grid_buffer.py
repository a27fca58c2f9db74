import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.records.arrays import is_alike
from widgets.grid.layers import GridBuffer, number_text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (-0.0, "−0"),
        (1 / 3, "0.3333"),
        (-1.25e-7, "−1.25e−7"),
        (12345.678, "12346"),
        (99999.9, "99999.9"),
        (1e6, "1000000"),
        (14860003.0, "14860003"),
        (226.75, "226.75"),
        (1e13, "1e13"),
        (0.5, "0.5"),
        (float("nan"), "NaN"),
        (float("inf"), "∞"),
        (float("-inf"), "−∞"),
        (True, "1"),
        (-7, "−7"),
        (1234567, "1234567"),
    ],
)
def test_numbers_read_well(value: bool | int | float, text: str) -> None:
    assert number_text(value) == text


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_full_precision_reads_back(value: float) -> None:
    assert float(number_text(value, 0).replace("−", "-")) == value


@given(st.floats(allow_nan=False, allow_infinity=False, min_value=-1e300, max_value=1e300))
def test_four_digits_are_near(value: float) -> None:
    read = float(number_text(value).replace("−", "-"))
    assert read == pytest.approx(value, rel=5.1e-4, abs=0.0)


def test_digits_are_dropped_to_fit() -> None:
    assert number_text(-0.123456, 4, 6) == "−0.123"
    assert number_text(1.23456e-10, 4, 5) == "1e−10"


def test_values_as_text() -> None:
    weights = np.array([[[0.25, 0.5, 0.25]]], np.float32)
    assert GridBuffer("w", weights, "weights").text_at(0, 0) == "(0.25, 0.5, 0.25)"
    assert GridBuffer("z", np.array([[0.5]]), unit="px").text_at(0, 0) == "0.5 px"
    ids = GridBuffer("id", np.array([[-1, 3]], np.int32), "ids")
    assert [ids.text_at(0, 0), ids.text_at(1, 0)] == ["−", "3"]


def test_row_0_is_the_first_row_of_the_array() -> None:
    buffer = GridBuffer("z", np.array([[1.0, 2.0], [3.0, 4.0]]))
    assert buffer.text_at(1, 0) == "2"
    assert buffer.text_at(0, 1) == "3"


def test_a_cell_says_where_rounding_alone_keeps_a_weight_from_0() -> None:
    values = np.array([[1.9e-17, 0.0, 0.25, 1e-12]])
    buffer = GridBuffer("weight 1", values, is_weight=True)
    assert [buffer.lines_at(column, 0, 4, 8)[0] for column in range(4)] == ["≈0", "0", "0.25", "1e−12"]
    assert buffer.text_at(0, 0) == "1.9e−17", "as it is, where it is asked for"
    assert GridBuffer("edge 1", values).lines_at(0, 0, 4, 8) == ["1.9e−17"], "its sign decides"


@pytest.mark.parametrize(
    ("values", "kind", "message"),
    [
        (np.zeros(4), "scalar", "got \\(4,\\)"),
        (np.zeros((0, 4)), "scalar", "at least one pixel"),
        (np.zeros((2, 2), complex), "scalar", "complex128"),
        (np.zeros((2, 2, 2)), "color", "1 or 3 or 4 channels, got 2"),
        (np.zeros((2, 2)), "ids", "ids must be integers"),
        (np.zeros((2, 2)), "heat", "got 'heat'"),
    ],
)
def test_bad_input_is_named(values: np.ndarray, kind: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        GridBuffer("b", values, kind)


def test_equal_values_are_the_same_picture() -> None:
    values = np.array([[0.0, np.nan]])
    buffer = GridBuffer("z", values)
    assert is_alike(buffer, GridBuffer("z", values.copy()))
    assert not is_alike(buffer, GridBuffer("z", values + 1))
    assert not is_alike(buffer, GridBuffer("z", values, range=(0, 1)))
    assert not is_alike(buffer, None)
