"""Everything by keyboard: Tab reaches every stop and shows it, F6 walks the panes, Escape comes back."""

from itertools import pairwise

import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtGui import QColor
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QSplitterHandle, QTabBar, QWidget

from app.window import focus_walk
from app.window.main_window import MainWindow
from tests.covering import in_turns, is_everything
from widgets.basics.accessibility import ArrowGroup, KeyClaim, tab_stops
from widgets.basics.theme import current_theme
from widgets.space.scene_view import SceneView

pytestmark = pytest.mark.shared_window
PAGES = ("start", "step", "compare", "stability", "plan", "exercises")


def name_of(widget: QWidget) -> str:
    """Return a widget in words."""
    return f"{type(widget).__name__} {widget.accessibleName()}"


def walk(window: MainWindow, key: Qt.Key, modifier: Qt.KeyboardModifier) -> list[QWidget]:
    """Return what has the focus after each press of a key, until it comes round."""
    found: list[QWidget] = []
    while len(found) < 150:
        QTest.keyClick(window.focusWidget() or window, key, modifier)
        now = window.focusWidget()
        assert now is not None
        if now in found:
            break
        found.append(now)
    return found


def keyboard_widgets(window: MainWindow) -> list[QWidget]:
    """Return everything on the page that takes the keyboard by Tab; of several that arrows join, one will do."""
    found = []
    for widget in window.pages.current.findChildren(QWidget):
        takes_tab = bool(widget.focusPolicy() & Qt.FocusPolicy.TabFocus) and widget.focusProxy() is None
        if not (
            takes_tab and widget.isVisible() and widget.isEnabled() and widget.width() and widget.height()
        ):
            continue
        group = widget.group() if isinstance(widget, QAbstractButton) else None
        is_one_of_several = isinstance(widget.property("arrow group"), ArrowGroup) or (
            group is not None and group.exclusive()
        )
        is_inside = isinstance(widget.parent(), QTabBar)  # its arrows do what its scroll buttons do
        if not is_one_of_several and not widget.isWindow() and not is_inside:
            found.append(widget)
    return found


def is_seen(window: MainWindow, widget: QWidget) -> bool:
    """Return whether a widget can be seen in the window: a part of it is there and nothing lies over that."""
    area, above = QRect(widget.mapTo(window, QPoint(0, 0)), widget.size()), widget.parentWidget()
    while above is not None and above is not window:
        area &= QRect(above.mapTo(window, QPoint(0, 0)), above.size())
        above = above.parentWidget()
    on_top = window.childAt(area.center()) if area.isValid() else None
    return on_top is not None and (
        on_top is widget or widget.isAncestorOf(on_top) or on_top.isAncestorOf(widget)
    )


def check_tab(window: MainWindow, page: str) -> None:
    """Assert that Tab and Shift+Tab walk a page."""
    window.run_action(f"page_{page}")
    if page == "step":
        window.page.show_panes(["methods", "inspector", "thumbnails"])
    QApplication.processEvents()
    tab_stops([window.pages.current.main_view()])[0].setFocus(Qt.FocusReason.TabFocusReason)
    forward = walk(window, Qt.Key.Key_Tab, Qt.KeyboardModifier.NoModifier)
    hidden = []
    for stop in forward:
        stop.setFocus(Qt.FocusReason.TabFocusReason)
        window.focus_walk.go(is_forward=True)
        now = window.focusWidget()
        assert now is not None
        if not is_seen(window, now):
            hidden.append(name_of(now))
    assert hidden == []
    forward[-1].setFocus(Qt.FocusReason.TabFocusReason)
    backward = walk(window, Qt.Key.Key_Tab, Qt.KeyboardModifier.ShiftModifier)
    assert [*backward[-1:], *backward[:-1]] == forward[::-1]
    assert [name_of(each) for each in keyboard_widgets(window) if each not in forward] == []
    assert len(forward) <= 30 or page == "step"
    main = tab_stops([window.pages.current.main_view()])
    assert forward[-1] in main or set(forward[: len(main)]) & set(main)


def test_the_step_page_has_few_stops(window: MainWindow) -> None:
    """As it is at first, far fewer than the fifty that it had."""
    assert len(tab_stops(window.focus_walk.panes())) <= 26


def test_tab_stays_in_the_page_of_keys(window: MainWindow) -> None:
    """While the page of keys lies over the rest, only its own stops get the keyboard."""
    window.run_action("show_keys")
    stops = walk(window, Qt.Key.Key_Tab, Qt.KeyboardModifier.NoModifier)
    assert stops
    assert all(window.overlays.key_help.isAncestorOf(stop) and is_seen(window, stop) for stop in stops)


def check_f6(window: MainWindow, page: str) -> None:
    """Assert that F6 and Shift+F6 walk the panes of a page."""
    window.run_action(f"page_{page}")
    QApplication.processEvents()
    main = tab_stops([window.pages.current.main_view()])
    main[0].setFocus(Qt.FocusReason.TabFocusReason)
    forward = walk(window, Qt.Key.Key_F6, Qt.KeyboardModifier.NoModifier)
    assert len(forward) >= 2
    assert forward[-1] in main
    backward = walk(window, Qt.Key.Key_F6, Qt.KeyboardModifier.ShiftModifier)
    assert backward == forward[::-1]  # one press more has come round
    window.run_action("page_plan" if page == "compare" else "page_compare")
    window.run_action(f"page_{page}")
    assert window.focusWidget() in tab_stops([window.pages.current])
    forward[0].setFocus(Qt.FocusReason.TabFocusReason)
    window.run_action("unpin")
    assert window.focusWidget() in main


def test_the_ring_follows_the_focus_that_a_page_takes(window: MainWindow) -> None:
    """Qt sends no event for a focus without a reason: neither ring nor screen reader would follow."""
    window.run_action("page_step")
    grid, ring = window.page.grid, QColor(current_theme().focus)
    window.page.timeline.transport_buttons()[0].setFocus(Qt.FocusReason.MouseFocusReason)
    assert grid.grab().toImage().pixelColor(1, grid.height() // 2) != ring
    window.page.take_focus()
    assert grid.grab().toImage().pixelColor(1, grid.height() // 2) == ring


def test_arrows_go_through_a_row_of_buttons(window: MainWindow) -> None:
    """The buttons that step and play are one stop; Left and Right go from one to the next."""
    buttons = window.page.timeline.transport_buttons()
    stops = [stop for stop in tab_stops([window.page.timeline]) if stop in buttons]
    assert len(stops) == 1
    position = window.session.cursor.position
    stops[0].setFocus(Qt.FocusReason.TabFocusReason)
    QTest.keyClick(stops[0], Qt.Key.Key_Right)
    assert window.focusWidget() is buttons[1]
    assert window.session.cursor.position == position


def test_borders_move_by_keyboard(window: MainWindow) -> None:
    """A border has the focus and arrows move it."""
    window.run_action("page_compare")
    border = next(
        each
        for each in window.pages.current.findChildren(QSplitterHandle)
        if each.isVisible() and each.orientation() == Qt.Orientation.Horizontal
    )
    border.setFocus(Qt.FocusReason.TabFocusReason)
    before = border.x()
    QTest.keyClick(border, Qt.Key.Key_Right)
    assert border.x() > before


@pytest.mark.own_window
def test_view_and_timeline_zoom_and_move_by_keys(window: MainWindow) -> None:
    """Alt and plus magnifies the view, or the timeline while that has the keyboard; Ctrl and arrows move it."""
    grid, bar = window.page.grid, window.page.timeline.bar
    views, stretches = [grid.view()], [bar.visible_stretch()]
    grid.setFocus()
    for action in ("zoom_in", "view_right", "view_up"):
        window.run_action(action)
        views.append(grid.view())
    bar.setFocus(Qt.FocusReason.TabFocusReason)
    for action in ("zoom_in", "view_left", "zoom_out"):
        window.run_action(action)
        stretches.append(bar.visible_stretch())
    for shown in (views, stretches):
        assert all(before != after for before, after in pairwise(shown))
    window.page.show_view("scene")
    space = window.page.main_view()
    assert isinstance(space, SceneView)
    orbit = space.orbit()
    space.setFocus(Qt.FocusReason.TabFocusReason)
    window.run_action("zoom_in")
    assert space.orbit() != orbit


def test_triangles_and_vertices_by_keys(window: MainWindow) -> None:
    """A triangle is chosen and its vertex moved by half a pixel a press; each press can be undone."""
    session = window.session
    window.run_action("next_triangle")
    assert session.document.triangle == 0
    window.run_action("previous_triangle")
    assert session.document.triangle == 1
    window.run_action("go_to_triangle")
    window.overlays.ask_bar.text_entered.emit("triangle", "0")
    assert session.document.triangle == 0
    before = session.document.scene
    window.run_action("next_vertex")
    assert "Vertex 0" in window.page.grid.vertex_text()
    place = window.page.grid.vertex_text()
    window.run_action("vertex_right")
    assert window.page.grid.vertex_text() != place
    window.run_action("undo")
    assert session.document.scene is before


@pytest.mark.own_window
def test_tab_reaches_every_stop_and_shift_tab_is_its_mirror(window: MainWindow) -> None:
    """Forward and backward the same stops in opposite order, all that take the keyboard, all in sight."""
    for page in PAGES if is_everything() else ("step", "stability", "exercises"):
        check_tab(window, page)


@pytest.mark.own_window
def test_f6_walks_the_panes_and_escape_comes_back(window: MainWindow) -> None:
    """F6 and Shift+F6 are mirror images; Escape gives the keyboard to the main view and only then does more."""
    for page in PAGES:
        check_f6(window, page)


@pytest.mark.own_window
@in_turns(
    opened=["choose_scene", "show_keys", "go_to_pixel"],
    reason=[Qt.FocusReason.MouseFocusReason, Qt.FocusReason.TabFocusReason],
)
def test_what_lay_over_the_page_gives_the_keyboard_back(
    window: MainWindow, opened: str, reason: Qt.FocusReason
) -> None:
    """The view had the arrows only if Tab had gone there, and has them after the list just as before."""
    page = window.page
    page.show_view("scene")
    view = page.main_view()
    view.setFocus(reason)
    claim = view.findChild(KeyClaim)
    window.run_action(opened)
    assert window.focusWidget() is not view
    QTest.keyClick(window.focusWidget(), Qt.Key.Key_Escape)
    assert window.focusWidget() is view
    assert claim.is_kept == (reason is Qt.FocusReason.TabFocusReason)


@pytest.mark.own_window
def test_what_hides_gives_the_keyboard_to_the_first_stop_without_looking_further(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = window.page
    focused = page.variables
    focused.setFocus()
    assert window.focusWidget() is focused
    first = tab_stops(window.focus_walk.panes())[0]

    def refuse(panes: object) -> list[QWidget]:
        raise AssertionError("all stops were looked for")

    monkeypatch.setattr(focus_walk, "tab_stops", refuse)
    page.toggle_pane("inspector")
    assert window.focusWidget() is first
    page.toggle_pane("inspector")
