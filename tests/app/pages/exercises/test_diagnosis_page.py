"""A picture that another program drew is dropped on the window: its mistake is named, marked and stepped."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.pages.cover import COVERED
from app.pages.exercises.page import ExercisesPage
from app.session.document import open_document
from app.window.main_window import MainWindow
from core import render
from core.framebuffer.display import to_display
from lessons.small_scenes import triangle_scene
from tests.app.pages.exercises.acting import LEFT
from widgets.basics.message_bar import Progress
from widgets.grid.layers import MaskOverlay

pytestmark = pytest.mark.shared_window


@pytest.fixture
def small(window: MainWindow) -> MainWindow:
    """Return the window with a scene that is drawn in a moment: the longest edge goes through pixel centres."""
    places = [[(1.5, 1.5), (9.5, 1.5), (9.5, 9.5)], [(1.5, 1.5), (9.5, 9.5), (2, 9)]]
    colors = [[(1, 0, 0, 1)] * 3, [(0, 1, 0, 1)] * 3]
    scene = triangle_scene(places, (16, 12), attributes=colors)
    window.session.open(open_document(scene, "Mine"))
    window.session.set_stage("raster", 100)
    return window


def dropped(window: MainWindow, path: Path) -> ExercisesPage:
    window.open_path(str(path))
    page = window.pages.current
    page.settle()
    return page


def test_the_mistake_of_a_picture_is_named_marked_and_stepped(
    small: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    document = small.session.document
    right, wrong = (
        render(document.traced_scene, replace(document.settings, fill_rule=rule))
        for rule in ("shared-edge", "inclusive")
    )
    path = tmp_path / "homework.png"
    Image.fromarray(np.ascontiguousarray(to_display(wrong.color).pixels[::-1, :, :3])).save(path)
    worked: list[Progress | None] = []
    small.pages.page("exercises").work_progressed.connect(worked.append)
    page = dropped(small, path)
    assert worked[0] == Progress("comparing", 0, 100)
    assert worked[-1] is None
    view = page.diagnosis_view
    assert page.main_view() is view
    assert view.about.text().startswith(
        "homework.png, compared with Mine, 16 x 12 pixels. Compared: the colours"
    )
    said = view.spoken_text()
    assert "make this picture" in said
    assert "All edges inclusive. Every centre on an edge was counted" in said
    (marks,) = [each for each in view.grid.overlays() if isinstance(each, MaskOverlay)]
    assert (marks.mask == (right.primitive != wrong.primitive)).all()
    with qtbot.waitSignal(small.opening.opened):
        QTest.mouseClick(view.run_buttons[0], LEFT)
    comparing = small.page.comparing
    qtbot.waitUntil(lambda: not comparing.meeting.is_searching)
    assert small.page.current_view() == "compare"
    differing = (right.primitive != wrong.primitive).nonzero()
    assert small.session.cursor.stage == "raster", "the pixel, not the rule of an edge"
    assert small.session.pin in list(zip(differing[1], differing[0], strict=True))
    small.run_action("page_exercises")
    small.run_action("unpin")
    assert page.main_view() is page.panes


def test_a_grey_picture_is_named_and_has_no_run(small: MainWindow, tmp_path: Path) -> None:
    shown = to_display(render(small.session.document.traced_scene).color).pixels[::-1, :, :3]
    Image.fromarray(np.ascontiguousarray(shown)).convert("L").save(tmp_path / "grey.png")
    view = dropped(small, tmp_path / "grey.png").diagnosis_view
    assert "Grey. The colours are made grey: 0.299 R + 0.587 G + 0.114 B." in view.spoken_text()
    assert view.run_buttons == []


def test_what_is_no_such_picture_is_one_sentence(small: MainWindow, tmp_path: Path) -> None:
    said: list[str] = []
    page = small.pages.page("exercises")
    page.edit_refused.connect(said.append)
    Image.new("RGB", (3, 2)).save(tmp_path / "small.png")
    (tmp_path / "text.csv").write_text("a,b,c,d")
    for name, wanted in (
        ("small.png", "small.png: expected a picture of 16 x 12 pixels, got 3 x 2."),
        ("text.csv", "text.csv: expected lines of column, row;"),
        ("nothing.npz", "nothing.npz cannot be read or written: no such file or directory."),
    ):
        said.clear()
        assert dropped(small, tmp_path / name).main_view() is not page
        assert len(said) == 1
        assert said[0].startswith("The picture was not compared: ")
        assert wanted in said[0]
    small.session.set_asked("digest", is_open=True)
    said.clear()
    dropped(small, tmp_path / "small.png")
    assert said == [COVERED["exercise"]]
    small.session.set_asked("", is_open=False)


@pytest.mark.slow
def test_what_goes_well_takes_an_earlier_warning_of_its_page_away(small: MainWindow, tmp_path: Path) -> None:
    Image.new("RGB", (3, 2)).save(tmp_path / "small.png")
    Image.new("RGB", (16, 12)).save(tmp_path / "black.png")
    for name, is_warned in (("small.png", True), ("black.png", False)):
        dropped(small, tmp_path / name)
        assert small.messages.isHidden() is not is_warned, name
    small.files.save_to(str(tmp_path / "none" / "a.json"))
    assert not small.messages.isHidden()
    dropped(small, tmp_path / "black.png")
    assert not small.messages.isHidden(), "the scene is still not saved"
    small.files.save_to(str(tmp_path / "a.json"))
    assert small.messages.isHidden()
