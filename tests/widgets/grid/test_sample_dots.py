"""Samples as dots: filled in the colour of the triangle that has them, small and dark where nothing does."""

import numpy as np
import pytest

from tests.widgets.grid.pixel_grids import picture, shown_grid
from widgets.basics.image import id_table
from widgets.basics.theme import current_theme
from widgets.grid.layers import GridBuffer
from widgets.grid.marks import SampleDots, between_samples
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView


@pytest.fixture
def grid(qtbot) -> PixelGrid:
    return shown_grid(qtbot)


PLACES = np.array([[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]])


def samples_of(grid: PixelGrid, *marks: tuple[int, int, int, int]) -> SampleDots:
    """Return four samples in every pixel; ``marks``: sample, column, row and triangle."""
    buffer = grid.buffer()
    shown = np.full((4, buffer.rows, buffer.columns), -1)
    for sample, column, row, triangle in marks:
        shown[sample, row, column] = triangle
    return SampleDots(PLACES, shown)


def test_several_samples_are_drawn(grid: PixelGrid) -> None:
    plain = picture(grid)
    grid.show_samples(samples_of(grid))
    assert picture(grid) != plain


def test_a_sample_that_a_triangle_has_is_filled_in_its_colour(grid: PixelGrid) -> None:
    grid.set_view(GridView(2.5 / 24, 3.5 / 16, 4.0))
    grid.show_samples(samples_of(grid))
    hollow = picture(grid)
    grid.show_samples(samples_of(grid, (1, 2, 3, 2), (2, 2, 3, 5)))
    filled = picture(grid)
    placement, colors = grid.placement(), id_table()
    for sample, (x, y) in enumerate(PLACES):
        place = placement.to_widget(2 + x, 3 + y).toPoint()
        triangle = {1: 2, 2: 5}.get(sample)
        color = filled.pixelColor(place)
        if triangle is None:
            assert color == hollow.pixelColor(place)
        else:
            assert (color.red(), color.green(), color.blue()) == tuple(colors[triangle].tolist())
    other = placement.to_widget(4 + PLACES[1, 0], 3 + PLACES[1, 1]).toPoint()
    assert filled.pixelColor(other) == hollow.pixelColor(other)


def test_the_samples_of_a_pixel_are_told_in_words(grid: PixelGrid) -> None:
    assert grid.samples_text((2, 3)) == ""
    grid.show_samples(samples_of(grid, (0, 2, 3, 7), (2, 2, 3, 7), (1, 2, 3, 4)))
    assert grid.samples_text((2, 3)) == "Sample 1 shows triangle 4, samples 0 and 2 triangle 7, sample 3 none"
    assert grid.samples_text((0, 0)) == "Samples 0, 1, 2 and 3 show none"
    nine = np.zeros((9, 1, 1), int)
    nine[:4] = -1
    many = SampleDots(np.full((9, 2), 0.5), nine)
    assert many.text_at(0, 0) == "5 of 9 samples show triangle 0, 4 of 9 samples none"
    with pytest.raises(ValueError, match=r"shown must be \(4, H, W\), got \(3, 2, 2\)"):
        SampleDots(PLACES, np.zeros((3, 2, 2), int))


@pytest.mark.parametrize("across", [2, 3, 4])
@pytest.mark.parametrize("cell", [44, 72, 150])
def test_numbers_stand_between_dots_or_not_at_all(qtbot, across: int, cell: int) -> None:
    place = (np.arange(across) + 0.5) / across
    position = np.stack(np.meshgrid(place, place), axis=-1).reshape(-1, 2)
    grid = PixelGrid()
    qtbot.addWidget(grid)
    grid.resize(3 * cell + 60, 2 * cell + 60)
    grid.show_buffer(GridBuffer("z", np.full((2, 3), 0.2864, np.float32)))
    assert grid.has_numbers()
    dots = SampleDots(position, np.zeros((len(position), 2, 3), np.int64))
    grid.show_samples(dots)
    below, room = between_samples(grid.placement(), dots)
    side = grid.placement().cell
    centres = side * (0.5 - position[:, 1])
    assert np.abs(centres - below).min() > max(room, 0.0) / 2
    assert abs(below) < side / across
    assert grid.has_numbers() == (room >= 0.8 * round(0.73 * current_theme().small_px))


def test_the_numbers_of_four_samples_come_with_zoom(qtbot) -> None:
    grid = PixelGrid()
    qtbot.addWidget(grid)
    grid.show_buffer(GridBuffer("z", np.zeros((2, 3), np.float32)))
    grid.show_samples(SampleDots(PLACES, np.zeros((4, 2, 3), np.int64)))
    grid.resize(190, 140)
    assert 40 <= grid.placement().cell < 60
    assert not grid.has_numbers()
    grid.resize(400, 300)
    assert grid.has_numbers()
