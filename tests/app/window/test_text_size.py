"""The size of the text and of the window: what is chosen is shown, kept, and fits."""

import pytest
from PySide6.QtWidgets import QApplication

from app.window.appearance import TEXT_SIZES, sized_theme, the_application
from app.window.main_window import MainWindow
from app.window.start import first_size
from widgets.basics.theme import LIGHT, current_theme

pytestmark = pytest.mark.shared_window


def test_the_text_grows_and_shrinks_and_is_remembered(window: MainWindow) -> None:
    window.run_action("text_larger")
    assert current_theme().text_px == round(1.1 * LIGHT.text_px)
    assert window.memory.preferences.text_size == 110
    window.appearance.set_text_size(TEXT_SIZES[-1])
    window.run_action("text_larger")
    assert current_theme().text_px == 2 * LIGHT.text_px
    assert window.page.listing.font().pixelSize() == 2 * LIGHT.text_px
    assert window.page.sentence.font().pixelSize() == 2 * LIGHT.text_px
    window.run_action("toggle_theme")
    assert current_theme().is_dark
    assert current_theme().text_px == 2 * LIGHT.text_px
    for _ in TEXT_SIZES:
        window.run_action("text_smaller")
    assert current_theme().text_px == LIGHT.text_px
    shown = [action.data() for action in window.menus.text_size_group.actions() if action.isChecked()]
    assert shown == [100]


def test_the_desktop_decides_where_nothing_is_chosen() -> None:
    font = QApplication.font()
    assert sized_theme("light", 0).text_px in [round(size * LIGHT.text_px / 100) for size in TEXT_SIZES]
    assert QApplication.font() == font


def test_the_window_opens_inside_the_screen() -> None:
    application = the_application()
    size = first_size(application)
    screen = application.primaryScreen().availableSize()
    assert size.width() <= screen.width()
    assert size.height() < screen.height()


@pytest.mark.slow
@pytest.mark.parametrize(("size", "percent"), [((853, 533), 100), ((1280, 800), 200)])
def test_nothing_of_the_step_page_lies_off_the_window(
    window: MainWindow, size: tuple[int, int], percent: int
) -> None:
    window.appearance.set_text_size(percent)
    window.resize(*size)
    QApplication.processEvents()
    QApplication.processEvents()
    assert (window.width(), window.height()) == size
    page = window.page
    inside = window.rect()
    for widget in (
        *page.timeline.transport_buttons(),
        *page.timeline.level_buttons.values(),
        page.events.box,
        page.timeline.position_box,
        page.timeline.speed_box,
        page.timeline.chapters,
        page.timeline.bar,
        page.main_area.buffer_choice,
        page.main_area.thumbnails_button,
        page.main_view(),
        page.column,
        *page.side_tabs.buttons.values(),
    ):
        box = widget.rect().translated(widget.mapTo(window, widget.rect().topLeft()))
        assert inside.contains(box), (widget, box)
    view = page.main_view()
    assert page.timeline.bar.height() == page.timeline.bar.sizeHint().height()
    assert view.width() >= 200
    assert view.height() >= 150


@pytest.mark.slow
def test_large_text_leaves_room_for_the_picture_of_a_stage_with_two_sides(window: MainWindow) -> None:
    window.session.set_stage("transform", 0)
    QApplication.processEvents()
    assert window.page.main_area.beside.isVisible()
    window.appearance.set_text_size(TEXT_SIZES[-1])
    QApplication.processEvents()
    assert not window.page.main_area.beside.isVisible()
    window.appearance.set_text_size(100)
    QApplication.processEvents()
    assert window.page.main_area.beside.isVisible()
