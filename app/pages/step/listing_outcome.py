"""What an edited listing draws: where it differs first from the method, and which mistake of the shelf it is."""

from functools import partial
from html import escape
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Slot

from app.background import Job
from app.pages.step.ab.presenter import ComparePresenter
from app.session.session import Session
from widgets.inspector.listing_pane import ListingPane

if TYPE_CHECKING:
    from app.pages.step.page import StepPage
    from app.session.named_mistakes import Outcome

FIRST = '<a href="first">First difference</a>'
SAME = "On this scene your version draws the same picture as the method."


class ListingOutcome(QObject):
    """Says under the listing what it draws, with links."""

    def __init__(
        self, session: Session, comparing: ComparePresenter, pane: ListingPane, page: "StepPage"
    ) -> None:
        super().__init__(page)
        self._session, self._comparing, self._pane, self._page = session, comparing, pane, page
        self._naming = Job(self, succeeded=self._name_mistake, failed=self._leave_unnamed)
        """Looks for the mistake that an edit is."""
        pane.link_clicked.connect(self._follow_link)

    def tell(self) -> None:
        """Offer the way to the first difference, and look for the mistake that the edit is."""
        from app.session.named_mistakes import outcome_of

        if self._page.lessons.is_before_a_class:
            return  # The lesson says it, and the listing needs the room.
        self._pane.show_message(FIRST)
        self._naming.call(partial(outcome_of, self._session.document))

    @Slot(object)
    def _name_mistake(self, outcome: "Outcome") -> None:
        """Say that an edit draws what a mistake of the shelf draws, or what the method draws."""
        from app.session.named_mistakes import exercise_about, lesson_about
        from core.edits.editable import EDITABLE

        if self._pane.editor.has_problem or not self._session.document.edits:
            return
        if outcome.is_right:
            self._pane.show_message(SAME)
            return
        if outcome.mistake is None:
            return
        name = outcome.mistake.name
        links = [FIRST]
        if exercise := exercise_about(EDITABLE[self._session.document.edits[-1].part].family):
            links.append(f'<a href="exercise/{exercise}">Exercise</a>')
        if lesson := lesson_about(name):
            links.append(f'<a href="lesson/{lesson[0]}/{lesson[1]}">Lesson</a>')
        alike = f"On this scene it draws the same as the mistake “{name.replace('-', ' ')}”"
        said = f"{alike}: {escape(outcome.mistake.sentence)}"
        self._pane.show_message(f"{said} {' · '.join(links)}")

    @Slot(object)
    def _leave_unnamed(self, error: Exception) -> None:
        """Say nothing more: why B cannot be drawn stands in its place."""

    @property
    def is_working(self) -> bool:
        """Whether the mistake that an edit is is being looked for."""
        return self._naming.is_running

    def cancel(self) -> None:
        """Look for no mistake any more."""
        self._naming.cancel()

    @Slot(str)
    def _follow_link(self, link: str) -> None:
        """Go where a link of the sentence leads."""
        kind, *names = link.split("/")
        if kind == "first":
            self._page.show_view("compare")
            self._comparing.meeting.go_to_first_difference()
        elif kind == "lesson":
            self._page.lesson_requested.emit(names[0], int(names[1]))
        else:
            self._page.link_requested.emit(link)
