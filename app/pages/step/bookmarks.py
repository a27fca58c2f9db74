"""Bookmarks: remembered steps, each with a note that the user may type."""

from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, Signal

from app.files.state_models import NOTE_LIMIT, Bookmark
from app.session.session import Session
from core.stages.declared import stage_of

BOOKMARKS = 10
"""Bookmarks that have a key; there can be no more."""


class Bookmarks(QObject):
    """The bookmarks of the open scene, in the order in which they were set."""

    bookmarks_changed = Signal()
    """There are others, or one has another note."""

    def __init__(self, session: Session, tell: Callable[[str], None], parent: QObject) -> None:
        """``tell`` tells the user something."""
        super().__init__(parent)
        self._tell = tell
        self._session = session
        self.marks: list[Bookmark] = []

    def set_marks(self, marks: Iterable[Bookmark]) -> None:
        """Have these bookmarks, as those of another scene."""
        self.marks = list(marks)
        self.bookmarks_changed.emit()

    def here(self) -> Bookmark | None:
        """Return the bookmark of the present step."""
        cursor = self._session.cursor
        place = cursor.stage, cursor.position
        return next((mark for mark in self.marks if (mark.stage, mark.position) == place), None)

    def toggle(self) -> None:
        """Remember this step, or forget it."""
        mark = self.here()
        if mark is None:
            self.describe("")
        else:
            self.marks.remove(mark)
            self.bookmarks_changed.emit()

    def describe(self, note: str) -> None:
        """Remember this step with a note; ValueError if the note is too long."""
        if len(note) > NOTE_LIMIT:
            raise ValueError(f"A note has at most {NOTE_LIMIT} characters, got {len(note)}.")
        cursor, before = self._session.cursor, self.here()
        mark = Bookmark(stage=cursor.stage, position=cursor.position, note=note)
        if before is not None:
            self.marks[self.marks.index(before)] = mark
        elif len(self.marks) >= BOOKMARKS:
            self._tell("All ten bookmarks are set. Remove one first.")
            return
        else:
            self.marks.append(mark)
        self.bookmarks_changed.emit()

    def text(self, index: int) -> str:
        """Return a bookmark in words, by its number from 0."""
        mark = self.marks[index]
        text = f"{stage_of(mark.stage).short_title}, step {mark.position:,}"
        return f"{text}: {mark.note}" if mark.note else text

    def go_to(self, index: int) -> None:
        """Go to a bookmark by its number from 0, and tell its note."""
        if index >= len(self.marks):
            self._tell(f"Bookmark {index + 1} is not set: Ctrl+B sets one.")
            return
        mark = self.marks[index]
        self._session.set_stage(mark.stage, mark.position)
        if mark.note:
            self._tell(f"Bookmark {index + 1}: {mark.note}")
