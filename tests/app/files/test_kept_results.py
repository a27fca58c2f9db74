"""Results that are there again at the next start of the window, and work that is not dropped without a word."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.background import end_work, is_working
from app.files.file_access import FileWriteError
from app.files.kept_work import LARGEST, KeptResults, remove_oldest, results_folder, write_result
from app.pages.compare.page import ComparePage
from app.pages.compare.study_files import load_study, study_json
from app.session.document import open_document
from app.window.main_window import MainWindow
from core.study.fragment_cases import NAME as OPEN_SCENE
from lessons.scenes import built_in_scene
from tests.app.pages.compare.compare_pages import compare_page, hand_made, measured


@pytest.fixture
def keeping(window: MainWindow) -> MainWindow:
    """Return a window that keeps results, as the program's own does."""
    window.memory.restore(window)
    return window


@pytest.fixture
def later(keeping: MainWindow) -> Iterator[MainWindow]:
    """Return a window of the next start."""
    scene = built_in_scene("cube")
    made = MainWindow(open_document(scene.make(), scene.title))
    made.memory.restore(made)
    made.show()
    yield made
    made.close()
    made.deleteLater()


def test_the_first_visit_shows_an_example_that_says_so(keeping: MainWindow, qtbot: QtBot) -> None:
    said = "An example from another computer: F5 makes your own."
    for name in ("compare", "stability"):
        keeping.pages.show_page(name)
        page = keeping.pages.current
        qtbot.waitUntil(lambda page=page: page.choice.result is not None, timeout=20000)
        assert page.choice.result.is_example
        assert page.shown_text.text().startswith(said)
        assert page.choice.result.content.machine["date"] in page.shown_text.text()
    compare = compare_page(keeping)
    compare.start()
    qtbot.waitUntil(lambda: not compare.is_running, timeout=60000)
    assert said not in compare.shown_text.text()
    assert not compare.choice.result.is_example


def test_a_study_is_there_again_at_the_next_start(
    keeping: MainWindow, later: MainWindow, qtbot: QtBot
) -> None:
    first = compare_page(keeping)
    first.start()
    qtbot.waitUntil(lambda: not first.is_running, timeout=60000)
    first.stop()
    study = first.content
    assert os.listdir(results_folder()) == ["study-visibility.json"]
    second = compare_page(later)
    qtbot.waitUntil(lambda: second.content is not None, timeout=20000)
    again = second.content
    assert [point.seconds.tolist() for point in again.points] == [p.seconds.tolist() for p in study.points]
    assert len(second.scatter.places()) == len(study.points)
    assert "Kept from an earlier start." in second.shown_text.text()
    assert second.choice.dial_values == dict(study.dials)
    second.choose("visibility=painters")
    qtbot.waitUntil(lambda: second.pictures.linked.grids[0].buffer() is not None, timeout=60000)


def test_an_atlas_is_there_again_and_one_of_a_scene_says_that_it_has_none(
    keeping: MainWindow, later: MainWindow, qtbot: QtBot
) -> None:
    keeping.pages.show_page("stability")
    first = keeping.pages.current
    first.show_named(OPEN_SCENE)
    first.choice.resolution = "coarse"
    first.start()
    qtbot.waitUntil(lambda: not first.is_running, timeout=60000)
    first.stop()
    later.pages.show_page("stability")
    second = later.pages.current
    second.show_named(OPEN_SCENE)
    qtbot.waitUntil(lambda: second.choice.result is not None, timeout=20000)
    assert second.info.methods == first.info.methods
    second.choose_failure(second.info.methods[0])
    assert not is_working(second.opened), "another scene is open: its cells are not those of the atlas"
    assert second.controls.start_button.isEnabled()
    second.start()
    assert second.is_running, "it is run on the scene that is open now"
    second.cancel()


def test_a_file_that_is_broken_is_told_and_the_others_are_shown(keeping: MainWindow, qtbot: QtBot) -> None:
    results_folder().mkdir(parents=True)
    (results_folder() / "study-cull.json").write_text("{")
    (results_folder() / "study-line.json").write_text(study_json(hand_made()), encoding="utf-8")
    page = compare_page(keeping)
    page.show_named("line")
    qtbot.waitUntil(lambda: page.content is not None, timeout=20000)
    qtbot.waitUntil(keeping.messages.isVisible, timeout=20000)
    assert "study-cull.json cannot be opened" in keeping.messages.text.text()


@pytest.mark.slow
def test_what_is_measured_now_is_not_replaced_by_what_was_kept(window: MainWindow, qtbot: QtBot) -> None:
    page = compare_page(window)
    study = measured(page, qtbot)
    page.take_kept(hand_made("visibility"))
    assert page.content is study


@pytest.mark.slow
def test_a_cancelled_measurement_keeps_the_file_of_the_one_before(keeping: MainWindow, qtbot: QtBot) -> None:
    page = compare_page(keeping)
    measured(page, qtbot)
    path = results_folder() / "study-visibility.json"
    qtbot.waitUntil(path.exists, timeout=20000)
    before = path.read_bytes()
    page.choice.rounds = 90
    QTest.keyClick(keeping, Qt.Key.Key_F5)
    page.cancel()
    page.stop()
    assert path.read_bytes() == before


def test_a_window_that_was_not_started_by_the_user_keeps_nothing(window: MainWindow, qtbot: QtBot) -> None:
    page = compare_page(window)
    measured(page, qtbot)
    page.stop()
    assert not results_folder().exists()


def test_a_result_that_is_too_large_leaves_the_one_before(tmp_path: Path) -> None:
    write_result(tmp_path, "study-line.json", b"small")
    with pytest.raises(FileWriteError, match=r"study-line\.json is larger than 4 MiB"):
        write_result(tmp_path, "study-line.json", b" " * (LARGEST + 1))
    assert (tmp_path / "study-line.json").read_bytes() == b"small"


def test_the_oldest_results_go_first(tmp_path: Path) -> None:
    for number in range(5):
        path = tmp_path / f"study-{number}.json"
        path.write_bytes(b" " * 10)
        os.utime(path, (number, number))
    remove_oldest(tmp_path, 25)
    assert sorted(os.listdir(tmp_path)) == ["study-3.json", "study-4.json"]


def test_a_folder_that_cannot_be_made_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path / "file"))
    kept = KeptResults("study", load_study)
    told: list[str] = []
    kept.failed.connect(told.append)
    kept.begin()
    kept.keep("line", lambda: b"{}")
    qtbot.waitUntil(lambda: bool(told), timeout=20000)
    end_work(kept)
    assert told[0].startswith("The result could not be kept for the next start: ")
    assert "cannot be made" in told[0]


def test_a_running_measurement_is_not_dropped_for_another(window: MainWindow, qtbot: QtBot) -> None:
    page = compare_page(window)
    page.choice.rounds = 90
    QTest.keyClick(window, Qt.Key.Key_F5)
    page.show_named("line")
    QTest.keyClick(window, Qt.Key.Key_F5)
    assert "Hidden surfaces is still being measured" in window.statusBar().currentMessage()
    assert page.is_running
    qtbot.waitUntil(lambda: page.controls.doing.text().startswith("Hidden surfaces: "), timeout=20000)
    assert page.controls.cancel_button.isVisible()
    window.pages.show_page("step")
    qtbot.waitUntil(lambda: "%" in bar_text(window), timeout=20000)
    page.cancel()
    assert bar_text(window) == "Compare"


def bar_text(window: MainWindow) -> str:
    return window.pages.bar.tabText(window.pages.names.index("compare"))


@pytest.mark.slow
def test_a_study_that_is_done_is_shown_on_its_family(window: MainWindow, qtbot: QtBot) -> None:
    page: ComparePage = compare_page(window)
    QTest.keyClick(window, Qt.Key.Key_F5)
    page.show_named("cull")
    qtbot.waitUntil(lambda: not page.is_running, timeout=60000)
    assert page.choice.result is None
    page.show_named("visibility")
    assert page.choice.result is not None
