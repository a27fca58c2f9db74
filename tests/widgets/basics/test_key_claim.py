import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QLineEdit, QVBoxLayout, QWidget

from core.explain.records import Variable
from widgets.inspector.listing import ListingText, ListingView
from widgets.inspector.variables import VariablesView


@pytest.fixture
def page(qtbot) -> QWidget:
    """Return a window whose arrows step, with a pane of code and a pane of variables."""
    page = QWidget()
    qtbot.addWidget(page)
    page.steps = []
    page.first = QLineEdit(page)
    page.listing = ListingView(page)
    page.listing.show_listing(ListingText("code", "a = 1\nb = 2\nc = 3"))
    page.variables = VariablesView(page)
    page.variables.show_variables((Variable("x", 1), Variable("y", 2)))
    layout = QVBoxLayout(page)
    for part in (page.first, page.listing, page.variables):
        layout.addWidget(part)
    for key in ("Left", "Right", "Up", "Down", "Space"):
        shortcut = QShortcut(QKeySequence(key), page)
        shortcut.activated.connect(lambda key=key: page.steps.append(key))
    page.resize(300, 400)
    page.show()
    qtbot.waitExposed(page)
    page.activateWindow()
    page.first.setFocus()
    return page


@pytest.mark.parametrize("name", ["listing", "variables"])
def test_after_a_click_the_arrows_go_on_stepping(qtbot, page, name: str) -> None:
    pane = getattr(page, name)
    qtbot.mouseClick(pane.viewport(), Qt.MouseButton.LeftButton, pos=QPoint(60, 8))
    assert pane.hasFocus()
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Down, Qt.Key.Key_Space):
        qtbot.keyClick(page.windowHandle(), key)
    assert page.steps == ["Right", "Down", "Space"]


@pytest.mark.parametrize("name", ["listing", "variables"])
def test_a_pane_reached_by_tab_moves_inside_with_the_arrows(qtbot, page, name: str) -> None:
    pane = getattr(page, name)
    pane.setFocus(Qt.FocusReason.TabFocusReason)
    qtbot.keyClick(page.windowHandle(), Qt.Key.Key_Down)
    qtbot.keyClick(page.windowHandle(), Qt.Key.Key_Space)
    assert page.steps == ["Space"]
