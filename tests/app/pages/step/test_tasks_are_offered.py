"""What a task of a lesson asks for is offered where the learner looks for it."""

import re

import pytest
from pytestqt.qtbot import QtBot

from app.pages.step.setting_records import settings_records
from app.session.document import Document, TeachingRaster
from core.settings import FIELDS
from lessons.course.catalogue import shipped
from lessons.course.state import States, wanted_settings
from widgets.basics.settings_panel import SettingsPanel


@pytest.mark.slow
@pytest.mark.parametrize("name", list(shipped().lessons))
def test_the_methods_of_a_task_are_listed(qtbot: QtBot, name: str) -> None:
    lesson = shipped().named(name)
    for number, part in enumerate(lesson.steps):
        chosen = {} if part.solution is None else part.solution.settings
        if not chosen:
            continue
        state = States(lesson).of_step(number)
        panel = SettingsPanel()
        qtbot.addWidget(panel)
        document = Document(state.scene, TeachingRaster(64, 48), state.settings)
        panel.show_wanted(wanted_settings(part, state.panes))
        panel.show_settings(settings_records(document))
        for family, value in chosen.items():
            combo = panel.combo(family)
            assert combo.isVisibleTo(panel), (number + 1, family)
            assert combo.findData(str(value)) >= 0, (number + 1, family, value)


@pytest.mark.parametrize("name", list(shipped().lessons))
def test_a_task_on_depths_or_the_camera_opens_the_scene_pane(name: str) -> None:
    lesson = shipped().named(name)
    for number, part in enumerate(lesson.steps):
        if part.solution is not None and (part.solution.depth or part.solution.camera):
            assert "scene" in States(lesson).of_step(number).panes, number + 1


@pytest.mark.parametrize("name", list(shipped().lessons))
def test_what_a_task_sends_the_learner_to_has_that_title(name: str) -> None:
    titles = [field.title for field in FIELDS.values()] + ["Scene", "Numbers"]
    texts = " ".join(f"{part.text} {part.task}" for part in shipped().named(name).steps)
    for first in re.findall(r"\bunder ([A-Z]\w+)", texts):
        assert any(title == first or title.startswith(f"{first} ") for title in titles), first
