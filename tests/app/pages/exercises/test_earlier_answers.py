"""Answers in progress that were kept before stand in their forms again, and are read as they were."""

import json
from pathlib import Path
from shutil import copyfile

import pytest
from pytestqt.qtbot import QtBot

from app.files.user_folders import ANSWERS
from app.pages.exercises.page import ExercisesPage
from app.session.document import open_document
from app.session.session import Session
from lessons.exercises.catalogue import TEMPLATES
from lessons.scenes import built_in_scene

EARLIER = Path(__file__).parents[2] / "files" / "earlier"


def test_an_answer_of_every_type_that_was_kept_opens(
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RASTERSCOPE_CONFIG", str(tmp_path))
    copyfile(EARLIER / "answers-3.json", tmp_path / ANSWERS)
    kept = json.loads((EARLIER / "answers-3.json").read_text(encoding="utf-8"))["answers"]
    texts = json.loads((EARLIER / "answers-3-texts.json").read_text(encoding="utf-8"))
    scene = built_in_scene("shared-edge")
    page = ExercisesPage(Session(open_document(scene.make(), scene.title)))
    qtbot.addWidget(page)
    page.settle()
    kinds = set()
    for name, text in texts.items():
        page.questions.open_at_once(TEMPLATES[name])
        page.settle()
        question, form = page.question, page.question_view.answer
        assert question.seed == kept[name]["seed"]
        assert form.given() == kept[name]["given"], name
        page.questions.check()
        page.questions.check()  # What is left empty is asked about first.
        page.settle()
        checked = page.questions._last.checked
        assert checked is not None, name
        assert question.draft.answer.text(checked.response) == text
        kinds.add(question.draft.answer.kind)
    assert len(kinds) == 11
    page.stop()
