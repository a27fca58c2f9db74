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
    user.does(
        "begin",
        lambda: user.click("Begin with one triangle"),
        lambda: user.window.pages.current_name == "step",
    )
    user.does("see the start", lambda: user.press("1"), lambda: user.at() == ("transform", 0))
    user.does("do a step", lambda: user.press("Right"), lambda: user.position > 0 and user.view == "scene")
    user.does("take it back", lambda: user.press("Left"), lambda: user.position == 0)
    user.does(
        "step by stages",
        lambda: user.click("Step by stage"),
        lambda: user.session.cursor.level == Level.STAGE,
    )
    user.does("do a stage", lambda: user.press("Right"), lambda: user.at() == ("transform", user.end()))
    user.does("enter the next", lambda: user.press("Right"), lambda: user.at() == ("cull", 0))
    user.does("do it", lambda: user.press("Right"), lambda: user.at() == ("cull", user.end()))
    user.does(
        "go on to clip", lambda: user.press("Right"), lambda: user.at() == ("clip", 0) and user.view == "clip"
    )
    user.does(
        "enter raster by its card", lambda: user.click("Stage Raster"), lambda: user.at() == ("raster", 0)
    )
    user.does("go on by pixels", lambda: user.click("Step by pixel"), lambda: user.view == "pixels")
    user.does("test a pixel", lambda: user.press("Right"), lambda: "Pixel" in user.page.sentence.text())
    user.does("see no future", lambda: user.press("Right"), lambda: user.covered() <= 2)
    user.does(
        "enter the last stage", lambda: user.click("Stage Resolve"), lambda: user.at() == ("resolve", 0)
    )
    user.does("do all of it", lambda: user.press("End"), lambda: user.position == user.end())
    user.does(
        "press on", lambda: user.press("Right"), lambda: user.message and user.at() == ("resolve", user.end())
    )


def ask_numbers(user: NewUser) -> None:
    """Where numbers come from, and what a pixel went through."""
    click, press = user.click, user.press
    user.does(
        "enter raster by its digit", lambda: press("6"), lambda: (user.stage, user.position) == ("raster", 0)
    )
    user.does("go to a pixel's test", lambda: press("Right"), lambda: user.page.formula.spoken())
    before = user.session.cursor
    user.does(
        "follow E0", lambda: user.click_number("E0"), lambda: user.session.cursor != before and user.message
    )
    user.does("follow its a0", lambda: user.click_number("a0"), lambda: user.stage == "edges")
    user.does("come back", lambda: press("Ctrl+["), lambda: user.stage == "raster")
    user.does("come back further", lambda: press("Ctrl+["), lambda: user.session.cursor == before)
    user.does("click a pixel", lambda: user.click_pixel(27, 20), lambda: user.session.pin == (27, 20))
    user.does(
        "read why", lambda: user.click_tab("Pixel history"), lambda: "0" in user.page.history.verdict.text()
    )
    user.does("go to its step", lambda: press("J"), lambda: "(27, 20)" in user.page.sentence.text())
    user.does(
        "see the variables", lambda: user.click_tab("This step"), lambda: user.page.variables.isVisible()
    )
    user.does("ask for the pinned value", lambda: press("Y"), lambda: user.message)
    user.does("unpin", lambda: press("Escape"), lambda: user.session.pin is None)
    user.does(
        "predict from the start", lambda: [press("6"), press("P")], lambda: user.page.prediction.isVisible()
    )
    user.does(
        "guess right",
        lambda: user.click_pixel(27, 20),
        lambda: "Right" in user.page.prediction.verdict.text(),
    )
    user.does(
        "guess wrong", lambda: user.click_pixel(2, 40), lambda: "Wrong" in user.page.prediction.verdict.text()
    )
    user.does("reveal", lambda: click("Reveal"), lambda: user.page.prediction.verdict.text())
    user.does("stop predicting", lambda: press("P"), lambda: not user.page.prediction.isVisible())


def learn(user: NewUser) -> None:
    """The guide, the glossary and a method's page."""
    user.does("look for keys", lambda: user.press("?"), lambda: user.window.overlays.key_help.isVisible())
    user.does(
        "close them", lambda: user.press("Escape"), lambda: not user.window.overlays.key_help.isVisible()
    )
    user.does(
        "open the guide",
        lambda: [user.press("Alt+0"), user.click("Five-minute guide")],
        lambda: user.help_address() == "guide",
    )
    user.does(
        "open its triangle",
        lambda: user.click_link("Open the triangle"),
        lambda: user.window.pages.current_name == "step",
    )
    user.does("go to its stage", lambda: user.click_link("Interpolate"), lambda: user.stage == "interpolate")
    user.does(
        "look a word up", lambda: user.click_link("fragments"), lambda: user.help_address() == "term/fragment"
    )
    user.does(
        "find a method",
        lambda: user.type_into("Find in Help", "affine"),
        lambda: "Affine" in user.help_text(),
    )
    user.does(
        "open its page",
        lambda: user.click_link("Affine (screen-linear)"),
        lambda: user.help_address() == "method/interpolation/affine",
    )
    user.does(
        "read its source",
        lambda: None,
        lambda: "Source" in user.help_text() and "Breaks where" in user.help_text(),
    )
    user.does("close Help", lambda: user.press("F1"), lambda: not user.window.help.is_visible())


def change(user: NewUser) -> None:
    """Methods, A | B, corners."""
    user.does("open Methods", lambda: user.click("Methods"), lambda: user.is_shown("Fill"))
    fill = user.document().settings.fill
    user.does(
        "fill by blocks",
        lambda: user.choose("Fill", "Blocks"),
        lambda: user.document().settings.fill == "blocks",
    )
    user.does("take it back", lambda: user.press("Ctrl+Z"), lambda: user.document().settings.fill == fill)
    user.does("compare", lambda: user.click_tab("A | B"), lambda: user.view == "compare")
    user.does("part ways", lambda: user.click("First divergence"), lambda: user.message)
    user.does("see the pixels", lambda: user.click_tab("Pixels"), lambda: user.view == "pixels")
    before = user.corner()
    user.does("drag a corner", lambda: user.drag_vertex(QPoint(20, -20)), lambda: user.corner() != before)
    user.does("take it back", lambda: user.press("Ctrl+Z"), lambda: user.corner() == before)
    user.does("open Scene", lambda: user.click("Scene"), lambda: user.is_shown("vertex 0 x"))
    user.does("type a corner", lambda: user.type_into("vertex 0 x", "12.5"), lambda: user.corner() != before)


def open_and_keep(user: NewUser) -> None:
    """A mesh of one's own, into a triangle and back; files, type and light."""
    press = user.press
    text = current_theme().text_px
    user.does(
        "open a mesh",
        lambda: press("Ctrl+O"),
        lambda: "hill" in user.window.windowTitle() and user.view == "scene",
    )
    user.does("go into a triangle", lambda: press("F"), lambda: user.document().triangle is not None)
    user.does("see its pixels", lambda: user.click_tab("Pixels"), lambda: user.page.navigator.isVisible())
    user.does("come back", lambda: press("Shift+F"), lambda: user.view == "scene")
    user.does("save", lambda: press("Ctrl+S"), lambda: "mine.rasterscope" in user.message)
    user.does(
        "start anew",
        lambda: [press("Alt+0"), user.click("Segment")],
        lambda: user.document().scene.corner_count == 2,
    )
    user.does("open what was saved", lambda: press("Ctrl+O"), lambda: user.document().scene.corner_count == 3)
    user.does("export", lambda: press("Ctrl+E"), lambda: "Exported view.png" in user.message)
    user.does("look at the print", lambda: press("Ctrl+P"), lambda: True)
    user.does("larger text", lambda: press("Ctrl++"), lambda: current_theme().text_px > text)
    user.does("smaller again", lambda: press("Ctrl+-"), lambda: current_theme().text_px == text)
    user.does("go dark", lambda: press("Ctrl+T"), lambda: current_theme().name == "dark")
    user.does("and light", lambda: press("Ctrl+T"), lambda: current_theme().name == "light")


def present(user: NewUser) -> None:
    """Before a class: large type, a clicker's keys, A | B, and the desk again."""
    press, window = user.press, user.window
    user.does(
        "open a scene", lambda: [press("Alt+0"), user.click("Two triangles sharing an edge")], lambda: True
    )
    user.does("go to raster", lambda: press("6"), lambda: user.at() == ("raster", 0))
    user.does(
        "step by pixels",
        lambda: user.click("Step by pixel"),
        lambda: user.session.cursor.level == Level.PIXEL,
    )
    panes = user.page.shown_panes()
    user.does("present", lambda: press("Ctrl+Shift+P"), lambda: window.presenter.is_presenting)
    user.does("click on", lambda: press("PgDown"), lambda: user.position > 0 and user.covered() <= 1)
    user.does("click back", lambda: press("PgUp"), lambda: user.position == 0)
    user.does("black the screen", lambda: press("B"), lambda: user.is_shown("Black screen"))
    user.does("go on", lambda: press("."), lambda: not user.is_shown("Black screen"))
    user.does("compare", lambda: press("Ctrl+D"), lambda: user.view == "compare")
    user.does("click on in both", lambda: press("PgDown"), lambda: user.position > 0)
    user.does("see the pixels", lambda: press("Ctrl+D"), lambda: "inspector" in user.page.shown_panes())
    user.does("begin anew", lambda: press("F5"), lambda: user.at() == ("transform", 0))
    user.does("leave", lambda: press("Ctrl+Shift+P"), lambda: user.page.shown_panes() == panes)


def test_the_first_run(user: NewUser) -> None:
    walk_the_run(user)


@pytest.mark.slow
def test_seventy_steps(user: NewUser) -> None:
    for part in (walk_the_run, ask_numbers, learn, change, open_and_keep, present):
        part(user)
    assert user.steps >= 70
