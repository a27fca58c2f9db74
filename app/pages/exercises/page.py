"""The Exercises page: the catalogue, a question with its picture, the check, and what other pages hide meanwhile.

The step goes back to before what is asked. Going on from there, or what Predict shows there, ends the question. A scene
that was hidden stays so while it is edited: a corner moved by a hair would show the answer.
"""

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QCoreApplication, QObject, Qt, QThread, Slot
from PySide6.QtGui import QKeyEvent, QResizeEvent
from PySide6.QtWidgets import QApplication, QPushButton, QSplitter, QStackedWidget, QWidget

from app.background import is_working
from app.files.file_access import DRAWN_ENDINGS
from app.files.file_dialogs import ask_folder
from app.files.kept_work import UnfinishedFile
from app.pages.columns import SideColumns
from app.pages.exercises.catalogue_presenter import FIRST_COURSE, CataloguePresenter, ProgressPresenter
from app.pages.exercises.diagnosis_presenter import DiagnosisPresenter
from app.pages.exercises.question_presenter import QuestionPresenter
from app.pages.page_bar import Caption, Page
from app.session.moment import Change
from app.session.session import Session
from core import STAGES
from lessons.exercises.question import Template
from lessons.exercises.screen import PREFIX, screen_of
from lessons.scene_edits import scene_digest
from widgets.basics.accessibility import give_focus, tab_stops
from widgets.basics.controls import column_layout
from widgets.basics.panes import PaneSplitter
from widgets.basics.theme import current_theme, theme_notifier
from widgets.exercises.catalogue import Catalogue, ProgressView
from widgets.exercises.diagnosis_view import DiagnosisView
from widgets.exercises.field_answers import PlaceAnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.picture_answers import PixelAnswerView, SpotAnswerView
from widgets.exercises.question_view import QuestionView

if TYPE_CHECKING:
    from lessons.exercises.question import Question


# Keeps the pages from showing what is asked: Step hides what comes next while it has the question's scene.


EDITED = "The scene stays hidden while an exercise asks about it. P shows it, and ends the question."


class AskedScene(QObject):
    """Watches the open scene and the question."""

    def __init__(
        self, session: Session, questions: QuestionPresenter, unfinished: UnfinishedFile, page: Page
    ) -> None:
        super().__init__(page)
        self._session, self._questions, self._unfinished, self._page = session, questions, unfinished, page
        self._is_hidden = self._is_edited = False
        """Whether it is hidden for the question's sake, and whether an edit has made another scene of it since."""
        self._asked = unfinished.answers.asked_scene
        """Digest of the scene for which something was hidden last."""
        session.changed.connect(self._follow)
        questions.state_changed.connect(self._look)

    def _is_open(self) -> bool:
        """Return whether the scene that is asked about, or what an edit has made of it, is open on the Step page."""
        asked, document = self._questions.asked_scene, self._session.document
        if not asked:
            return False
        # What an earlier question has hidden is not for this one to hide.
        hidden = self._unfinished.answers.hidden if asked == self._asked else None
        return hidden == (document.title, document.path) or scene_digest(document.scene) == asked

    @Slot()
    def _look(self) -> None:
        """Hide the scene while it is asked about, and show it when it no longer is."""
        session, document = self._session, self._session.document
        if self._questions.question is None and self._questions.is_working:
            return  # What was asked when the program ended is still hidden.
        is_open, is_predicting = self._is_open(), session.is_predicting
        was_hidden, self._is_hidden = self._is_hidden, is_open
        was_edited = self._is_edited
        self._is_edited = is_open and scene_digest(document.scene) != self._questions.asked_scene
        if self._is_edited and not was_edited:
            self._page.tell(EDITED)
        self._asked = self._questions.asked_scene
        self._unfinished.keep_hidden((document.title, document.path) if is_open else None)
        if is_open and self._here() > self._start():
            number, position = self._start()
            session.scrub(position, STAGES[number])
        session.set_asked(self._questions.asked_scene, is_open=is_open)
        if is_open != is_predicting and (is_open or was_hidden):
            # The Step page asks before it shows what is asked here, or shows it again.
            self._page.action_requested.emit("predict")

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        """Look at another scene; give the question up where the user can see the answer.

        That is where predicting ends, where the steps go into what is asked, and where Predict shows what comes next of
        it; earlier stages may be predicted.
        """
        if Change.DOCUMENT in what:
            self._look()
        elif (
            (Change.PREDICTING in what and not self._session.is_predicting)
            or (Change.CURSOR in what and self._is_hidden and self._here() > self._start())
            or (Change.REVEALED in what and self._is_hidden and self._here() == self._start())
        ):
            self._end()

    def _end(self) -> None:
        """Give the question up; Predict goes on by itself."""
        if self._is_hidden and self._is_open():
            self._is_hidden = False
            self._questions.give_up()

    def _here(self) -> tuple[int, int]:
        """Return the number of the stage at the cursor, and the position."""
        cursor = self._session.cursor
        return STAGES.index(cursor.stage), cursor.position

    def _start(self) -> tuple[int, int]:
        """Return the last place that shows nothing of what is asked: before a step, else before the whole stage."""
        question = self._questions.question
        assert question is not None
        template = question.template
        row = screen_of(template.name).row if template.name.startswith(PREFIX) else -1
        position = 0
        if row > 0:
            steps = self._session.trace.stage(template.stage).steps
            position = steps.position_after(min(row, steps.row_count) - 1)
        return STAGES.index(template.stage), position


# The Exercises page: the catalogue, a question with its picture, the check, and the runs behind an answer.


CATALOGUE_WIDTH = 292
"""Pixels of the catalogue at the usual size of the type: the longest title is read whole."""
ROOM = 75
"""Width of the page, in sizes of the text, from which the catalogue stands beside question and picture."""


class ExercisesPage(Page):
    """All panes of the Exercises page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.session = session
        self.grid = MarkGrid(self)
        self.catalogue, self.question_view = Catalogue(self), QuestionView(self.grid, self)
        self.unfinished = UnfinishedFile(self)
        self.exercises = CataloguePresenter(self.catalogue, self.unfinished, self)
        self.questions = QuestionPresenter(
            self.question_view, self.grid, self.unfinished, self.exercises, self
        )
        self.progress_view = ProgressView(self)
        self.progress = ProgressPresenter(self.progress_view, self)
        self.panes = PaneSplitter(Qt.Orientation.Horizontal, self)
        self.diagnosis_view = DiagnosisView(self)
        self.diagnosis = DiagnosisPresenter(session, self.diagnosis_view, self)
        for pane, stretch in ((self.question_view, 2), (self.grid, 3)):
            self.panes.addWidget(pane)
            self.panes.setStretchFactor(self.panes.count() - 1, stretch)
        self.panes.setSizes([400, 600])
        self.stack = QStackedWidget(self)
        for widget in (self.panes, self.progress_view, self.diagnosis_view):
            self.stack.addWidget(widget)
        self.columns = SideColumns(self.catalogue, self.stack, self)
        self.columns.setSizes([CATALOGUE_WIDTH, 1000])
        layout = column_layout(self, margins=(8, 4, 8, 8))
        layout.addWidget(self.columns)
        self._wants_catalogue: bool | None = None
        """Whether the user has unfolded the catalogue or folded it away; ``None``: it follows the room."""
        self.question_view.list_requested.connect(self._toggle_catalogue)
        self.question_view.lesson_button.clicked.connect(self._go_back)
        theme_notifier().theme_changed.connect(self._make_room)
        self.exercises.question_chosen.connect(self._open)
        self.questions.asked.connect(self.exercises.show_question)
        self.questions.asked.connect(self._focus_asked)
        self.questions.checked.connect(self.exercises.take_attempt)
        self.catalogue.next_requested.connect(self.open_next)
        self.catalogue.progress_requested.connect(self.toggle_progress)
        self.catalogue.picture_requested.connect(self.diagnosis.ask_picture)
        self.progress_view.closed.connect(self.show_question)
        self.diagnosis_view.closed.connect(self.show_question)
        self.diagnosis.shown.connect(self._show_diagnosis)
        self.diagnosis.hidden.connect(self.show_question)
        for presenter in (self.diagnosis, self.progress):
            self.follow(presenter.job)
        self.progress.user_changed.connect(self._set_user)
        self.progress.attempts_added.connect(self.exercises.begin)
        self.exercises.found.connect(self._show_progress)
        self.unfinished.failed.connect(self.edit_refused)
        for success in (self.exercises.question_chosen, self.diagnosis.shown):
            success.connect(self.went_well)
        trouble = self.unfinished.read()
        self.hiding = AskedScene(session, self.questions, self.unfinished, self)
        self._begin(trouble)

    def _begin(self, trouble: str) -> None:
        """Show the exercise that was open last, or else the first, and what is wrong with the answers kept."""
        if trouble:
            self.edit_refused.emit(trouble)
        self.exercises.user = self.questions.user = self.unfinished.answers.user
        self.exercises.found.connect(self._open_last)
        self.exercises.begin()
        if not self.unfinished.answers.current or self.exercises.last() is not None:
            self._open_last()

    @Slot()
    def _open_last(self) -> None:
        """Show the exercise that was open last, or else the first: a teacher's once the folders are read."""
        if self.question is None and not self.questions.is_working:
            self.questions.open(self.exercises.last() or self.exercises.templates[FIRST_COURSE[0]])

    def resume(self) -> None:
        """Ask the question that was open when the program ended, and hide its scene."""
        template = self.exercises.last()
        if template is not None:
            self.questions.open_at_once(template)

    def open_line(self, line: str) -> None:
        """Ask the question of a line that was handed out."""
        self.exercises.open_line(line)

    @Slot()
    def _focus_asked(self) -> None:
        """Let the next key answer, unless something else covers the question."""
        if self.stack.currentWidget() is self.panes:
            self._focus_answer()

    def _focus_answer(self) -> None:
        """Let the next key answer: on the picture, or in the first field."""
        answer = self.question_view.answer
        for view in (self.progress_view, self.diagnosis_view):
            if self.stack.currentWidget() is view:
                give_focus(view.close_button)
                return
        if answer is None or not self.isVisible():
            return
        stops = [self.grid] if isinstance(answer, PixelAnswerView | PlaceAnswerView) else tab_stops([answer])
        if stops:
            by_mouse = QApplication.mouseButtons() != Qt.MouseButton.NoButton
            give_focus(
                stops[0], Qt.FocusReason.MouseFocusReason if by_mouse else Qt.FocusReason.TabFocusReason
            )

    @Slot(object, object)
    def _open(self, template: Template, seed: int | None) -> None:
        self._wants_catalogue = None
        self._make_room()
        self.stack.setCurrentWidget(self.panes)
        self.questions.open(template, seed)

    def open_named(self, name: str) -> None:
        """Ask a question of the exercise with a name."""
        self._open(self.exercises.templates[name], None)

    def show_way_back(self, is_shown: bool, task: str = "") -> None:
        """Offer to go back to the lesson that is open on the Step page."""
        self.question_view.lesson_button.setVisible(is_shown)

    @Slot()
    def _go_back(self) -> None:
        self.action_requested.emit("page_step")

    @Slot()
    def open_next(self) -> None:
        """Ask what suits the learner, after the answer that is being checked."""
        self.questions.after_check(self.exercises.open_next)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Press a button with Return; elsewhere Return checks the answer; Esc ends a check."""
        focused = self.focusWidget()
        is_return = event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter)
        if event.key() == Qt.Key.Key_Escape and self.questions.is_checking:
            self.questions.stop_check()
        elif not is_return or event.modifiers():
            super().keyPressEvent(event)
        elif isinstance(focused, QPushButton):
            focused.click()
        elif focused is not None and self.panes.isAncestorOf(focused):
            self.questions.check()

    @property
    def question(self) -> "Question | None":
        """The question that is shown."""
        return self.questions.question

    # Progress.

    @Slot()
    def toggle_progress(self) -> None:
        """Show points and mistakes in place of the question, or the question again."""
        is_shown = self.stack.currentWidget() is self.progress_view
        self._put(self.panes if is_shown else self.progress_view)
        self._show_progress()

    @Slot()
    def show_question(self) -> None:
        """Show the question again."""
        self._put(self.panes)

    @Slot()
    def _show_diagnosis(self) -> None:
        self._put(self.diagnosis_view)

    def _put(self, view: QWidget) -> None:
        self.stack.setCurrentWidget(view)
        if self.isVisible():
            self.take_focus()

    @Slot()
    def _show_progress(self) -> None:
        if self.stack.currentWidget() is self.progress_view:
            self.progress.show(self.exercises.attempts, self.exercises.user)

    @Slot(str)
    def _set_user(self, user: str) -> None:
        """Let somebody else answer, once the attempt of the one before has its verdict."""
        self.questions.after_check(partial(self._begin_user, user))

    def _begin_user(self, user: str) -> None:
        self.unfinished.keep_user(user)
        self.questions.user = user
        self.exercises.set_user(user)
        if self.question is not None:
            template = self.question.template
            has_begun = template.name in self.unfinished.answers.answers
            self.questions.open_at_once(template, None if has_begun else self.question.seed)

    def dismiss(self) -> bool:
        """Show the question again in place of the progress or of a picture."""
        is_covered = self.stack.currentWidget() is not self.panes
        if is_covered:
            self.show_question()
        return is_covered

    @Slot()
    def ask_folder(self) -> None:
        """Ask for a folder of own exercises, and take them into the catalogue."""
        folder = ask_folder(self.window(), "Add a folder of exercises")
        if folder:
            self.exercises.add_folder(folder)

    def open_path(self, path: str) -> None:
        """Ask the exercise of a file, or say which mistake makes its picture."""
        if path.lower().endswith(DRAWN_ENDINGS):
            self.diagnosis.open(path)
        else:
            self.exercises.open_file(path)

    # The catalogue takes its room last.

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fold the catalogue away where question and picture need the room."""
        super().resizeEvent(event)
        self._make_room()

    @Slot()
    def _make_room(self) -> None:
        has_room = self.width() >= ROOM * current_theme().text_px
        is_shown = has_room if self._wants_catalogue is None else self._wants_catalogue
        self.catalogue.setVisible(is_shown)
        self.question_view.show_list_button(not has_room, is_shown)

    @Slot()
    def _toggle_catalogue(self) -> None:
        self._wants_catalogue = self.catalogue.isHidden()
        self._make_room()

    # As a page of the window.

    def undo(self) -> bool:
        """Take back what was answered last."""
        self.questions.go_back(-1)
        return True

    def redo(self) -> bool:
        """Answer it again."""
        self.questions.go_back(1)
        return True

    def toggle_rows(self) -> None:
        """Answer row by row, or on the picture."""
        answer = self.question_view.answer
        if isinstance(answer, PixelAnswerView | SpotAnswerView):
            answer.toggle_rows()
        else:
            self.tell("This answer is given in fields already.")

    def main_view(self) -> QWidget:
        """Return what is exported and copied: the question with its picture, or the progress."""
        return self.stack.currentWidget() or self.stack

    def first_pane(self) -> QWidget:
        """Return the question without its picture, or what stands in its place."""
        return self.question_view if self.main_view() is self.panes else self.main_view()

    def focus_panes(self) -> list[QWidget]:
        """Return what F6 goes through after that: the picture, the catalogue, and the borders."""
        return [self.grid, self.catalogue, self]

    def take_focus(self) -> None:
        """Give the keyboard to the answer."""
        self._focus_answer()

    def caption(self) -> Caption:
        """Return the question, or what was found of a picture."""
        if self.stack.currentWidget() is self.diagnosis_view:
            return Caption(self.diagnosis_view.verdict.text())
        return Caption("" if self.question is None else self.question.draft.text)

    def settle(self) -> None:
        """Wait until the question is there."""
        while self.questions.is_working or is_working(self):
            QCoreApplication.processEvents()
            QThread.msleep(5)

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes."""
        return {
            "exercise columns": self.columns,
            "exercise panes": self.panes,
            "diagnosis panes": self.diagnosis_view.panes,
        }

    def leave(self) -> None:
        """Keep the answer now: the program may end while another page is shown."""
        self.unfinished.finish()

    def stop(self) -> None:
        """End all work, and keep the answer."""
        self.questions.stop()
        super().stop()
        self.unfinished.finish()
