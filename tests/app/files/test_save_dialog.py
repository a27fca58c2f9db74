"""What is saved has the ending of its kind, and nothing is written over without being asked about."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QLineEdit, QMessageBox
from pytestqt.qtbot import QtBot

from app.files.save_dialog import SaveDialog

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
        assert isinstance(question, QMessageBox)
        asked.append(question.text())
        question.reject()
        dialog.reject()

    QTimer.singleShot(300, refuse)
    assert typed(dialog, "figure") == ""
    assert "figure.png" in asked[0]
