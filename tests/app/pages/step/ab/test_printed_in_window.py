"""Listings as printed run as side B of A | B, beside the right method, from where they first differ."""

import json
import re
from pathlib import Path

import pytest
from PySide6.QtWidgets import QPushButton

from app.files.open_any import open_any
from app.files.state_files import State, load_state, save_state
from app.files.state_scenes import StateFileError
from app.help.reference import method_page
from app.pages.step.kept_look import look_of, show_look
from app.session.printed_runs import runnable
from app.window.main_window import MainWindow
from core.methods import table

pytestmark = pytest.mark.shared_window


def opened(window: MainWindow, scene: str) -> MainWindow:
    window.session.open(open_any(scene).document)
    return window


@pytest.mark.slow
def test_bresenham_as_printed_steps_up_one_column_early(window: MainWindow) -> None:
    opened(window, "pellacini-line")
    said: list[str] = []
    window.page.message_sent.connect(said.append)
    window.show_printed("pellacini-bresenham")
    view = window.page.comparing._view
    assert window.page.current_view() == "compare"
    assert window.session.document.settings.line == "bresenham-float"
    assert window.session.cursor.stage == "raster"
    assert "as printed: Bresenham loop (Pellacini)" in view.titles[1].text()
    assert said[-1].startswith(
        "In the order of drawing, pixel 2 is the first that differs: A draws (1, 0), B draws (1, 1)."
    )
    # The same loop, line by line, but that A tests before it adds.
    texts = [listing.toPlainText() for listing in view.listings]
    assert sorted(texts[0].splitlines()) == sorted(texts[1].splitlines())
    assert re.search(r"if d > 0.5.*d \+= m", texts[0], re.DOTALL)
    assert re.search(r"write\(x, y, 1\).*d \+= m.*if d > 0.5", texts[1], re.DOTALL)
    assert "tested before m is added (after Pellacini)" in view.titles[0].text()
    assert all(listing._line for listing in view.listings)
    assert view.grids[2].isVisibleTo(view)


def test_dda_as_printed_ends_before_the_last_pixel(window: MainWindow) -> None:
    opened(window, "pellacini-line")
    said: list[str] = []
    window.page.message_sent.connect(said.append)
    window.show_printed("pellacini-dda")
    assert said[-1].startswith(
        "In the order of drawing, pixel 6 is the first that differs: A draws (5, 2), B has ended."
    )


def test_it_stands_in_no_menu_of_methods_and_the_page_cannot_take_it(window: MainWindow) -> None:
    opened(window, "pellacini-line")
    window.show_printed("pellacini-dda")
    titles = {method.title for method in table}
    assert not titles & {printed.method.title for printed in runnable() if printed.method is not None}
    buttons = window.page.compare_view.findChildren(QPushButton)
    assert {button.text() for button in buttons if not button.isEnabled()} == {"Swap", "Use B"}
    assert window.session.document.settings.replacements == {}
    comparing = window.page.comparing
    assert comparing._view.value_box.currentText() == "as printed: DDA loop (Pellacini)"
    comparing._choose("line_clipping", "liang-barsky")
    assert comparing.printed == ""
    assert comparing.other.replacements == {}


def test_where_it_cannot_run_the_reason_is_said(window: MainWindow) -> None:
    opened(window, "single-triangle")
    before = window.session.document.settings
    window.show_printed("pellacini-dda")
    assert window.session.document.settings == before
    assert window.page.comparing.printed == ""


def test_fills_and_clippers_of_the_table_run_too(window: MainWindow) -> None:
    opened(window, "lmu-scanline-triangle")
    window.show_printed("lmu-scanline")
    assert window.session.document.settings.fill == "scanline"
    assert window.page.comparing.other.fill == "scanline-lecture"
    assert window.page.comparing.printed == "lmu-scanline"


def test_a_state_keeps_its_name_and_a_wrong_one_is_refused(window: MainWindow, tmp_path: Path) -> None:
    opened(window, "pellacini-line")
    window.show_printed("pellacini-bresenham")
    file = tmp_path / "printed.rasterscope"
    session = window.session
    save_state(
        file, State(session.document, "raster", session.cursor.position, look=look_of(window.page, 100))
    )
    state, _ = load_state(file)
    assert state.look.printed == "pellacini-bresenham"
    assert state.document.settings == session.document.settings
    assert json.loads(file.read_text())["settings"]["line"] == "bresenham-float"
    window.page.comparing.set_differences({})
    show_look(window.page, state.look)
    assert window.page.comparing.printed == "pellacini-bresenham"
    assert session.cursor.position == state.position

    record = json.loads(file.read_text())
    record["look"]["printed"] = "pellacini-dda2"
    file.write_text(json.dumps(record))
    with pytest.raises(StateFileError, match=r"look\.printed.*must be one of"):
        load_state(file)
    record["settings"]["fill"], record["look"]["printed"] = "spans", "lmu-scanline"
    file.write_text(json.dumps(record))
    with pytest.raises(StateFileError, match=r"look\.printed.*Segments have no area"):
        load_state(file)


def test_the_reference_of_the_right_method_leads_to_them() -> None:
    assert "do:printed/pellacini-dda" in method_page("line", "midpoint").html
    assert "do:printed" not in method_page("line", "dda").html


def test_every_listing_has_an_entry_in_the_menu(window: MainWindow) -> None:
    window.menus.printed_menu.aboutToShow.emit()
    entries = [action.data() for action in window.menus.printed_menu.actions()]
    assert entries == [printed.name for printed in runnable()]
    assert len(entries) == 13
