"""Keeps the pages from showing what is asked: Step hides what comes next while it has the question's scene.

The step goes back to before what is asked. Going on from there, or what Predict shows there, ends the question. A scene
that was hidden stays so while it is edited: a corner moved by a hair would show the answer.
"""

from PySide6.QtCore import QObject, Slot

from app.files.unfinished_answers import UnfinishedFile
from app.pages.exercises.question_presenter import QuestionPresenter
from app.pages.page_bar import Page
from app.session.moment import Change
from app.session.session import Session
from core import STAGES
from lessons.exercises.scene_digest import scene_digest
from lessons.exercises.screen import PREFIX, screen_of

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
