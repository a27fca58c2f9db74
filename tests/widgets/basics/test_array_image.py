import numpy as np
import pytest
from numpy.typing import NDArray
from PySide6.QtGui import QColor, QImage

from widgets.basics.image import (
    buffer_image,
    colormap_table,
    display_image,
    fitted_range,
    mask_image,
    srgb_table,
    value_range,
)
from widgets.basics.theme import LIGHT
from widgets.grid.layers import GridBuffer


def name_at(image: QImage, column: int, row: int) -> str:
    return image.pixelColor(column, image.height() - 1 - row).name()


def hex_of(color: NDArray[np.uint8]) -> str:
    return QColor(*color.tolist()).name()


def test_row_0_is_at_the_bottom() -> None:
    image = buffer_image(
        GridBuffer("c", np.array([[True, False], [False, False], [False, False]]), "bool"), LIGHT
    )
    assert (image.width(), image.height()) == (2, 3)
    assert image.pixelColor(0, 2).name() == LIGHT.covered
    assert image.pixelColor(0, 0).name() == LIGHT.empty
    assert image.pixelColor(1, 2).name() == LIGHT.empty


def test_a_drawn_picture_is_shown_byte_for_byte_without_its_alpha() -> None:
    pixels = np.random.default_rng(4).integers(0, 256, (3, 5, 4), np.uint8)
    image = display_image(pixels)
    assert (image.width(), image.height()) == (5, 3)
    for row in range(3):
        for column in range(5):
            found = image.pixelColor(column, 2 - row)
            assert found.getRgb() == (*pixels[row, column, :3].tolist(), 255)
    kept = image.pixelColor(0, 0).name()
    pixels[:] = 0
    assert image.pixelColor(0, 0).name() == kept, "the image owns its memory"


def test_scalars_take_the_ends_of_the_map() -> None:
    table = colormap_table("viridis")
    image = buffer_image(GridBuffer("z", np.array([[-5.0, 0.0, 1.0, 7.0]]), range=(0, 1)), LIGHT)
    assert [name_at(image, k, 0) for k in range(4)] == [hex_of(table[k]) for k in (0, 0, 255, 255)]


def test_zero_is_white_in_signed_buffers() -> None:
    image = buffer_image(GridBuffer("e", np.array([[-3.0, 0.0, 1.0]]), "signed"), LIGHT)
    assert name_at(image, 1, 0) == "#ffffff"
    assert name_at(image, 0, 0) == hex_of(colormap_table("diverging")[0])
    assert value_range(GridBuffer("e", np.array([[-3.0, 1.0]]), "signed")) == (-3.0, 3.0)


def test_nan_is_a_checker_and_infinity_has_a_colour_of_its_own() -> None:
    values = np.full((2, 2), np.nan, np.float32)
    image = buffer_image(GridBuffer("u", values), LIGHT)
    assert name_at(image, 0, 0) == name_at(image, 1, 1) == LIGHT.nan_light
    assert name_at(image, 1, 0) == name_at(image, 0, 1) == LIGHT.nan_dark
    values[0, 0] = np.inf
    assert name_at(buffer_image(GridBuffer("u", values), LIGHT), 0, 0) == LIGHT.infinite


@pytest.mark.parametrize("channels", [1, 3, 4])
def test_linear_colour_is_encoded(channels: int) -> None:
    linear = np.linspace(0, 1, 1000, dtype=np.float32)
    values = np.ones((1, 1000, channels), np.float32)
    values[0, :, : min(channels, 3)] = linear[:, None]
    image = buffer_image(GridBuffer("c", values, "color"), LIGHT)
    found = np.array([image.pixelColor(k, 0).red() for k in range(1000)])
    exact = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear.astype(float) ** (1 / 2.4) - 0.055)
    assert np.abs(found - 255 * exact).max() < 0.6
    assert srgb_table()[0] == 0
    assert srgb_table()[-1] == 255


def test_bytes_are_shown_as_they_are() -> None:
    values = np.array([[[10, 20, 30, 40]]], np.uint8)
    color = buffer_image(GridBuffer("c", values, "color"), LIGHT).pixelColor(0, 0)
    assert color.getRgb() == (10, 20, 30, 40)


def test_transparent_pixels_stay_transparent() -> None:
    values = np.zeros((1, 2, 4), np.float32)
    values[0, 1] = 1.0
    image = buffer_image(GridBuffer("c", values, "color"), LIGHT)
    assert [image.pixelColor(k, 0).alpha() for k in (0, 1)] == [0, 255]


def test_ids_have_distinct_colours_and_none_is_transparent() -> None:
    image = buffer_image(GridBuffer("p", np.array([[-1, 0, 1, 2, 5000]], np.int32), "ids"), LIGHT)
    assert image.pixelColor(0, 0).alpha() == 0
    assert len({image.pixelColor(k, 0).name() for k in range(1, 5)}) == 4


def test_weights_are_the_vertex_colours() -> None:
    image = buffer_image(GridBuffer("w", np.eye(3)[None], "weights"), LIGHT)
    assert [name_at(image, k, 0) for k in range(3)] == [color.lower() for color in LIGHT.vertex]


def test_extreme_values_do_no_harm() -> None:
    values = np.array([[-1.7e308, 1.7e308, 0.0]])
    table = colormap_table("viridis")
    image = buffer_image(GridBuffer("x", values), LIGHT)
    assert name_at(image, 0, 0) == hex_of(table[0])
    assert name_at(image, 1, 0) == hex_of(table[255])
    flat = buffer_image(GridBuffer("x", np.full((1, 1), 3.0)), LIGHT)
    assert name_at(flat, 0, 0) == hex_of(table[128])


def test_ranges_leave_out_what_is_not_finite() -> None:
    assert fitted_range(np.array([np.nan, 2.0, -1.0, np.inf])) == (-1.0, 2.0)
    assert fitted_range(np.array([np.nan])) == (0.0, 1.0)
    assert fitted_range(np.array([[3, 9]])) == (3.0, 9.0)


def test_masks_are_flipped_too() -> None:
    image = mask_image(np.array([[True], [False]]))
    assert [image.pixelColor(0, 0).alpha(), image.pixelColor(0, 1).alpha()] == [0, 255]
