"""What is saved has the ending of its kind, and nothing is written over without being asked about."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QFileDialog, QLineEdit
from pytestqt.qtbot import QtBot

from app.files.file_dialogs import SaveDialog, ask_file, ask_folder, keep_folder, last_folder

KINDS = "PNG picture (*.png);;SVG drawing (*.svg);;PDF page (*.pdf)"


def typed(dialog: SaveDialog, text: str) -> str:
    """Return what the dialog answers when a name is typed and confirmed."""

    def type_name() -> None:
        edit = dialog.findChild(QLineEdit)
        edit.setText(text)
        QTest.keyClick(edit, Qt.Key.Key_Return)

    QTimer.singleShot(0, type_name)
    return dialog.ask()


@pytest.mark.parametrize(
    ("kind", "name", "wanted"),
    [
        ("", "figure", "figure.png"),
        ("SVG drawing (*.svg)", "figure", "figure.svg"),
        ("", "figure.pdf", "figure.pdf"),
    ],
)
def test_a_name_without_an_ending_gets_that_of_the_kind(
    qtbot: QtBot, tmp_path: Path, kind: str, name: str, wanted: str
) -> None:
    dialog = SaveDialog(None, "Export view", "view.png", KINDS)
    dialog.setDirectory(str(tmp_path))
    if kind:
        dialog.selectNameFilter(kind)
        dialog.filterSelected.emit(kind)
    assert Path(typed(dialog, name)) == tmp_path / wanted


def test_a_file_that_the_ending_leads_to_is_asked_about(qtbot: QtBot, tmp_path: Path) -> None:
    (tmp_path / "figure.png").write_text("an old one")
    dialog = SaveDialog(None, "Export view", "view.png", KINDS)
    dialog.setDirectory(str(tmp_path))
    asked: list[str] = []

    def refuse() -> None:
        question = QApplication.activeModalWidget()
        asked.append(question.text())
        question.reject()
        dialog.reject()

    QTimer.singleShot(300, refuse)
    assert typed(dialog, "figure") == ""
    assert "figure.png" in asked[0]


def test_the_next_question_begins_where_the_last_was_answered(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever is asked for; a question that was not answered changes nothing, nor does a folder that is gone."""
    begun: list[str] = []

    def answers(path: str) -> None:
        def ask(parent: object, title: str, folder: str, kinds: str) -> tuple[str, str]:
            begun.append(folder)
            return path, ""

        monkeypatch.setattr(QFileDialog, "getOpenFileName", ask)

    keep_folder("")
    (tmp_path / "one").mkdir()
    for path in (str(tmp_path / "one" / "a.obj"), "", str(tmp_path / "two" / "b.obj"), ""):
        answers(path)
        assert ask_file(None, "Open", KINDS) == path
    assert begun == ["", str(tmp_path / "one"), str(tmp_path / "one"), ""]
    monkeypatch.setattr(QFileDialog, "getExistingDirectory", lambda *_: str(tmp_path))
    assert ask_folder(None, "Add a folder") == str(tmp_path)
    dialog = SaveDialog(None, "Export view", "view.png", KINDS)
    assert dialog.directory().absolutePath() == str(tmp_path)
    assert typed(dialog, "one/figure") == str(tmp_path / "one" / "figure.png")
    assert last_folder() == str(tmp_path / "one")
