"""What must be seen is seen, measured from pixels: focus, current rows, marks, letters, splitters; light and dark."""

from collections.abc import Iterator
from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray
from PySide6.QtCore import QPoint, QRect, QRectF, Qt
from PySide6.QtGui import QAccessible, QColor, QImage, QPainter, QPixmap
from PySide6.QtWidgets import QApplication, QListWidget, QMenu, QTreeWidget, QTreeWidgetItem, QWidget
from pytestqt.qtbot import QtBot

from app.pages.stability.records import cell_kinds
from app.window.main_window import MainWindow
from tests.covering import is_everything
from widgets.basics.drawing import draw_mark
from widgets.basics.panes import PaneSplitter
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT, Theme
from widgets.experiments.map_canvas import cell_pixmap
from widgets.timeline.bar import TimelineBar
from widgets.timeline.run_picture import FLAGS, LANES, TimelineRun

Luminance = NDArray[np.float64]
BOTH = pytest.mark.parametrize("look", [LIGHT, DARK], ids=["light", "dark"])


@pytest.fixture
def styled(look: Theme, qapp: QApplication) -> Iterator[Theme]:
    """Apply a theme with its style sheet, and the light one without at the end."""
    apply_theme(qapp, look)
    yield look
    apply_theme(qapp, LIGHT)
    qapp.setStyleSheet("")


def luminance(picture: QPixmap | QImage) -> Luminance:
    """Return the (H, W) relative luminance of a picture, as WCAG 2 defines it."""
    image = QImage(picture if isinstance(picture, QImage) else picture.toImage())
    image = image.convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    encoded = rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3) / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return np.asarray(linear @ (0.2126, 0.7152, 0.0722))


def contrast(first: Luminance, second: Luminance | float) -> Luminance:
    """Return the contrast of luminances, elementwise."""
    low, high = np.minimum(first, second), np.maximum(first, second)
    return np.asarray((high + 0.05) / (low + 0.05))


def spoken_name(widget: QWidget) -> str:
    """Return the name that a screen reader reads."""
    return QAccessible.queryAccessibleInterface(widget).text(QAccessible.Text.Name)


def clear_pixels(before: Luminance, after: Luminance) -> int:
    """Return how many pixels differ by 3:1 or more."""
    return int((contrast(before, after) >= 3).sum())


@BOTH
def test_marks_of_the_timeline_stand_out(qtbot: QtBot, styled: Theme) -> None:
    """Marks in a lane have 3:1 to the lane along a good part of their pixels, alone and side by side."""
    bar = TimelineBar()
    qtbot.addWidget(bar)
    bar.resize(700, 90)
    bar.show()
    pale = []
    for mark in LANES:
        for steps in (np.arange(0, 4000, 400), np.arange(0, 4000, 5)):
            pictures = []
            for shown in (np.array([], np.int64), steps):
                bar.show_run(TimelineRun(4000, {mark: shown}))
                pictures.append(luminance(bar.grab()))
            changed = pictures[0] != pictures[1]
            share = clear_pixels(*pictures) / int(changed.sum())
            if share < 0.25:
                pale.append((mark, len(steps), round(share, 2)))
    assert pale == []


def selected_rows(parent: QWidget) -> list[tuple[str, QWidget, QRect]]:
    """Return menus and lists with a row that is current, and where that row is."""
    menu = QMenu(parent)
    actions = [menu.addAction(f"Action {k}") for k in range(3)]
    menu.resize(menu.sizeHint())
    rows = QListWidget(parent)
    rows.addItems(["one", "two", "three"])
    table = QTreeWidget(parent)
    table.setColumnCount(2)
    table.addTopLevelItems([QTreeWidgetItem([name, "1"]) for name in ("a", "b", "c")])
    for view in (rows, table):
        view.resize(200, 120)
        view.show()
    menu.setActiveAction(actions[1])
    rows.setCurrentRow(1)
    table.setCurrentItem(table.topLevelItem(1))
    return [
        ("menu", menu, menu.actionGeometry(actions[1])),
        ("list", rows.viewport(), rows.visualItemRect(rows.item(1))),
        ("table", table.viewport(), table.visualItemRect(table.topLevelItem(1))),
    ]


@BOTH
def test_the_current_row_stands_out(qtbot: QtBot, styled: Theme) -> None:
    """The current row of menus and lists differs by 3:1 from the others along its edge."""
    parent = QWidget()
    qtbot.addWidget(parent)
    for name, widget, row in selected_rows(parent):
        seen = luminance(widget.grab(row))
        ground = float(np.median(luminance(widget.grab(QRect(row.translated(0, row.height()))))))
        edges = np.concatenate((seen[:2].ravel(), seen[-2:].ravel(), seen[:, :6].ravel()))
        assert int((contrast(edges, ground) >= 3).sum()) >= row.height(), name


@BOTH
def test_letters_of_maps_can_be_read(qtbot: QtBot, styled: Theme) -> None:
    """The character of a cell has 4.5:1 to its fill."""
    for kind in cell_kinds():
        seen = luminance(cell_pixmap(kind, 60, styled, 1.0))
        fill = seen[6, 6]
        assert float(contrast(seen[4:-4, 4:-4], fill).max()) >= 4.5, kind.title


@BOTH
def test_states_survive_greyscale(styled: Theme) -> None:
    """Marks differ in brightness and shape, and cells of maps by their character, whatever their hue."""
    ground = QImage(24, 24, QImage.Format.Format_RGB32)
    shapes = {}
    for mark in (*LANES, *FLAGS):
        ground.fill(QColor(styled.canvas))
        with QPainter(ground) as painter:
            draw_mark(painter, mark, QRectF(0, 0, 24, 24))
        shapes[mark] = luminance(ground)
    for first, second in combinations(shapes, 2):
        assert int((contrast(shapes[first], shapes[second]) > 1.5).sum()) > 24, (first, second)
    characters = [kind.mark for kind in cell_kinds()]
    assert len(set(characters)) == len(characters)


@BOTH
def test_borders_between_panes_can_be_seen(qtbot: QtBot, styled: Theme) -> None:
    """A border has a line with 3:1 to its ground, in both directions."""
    for direction in (Qt.Orientation.Horizontal, Qt.Orientation.Vertical):
        panes = PaneSplitter(direction)
        qtbot.addWidget(panes)
        for _ in range(2):
            panes.addWidget(QWidget())
        panes.resize(300, 200)
        panes.show()
        seen = luminance(panes.handle(1).grab())
        assert int((contrast(seen, float(seen[0, 0])) >= 3).sum()) >= 24


@pytest.mark.slow
@pytest.mark.parametrize("look", [LIGHT, pytest.param(DARK, marks=pytest.mark.slow)], ids=["light", "dark"])
def test_the_focus_can_be_seen(window: MainWindow, styled: Theme) -> None:
    """Whatever takes the keyboard shows by 3:1 that it has it, along a line as long as its shorter side."""
    pages = ("step", "exercises", "start", "compare", "stability", "plan")
    for page in pages if is_everything() else pages[:2]:
        assert (page, unseen_stops(window, page)) == (page, [])


def unseen_stops(window: MainWindow, page: str) -> list[tuple[str, str]]:
    """Return what takes the keyboard on a page and does not show it."""
    window.session.set_stage("raster", 0)  # nothing has been done yet: the formula is empty
    window.page.show_panes(["methods", "inspector", "thumbnails"])
    window.run_action(f"page_{page}")
    unseen = []
    for stop in window.pages.current.findChildren(QWidget):
        is_stop = stop.isVisible() and stop.isEnabled() and stop.focusPolicy() & Qt.FocusPolicy.TabFocus
        if not is_stop or stop.focusProxy() is not None or stop.visibleRegion().isEmpty():
            continue
        area = QRect(stop.mapTo(window, QPoint(0, 0)), stop.size()).adjusted(-3, -3, 3, 3)
        area &= QRect(QPoint(0, 0), window.size())
        stop.clearFocus()
        stop.setFocus(Qt.FocusReason.TabFocusReason)
        if window.focusWidget() is not stop:
            continue
        with_focus = luminance(window.grab(area))
        stop.clearFocus()
        without = luminance(window.grab(area))
        if clear_pixels(with_focus, without) < min(stop.width(), stop.height()):
            unseen.append((type(stop).__name__, spoken_name(stop)))
    return sorted(set(unseen))
