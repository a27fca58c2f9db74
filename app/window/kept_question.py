"""Hides from the first moment on what was asked when the program ended; the page of Exercises is made for it."""

from PySide6.QtCore import QObject, Slot

from app.files.kept_work import read_answers
from app.pages.page_bar import Pages
from app.session.moment import Change
from app.session.session import Session
from core.scene import AnyScene
from lessons.scene_edits import scene_digest


class KeptQuestion(QObject):
    """Watches the open scene until the page of Exercises does."""

    def __init__(self, session: Session, pages: Pages, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._pages = session, pages
        self._seen: AnyScene | None = None
        try:
            kept = read_answers()
        except (OSError, ValueError):
            return  # The page says what is wrong with the file.
        self._hidden, self._asked = kept.hidden, kept.asked_scene
        if kept.asked_scene:
            session.set_asked(kept.asked_scene, is_open=False)
            session.changed.connect(self._follow)
            self._look()

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.DOCUMENT in what:
            self._look()

    def _look(self) -> None:
        """Have the question asked once its scene is open."""
        document = self._session.document
        scene = document.scene
        if self._pages.is_made("exercises"):
            self._session.changed.disconnect(self._follow)
        elif scene is not self._seen:
            self._seen = scene
            is_hidden = self._hidden == (document.title, document.path)
            if is_hidden or scene_digest(scene) == self._asked:
                self._pages.page("exercises").resume()
