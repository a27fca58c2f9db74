import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest

from tests.widgets.showing import shown
from widgets.grid.buffer_strip import BufferStrip
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView

LEFT, NO_KEY = Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier


def three(offset: float = 0.0) -> list[GridBuffer]:
    values = np.arange(12.0).reshape(3, 4) + offset
    return [
        GridBuffer("z", values, title="depth"),
        GridBuffer("c", values > 5, "bool", title="coverage"),
        GridBuffer("w", np.repeat(values[:, :, None], 3, axis=2) / 12, "weights"),
    ]


@pytest.fixture
def strip(qtbot) -> BufferStrip:
    widget = BufferStrip()
    widget.show_buffers(three())
    return shown(qtbot, widget, 700, 200)


def center(grid: PixelGrid, column: int, row: int) -> QPoint:
    return grid.placement().cells_rect(column, row).center().toPoint()


def test_hover_in_one_marks_all_and_writes_values(strip: BufferStrip, qtbot) -> None:
    grid = strip.tile("c").grid
    before = {name: strip.tile(name).grid.grab().toImage() for name in strip.names()}
    with qtbot.waitSignal(strip.pixel_hovered) as hovered:
        QTest.mouseMove(grid, center(grid, 2, 1))
    assert hovered.args == [2, 1]
    assert [strip.tile(name).value.text() for name in ("z", "c")] == ["6", "1"]
    assert all(strip.tile(name).grid.grab().toImage() != before[name] for name in strip.names())


def test_the_pinned_value_comes_back_when_the_pointer_leaves(strip: BufferStrip) -> None:
    strip.show_pin((0, 0))
    assert strip.tile("z").value.text() == "0"
    strip.show_hover((3, 2))
    assert strip.tile("z").value.text() == "11"
    strip.show_hover(None)
    assert strip.tile("z").value.text() == "0"


def test_a_click_on_a_title_chooses_the_buffer(strip: BufferStrip, qtbot) -> None:
    with qtbot.waitSignal(strip.buffer_chosen) as chosen:
        QTest.mouseClick(strip.tile("c").title, LEFT)
    assert chosen.args == ["c"]
    assert [strip.tile(name).title.isChecked() for name in strip.names()] == [False, True, False]
    QTest.mouseClick(strip.tile("c").title, LEFT)
    assert strip.tile("c").title.isChecked()
    with qtbot.assertNotEmitted(strip.buffer_chosen):
        strip.show_chosen("z")
    assert strip.tile("z").title.isChecked()


def test_clicks_in_any_grid_are_passed_on(strip: BufferStrip, qtbot) -> None:
    grid = strip.tile("w").grid
    with qtbot.waitSignal(strip.pixel_clicked) as clicked:
        QTest.mouseClick(grid, LEFT, NO_KEY, center(grid, 1, 2))
    assert clicked.args == [1, 2]


def test_zoom_in_one_is_zoom_in_all(strip: BufferStrip, qtbot) -> None:
    with qtbot.waitSignal(strip.view_changed):
        strip.tile("z").grid.zoom_by(2.0)
    assert len({strip.tile(name).grid.view() for name in strip.names()}) == 1
    with qtbot.assertNotEmitted(strip.view_changed):
        strip.set_view(GridView(0.2, 0.2, 3.0))
    assert strip.tile("c").grid.view() == GridView(0.2, 0.2, 3.0)


def test_tiles_are_kept_from_step_to_step(strip: BufferStrip) -> None:
    before = [strip.tile(name) for name in strip.names()]
    strip.show_buffers(three(1.0))
    assert [strip.tile(name) for name in strip.names()] == before
    strip.show_hover((0, 0))
    assert strip.tile("z").value.text() == "1"
    strip.show_buffers(list(reversed(three()))[:2])
    assert strip.names() == ("w", "c")
    assert strip.tile("c") is before[1]


def test_new_tiles_know_what_the_others_show(strip: BufferStrip) -> None:
    geometry = GridGeometry(np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]), np.array([[0, 1, 2]]))
    strip.show_pin((1, 1))
    strip.show_geometry(geometry)
    strip.set_view(GridView(0.4, 0.4, 2.0))
    strip.show_buffers([*three(), GridBuffer("extra", np.zeros((3, 4)))])
    assert strip.tile("extra").grid.view() == GridView(0.4, 0.4, 2.0)
    assert strip.tile("extra").value.text() == "0"


def test_hidden_buffers_are_remembered(strip: BufferStrip) -> None:
    strip.set_hidden_names(frozenset({"c"}))
    assert not strip.tile("c").isVisible()
    strip.show_buffers(three()[:1])
    strip.show_buffers(three())
    assert not strip.tile("c").isVisible()
    assert strip.tile("z").isVisible()
    entries = {action.text(): action for action in strip.menu().actions()}
    assert [entries["depth"].isChecked(), entries["coverage"].isChecked()] == [True, False]
    entries["coverage"].trigger()
    assert strip.tile("c").isVisible()


def test_vector_values_lose_digits_before_they_are_cut(strip: BufferStrip) -> None:
    strip.show_pin((1, 2))
    tile = strip.tile("w")
    assert tile.value.fontMetrics().horizontalAdvance(tile.value.text()) <= tile.width()
    assert tile.value.toolTip().startswith("(0.75")


def test_names_must_differ(strip: BufferStrip) -> None:
    with pytest.raises(ValueError, match="names of their own"):
        strip.show_buffers([three()[0], three()[0]])


def test_titles_are_reached_by_the_keyboard(strip: BufferStrip, qtbot) -> None:
    title = strip.tile("w").title
    title.setFocus()
    with qtbot.waitSignal(strip.buffer_chosen) as chosen:
        QTest.keyClick(title, Qt.Key.Key_Space)
    assert chosen.args == ["w"]
    assert title.accessibleName() == "Show w in the main view"


def test_the_chosen_buffer_comes_into_sight_where_the_buffers_have_changed(strip: BufferStrip, qtbot) -> None:
    def is_in_sight(name: str) -> bool:
        tile = strip.tile(name)
        left = tile.mapTo(strip, QPoint(0, 0)).x()
        return left >= 0 and left + tile.width() <= strip.width()

    strip.resize(300, 200)
    names = [f"buffer {number}" for number in range(8)]
    strip.show_buffers([GridBuffer(name, np.zeros((3, 4))) for name in names])
    strip.show_chosen("buffer 7")
    qtbot.waitUntil(lambda: is_in_sight("buffer 7"))
    strip.show_buffers([GridBuffer(name, np.zeros((3, 4))) for name in ["first", *names]])
    strip.show_chosen("first")
    qtbot.waitUntil(lambda: is_in_sight("first") and not is_in_sight("buffer 7"))


def test_a_value_that_is_too_long_ends_in_an_ellipsis(strip: BufferStrip) -> None:
    strip.show_buffers([GridBuffer("picture", np.full((2, 2, 4), 255, np.uint8), "color")])
    tile = strip.tile("picture")
    tile.resize(60, 120)
    tile.show_value((0, 0))
    assert tile.value.text().endswith("…")
    assert tile.value.fontMetrics().horizontalAdvance(tile.value.text()) <= 60
    assert tile.value.toolTip() == "(255, 255, 255, 255)"
