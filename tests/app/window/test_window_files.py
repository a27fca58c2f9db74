"""Opening, saving and coming back: menus, drops, broken files, states, preferences."""

from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDragEnterEvent, QDropEvent, QImage
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from app.files.file_dialogs import SaveDialog
from app.files.open_any import open_any
from app.files.preferences import load_preferences
from app.files.state_files import EXTENSION
from app.session.document import open_document
from app.window.main_window import MainWindow
from app.window.start import reopen
from core.records.steps import Level
from core.scene import Scene
from lessons.lectures.scenes import LECTURE_SCENES
from lessons.scenes import built_in_scene
from tests.app.files.mesh_writing import write_image
from tests.covering import is_everything
from widgets.basics.theme import DARK, current_theme
from widgets.grid.view import GridView
from widgets.space.orbit import Orbit

pytestmark = pytest.mark.shared_window

TETRAHEDRON = """
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 1 4 3
"""


def drop(window: MainWindow, *paths: Path) -> None:
    """Drag files over the window and drop them."""
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(path)) for path in paths])
    place, buttons = QPointF(200, 200), Qt.MouseButton.LeftButton
    actions = Qt.DropAction.MoveAction | Qt.DropAction.CopyAction
    modifiers = Qt.KeyboardModifier.NoModifier
    enter = QDragEnterEvent(place.toPoint(), actions, data, buttons, modifiers)
    QApplication.sendEvent(window, enter)
    assert enter.isAccepted()
    dropped = QDropEvent(place, actions, data, buttons, modifiers)
    QApplication.sendEvent(window, dropped)
    assert enter.dropAction() == dropped.dropAction() == Qt.DropAction.CopyAction, (
        "the file stays where it is"
    )


@pytest.fixture
def mesh(tmp_path: Path) -> Path:
    """Return a small OBJ file."""
    path = tmp_path / "tetrahedron.obj"
    path.write_text(TETRAHEDRON)
    return path


def test_a_dropped_mesh_opens_paused_at_the_start(window: MainWindow, qtbot: QtBot, mesh: Path) -> None:
    drop(window, mesh)
    qtbot.waitUntil(lambda: window.session.document.title == "tetrahedron", timeout=20000)
    assert isinstance(window.session.document.scene, Scene)
    assert window.session.document.triangle_count == 4
    assert (window.session.cursor.stage, window.session.cursor.position) == ("transform", 0)
    assert window.page.current_view() == "scene", "the model is shown first, large"
    assert window.windowTitle().startswith("tetrahedron")
    assert window.memory.preferences.recent_files[0] == str(mesh)
    assert window.menus.recent_menu.actions()[0].data() == str(mesh)
    assert not window.messages.isVisible()
    window.menus.actions_by_name["undo"].trigger()
    assert window.session.document.title == "Two triangles sharing an edge"


def test_a_broken_file_leaves_the_scene_as_it_was(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    meshes = [
        ("broken.obj", b"v 0 0 nan\nf 1 1 9\n"),
        ("empty.obj", b""),
        ("truncated.glb", b"glTF\x02\x00\x00\x00\xff\xff"),
        ("not_a_mesh.ply", b"hello"),
    ]
    others = [("other.rasterscope", b'{"version": 999}'), ("notes.txt", b"hello")]
    # Each mesh is read by a process of its own.
    for name, content in (meshes if is_everything() else meshes[:1]) + others:
        path = tmp_path / name
        path.write_bytes(content)
        window.session.set_stage("depth", 400)
        document, cursor = window.session.document, window.session.cursor
        window.page.timeline.toggle_play()
        drop(window, path)
        qtbot.waitUntil(lambda: not window.files.job.is_running, timeout=20000)
        window.page.timeline.show_playing(False)
        assert window.session.document is document
        assert window.session.cursor.stage == cursor.stage
        assert window.messages.isVisible()
        assert window.messages.text.text().endswith("The open scene is unchanged.")
        window.run_action("unpin")
        assert not window.messages.isVisible()


def test_a_file_that_is_gone(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    document = window.session.document
    window.files.open_path(str(tmp_path / "gone.obj"))
    qtbot.waitUntil(window.messages.isVisible, timeout=20000)
    assert window.session.document is document


def test_a_texture_outside_is_read_once_the_user_allows_it(
    window: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    (tmp_path / "meshes").mkdir()
    write_image(tmp_path / "skin.png", [[(255, 0, 0)]])
    (tmp_path / "meshes" / "looks.mtl").write_text("newmtl a\nmap_Kd ../skin.png\n")
    path = tmp_path / "meshes" / "a.obj"
    path.write_text(f"mtllib looks.mtl\nvt 0 0\nusemtl a\n{TETRAHEDRON.replace('f 1 3 2', 'f 1/1 3/1 2/1')}")
    drop(window, path)
    qtbot.waitUntil(window.messages.action_button.isVisible, timeout=20000)
    assert window.messages.text.text().startswith("Texture ../skin.png of material a is outside the folder")
    scene = window.session.document.scene
    assert scene.meshes[0].texture is None
    window.messages.action_button.click()
    qtbot.waitUntil(lambda: not window.files.job.is_running, timeout=20000)
    scene = window.session.document.scene
    assert scene.meshes[0].texture is not None
    assert not window.messages.action_button.isVisible()


def test_a_built_in_scene_by_menu(window: MainWindow, qtbot: QtBot) -> None:
    cube = next(action for action in window.menus.scene_menu.actions() if action.data() == "cube")
    cube.trigger()
    qtbot.waitUntil(lambda: window.session.document.title == cube.text(), timeout=20000)
    assert window.page.grid.buffer() is not None


def test_a_scene_of_a_lecture_by_menu(window: MainWindow, qtbot: QtBot) -> None:
    lectures = [action.menu() for action in window.menus.lecture_menu.actions()]
    assert [menu.title() for menu in lectures] == list(LECTURE_SCENES)
    line = lectures[1].actions()[0]
    line.trigger()
    qtbot.waitUntil(
        lambda: window.session.document.title == line.text() == "Line of slope 0.4", timeout=20000
    )


def test_a_state_opens_where_it_was_left(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    session = window.session
    session.set_setting("fill", "scanline")
    session.set_stage("depth", 300)
    session.set_level(Level.OPERATION)
    session.step(1)
    session.set_pin((30, 20))
    window.page.stepping.bookmarks.toggle()
    window.page.show_view("clip")
    path = tmp_path / "here.rasterscope"
    window.files.save_to(str(path))
    color, cursor = session.trace.source.picture.color, session.cursor
    window.files.open_path("cube")
    qtbot.waitUntil(lambda: session.document.title == "Cube", timeout=20000)
    assert window.page.stepping.bookmarks.marks == []
    window.page.show_view("pixels")
    window.files.open_path(str(path))
    qtbot.waitUntil(lambda: session.document.settings.fill == "scanline", timeout=20000)
    assert session.cursor == cursor
    assert session.pin == (30, 20)
    assert window.page.current_view() == "clip"
    assert [mark.position for mark in window.page.stepping.bookmarks.marks] == [cursor.position]
    assert np.array_equal(session.trace.source.picture.color, color)


def test_a_state_keeps_everything_that_was_chosen(window: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    page, session = window.page, window.session
    page.main_area.next_view()
    session.set_stage("depth", 30)
    session.set_pin((30, 20))
    page.stepping.toggle_pixel_breakpoint()
    page.stepping.toggle_line_breakpoint("cover", 3)
    page.stepping.set_condition("column == 30")
    page.stepping.bookmarks.describe("the first tie")
    page.strip.buffer_chosen.emit("primitive")
    page.legend.overlays_changed.emit(frozenset({"nan"}))
    page.ranges.range_changed.emit(0.25, 0.75)
    page.grid.set_view(GridView(0.25, 0.75, 3.0))
    page.comparing.set_differences({"coverage": "float32"})
    page.comparing.set_buffer("depth")
    page.events.choose("tie")
    page.show_panes(["overlays", "thumbnails"])
    page.show_view("clip")
    page.views.look_from({"clip": Orbit(1.0, 0.5, (0.0, 0.0, 0.0), 2.0)})
    path = tmp_path / "here.rasterscope"
    window.files.save_to(str(path))
    kept = window.files.state()
    assert all((kept.look.views, kept.look.orbits, kept.look.grid.overlays, kept.look.grid.ranges))
    again = MainWindow(open_document(built_in_scene("cube").make(), "Cube"))
    qtbot.addWidget(again)
    again.files.show_opened(open_any(str(path)))
    found = again.files.state()
    assert (found.look, found.breakpoints, found.bookmarks) == (kept.look, kept.breakpoints, kept.bookmarks)
    assert again.page.stepping.bookmarks.text(0).endswith(": the first tie")
    again.close()


def test_a_bookmark_takes_a_note_by_key(window: MainWindow) -> None:
    QTest.keyClick(
        window, Qt.Key.Key_B, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    )
    QTest.keyClicks(window.overlays.ask_bar.field, "look here")
    QTest.keyClick(window.overlays.ask_bar.field, Qt.Key.Key_Return)
    (mark,) = window.page.stepping.bookmarks.marks
    assert mark.note == "look here"
    assert [action.text() for action in window.menus.bookmark_menu.actions()] == [
        "Raster, step 4,000: look here"
    ]
    window.session.set_stage("depth", 0)
    QTest.keyClick(window, Qt.Key.Key_1, Qt.KeyboardModifier.ControlModifier)
    assert window.session.cursor.stage == "raster"
    assert window.statusBar().currentMessage() == "Bookmark 1: look here"


@pytest.mark.own_window
def test_the_window_comes_back_as_it_was_left(window: MainWindow, qtbot: QtBot) -> None:
    window.session.set_stage("interpolate", 900)
    window.session.set_level(Level.GROUP)
    window.page.show_view("pyramid")
    window.page.card.fold_button.click()
    window.page.timeline.change_speed(2)
    window.appearance.set_theme("dark")
    speed = window.page.timeline.speed_box.currentData()
    cursor = window.session.cursor
    window.close()
    preferences, warning = load_preferences()
    assert warning == ""
    first = reopen()
    assert first.message is None
    again = MainWindow(first.opened.document, preferences)
    qtbot.addWidget(again)
    again.files.show_opened(first.opened)
    again.memory.restore(again)
    again.memory.autosave.begin(first.file)
    again.show()
    assert again.session.cursor == cursor
    assert again.page.current_view() == "pyramid"
    assert not again.page.card.is_folded()
    assert again.page.timeline.speed_box.currentData() == speed
    assert preferences.theme == "dark"
    again.close()


def test_the_view_is_exported(window: MainWindow, tmp_path: Path) -> None:
    for ending in ["png", "svg", "pdf"]:
        path = tmp_path / f"view.{ending}"
        window.exports.export_to(str(path))
        assert path.stat().st_size > 500
        assert window.statusBar().currentMessage().startswith(f"Exported view.{ending}")


def test_sentence_and_formula_stand_under_an_exported_view(window: MainWindow, tmp_path: Path) -> None:
    window.run_action("export_caption")
    window.exports.export_to(str(tmp_path / "view.svg"))
    drawing = ElementTree.parse(tmp_path / "view.svg")
    written = " ".join(text.text or "" for text in drawing.iter("{http://www.w3.org/2000/svg}text"))
    assert all(word in written for word in window.page.sentence.text().split()[:4])
    view = window.page.main_view()
    assert int(drawing.getroot().get("height") or 0) > view.height() + 60
    window.exports.set_scale(2)
    window.exports.export_to(str(tmp_path / "view.png"))
    picture = QImage(str(tmp_path / "view.png"))
    assert picture.width() == 2 * int(drawing.getroot().get("width") or 0)
    message = f"Exported view.png, {picture.width()} × {picture.height()} pixels."
    assert window.statusBar().currentMessage() == message
    window.run_action("copy_view")
    assert QApplication.clipboard().image().size() == picture.size()
    assert window.statusBar().currentMessage().startswith("Copied the view")


def test_an_enlarged_picture_is_drawn_sharp(window: MainWindow, tmp_path: Path) -> None:
    window.exports.set_scale(2)
    window.exports.export_to(str(tmp_path / "view.png"))
    large = QImage(str(tmp_path / "view.png")).convertToFormat(QImage.Format.Format_RGB32)
    blurred = window.page.main_view().grab().toImage().scaled(large.size())
    rows = [np.frombuffer(image.constBits(), np.uint32) for image in (large, blurred)]
    assert not np.array_equal(*rows)


def test_the_view_is_printed_on_one_page_and_light_and_its_text_stays_text(
    window: MainWindow, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from PySide6.QtPrintSupport import QPrinter, QPrintPreviewDialog

    printed = []

    def exec_(dialog: QPrintPreviewDialog) -> int:
        printer = dialog.printer()
        printer.setOutputFormat(QPrinter.OutputFormat.PdfFormat)
        printer.setOutputFileName(str(tmp_path / "page.pdf"))
        dialog.paintRequested.emit(printer)
        printed.append(current_theme().is_dark)
        assert dialog.height() > 0.8 * window.height()
        return 1

    monkeypatch.setattr(QPrintPreviewDialog, "exec", exec_)
    window.appearance.set_theme("dark")
    window.run_action("print_view")
    assert printed == [False]
    assert current_theme() == DARK
    content = (tmp_path / "page.pdf").read_bytes()
    assert content.count(b"/MediaBox") == 1
    assert content.count(b"/FontFile") == 1
    assert len(content) > 5000
    assert window.statusBar().currentMessage() == "Printed the view."


def test_an_export_that_fails_is_told(window: MainWindow, tmp_path: Path) -> None:
    window.exports.export_to(str(tmp_path / "nowhere" / "view.png"))
    assert window.messages.text.text().startswith("The view was not exported")


def test_dialogs_suggest_the_scene_and_its_stage_and_the_folder_is_remembered(
    window: MainWindow, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mesh = tmp_path / "my mesh.obj"
    mesh.write_text(TETRAHEDRON)
    with qtbot.waitSignal(window.files.file_used):
        window.open_path(str(mesh))
    suggested: list[str] = []
    monkeypatch.setattr(SaveDialog, "ask", lambda dialog: suggested.append(dialog.selectedFiles()[0]) or "")
    window.session.set_stage("clip", 0)
    window.exports.ask_export()
    window.files.ask_save()
    names = ("my-mesh-clip.png", f"my-mesh{EXTENSION}")
    assert suggested == [str(tmp_path / name) for name in names]
    window.memory.save_preferences(window)
    assert load_preferences()[0].folder == str(tmp_path)
