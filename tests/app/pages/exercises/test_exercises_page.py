"""The Exercises page, as a learner uses it: the mistake behind an answer, variants, progress, and what is kept."""

import errno
import os
from dataclasses import replace
from itertools import count, cycle
from pathlib import Path
from typing import NoReturn

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from pytestqt.qtbot import QtBot

from app.files.user_folders import attempt_file
from app.pages.exercises.answers import Checked, marks_of, outline_of
from app.pages.exercises.feedback import CORRECTED, feedback_of
from app.pages.exercises.page import ExercisesPage
from app.window.main_window import MainWindow
from core import render
from lessons.exercises.catalogue import SUBJECTS, TEMPLATES
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Question, ask, judge
from tests.app.pages.exercises.acting import LEFT, Page, check, paint
from widgets.basics.message_bar import Progress
from widgets.exercises.catalogue import Catalogue
from widgets.exercises.mark_grid import FOUND
from widgets.exercises.picture_answers import LEGEND
from widgets.exercises.records import ExerciseEntry, ExerciseGroup
from widgets.grid.layers import CellMark, MaskOverlay

pytestmark = pytest.mark.shared_window


@pytest.mark.own_window
def test_pixels_are_painted_checked_and_the_mistake_is_stepped(
    page: Page, window: MainWindow, qtbot: QtBot
) -> None:
    """The answer of a twin is named; both runs open at their first divergence; the attempt is on the disk."""
    shown = page("triangle-coverage")
    draft = shown.question.draft
    wrong = draft.mistakes["corner-for-center"]
    paint(shown, wrong)
    assert shown.grid.marked() == wrong
    said = check(shown)
    assert "centre (i + 1/2, j + 1/2) decides" in said
    assert "row with a wrong one: row" in said
    assert not [each for each in shown.grid.overlays() if isinstance(each, MaskOverlay)], "not all at once"
    assert len(attempt_file().attempts()) == 1
    assert CORRECTED not in said
    assert CORRECTED in check(shown), "progress counts the first check"
    marks = {each.mark: each.mask for each in shown.grid.overlays() if isinstance(each, MaskOverlay)}
    assert marks[CellMark.MISSING].sum() == len(draft.answer.reference - wrong)
    assert marks[CellMark.EXTRA].sum() == len(wrong - draft.answer.reference)
    answer = shown.question_view.answer
    found = {kind for kind, text in LEGEND.items() if text in answer.how.text()}
    assert found == {kind for kind, mark in FOUND.items() if mark in marks and marks[mark].any()}
    assert {attempt.mistakes for attempt in attempt_file().attempts()} == {("corner-for-center",)}
    with qtbot.waitSignal(window.opening.opened):
        QTest.mouseClick(shown.question_view.twin_button, LEFT)
    comparing = window.page.comparing
    qtbot.waitUntil(lambda: not comparing.meeting.is_searching)
    assert window.pages.current_name == "step"
    assert window.page.current_view() == "compare"
    assert comparing.other.pixel_center == "integer"
    assert window.session.cursor.position > 0 or comparing.second.cursor.position > 0


@pytest.mark.own_window
def test_work_survives_leaving_and_the_program(page: Page, qtbot: QtBot) -> None:
    """Another page of the program finds question, marks and hints again."""
    shown = page("shared-edge", 11)
    paint(shown, frozenset({(2, 2), (3, 2)}))
    QTest.mouseClick(shown.question_view.hint_button, LEFT)
    shown.leave()
    other = ExercisesPage(shown.session)
    qtbot.addWidget(other)
    other.settle()
    assert other.question.mark == "shared-edge 2, seed 11"
    assert other.grid.marked() == {(2, 2), (3, 2)}
    assert other.question_view.hints.text().startswith("Hint 1")
    other.stop()


@pytest.mark.slow
def test_a_variant_after_a_miss_tells_two_mistakes_apart(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """Seeds in which both mistakes give the same answer are passed over; without such a miss the first is taken."""
    pair = ("level-edges-never", "all-edges-exclusive")

    def are_alike(seed: int) -> bool:
        draft = ask(TEMPLATES["shared-edge"], seed).draft
        named = set(pair) <= set(draft.mistakes)
        return not named or draft.answer.is_same(*(draft.mistakes[name] for name in pair))

    shown = page("shared-edge")
    alike = next(seed for seed in count() if are_alike(seed))
    apart = next(seed for seed in count(alike) if not are_alike(seed))
    seeds = cycle((alike, apart))
    monkeypatch.setattr("app.pages.exercises.question_presenter.new_seed", lambda: next(seeds))
    shown.questions.ask_variant()
    shown.settle()
    assert shown.question.seed == alike
    paint(shown, frozenset({(0, 0)}))
    check(shown)
    checked = shown.questions._last.checked
    shown.questions._last.checked = replace(checked, judgement=replace(checked.judgement, mistakes=pair))
    seeds = cycle((alike, apart))
    shown.questions.ask_variant()
    shown.settle()
    assert shown.question.seed == apart


@pytest.mark.slow
def test_outlines_have_the_names_of_the_question(page: Page) -> None:
    shown = page("facing")
    geometry = shown.grid._geometry
    assert geometry.names == ("A", "B", "C", "D")
    before = shown.grid.grab().toImage()
    shown.grid.show_geometry(replace(geometry, names=()))
    assert shown.grid.grab().toImage() != before


def test_triangles_that_stand_for_fragments_have_no_outline() -> None:
    """They all have one shape, in the pixel of their fragment: only the pixels say something."""
    for name in ("depth-test-steps", "z-buffer-table"):
        assert outline_of(ask(TEMPLATES[name], 7).draft, "depth") is None
    assert outline_of(ask(TEMPLATES["point-pixels"], 7).draft, "raster") is not None


def test_the_list_of_a_stage_is_divided_by_subject(page: Page) -> None:
    """Headings stand between the exercises; neither clicks nor the keys of the list stop there."""
    shown = page("line-octants")
    tree = shown.catalogue.tree
    stage = tree.currentItem().parent()
    titles = [stage.child(number).text(0) for number in range(stage.childCount())]
    heads = [title for title in titles if title in SUBJECTS.values()]
    assert heads == list(dict.fromkeys(SUBJECTS[name] for name in SUBJECTS if SUBJECTS[name] in heads))
    assert len(heads) == 4
    heading = stage.child(titles.index("Lines"))
    tree.itemClicked.emit(heading, 0)
    assert stage.isExpanded()
    assert shown.question.template.name == "line-octants"
    tree.setCurrentItem(stage.child(titles.index("Lines") - 1))
    QTest.keyClick(tree, Qt.Key.Key_Down)
    assert tree.currentItem() is stage.child(titles.index("Lines") + 1)


def test_a_belief_is_refuted_by_a_step_and_a_mistake_by_its_picture(
    page: Page, window: MainWindow, qtbot: QtBot
) -> None:
    shown = page("blend-over")
    shown.questions.answer(shown.question.draft.mistakes["order-reversed"])
    check(shown)
    button = shown.question_view.twin_button
    assert button.text() == "Show that picture"
    QTest.mouseClick(button, LEFT)
    assert shown.grid.buffer().label == "the picture"
    QTest.mouseClick(button, LEFT)
    assert shown.grid.buffer().label == "your marks"
    page("belief-w-is-one")
    shown.questions.answer(frozenset({2}))
    check(shown)
    assert button.text() == "Show the step"
    with qtbot.waitSignal(window.opening.opened):
        QTest.mouseClick(button, LEFT)
    page("triangle-coverage")
    shown.questions.answer(shown.question.draft.mistakes["vertices-rounded"])
    check(shown)
    with qtbot.waitSignal(window.opening.opened):
        QTest.mouseClick(button, LEFT)
    assert (
        window.session.cursor.stage == "raster"
    )  # Other corners differ before: the question is about this stage.
    page("belief-w-is-one")
    shown.questions.answer(frozenset({2}))
    check(shown)
    with qtbot.waitSignal(window.opening.opened):
        QTest.mouseClick(button, LEFT)
    assert (window.session.cursor.stage, window.session.cursor.position) == ("transform", 12)


@pytest.mark.own_window
def test_progress_users_files_and_a_teachers_exercise(page: Page, tmp_path: Path) -> None:
    """What was missed is counted; somebody else begins anew; answers are exchanged; a file is asked."""
    shown = page("triangle-coverage")
    shown.questions.answer(shown.question.draft.mistakes["y-down"])
    check(shown)
    QTest.mouseClick(shown.catalogue.progress_button, LEFT)
    tree = shown.progress_view.tree
    rows = {tree.topLevelItem(0).child(k).text(0): tree.topLevelItem(0).child(k).text(1) for k in range(5)}
    assert rows["y down"] == "1 of 1"
    assert rows["corner for center"] == "0 of 1"
    shown.progress.export_to(str(tmp_path / "answers.json"))
    shown.progress_view.users.setFocus()
    shown.progress_view.users.setEditText("Ada")
    QTest.keyClick(shown.progress_view.users.lineEdit(), Qt.Key.Key_Return)
    shown.settle()
    assert tree.topLevelItemCount() == 0
    assert shown.questions.user == "Ada"
    assert shown.grid.marked() == frozenset()
    said: list[str] = []
    shown.message_sent.connect(said.append)
    shown.edit_refused.connect(said.append)
    worked: list[Progress | None] = []
    shown.work_progressed.connect(worked.append)
    for name in ("answers.json", "nothing.json"):
        shown.progress.import_from(str(tmp_path / name))
        shown.settle()
    assert worked == [Progress("judging answers", 0, 100), None, None]
    assert said[0] == "Imported 0 answers from answers.json. 1 answer judged again."
    assert said[1].startswith("The answers were not imported: ")
    assert said[1].endswith("nothing.json cannot be read or written: no such file or directory.")
    assert shown.dismiss()
    path = tmp_path / "mine.toml"
    path.write_text(
        'version = 1\ntitle = "Mine"\nstage = "raster"\nquestion = "Which?"\n'
        '[answer]\ntype = "choice"\noptions = ["a", "b"]\nright = ["a"]\n'
    )
    shown.window().open_path(str(path))
    shown.settle()
    assert shown.question.template.title == "Mine"
    assert shown.grid.isHidden()


@pytest.mark.own_window
def test_the_third_miss_in_a_row_offers_the_step_that_decides(page: Page, qtbot: QtBot) -> None:
    for seed in range(3):
        shown = page("triangle-coverage", seed)
        shown.questions.answer(shown.question.draft.mistakes["y-down"])
        verdict = check(shown)
        assert ("Missed 3 times in a row." in verdict) is (seed == 2)
        assert shown.question_view.step_button.isHidden() is (seed < 2)
    question = shown.question
    wrong = question.draft.mistakes["y-down"] ^ question.draft.answer.reference
    window = shown.window()
    with qtbot.waitSignal(window.opening.opened):
        QTest.mouseClick(shown.question_view.step_button, LEFT)
    assert window.session.cursor.stage == "raster"
    assert window.session.pin == min(wrong, key=lambda pixel: pixel[::-1])


@pytest.mark.own_window
def test_where_nothing_can_be_kept_the_verdict_says_so(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> NoReturn:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS))

    shown = page("triangle-coverage")
    monkeypatch.setattr(Path, "touch", refuse)
    said: list[str] = []
    shown.edit_refused.connect(said.append)
    shown.questions.answer(shown.question.draft.answer.reference)
    assert check(shown).startswith("4 of 4 points")
    shown.exercises.begin()
    shown.settle()
    assert said[0].startswith("The attempt is not saved: ")
    assert said[0].endswith("attempts.sqlite cannot be written: read-only file system.")
    assert said[1].endswith("read-only file system. Answers are checked, but not kept.")
    assert shown.exercises.templates, "exercises and what was kept before are still there"


def test_only_a_pixel_that_another_triangle_covers_is_double(tmp_path: Path) -> None:
    """Where coverage is asked; what is covered and has another colour or texel is extra."""
    path = tmp_path / "mine.toml"
    path.write_text(
        'version = 1\ntitle = "Mine"\nstage = "raster"\nquestion = "Which?"\n'
        "scene = {size = [8, 6], triangles = [[[0, 0], [8, 0], [8, 6]], [[0, 0], [8, 6], [0, 6]]]}\n"
        'answer = {type = "pixels", triangle = 0}\n'
    )

    def checked(question: Question, more: set[tuple[int, int]]) -> Checked:
        response = question.draft.answer.reference | more
        judgement = judge(question, response)
        marks = marks_of(question, judgement.verdict)
        return Checked(None, response, judgement, marks, None, "")

    question = ask(read_exercise(path), 0)
    found = checked(question, {(0, 5), (1, 4)})
    nothing: frozenset[tuple[int, int]] = frozenset()
    double = frozenset({(0, 5), (1, 4)})
    right = question.draft.answer.reference
    assert found.marks == {"right": right, "missing": nothing, "extra": nothing, "double": double}
    said = feedback_of(question, found, first=None)
    assert said.counts.endswith("2 extra, 2 of these double")
    question = ask(TEMPLATES["below-half"], 7)
    assert question.draft.scene is not None
    primitive = render(question.draft.scene, question.draft.settings).primitive
    covered = {(column, row) for row, column in np.argwhere(primitive >= 0).tolist()}
    marks = checked(question, covered).marks
    assert marks["extra"]
    assert not marks.get("double")


def test_the_triangle_across_a_shared_edge_is_drawn_too() -> None:
    outline = outline_of(ask(TEMPLATES["shared-edge"], 0).draft, "raster")
    assert (outline.names, len(outline.triangles)) == (("A", "B"), 2)


def test_a_long_title_of_the_catalogue_is_read_whole(qtbot: QtBot) -> None:
    """It takes a second line where it is wider than its column."""
    view = Catalogue()
    qtbot.addWidget(view)
    view.resize(292, 600)
    view.show()
    titles = ("Short", "The wrong line from clip space to the window, told at length")
    entries = tuple(ExerciseEntry(title, title, "1 point") for title in titles)
    view.show_exercises([ExerciseGroup("raster", "Raster", entries)], titles[0], "")
    stage = view.tree.topLevelItem(0)
    short, long = (view.tree.visualItemRect(stage.child(number)).height() for number in range(2))
    assert long >= short + view.tree.fontMetrics().lineSpacing()
