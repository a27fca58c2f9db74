"""A | B | difference: linked grids, what B does otherwise, and what cannot be drawn."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.pages.step.ab_presenter import compare, settings_difference
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import Settings, render
from core.scene import Scene
from lessons.scenes import make_scene


def test_equal_settings_do_not_differ() -> None:
    frame = render(make_scene("single-triangle"))
    found = compare(frame, frame, "color", Settings(), Settings(), (0, 0))
    assert found.summary == "0 of 3,072 pixels differ."
    assert found.second_title == "B, the same settings"


@pytest.mark.parametrize("buffer", ["color", "primitive", "depth", "cover_count"])
def test_the_difference_is_b_minus_a(buffer: str) -> None:
    scene = make_scene("single-triangle")
    other = Settings(fill="scanline-lecture")
    a, b = render(scene), render(scene, other)
    found = compare(a, b, buffer, Settings(), other, (0, 0))
    first, second = getattr(a, buffer), getattr(b, buffer)
    differs = (first != second).any(axis=2) if first.ndim == 3 else first != second
    assert np.array_equal(found.difference.values != 0, differs)
    assert found.summary.startswith(f"{int(differs.sum())} of 3,072 pixels differ")


def test_the_difference_in_words() -> None:
    assert settings_difference(Settings(), Settings(block_size=4)) == "block size: 4"
    assert settings_difference(Settings(), Settings()) == ""


def test_one_key_shows_both_and_the_pixels_again(window: MainWindow, qtbot: QtBot) -> None:
    QTest.keyClick(window, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    view = window.page.compare_view
    assert view.isVisible()
    assert window.menus.actions_by_name["compare"].isChecked()
    assert "pixels differ" in view.summary.text()
    assert view.family_box.currentData() == "fill"
    assert view.value_box.currentData() == "scanline-lecture"
    QTest.keyClick(window, Qt.Key.Key_D, Qt.KeyboardModifier.ControlModifier)
    assert window.page.current_view() == "pixels"
    assert not window.menus.actions_by_name["compare"].isChecked()


def test_the_pictures_are_exported_without_the_choices(window: MainWindow, tmp_path: Path) -> None:
    window.page.show_view("compare")
    window.exports.export_to(str(tmp_path / "both.svg"))
    drawing = (tmp_path / "both.svg").read_text()
    for text in ("A, current settings", "Scanline, as printed", "Difference, colour", "pixels differ"):
        assert text in drawing
    for text in ("B = A", "Swap"):
        assert text not in drawing


def test_b_follows_the_page_but_for_its_difference(window: MainWindow) -> None:
    comparing = window.page.comparing
    window.page.show_view("compare")
    window.session.set_setting("interpolation", "affine")
    assert comparing.other == replace(window.session.document.settings, fill="scanline-lecture")
    window.page.compare_view.setting_chosen.emit("interpolation", "perspective")
    assert comparing.other.interpolation == "perspective"
    window.page.compare_view.reset_requested.emit()
    assert comparing.other == window.session.document.settings
    assert "0 of" in window.page.compare_view.summary.text()


def test_swapping_is_an_edit(window: MainWindow) -> None:
    window.page.show_view("compare")
    mine = window.session.document.settings
    window.page.compare_view.swap_requested.emit()
    assert window.session.document.settings.fill == "scanline-lecture"
    assert window.page.comparing.other == mine
    window.session.undo()
    assert window.session.document.settings == mine


def test_pin_and_hover_are_linked(window: MainWindow) -> None:
    window.page.show_view("compare")
    window.page.compare_view.pixel_clicked.emit(10, 11)
    assert window.session.pin == (10, 11)
    assert [grid.pin() for grid in window.page.compare_view.grids] == [(10, 11)] * 3


def test_what_b_cannot_draw_is_told_in_its_place(window: MainWindow) -> None:
    scene = make_scene("cube")
    assert isinstance(scene, Scene)
    window.page.show_view("compare")
    window.page.compare_view.setting_chosen.emit("depth", "inverse-w")
    flat = replace(scene, camera=replace(scene.camera, projection="orthographic"))
    window.session.open(open_document(flat, "Flat cube"))
    assert window.page.compare_view.summary.text().startswith(
        "B cannot be drawn: depth inverse-w needs a perspective"
    )
    assert window.page.compare_view.grids[1].buffer() is None


def test_a_slow_b_is_drawn_in_the_background(window: MainWindow, qtbot: QtBot) -> None:
    window.session.open(open_document(make_scene("sphere"), "Sphere"))
    window.page.show_view("compare")
    window.page.compare_view.setting_chosen.emit("fill", "brute-force")
    assert window.page.compare_view.summary.text() == "Drawing B …"
    qtbot.waitUntil(lambda: "0 of" in window.page.compare_view.summary.text(), timeout=20000)


def test_a_vertex_is_dragged_in_any_of_the_pictures(window: MainWindow) -> None:
    session = window.session
    session.open(replace(session.document, triangle=0))
    window.page.show_view("compare")
    document = session.document
    for grid in window.page.compare_view.grids:
        start = grid.placement().to_widget(*window.page.grids.geometry.vertices[0]).toPoint()
        QTest.mousePress(grid, Qt.MouseButton.LeftButton, pos=start)
        for step in range(1, 6):
            QTest.mouseMove(grid, start + QPoint(3 * step, 2 * step))
        assert session.document is not document
        assert "pixels differ" in window.page.compare_view.summary.text()
        QTest.mouseRelease(grid, Qt.MouseButton.LeftButton, pos=start + QPoint(15, 10))
        session.undo()
        assert session.document is document
    QTest.mousePress(grid, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(grid, start + QPoint(15, 10))
    assert session.document is not document
    QTest.keyClick(grid, Qt.Key.Key_Escape)
    assert session.document is document
