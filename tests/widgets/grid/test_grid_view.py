import pytest
from hypothesis import given
from hypothesis import strategies as st
from PySide6.QtCore import QPointF, QRect, QRectF

from widgets.grid.view import FIT, GridView, clamped, panned, place, zoomed

AREA = QRect(30, 5, 600, 400)


@given(st.integers(1, 200), st.integers(1, 200), st.floats(0.5, 60), st.floats(0, 1), st.floats(0, 1))
def test_the_two_mappings_undo_each_other(columns: int, rows: int, zoom: float, x: float, y: float) -> None:
    placement = place(columns, rows, AREA, GridView(x, y, zoom))
    for window in ((0.0, 0.0), (columns + 0.25, rows - 3.5)):
        back = placement.to_window(placement.to_widget(*window))
        assert back == pytest.approx(window, abs=1e-6)


def test_y_grows_upward() -> None:
    placement = place(8, 6, AREA, FIT)
    assert placement.to_widget(0, 6).y() < placement.to_widget(0, 0).y()
    assert placement.pixel_at(placement.to_widget(0.5, 0.5)) == (0, 0)
    assert placement.pixel_at(placement.to_widget(7.5, 5.5)) == (7, 5)
    assert placement.pixel_at(placement.to_widget(8.5, 5.5)) is None


@given(st.integers(1, 96), st.integers(1, 72))
def test_fit_holds_the_whole_raster_in_whole_cells(columns: int, rows: int) -> None:
    placement = place(columns, rows, AREA, FIT)
    raster = placement.cells_rect(0, 0, columns, rows)
    assert AREA.contains(raster.toAlignedRect())
    if placement.cell >= 6:
        assert raster == QRectF(raster.toRect())
    assert placement.visible_cells() == (0, 0, columns, rows)


def test_centres_on_integers_shift_window_positions() -> None:
    half, integer = place(8, 6, AREA, FIT), place(8, 6, AREA, FIT, corner=-0.5)
    assert half.to_widget(0.5, 0.5) == integer.to_widget(0.0, 0.0)


@pytest.mark.parametrize("factor", [1.25, 0.8])
@pytest.mark.parametrize("ratio", [1.0, 1.5, 2.0])
def test_zoom_keeps_the_point_under_the_pointer(factor: float, ratio: float) -> None:
    position = QPointF(250, 220)
    view = GridView(0.5, 0.5, 3.0)
    for _ in range(4):
        placement = place(24, 16, AREA, view, ratio)
        before = placement.to_window(position)
        view = zoomed(placement, position, factor, ratio)
        after = place(24, 16, AREA, view, ratio)
        assert (after.cell > placement.cell) == (factor > 1)
        assert (after.cell * ratio) % 1 == pytest.approx(0)
        assert after.to_window(position) == pytest.approx(before, abs=1.0 / after.cell)


def test_zoom_has_ends() -> None:
    view = FIT
    for _ in range(100):
        view = zoomed(place(24, 16, AREA, view), QPointF(250, 220), 1.25)
    assert place(24, 16, AREA, view).cell == 400
    for _ in range(100):
        view = zoomed(place(24, 16, AREA, view), QPointF(250, 220), 0.8)
    assert place(24, 16, AREA, view).cell == 12


def test_pan_follows_the_pointer() -> None:
    placement = place(24, 16, AREA, GridView(0.5, 0.5, 4.0))
    view = panned(placement, GridView(0.5, 0.5, 4.0), QPointF(30, -20))
    moved = place(24, 16, AREA, view)
    assert moved.left == placement.left + 30
    assert moved.bottom == placement.bottom - 20


def test_a_view_from_a_file_is_made_sound() -> None:
    assert clamped(GridView(float("nan"), 7.0, -1.0)) == GridView(0.5, 1.0, 1.0)


def test_a_raster_larger_than_the_widget_fits_too() -> None:
    placement = place(4000, 3000, QRect(0, 0, 100, 80), FIT)
    assert 0 < placement.cell < 0.03
