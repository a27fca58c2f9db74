import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QApplication

from tests.widgets.showing import shown
from widgets.basics.theme import current_theme
from widgets.inspector.code_view import token_formats
from widgets.inspector.listing import ListingText, ListingView

SOURCE = '''def inside(a0, x, y):
    """Decide."""
    value = a0 * x  # signed
    if value > 0:
        return True
    return "no"
'''


@pytest.fixture
def view(qtbot) -> ListingView:
    result = ListingView()
    result.show_listing(ListingText("inside", SOURCE))
    return shown(qtbot, result, 420, 240)


def line_middle(view: ListingView, line: int) -> int:
    block = view.document().findBlockByNumber(line - 1)
    return round(view.blockBoundingGeometry(block).translated(view.contentOffset()).center().y())


def test_tokens_have_their_kinds() -> None:
    kinds = {(line, column): kind for line, column, _, _, kind in token_formats(SOURCE)}
    assert kinds[1, 0] == "keyword"
    assert kinds[1, 11] == "vertex0"
    assert kinds[2, 4] == "string"
    assert kinds[3, 20] == "comment"
    assert kinds[4, 15] == "number"
    assert (1, 15) not in kinds


def test_what_a_listing_is_for_stands_in_its_tooltip(view) -> None:
    view.show_listing(ListingText("rule", "def rule():\n  return 1", "Listing of a rule."))
    assert view.toolTip() == "Listing of a rule."
    view.show_listing(None)
    assert view.toolTip() == ""


def test_source_that_does_not_parse_is_shown_plainly(view) -> None:
    assert list(token_formats('x = """never closed')) == []

    view.show_listing(ListingText("broken", 'x = """never closed'))
    assert view.toPlainText() == 'x = """never closed'


def test_tokens_of_a_shader():
    source = "#version 300 es\nin vec3 n; // from\nvoid main() {\n   float E0 = 1.5;\n}"
    found = token_formats(source)
    assert (1, 0, 1, 15, "comment") in found
    assert (2, 0, 2, 2, "keyword") in found
    assert (2, 11, 2, 18, "comment") in found
    assert (4, 14, 4, 17, "number") in found
    assert not [token for token in found if token[0] == 4 and token[1] == 9]
    # A function alone is one, too; the same word begins nothing in a listing.
    assert token_formats("float f(vec3 n) {\n")[0] == (1, 0, 1, 5, "keyword")
    assert token_formats("float(x)\n") == ()


def test_a_click_on_a_line_asks_to_run_to_it(qtbot, view) -> None:
    seen = []
    view.line_clicked.connect(seen.append)
    qtbot.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(60, line_middle(view, 4)))
    assert seen == [4]
    qtbot.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(60, 230))
    assert seen == [4]


def test_long_lines_wrap_and_ten_are_seen_whole(view) -> None:
    lines = [f"    value_{k} = function_of_many(a0, a1, a2, x, y)  # {'and more ' * 4}" for k in range(12)]
    view.resize(350, 100)
    view.show_listing(ListingText("long", "\n".join(["def long():", *lines])))
    assert not view.horizontalScrollBar().maximum()
    view.resize(350, view.height_of(10))
    last = view.document().findBlockByNumber(4)
    assert view.blockBoundingRect(last).height() > 1.5 * view.fontMetrics().lineSpacing()
    view.show_listing(ListingText("inside", SOURCE))
    assert view.height_of(10) >= 10 * view.fontMetrics().lineSpacing()
    view.show_line(3)
    assert view.extraSelections()[-1].cursor.selectedText() == SOURCE.splitlines()[2]


def test_dragging_selects_and_asks_for_nothing(qtbot, view) -> None:
    seen = []
    view.line_clicked.connect(seen.append)
    start, end = QPoint(4, line_middle(view, 1)), QPoint(120, line_middle(view, 3))
    qtbot.mousePress(view.viewport(), Qt.MouseButton.LeftButton, pos=start)
    qtbot.mouseMove(view.viewport(), end)
    qtbot.mouseRelease(view.viewport(), Qt.MouseButton.LeftButton, pos=end)
    assert seen == []


def test_the_whole_margin_toggles_breakpoints(qtbot, view) -> None:
    seen = []
    view.breakpoint_toggled.connect(seen.append)
    for x in (2, view.margin.wanted_width() - 3):
        qtbot.mouseClick(view.margin, Qt.MouseButton.LeftButton, pos=QPoint(x, line_middle(view, 5)))
    assert seen == [5, 5]
    assert view.margin.wanted_width() >= 30


def test_keys_choose_a_line_run_to_it_and_break_on_it(qtbot, view) -> None:
    runs, breaks = [], []
    view.line_clicked.connect(runs.append)
    view.breakpoint_toggled.connect(breaks.append)
    view.setFocus()
    qtbot.keyClick(view, Qt.Key.Key_Down)
    qtbot.keyClick(view, Qt.Key.Key_Return)
    qtbot.keyClick(view, Qt.Key.Key_Return, Qt.KeyboardModifier.ShiftModifier)
    assert (runs, breaks) == ([2], [2])


def test_the_present_line_is_marked_by_bar_and_arrow_and_nothing_is_emitted(view) -> None:
    seen = []
    view.line_clicked.connect(seen.append)
    view.breakpoint_toggled.connect(seen.append)
    accent = QColor(current_theme().accent)
    margin = view.margin

    def accent_columns() -> list[int]:
        row = margin.grab().toImage()
        y = line_middle(view, 3)
        return [x for x in range(row.width()) if row.pixelColor(x, y) == accent]

    assert accent_columns() == []
    view.show_line(3)
    view.show_breakpoints({4})
    bar, arrow = accent_columns()[:4], accent_columns()[4:]
    assert bar == [0, 1, 2, 3]
    assert arrow
    assert arrow[0] > 4
    assert "3" in view.accessibleDescription()
    view.show_line(None)
    assert accent_columns() == []
    assert seen == []


def test_a_line_far_down_is_brought_into_view(view) -> None:
    view.show_listing(ListingText("long", "\n".join(f"x = {k}" for k in range(200))))
    view.show_line(180)
    top = view.firstVisibleBlock().blockNumber() + 1
    assert top <= 180 <= top + 40


def test_an_empty_pane_says_what_it_is_for(view) -> None:
    view.show_listing(None)
    assert view.toPlainText() == ""
    assert "algorithm" in view.placeholderText()
    assert view.line_at(5) is None


def test_the_marked_line_is_in_view_in_a_view_that_shrinks_or_was_hidden(qtbot, view) -> None:
    def is_in_view(line: int) -> bool:
        block = view.document().findBlockByNumber(line - 1)
        box = view.blockBoundingGeometry(block).translated(view.contentOffset())
        return box.top() >= 0 and box.bottom() <= view.viewport().height()

    view.show_listing(ListingText("long", "\n".join(f"line_{number} = {number}" for number in range(1, 41))))
    view.show_line(10)
    assert is_in_view(10)
    view.resize(420, 90)
    assert is_in_view(10)
    view.hide()
    view.show_line(31)
    view.resize(420, 80)
    view.show()
    qtbot.waitUntil(lambda: is_in_view(31))
    lines = [f"line_{number} = {number}" for number in range(1, 41)]
    lines[20] = " + ".join(["a_long_name"] * 10)
    view.show_listing(ListingText("wrapped", "\n".join(lines)))
    view.show_line(21)
    assert is_in_view(21)


def test_sizes_on_the_way_to_a_size_leave_no_trace(qtbot, view) -> None:
    view.show_listing(ListingText("long", "\n".join(f"x{k} = {k}" for k in range(60))))
    places = set()
    for heights in ((400,), (120, 400), (400, 90, 700, 400)):
        view.show_line(5)
        view.show_line(30)
        for height in heights:
            view.resize(421, height + 1)
            QApplication.processEvents()
            view.resize(420, height)
            QApplication.processEvents()
        places.add(view.verticalScrollBar().value())
    assert len(places) == 1


def test_no_line_is_marked_over_the_hint_of_an_empty_view(view) -> None:
    view.activateWindow()
    view.setFocus()
    QApplication.processEvents()
    assert view.hasFocus()
    view.show_listing(None)
    assert not view.extraSelections()
