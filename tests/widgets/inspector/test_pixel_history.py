import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QGuiApplication

from tests.widgets.showing import shown
from widgets.basics.drawing import Mark
from widgets.basics.theme import current_theme
from widgets.inspector.pixel_history import (
    HistoryEntry,
    PixelHistory,
    PixelStory,
    PixelValue,
    is_stacked,
    value_columns,
)

GROUND = PixelValue((30, 34, 40, 255), 1.0)
ORANGE = PixelValue((220, 120, 60, 255), 0.421337)
STORY = PixelStory(
    13,
    7,
    "Triangle 12 is kept.",
    Mark.RIGHT,
    (
        HistoryEntry("Clear", None, None, GROUND),
        HistoryEntry("Triangle 3", GROUND, None, GROUND, Mark.REJECTED, "outside edge 1", is_rejected=True),
        HistoryEntry("Triangle 12", GROUND, ORANGE, ORANGE, Mark.COVERED, "nearer"),
    ),
)


@pytest.fixture
def history(qtbot) -> PixelHistory:
    result = PixelHistory()
    result.show_story(STORY)
    return shown(qtbot, result, 480, 320)


def row_box(history: PixelHistory, row: int):
    return history.view.visualRect(history.view.model().index(row, 0))


def test_the_verdict_comes_first(history) -> None:
    assert history.verdict.text() == "Triangle 12 is kept."
    assert "column 13, row 7" in history.place.text()


def test_each_row_shows_the_swatches_and_its_mark(history) -> None:
    box = row_box(history, 2)
    picture = history.view.viewport().grab().toImage()
    before, out, after = value_columns(box)
    middle = 7
    assert picture.pixelColor(before.left() + middle, box.top() + 5 + middle) == QColor(30, 34, 40)
    assert picture.pixelColor(out.left() + middle, box.top() + 5 + middle) == QColor(220, 120, 60)
    assert picture.pixelColor(after.left() + middle, box.top() + 5 + middle) == QColor(220, 120, 60)


def test_a_click_jumps_to_the_row(qtbot, history) -> None:
    seen = []
    history.row_activated.connect(seen.append)
    place = row_box(history, 2).center()
    qtbot.mouseClick(history.view.viewport(), Qt.MouseButton.LeftButton, pos=place)
    assert seen == [2]


def test_enter_jumps_too_and_numbers_stay_when_rows_are_left_out(qtbot, history) -> None:
    seen, toggles = [], []
    history.row_activated.connect(seen.append)
    history.rejected_toggled.connect(toggles.append)
    assert history.rejected_box.text() == "Show rejected (1)"
    qtbot.mouseClick(history.rejected_box, Qt.MouseButton.LeftButton, pos=QPoint(10, 10))
    assert toggles == [False]
    assert history.view.model().rowCount() == 2
    history.view.setCurrentIndex(history.view.model().index(1, 0))
    qtbot.keyClick(history.view, Qt.Key.Key_Return)
    assert seen == [2]


def test_code_shows_rejected_rows_without_a_signal(history) -> None:
    toggles = []
    history.rejected_toggled.connect(toggles.append)
    history.show_rejected(False)
    assert history.view.model().rowCount() == 2
    assert toggles == []


def test_full_precision_on_hover_and_copy(qtbot, history) -> None:
    index = history.view.model().index(2, 0)
    assert "depth 0.421337" in index.data(Qt.ItemDataRole.ToolTipRole)
    history.view.setFocus()
    history.view.setCurrentIndex(index)
    qtbot.keyClick(history.view, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    assert "out: sRGB (220, 120, 60), alpha 255, depth 0.421337" in QGuiApplication.clipboard().text()


def test_rejection_is_said_in_words(history) -> None:
    index = history.view.model().index(1, 0)
    assert "rejected: outside edge 1" in index.data(Qt.ItemDataRole.AccessibleTextRole)


def test_an_empty_pane_says_what_it_is_for_and_differs_from_a_pixel_without_fragments(history) -> None:
    history.show_story(None)
    assert "see its history" in history.verdict.text()
    assert not history.view.isVisible()
    history.show_story(PixelStory(0, 0, "No triangle reaches this pixel."))
    assert history.verdict.text() == "No triangle reaches this pixel."
    assert history.place.isVisible()


def test_a_narrow_pane_puts_the_values_under_the_title(history) -> None:
    wide = row_box(history, 2)
    assert value_columns(wide)[0].left() > wide.width() // 3
    history.resize(230, 320)
    narrow = row_box(history, 2)
    assert is_stacked(narrow.width())
    assert narrow.height() > wide.height()
    assert value_columns(narrow)[2].right() <= narrow.right()


@pytest.mark.parametrize("width", [240, 350, 420, 700])
def test_a_depth_of_eight_digits_has_room(qapp, width: int) -> None:
    box = QRect(0, 0, width, 20)
    font = QFont(qapp.font())
    font.setPixelSize(current_theme().small_px)
    needed = QFontMetrics(font).horizontalAdvance("0.62499994")
    swatch = QFontMetrics(qapp.font()).height() + 2
    for cell in value_columns(box):
        assert box.left() <= cell.left()
        assert cell.right() <= box.right()
        assert width < 300 or cell.width() - swatch >= needed
