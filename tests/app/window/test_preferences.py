"""Preferences: they come back, a broken file is set aside, and nothing of it ever stops the program."""

import json
import os
import sys

import pytest

from app.files.file_access import FileWriteError
from app.files.preferences import (
    FILE_NAME,
    RECENT_LIMIT,
    Preferences,
    load_preferences,
    save_preferences,
    with_recent_file,
)
from app.files.user_folders import preferences_folder


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    chosen = tmp_path / "configuration" / "of" / "somebody"
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(chosen))
    return chosen


def test_without_a_file_there_are_defaults(folder):
    assert load_preferences() == (Preferences(), "")
    assert not folder.exists()


def test_what_is_saved_comes_back(folder, tmp_path):
    mesh = tmp_path / "a.obj"
    mesh.write_text("")
    kept = Preferences(
        recent_files=[str(mesh)],
        theme="dark",
        geometry="AdnQywADAAA=",
        layout={"columns": "AAAA/w=="},
        folded_cards=["raster"],
        level=2,
        speed=12.5,
    )
    save_preferences(kept)
    assert load_preferences() == (kept, "")
    assert [path.name for path in folder.iterdir()] == [FILE_NAME]


def test_recent_files_that_are_gone_are_kept_for_the_day_that_they_are_back(tmp_path):
    gone = [str(tmp_path / "unplugged" / "gone.obj")]
    save_preferences(Preferences(recent_files=gone))
    assert load_preferences()[0].recent_files == gone


def test_two_windows_keep_the_recent_files_of_both(tmp_path):
    for name in ("first", "second"):
        save_preferences(with_recent_file(Preferences(), tmp_path / f"{name}.obj"))
    recent = load_preferences()[0].recent_files
    assert recent == [str(tmp_path / "second.obj"), str(tmp_path / "first.obj")]


def test_the_file_opened_last_is_the_first_of_the_recent_ones(tmp_path):
    preferences = Preferences()
    for number in range(RECENT_LIMIT + 3):
        preferences = with_recent_file(preferences, tmp_path / f"{number}.obj")
    preferences = with_recent_file(preferences, tmp_path / "5.obj")
    assert preferences.recent_files[0] == str(tmp_path / "5.obj")
    assert len(preferences.recent_files) == len(set(preferences.recent_files)) == RECENT_LIMIT


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (b"", "the file"),
        (b"{", "the file"),
        (b"[]", "the file"),
        (b"\xff\xfe", "the file"),
        (b'{"theme": "pink"}', "theme must be 'system', 'light', 'dark' or 'presenter', got 'pink'"),
        (b'{"level": "3"}', "level must be a valid integer, got '3'"),
        (b'{"level": 7}', "level must be less than or equal to 4, got 7"),
        (b'{"speed": NaN}', "speed must be a finite number"),
        (b'{"speed": 0}', "speed must be greater than 0, got 0"),
        (b'{"recent_files": [1, 2]}', "recent_files.0 must be a valid string, got 1 (and 1 more)"),
        ('{"geometry": "Größe"}'.encode(), "geometry must match pattern"),
        ('{"layout": {"columns": "→"}}'.encode(), "layout.columns must match pattern"),
        (b'{"recent_files": ["\\ud800"]}', "the file"),
        (b"[" * 100_000, "the file"),
        (b'{"layout": {"columns": null}}', "layout.columns must be a valid string, got nothing"),
    ],
)
def test_a_broken_file_is_set_aside_with_a_message(folder, content, wanted):
    folder.mkdir(parents=True)
    (folder / FILE_NAME).write_bytes(content)
    preferences, warning = load_preferences()
    assert preferences == Preferences()
    assert warning.startswith("The preferences were broken: ")
    assert wanted in warning
    assert f"kept as {FILE_NAME}.broken" in warning
    assert (folder / f"{FILE_NAME}.broken").read_bytes() == content
    assert not (folder / FILE_NAME).exists()
    assert load_preferences() == (Preferences(), "")


def test_a_field_of_another_version_is_no_harm(folder):
    folder.mkdir(parents=True)
    (folder / FILE_NAME).write_text(json.dumps({"level": 1, "colour": "red"}))
    assert load_preferences() == (Preferences(level=1), "")


def test_a_folder_in_the_place_of_the_file(folder):
    (folder / FILE_NAME).mkdir(parents=True)
    preferences, warning = load_preferences()
    assert preferences == Preferences()
    assert warning.startswith("The preferences cannot be read: ")


def test_saving_where_it_is_not_possible_is_one_sentence(folder):
    folder.parent.mkdir(parents=True)
    folder.write_text("a file in the way")
    with pytest.raises(FileWriteError, match=r"somebody cannot be made: "):
        save_preferences(Preferences())


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the place is another one elsewhere")
def test_the_folder_does_not_depend_on_the_running_program(monkeypatch):
    monkeypatch.delenv("RASTERSCOPE_CONFIG")
    monkeypatch.setenv("XDG_CONFIG_HOME", "/somewhere")
    assert os.fspath(preferences_folder()) == "/somewhere/rasterscope"


@pytest.mark.parametrize(
    "content",
    [
        {"speed": 1e308, "level": 0, "page": "nowhere", "folded_cards": ["nowhere", ""]},
        {"speed": 5e-324, "level": 4, "geometry": "AAAA", "layout": {"columns": "AAAA", "nothing": ""}},
        {
            "recent_files": ["", "\0", "a" * 5000, "//server/share/a.obj"],
            "theme": "presenter",
            "geometry": "AdnQywADAAA" + "/" * 400,
            "page": "\0",
        },
        pytest.param({"geometry": "="}, marks=pytest.mark.slow),
    ],
)
def test_preferences_that_say_nothing_sensible_open_a_window_too(folder, qtbot, content):
    from app.session.document import open_document
    from app.window.main_window import MainWindow
    from lessons.scenes import built_in_scene

    folder.mkdir(parents=True)
    (folder / FILE_NAME).write_text(json.dumps(content))
    preferences, warning = load_preferences()
    assert warning == ""
    scene = built_in_scene("single-triangle")
    window = MainWindow(open_document(scene.make(), scene.title), preferences)
    qtbot.addWidget(window)
    window.memory.restore(window)
    window.show()
    window.page.timeline.toggle_play()
    qtbot.wait(50)
    window.close()
    assert load_preferences()[1] == ""
