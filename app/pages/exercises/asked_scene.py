"""Keeps the Step page from showing what is asked: it hides what comes next while it has the question's scene."""

from PySide6.QtCore import QObject, Signal, Slot

from app.pages.exercises.question_presenter import QuestionPresenter
from app.session.session import Session
from lessons.exercises.screen import draws_same


class AskedScene(QObject):
    """Watches the open scene and the question."""

    hiding_toggled = Signal()
    """The Step page is to predict from now on, or no longer."""

    def __init__(self, session: Session, questions: QuestionPresenter, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._questions = session, questions
        self._is_hidden = False
        """Whether it is hidden for the question's sake."""
        session.document_changed.connect(self._look)
        session.predicting_changed.connect(self._follow_predicting)
        questions.state_changed.connect(self._look)

    def _is_open(self) -> bool:
        """Return whether the scene that is asked about is the one that is open on the Step page."""
        question = self._questions.question
        scene = None if question is None else question.draft.scene
        return (
            scene is not None and self._questions.is_asked and draws_same(scene, self._session.document.scene)
        )

    @Slot()
    def _look(self) -> None:
        """Hide the scene while it is asked about, and show it when it no longer is."""
        is_open, is_predicting = self._is_open(), self._session.is_predicting
        was_hidden, self._is_hidden = self._is_hidden, is_open
        if is_open != is_predicting and (is_open or was_hidden):
            self.hiding_toggled.emit()

    @Slot()
    def _follow_predicting(self) -> None:
        """Give the question up where the user ends predicting: then it can be seen."""
        if self._is_hidden and not self._session.is_predicting and self._is_open():
            self._is_hidden = False
            self._questions.give_up()
