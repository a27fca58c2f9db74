"""On a full disk the reason is told, saved files are whole, what is open stays, and it is saved once there is room."""

import errno
import json
import os
from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.files import file_access, saved_windows
from app.files.open_any import open_any
from app.files.user_folders import preferences_folder
from app.window.main_window import CLOSE_UNSAVED, MainWindow
from tests.app.cli.cli_runs import refused


def full() -> str:
    """Return what the system says, in the language that Qt has set for it."""
    return os.strerror(errno.ENOSPC).lower()


class Disk:
    """The disk that files are written to, as far as it can be filled up: by every write failing at its end."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.is_full = False
        self.sync = os.fsync
        monkeypatch.setattr(file_access.os, "fsync", self.finish)

    def finish(self, handle: int) -> None:
        """Do what the disk does at the end of a file."""
        if self.is_full:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        self.sync(handle)


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Disk:
    return Disk(monkeypatch)


def only_state() -> Path:
    """Return the one file that a window has saved."""
    (path,) = preferences_folder().glob("last*.rasterscope")
    return path


def test_edits_are_saved_once_there_is_room_again(
    window: MainWindow, disk: Disk, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(saved_windows, "PAUSE", 0)
    monkeypatch.setattr(saved_windows, "RETRY", 20)
    window.memory.autosave.begin(None)
    window.session.set_setting("fill", "blocks")
    qtbot.waitUntil(lambda: len(list(preferences_folder().glob("last*.rasterscope"))) == 1, timeout=20000)
    disk.is_full = True
    with qtbot.waitSignal(window.memory.autosave.failed, timeout=20000) as failed:
        window.session.set_setting("fill", "scanline")
    assert failed.args[0].endswith(f"{full()}. Saving is tried again every 10 seconds.")
    assert open_any(str(only_state())).document.settings.fill == "blocks"
    disk.is_full = False
    qtbot.waitUntil(lambda: window.messages.text.text() == "What is open is saved again.", timeout=20000)
    assert open_any(str(only_state())).document.settings.fill == "scanline"


def test_a_window_stays_open_while_its_scene_cannot_be_saved(
    window: MainWindow, disk: Disk, capfd: pytest.CaptureFixture[str]
) -> None:
    window.memory.autosave.begin(None)
    disk.is_full = True
    assert not window.close()
    text = window.messages.text.text()
    assert text.startswith("The window stays open: what is open could not be saved")
    assert full() in text
    assert window.session.document.settings.fill != "blocks"
    window.session.set_setting("fill", "blocks")
    disk.is_full = False
    assert window.close()
    assert open_any(str(only_state())).document.settings.fill == "blocks"
    assert capfd.readouterr().err == ""


def test_a_window_can_be_closed_without_saving(
    window: MainWindow, disk: Disk, capfd: pytest.CaptureFixture[str]
) -> None:
    window.memory.autosave.begin(None)
    window.memory.save_preferences(window)
    before = (preferences_folder() / "preferences.json").read_bytes()
    disk.is_full = True
    assert not window.close()
    assert window.messages.action_button.text() == CLOSE_UNSAVED
    window.messages.action_button.click()
    assert window.isHidden()
    lines = capfd.readouterr().err.splitlines()
    assert [line.split(" could ")[0] for line in lines] == [
        "rasterscope: what is open",
        "rasterscope: the preferences",
    ]
    assert all(line.endswith(full()) for line in lines)
    assert (preferences_folder() / "preferences.json").read_bytes() == before
    assert json.loads(before)["page"] == "step"
    assert not list(preferences_folder().glob(".*.part"))


def test_what_ends_the_program_closes_on_a_full_disk_too(
    window: MainWindow, disk: Disk, capfd: pytest.CaptureFixture[str]
) -> None:
    window.memory.autosave.begin(None)
    disk.is_full = True
    window.close_anyway()
    assert window.isHidden()
    assert "what is open could not be saved" in capfd.readouterr().err


def test_files_that_the_user_saves_stay_whole(window: MainWindow, disk: Disk, tmp_path: Path) -> None:
    window.resize(900, 600)
    state, picture = tmp_path / "a.rasterscope", tmp_path / "a.png"
    window.files.save_to(str(state))
    window.exports.export_to(str(picture))
    before = state.read_bytes(), picture.read_bytes()
    disk.is_full = True
    window.session.set_setting("fill", "blocks")
    window.files.save_to(str(state))
    assert window.messages.text.text() == f"The state was not saved: {state} cannot be written: {full()}"
    window.exports.export_to(str(picture))
    assert window.messages.text.text() == f"The view was not exported: {picture} cannot be written: {full()}"
    assert (state.read_bytes(), picture.read_bytes()) == before
    assert sorted(path.name for path in tmp_path.glob(".*.part")) == []


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
def test_commands_that_write_to_a_full_device_say_so_in_one_line() -> None:
    for arguments in (
        ("trace", "cube", "--stage", "raster", "--format", "csv", "--triangle", "0", "-o", "/dev/full"),
        ("trace", "cube", "--stage", "raster", "--format", "npz", "--triangle", "0", "-o", "/dev/full"),
        ("render", "cube", "-o", "/dev/full"),
    ):
        assert refused(1, *arguments).endswith(f"/dev/full cannot be written: {full()}")
