"""Seventy steps of a new user and of a lecturer, by intent."""

from pathlib import Path

import pytest
from PySide6.QtCore import QPoint
from PySide6.QtPrintSupport import QPrintPreviewDialog
from PySide6.QtWidgets import QApplication, QFileDialog
from pytestqt.qtbot import QtBot

from app.files.file_dialogs import SaveDialog
from app.window.main_window import MainWindow
from core.records.steps import Level
from tests.app.window.new_user import NewUser
from widgets.basics.theme import current_theme

SIDE = 21
"""Vertices along each side of the user's own mesh, a hill of 800 triangles."""


@pytest.fixture
def user(
    window: MainWindow,
    qtbot: QtBot,
    capfd: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> NewUser:
    """Return a user in front of the start page, for whom the system's dialogs choose files of a folder."""
    mesh = tmp_path / "hill.obj"
    places = [(x / 10 - 1, y / 10 - 1) for y in range(SIDE) for x in range(SIDE)]
    corners = [row * SIDE + column + 1 for row in range(SIDE - 1) for column in range(SIDE - 1)]
    rows = [f"v {x} {y} {1 - x * x - y * y}" for x, y in places]
    rows += [f"f {k} {k + 1} {k + 1 + SIDE} {k + SIDE}" for k in corners]
    mesh.write_text("\n".join(rows))
    chosen = iter([mesh, tmp_path / "mine.rasterscope"])
    saved = iter([tmp_path / "mine.rasterscope", tmp_path / "view.png"])
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *args: (str(next(chosen)), ""))
    monkeypatch.setattr(SaveDialog, "ask", lambda dialog: str(next(saved)))
    monkeypatch.setattr(QPrintPreviewDialog, "exec", lambda dialog: 1)
    window.run_action("page_start")
    QApplication.processEvents()
    capfd.readouterr()
    return NewUser(window, qtbot, capfd)


def walk_the_run(user: NewUser) -> None:
    """From the start page through the stages to the last byte."""
    does, press, click = user.does, user.press, user.click
    does("begin", lambda: click("Begin with one triangle"), lambda: user.window.pages.current_name == "step")
    does("see the start", lambda: press("1"), lambda: user.at() == ("transform", 0))
    does("do a step", lambda: press("Right"), lambda: user.position > 0 and user.view == "scene")
    does("take it back", lambda: press("Left"), lambda: user.position == 0)
    does("step by stages", lambda: click("Step by stage"), lambda: user.session.cursor.level == Level.STAGE)
    does("do a stage", lambda: press("Right"), lambda: user.at() == ("transform", user.end()))
    does("enter the next", lambda: press("Right"), lambda: user.at() == ("cull", 0))
    does("do it", lambda: press("Right"), lambda: user.at() == ("cull", user.end()))
    does("go on to clip", lambda: press("Right"), lambda: user.at() == ("clip", 0) and user.view == "clip")
    does("enter raster by its card", lambda: click("Stage Raster"), lambda: user.at() == ("raster", 0))
    does("go on by pixels", lambda: click("Step by pixel"), lambda: user.view == "pixels")
    does("test a pixel", lambda: press("Right"), lambda: "Pixel" in user.page.sentence.text())
    does("see no future", lambda: press("Right"), lambda: user.covered() <= 2)
    does("enter the last stage", lambda: click("Stage Resolve"), lambda: user.at() == ("resolve", 0))
    does("do all of it", lambda: press("End"), lambda: user.position == user.end())
    does("press on", lambda: press("Right"), lambda: user.message and user.at() == ("resolve", user.end()))


def ask_numbers(user: NewUser) -> None:
    """Where numbers come from, and what a pixel went through."""
    does, press, click_pixel = user.does, user.press, user.click_pixel
    does(
        "enter raster by its digit", lambda: press("6"), lambda: (user.stage, user.position) == ("raster", 0)
    )
    does("go to a pixel's test", lambda: press("Right"), lambda: user.page.formula.spoken())
    before = user.session.cursor
    does("follow E0", lambda: user.click_number("E0"), lambda: user.session.cursor != before and user.message)
    does("follow its a0", lambda: user.click_number("a0"), lambda: user.stage == "edges")
    does("come back", lambda: press("Ctrl+["), lambda: user.stage == "raster")
    does("come back further", lambda: press("Ctrl+["), lambda: user.session.cursor == before)
    does("click a pixel", lambda: click_pixel(27, 20), lambda: user.session.pin == (27, 20))
    does("read why", lambda: user.click_tab("Pixel history"), lambda: "0" in user.page.history.verdict.text())
    does("go to its step", lambda: press("J"), lambda: "(27, 20)" in user.page.sentence.text())
    does("see the variables", lambda: user.click_tab("This step"), lambda: user.page.variables.isVisible())
    does("ask for the pinned value", lambda: press("Y"), lambda: user.message)
    does("unpin", lambda: press("Escape"), lambda: user.session.pin is None)
    does("predict from the start", lambda: [press("6"), press("P")], lambda: user.page.prediction.isVisible())
    does("guess right", lambda: click_pixel(27, 20), lambda: "Right" in user.page.prediction.verdict.text())
    does("guess wrong", lambda: click_pixel(2, 40), lambda: "Wrong" in user.page.prediction.verdict.text())
    does("reveal", lambda: user.click("Reveal"), lambda: user.page.prediction.verdict.text())
    does("stop predicting", lambda: press("P"), lambda: not user.page.prediction.isVisible())


def learn(user: NewUser) -> None:
    """The guide, the glossary and a method's page."""
    does, press, click, click_link = user.does, user.press, user.click, user.click_link
    does("look for keys", lambda: press("?"), lambda: user.window.overlays.key_help.isVisible())
    does("close them", lambda: press("Escape"), lambda: not user.window.overlays.key_help.isVisible())
    does(
        "open the guide",
        lambda: [press("Alt+0"), click("Five-minute guide")],
        lambda: user.help_address() == "guide",
    )
    does(
        "open its triangle",
        lambda: click_link("Open the triangle"),
        lambda: user.window.pages.current_name == "step",
    )
    does("go to its stage", lambda: click_link("Interpolate"), lambda: user.stage == "interpolate")
    does("look a word up", lambda: click_link("fragments"), lambda: user.help_address() == "term/fragment")
    does(
        "find a method",
        lambda: user.type_into("Find in Help", "affine"),
        lambda: "Affine" in user.help_text(),
    )
    does(
        "open its page",
        lambda: click_link("Affine (screen-linear)"),
        lambda: user.help_address() == "method/interpolation/affine",
    )
    does(
        "read its source",
        lambda: None,
        lambda: "Source" in user.help_text() and "Breaks where" in user.help_text(),
    )
    does("close Help", lambda: press("F1"), lambda: not user.window.help.is_visible())


def change(user: NewUser) -> None:
    """Methods, A | B, corners."""
    does, press, click, click_tab = user.does, user.press, user.click, user.click_tab
    does("open Methods", lambda: click("Methods"), lambda: user.is_shown("Fill"))
    fill = user.document().settings.fill
    does(
        "fill by blocks",
        lambda: user.choose("Fill", "Blocks"),
        lambda: user.document().settings.fill == "blocks",
    )
    does("take it back", lambda: press("Ctrl+Z"), lambda: user.document().settings.fill == fill)
    does("compare", lambda: click_tab("A | B"), lambda: user.view == "compare")
    does("part ways", lambda: click("First divergence"), lambda: user.message)
    does("see the pixels", lambda: click_tab("Pixels"), lambda: user.view == "pixels")
    before = user.corner()
    does("drag a corner", lambda: user.drag_vertex(QPoint(20, -20)), lambda: user.corner() != before)
    does("take it back", lambda: press("Ctrl+Z"), lambda: user.corner() == before)
    does("open Scene", lambda: click("Scene"), lambda: user.is_shown("vertex 0 x"))
    does("type a corner", lambda: user.type_into("vertex 0 x", "12.5"), lambda: user.corner() != before)


def open_and_keep(user: NewUser) -> None:
    """A mesh of one's own, into a triangle and back; files, type and light."""
    does, press, click, click_tab = user.does, user.press, user.click, user.click_tab
    text = current_theme().text_px
    does(
        "open a mesh",
        lambda: press("Ctrl+O"),
        lambda: "hill" in user.window.windowTitle() and user.view == "scene",
    )
    does("go into a triangle", lambda: press("F"), lambda: user.document().triangle is not None)
    does("see its pixels", lambda: click_tab("Pixels"), lambda: user.page.navigator.isVisible())
    does("come back", lambda: press("Shift+F"), lambda: user.view == "scene")
    does("save", lambda: press("Ctrl+S"), lambda: "mine.rasterscope" in user.message)
    does(
        "start anew",
        lambda: [press("Alt+0"), click("Segment")],
        lambda: user.document().scene.corner_count == 2,
    )
    does("open what was saved", lambda: press("Ctrl+O"), lambda: user.document().scene.corner_count == 3)
    does("export", lambda: press("Ctrl+E"), lambda: "Exported view.png" in user.message)
    does("look at the print", lambda: press("Ctrl+P"), lambda: True)
    does("larger text", lambda: press("Ctrl++"), lambda: current_theme().text_px > text)
    does("smaller again", lambda: press("Ctrl+-"), lambda: current_theme().text_px == text)
    does("go dark", lambda: press("Ctrl+T"), lambda: current_theme().name == "dark")
    does("and light", lambda: press("Ctrl+T"), lambda: current_theme().name == "light")


def present(user: NewUser) -> None:
    """Before a class: large type, a clicker's keys, A | B, and the desk again."""
    does, press, click = user.does, user.press, user.click
    window = user.window
    does("open a scene", lambda: [press("Alt+0"), click("Two triangles sharing an edge")], lambda: True)
    does("go to raster", lambda: press("6"), lambda: user.at() == ("raster", 0))
    does("step by pixels", lambda: click("Step by pixel"), lambda: user.session.cursor.level == Level.PIXEL)
    panes = user.page.shown_panes()
    does("present", lambda: press("Ctrl+Shift+P"), lambda: window.presenter.is_presenting)
    does("click on", lambda: press("PgDown"), lambda: user.position > 0 and user.covered() <= 1)
    does("click back", lambda: press("PgUp"), lambda: user.position == 0)
    does("black the screen", lambda: press("B"), lambda: user.is_shown("Black screen"))
    does("go on", lambda: press("."), lambda: not user.is_shown("Black screen"))
    does("compare", lambda: press("Ctrl+D"), lambda: user.view == "compare")
    does("click on in both", lambda: press("PgDown"), lambda: user.position > 0)
    does("see the pixels", lambda: press("Ctrl+D"), lambda: "inspector" in user.page.shown_panes())
    does("begin anew", lambda: press("F5"), lambda: user.at() == ("transform", 0))
    does("leave", lambda: press("Ctrl+Shift+P"), lambda: user.page.shown_panes() == panes)


@pytest.mark.slow
def test_the_first_run(user: NewUser) -> None:
    walk_the_run(user)


@pytest.mark.slow
def test_seventy_steps(user: NewUser) -> None:
    for part in (walk_the_run, ask_numbers, learn, change, open_and_keep, present):
        part(user)
    assert user.steps >= 70
