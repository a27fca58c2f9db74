"""The widget of a table that fills: cells, what a screen reader hears, copying, and the way to the step of a number."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QGuiApplication
from pytestqt.qtbot import QtBot

from core.records.steps import StepTable, TableCell, TableColumn
from widgets.basics.theme import current_theme
from widgets.inspector.step_table import StepTableView

COLUMNS = (TableColumn("p", "Speed."), TableColumn("q", "Room."))


def table(*rows: tuple[TableCell | None, TableCell | None], made: tuple[int, int] = (0, 0)) -> StepTable:
    labels = ("left", "right")[: len(rows)]
    return StepTable("Borders", "Border", COLUMNS, labels, rows, frozenset({made}), made[0], "Kept.")


def test_it_shows_what_is_known_and_leads_to_its_step(qtbot: QtBot) -> None:
    view = StepTableView()
    qtbot.addWidget(view)
    view.show_table(
        table((TableCell("0.3333", "0.3333333333333333", 4), None), (TableCell("–", "–", -1), None))
    )
    view.show()
    items = view.cells.model()
    assert [items.index(0, k).data() for k in (0, 1)] == ["0.3333", ""]
    heard = [items.index(0, k).data(Qt.ItemDataRole.AccessibleTextRole) for k in (0, 1)]
    assert heard == ["0.3333333333333333, made in this step", "empty"]
    go, copy = view.cells.actions()
    assert (go.shortcut().toString(), copy.shortcut().toString()) == ("Return", "Ctrl+C")
    asked: list[int] = []
    view.step_requested.connect(asked.append)
    for place in ((0, 0), (0, 1), (1, 0)):
        view.cells.setCurrentIndex(items.index(*place))
        go.trigger()
    assert asked == [4], "an empty cell and one without a number lead nowhere"


def test_it_is_copied_with_all_digits(qtbot: QtBot) -> None:
    view = StepTableView()
    qtbot.addWidget(view)
    view.show_table(table((TableCell("0.3333", "0.3333333333333333", 4), None)))
    view.cells.actions()[1].trigger()
    assert QGuiApplication.clipboard().text() == "Borders\nBorder\tp\tq\nleft\t0.3333333333333333\t\nKept.\n"
    view.show_table(None)
    assert view.cells.model().rowCount() == 0


def test_the_bar_of_a_step_covers_no_digit(qtbot: QtBot) -> None:
    view = StepTableView()
    qtbot.addWidget(view)
    view.resize(300, 300)
    cell = TableCell("−1.671875", "−1.671875", 4)
    view.show_table(table((cell, None), (cell, None)))
    picture = view.cells.viewport().grab().toImage()
    made, other = (view.cells.visualRect(view.cells.model().index(row, 0)) for row in (0, 1))
    accent = QColor(current_theme().accent)
    bar = [x for x in range(made.width()) if picture.pixelColor(made.left() + x, made.center().y()) == accent]
    assert bar
    ground = {
        picture.pixel(other.left() + x, y)
        for x in range(bar[-1] + 2)
        for y in range(other.top() + 2, other.bottom() - 2)
    }
    assert len(ground) == 1, "digits begin beside the place of the bar"


def test_the_row_of_a_step_stays_in_view_in_a_table_that_shrinks(qtbot: QtBot) -> None:
    view = StepTableView()
    qtbot.addWidget(view)
    view.resize(300, 600)
    cell, labels = TableCell("1", "1", 4), tuple("abcdefghijkl")
    view.show_table(
        StepTable("Rows", "", COLUMNS, labels, ((cell, cell),) * 12, frozenset({(11, 0)}), 11, "")
    )
    view.show()
    view.resize(300, 200)
    cells = view.cells
    assert cells.visualRect(cells.model().index(11, 0)).bottom() <= cells.viewport().height()


def test_in_the_room_that_it_wants_a_table_does_not_scroll(qtbot: QtBot) -> None:
    view = StepTableView()
    qtbot.addWidget(view)
    cell = TableCell("1", "1", 4)
    shown = table((cell, None), (cell, None))
    view.make_room([shown])
    view.show_table(shown)
    view.resize(300, view.wanted_size(300)[1])
    view.show()
    cells = view.cells
    assert (cells.verticalScrollBar().maximum(), cells.horizontalScrollBar().maximum()) == (0, 0)
