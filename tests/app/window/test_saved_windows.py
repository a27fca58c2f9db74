"""What a window saves while it is open: every edit soon, in a file of its own; what cannot be opened stays."""

import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pytestqt.qtbot import QtBot

from app.files.file_access import FileWriteError
from app.files.open_any import open_any
from app.files.saved_windows import KEPT, WindowFile, earlier_windows, new_window_file, remove_oldest_windows
from app.files.user_folders import preferences_folder
from app.session.document import Document, open_document
from app.window.main_window import MainWindow
from app.window.start import reopen
from lessons.scenes import built_in_scene
from tests.app.files.mesh_writing import SQUARE

FACE = SQUARE + "f 1 2 3 4\n"


@pytest.fixture
def autosaved(window: MainWindow) -> MainWindow:
    """Return a window that saves its edits."""
    window.memory.autosave.begin(None)
    return window


def saved(window: MainWindow, qtbot: QtBot) -> Document:
    """Wait until the open document is saved, and return what the next start would open."""
    title = f"edit {id(window.session.document)}"
    window.session.edit(replace(window.session.document, title=title))
    qtbot.waitUntil(lambda: any(path.title == title for path in states()), timeout=20000)
    # What the file does not need any more is removed after it.
    qtbot.waitUntil(lambda: not window.memory.autosave.is_waiting, timeout=20000)
    (path,) = (each.path for each in states() if each.title == title)
    return open_any(str(path)).document


def states():
    """Return the files of all windows; the locks stay as they are."""
    from app.files.saved_windows import EarlierWindow

    return [EarlierWindow(path, was_closed=True) for path in preferences_folder().glob("last*.rasterscope")]


def with_moved_vertex(document: Document) -> Document:
    """Return the document with one vertex of its mesh moved."""
    (mesh,) = document.scene.meshes
    positions = mesh.positions.copy()
    positions[0] += 0.0625
    return replace(document, scene=replace(document.scene, meshes=(replace(mesh, positions=positions),)))


def test_an_edit_is_saved_while_the_window_is_open(autosaved: MainWindow, qtbot: QtBot) -> None:
    autosaved.session.set_setting("fill", "scanline")
    found = saved(autosaved, qtbot)
    assert found.settings == autosaved.session.document.settings
    assert earlier_windows(preferences_folder()) == [], "an open window's file is its own"
    autosaved.close()
    (left,) = earlier_windows(preferences_folder())
    assert left.was_closed
    assert reopen().message is None


def test_a_bookmark_is_saved_even_where_nothing_else_was_done(window: MainWindow, qtbot: QtBot) -> None:
    window.memory.autosave.begin(None, window.session.document)
    window.page.stepping.bookmarks.describe("why")
    qtbot.waitUntil(lambda: any(path.title for path in states()), timeout=20000)
    (path,) = (each.path for each in states())
    state = open_any(str(path)).state
    assert [mark.note for mark in state.bookmarks] == ["why"]


def test_a_mesh_that_did_not_change_is_not_written_again(autosaved: MainWindow, qtbot: QtBot) -> None:
    sphere = built_in_scene("sphere")
    autosaved.session.open(with_moved_vertex(open_document(sphere.make(), "Sphere")))
    first = saved(autosaved, qtbot)
    (array,) = preferences_folder().glob("last*.arrays/*")
    before = array.stat()
    autosaved.session.set_setting("depth", "z-16")
    second = saved(autosaved, qtbot)
    assert (array.stat().st_ino, array.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    for document in (first, second):
        mesh = autosaved.session.document.scene.meshes[0]
        np.testing.assert_array_equal(document.scene.meshes[0].positions, mesh.positions)
    autosaved.session.edit(with_moved_vertex(autosaved.session.document))
    saved(autosaved, qtbot)
    assert not array.exists(), "what is not needed any more is removed"
    (array,) = preferences_folder().glob("last*.arrays/*")
    array.write_bytes(array.read_bytes()[:-1] + b"?")
    autosaved.close()
    first_shown = reopen()
    assert f"{array.name} is damaged" in first_shown.message.text


def test_no_two_windows_write_the_same_file(window: MainWindow, tmp_path: Path) -> None:
    file = new_window_file(tmp_path)
    with pytest.raises(FileWriteError, match="another window has it open"):
        WindowFile(file.path)
    file.save(window.files.state())
    assert earlier_windows(tmp_path) == []
    file.release()
    WindowFile(file.path).release()
    assert [each.path for each in earlier_windows(tmp_path)] == [file.path]


def test_only_the_oldest_of_many_windows_are_removed(window: MainWindow, tmp_path: Path) -> None:
    files = [new_window_file(tmp_path) for _ in range(KEPT + 2)]
    for number, file in enumerate(files):
        file.save(window.files.state())
        os.utime(file.path, (number, number))
        if number != 0:
            file.release()
    remove_oldest_windows(tmp_path)
    assert [file.path.exists() for file in files] == [True, False, *[True] * KEPT], "the first is still open"


def test_a_mesh_that_is_gone_for_one_start_is_shown_again_by_the_next(
    autosaved: MainWindow, qtbot: QtBot, tmp_path: Path
) -> None:
    mesh, away = tmp_path / "drive" / "square.obj", tmp_path / "away"
    mesh.parent.mkdir()
    mesh.write_text(FACE)
    opened = open_any(str(mesh)).document
    autosaved.session.open(opened)
    autosaved.memory.remember_file(str(mesh))
    autosaved.close()
    mesh.parent.rename(away)
    first = reopen()
    assert "its mesh file is missing or broken" in first.message.text
    assert (first.file, first.opened.document.title) == (None, "Single triangle")
    stand_in = MainWindow(first.opened.document, autosaved.memory.preferences)
    qtbot.addWidget(stand_in)
    stand_in.memory.autosave.begin(first.file, first.opened.document)
    stand_in.offer(first.message, first.offered)
    stand_in.close()
    away.rename(mesh.parent)
    again = reopen()
    assert (again.message, again.opened.document.path) == (None, str(mesh))
    assert stand_in.memory.preferences.recent_files == [str(mesh)]
    again.file.release()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="names are text elsewhere")
def test_a_file_name_that_is_no_text_is_saved_with_its_mesh(
    autosaved: MainWindow, qtbot: QtBot, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    name = os.fsdecode(os.fsencode(tmp_path) + b"/gr\xfcn.obj")
    Path(name).write_text(FACE)
    autosaved.files.open_path(name)
    qtbot.waitUntil(lambda: autosaved.session.document.path == name, timeout=20000)
    assert autosaved.session.document.title == "gr\N{REPLACEMENT CHARACTER}n"
    assert autosaved.memory.preferences.recent_files == []
    assert saved(autosaved, qtbot).triangle_count == 2
    autosaved.close()
    assert capfd.readouterr().err == ""
    assert reopen().opened.document.triangle_count == 2


def test_what_cannot_be_saved_is_told_once(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, qtbot: QtBot
) -> None:
    in_the_way = tmp_path / "in the way"
    in_the_way.write_text("")
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(in_the_way))
    autosave = window.memory.autosave
    autosave.begin(None)
    told: list[str] = []
    autosave.failed.connect(told.append)
    for fill in ("scanline", "blocks"):
        window.session.set_setting("fill", fill)
        qtbot.waitUntil(lambda: not autosave.is_waiting, timeout=20000)
    assert len(told) == 1
    assert told[0].startswith("What is open cannot be saved for the next start: ")
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "config"))


def test_the_offer_stands_until_it_is_taken(autosaved: MainWindow, qtbot: QtBot, tmp_path: Path) -> None:
    from widgets.basics.message_bar import Message, MessageKind

    path = tmp_path / "earlier.rasterscope"
    autosaved.session.set_setting("fill", "blocks")
    autosaved.files.save_to(str(path))
    autosaved.session.undo()
    autosaved.offer(Message(MessageKind.WARNING, "The window was not closed.", action="Restore"), str(path))
    autosaved.files.open_path("cube")
    qtbot.waitUntil(lambda: autosaved.session.document.title == "Cube", timeout=20000)
    assert autosaved.messages.text.text() == "The window was not closed."
    autosaved.messages.action_button.click()
    qtbot.waitUntil(lambda: autosaved.session.document.settings.fill == "blocks", timeout=20000)
    assert autosaved.messages.isHidden()
