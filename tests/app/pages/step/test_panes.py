"""What every pane of the Step page owes: a key, a place in saved states, room for the presenter, and a name."""

from pathlib import Path

import pytest
from PySide6.QtGui import QAccessible, QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget

import bootstrap
from app.files.state_files import load_state, save_state
from app.pages.step.page import PANES_AT_FIRST
from app.pages.step.panes import PANES, SIDE_PANES, Pane
from app.window.actions import ACTIONS_BY_NAME
from app.window.main_window import MainWindow
from tests.covering import is_everything
from widgets.basics.accessibility import tab_stops

pytestmark = pytest.mark.shared_window


def spoken_name(widget: QWidget) -> str:
    """Return what a screen reader calls a widget."""
    found = QAccessible.queryAccessibleInterface(widget)
    return "" if found is None else found.text(QAccessible.Text.Name)


def part(window: MainWindow, pane: Pane) -> QWidget:
    """Return the widget that a pane shows."""
    page = window.page
    others: dict[str, QWidget] = {
        "inspector": page.column,
        "details": page.variables,
        "thumbnails": page.strip,
        "navigator": page.navigator,
        "run": page.timeline,
    }
    if pane in SIDE_PANES:
        return page.side_panes.widget(SIDE_PANES.index(pane))
    return others[pane.name]


@pytest.mark.parametrize("pane", PANES, ids=lambda pane: pane.name)
def test_what_every_pane_owes(window: MainWindow, tmp_path: Path, pane: Pane) -> None:
    page = window.page
    window.session.set_stage("raster", 400)
    page.grid.zoom_by(4.0)  # the navigator has something to show
    action = ACTIONS_BY_NAME[f"pane_{pane.name}"]
    assert action.keys == (pane.key,)
    assert f"{pane.key}" in (bootstrap.ROOT / "README.md").read_text(encoding="utf-8")
    page.show_panes(["inspector", *({pane.name} & {"details"})])
    if pane.name in page.shown_panes():
        page.toggle_pane(pane.name)
    # A key shows it, and the menu says so.
    page.grid.setFocus()
    QTest.keySequence(window, QKeySequence(pane.key))
    QApplication.processEvents()
    if pane.name == "details":
        page.show_panes(["inspector", "details"])
        page.column.show_step()
    assert part(window, pane).isVisible(), "shown by its key"
    assert window.menus.actions_by_name[action.name].isChecked()
    # A screen reader and Tab find something in it.
    stops = tab_stops([part(window, pane)])
    assert stops
    assert [stop for stop in stops if not spoken_name(stop)] == [], "named"
    # A saved state keeps it.
    file = tmp_path / "state.rasterscope"
    save_state(file, window.files.state())
    page.show_panes(PANES_AT_FIRST)
    look = load_state(file)[0].look
    assert look.panes is not None
    assert pane.name in look.panes


@pytest.mark.slow
def test_the_presenter_puts_every_pane_aside_and_leaving_brings_them_back(window: MainWindow) -> None:
    """Unless one is what is presented."""
    page, names = window.page, {pane.name for pane in PANES}
    page.show_panes([pane.name for pane in PANES])
    together = page.shown_panes()
    # Of those at the side one is seen at a time.
    assert names - {*together} <= {pane.name for pane in SIDE_PANES}
    others = [[*PANES_AT_FIRST, name] for name in sorted(names - {*together})]
    for shown in [together, *(others if is_everything() else others[:1])]:
        page.show_panes(shown)
        before = page.shown_panes()
        assert {*shown} <= {*before}
        window.presenter.arrange()
        assert page.shown_panes() == ["inspector"]
        window.presenter.leave()
        assert page.shown_panes() == before
