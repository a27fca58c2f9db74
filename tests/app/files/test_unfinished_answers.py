"""Answers in progress: kept soon after every change, and nothing lost where the file cannot be read or written."""

from pathlib import Path

import pytest
from pytestqt.qtbot import QtBot

from app.files.kept_work import Unfinished, UnfinishedFile
from app.files.user_folders import ANSWERS
from lessons.exercises.catalogue import TEMPLATES

KEPT = Unfinished(version=1, seed=7, given=[[1, 2]], hints=1)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of the user's data."""
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    return tmp_path


def test_a_change_is_on_the_disk_soon_and_after_the_end(qtbot: QtBot, folder: Path) -> None:
    first = UnfinishedFile()
    first.keep(TEMPLATES["shared-edge"], KEPT)
    qtbot.waitUntil((folder / ANSWERS).exists)
    first.keep(TEMPLATES["facing"], KEPT)
    first.finish()
    second = UnfinishedFile()
    assert second.read() == ""
    assert second.answers.answers == {"shared-edge": KEPT, "facing": KEPT}
    assert second.answers.current == "facing"


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"answers": {"a": {"seed": -1}}}', b"\xff\x00"])
def test_a_broken_file_is_set_aside(qtbot: QtBot, folder: Path, content: bytes) -> None:
    (folder / ANSWERS).write_bytes(content)
    file = UnfinishedFile()
    assert (
        file.read() == "Answers in progress were broken. They are kept as answers.broken, and none is open."
    )
    assert (folder / "answers.broken").read_bytes() == content


def test_a_file_of_a_later_version_is_left_alone(qtbot: QtBot, folder: Path) -> None:
    content = b'{"program": "rasterscope answers", "version": 4, "more": 1}'
    (folder / ANSWERS).write_bytes(content)
    file = UnfinishedFile()
    assert "later version" in file.read()
    file.keep(TEMPLATES["facing"], KEPT)
    file.finish()
    assert (folder / ANSWERS).read_bytes() == content


def test_what_cannot_be_written_is_reported_once(qtbot: QtBot, folder: Path) -> None:
    (folder / ANSWERS).mkdir()
    file = UnfinishedFile()
    said: list[str] = []
    file.failed.connect(said.append)
    file.keep(TEMPLATES["facing"], KEPT)
    file.finish()
    file.finish()
    assert len(said) == 1
    assert said[0].startswith("The answer is not kept for the next start: ")


def test_a_file_of_an_earlier_version_is_read(qtbot: QtBot, folder: Path) -> None:
    (folder / ANSWERS).write_text(
        '{"program":"rasterscope answers","version":1,"user":"me","current":"facing",'
        '"answers":{"facing":{"version":1,"seed":7,"given":["A"],"hints":1,"is_shown":false}}}'
    )
    file = UnfinishedFile()
    assert file.read() == ""
    assert file.answers.answers["facing"] == Unfinished(version=1, seed=7, given=["A"], hints=1)


def test_two_windows_lose_no_answer_of_each_other(qtbot: QtBot, folder: Path) -> None:
    """Each writes only what it has changed; somebody else begins with nothing."""
    first, second = UnfinishedFile(), UnfinishedFile()
    for file, name in ((first, "facing"), (second, "shared-edge"), (first, "clip-ends")):
        file.keep(TEMPLATES[name], KEPT)
        file.finish()
    third = UnfinishedFile()
    third.read()
    assert set(third.answers.answers) == {"facing", "shared-edge", "clip-ends"}
    third.keep_user("Ada")
    third.finish()
    second.read()
    assert (second.answers.user, second.answers.answers) == ("Ada", {})


def test_two_learners_lose_no_answer_of_each_other(qtbot: QtBot, folder: Path) -> None:
    """In two windows at once, and where one follows the other in a window."""
    first, second = UnfinishedFile(), UnfinishedFile()
    first.keep_user("Ada")
    first.keep(TEMPLATES["facing"], KEPT)
    second.keep_user("Bob")
    second.keep(TEMPLATES["clip-ends"], KEPT)
    for file in (first, second):
        file.finish()
    first.keep(TEMPLATES["shared-edge"], KEPT)
    first.finish()
    third = UnfinishedFile()
    third.read()
    assert third.answers.user == "Ada"
    assert set(third.answers.answers) == {"facing", "shared-edge"}
    third.keep_user("Bob")
    assert third.answers.answers == {"clip-ends": KEPT}
    third.keep(TEMPLATES["clip-ends"], Unfinished(version=1, seed=8))
    third.keep_user("Ada")
    assert set(third.answers.answers) == {"facing", "shared-edge"}
    third.finish()
    fourth = UnfinishedFile()
    fourth.read()
    fourth.keep_user("Bob")
    assert fourth.answers.answers["clip-ends"].seed == 8
