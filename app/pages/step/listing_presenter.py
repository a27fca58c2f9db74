"""Change the line: the listing of a step is edited, and side B of A | B draws what the edited one draws."""

from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.files.state_models import DRAFT_LIMIT, DraftRecord
from app.pages.step.ab.presenter import ComparePresenter
from app.pages.step.inspector_column import InspectorColumn
from app.pages.step.inspector_presenter import InspectorPresenter, load_stages
from app.pages.step.listing_outcome import ListingOutcome
from app.session.document import Document
from app.session.moment import Moment, Step
from app.session.session import Session
from core.records.listing import EditedListing, Listing, moved_lines
from core.scene import AnyScene
from core.settings import FAMILIES
from widgets.inspector.listing_pane import A, B, ListingPane, PaneHead

if TYPE_CHECKING:
    from app.pages.step.page import StepPage
    from core.edits.edit import Edit

HIDDEN = "While you predict, or a question is asked about this scene, no listing can be edited."
ASKED = "A's listing is hidden: it is asked for"
KEPT = "The text that has not run is kept: Edit opens it again."
LOADING = "The editor is being loaded."
LATER_MS = 50
EDITED_FAMILIES = (
    *("cull", "line", "line_clipping", "fill_rule", "fill", "interpolation", "shading", "texture_filter"),
    *("depth", "blend"),
)
"""Families whose listings can be edited, as `core.edits.EDITABLE` has them."""
EDITED_STAGES = frozenset(FAMILIES[family].stage for family in EDITED_FAMILIES)
DRAFT_KEPT = "Your text has not run"
LISTING_CHANGES = "all changes of this listing"
OLD_STEP = " The step and its numbers are those of the last version that ran."
HAS_NONE = "This step has no listing."
SLEEPS = "Your edited listing stays, but it does not run on this scene"


class ListingPresenter(QObject):
    """Lets the listing be edited, and shows in the inspector whose step is meant: that of A, or of B."""

    drafts_changed = Signal()
    """Another text that does not run is kept, or one is no more."""

    def __init__(
        self,
        session: Session,
        comparing: ComparePresenter,
        inspector: InspectorPresenter,
        column: InspectorColumn,
        page: "StepPage",
    ) -> None:
        super().__init__(page)
        self._session, self._comparing, self._inspector, self._page = session, comparing, inspector, page
        self._pane: ListingPane = column.code
        self._place: tuple[str, str] | None = None
        """Part and method of what is edited in the editor."""
        self._is_stopped = False
        """Whether the text that stands in the editor was stopped before it had run."""
        self._drafts: dict[tuple[str, str], str] = {}
        """Texts that did not run when the editor was left, by part and method."""
        self._asked: AnyScene | None = None
        """The scene of an exercise that asks for a listing; ``None``: none does."""
        self._lent: tuple[Edit, ...] = ()
        """Edits that an exercise has brought along."""
        self.outcome = ListingOutcome(session, comparing, column.code, page)
        self._later = QTimer(self, singleShot=True)
        self._later.timeout.connect(self._show_head_later)
        inspector.listing_shown = self._show_head
        inspector.line_beside_clicked.connect(self._run_to_line)
        comparing.second_shown.connect(self._follow_second)
        comparing.edited.ran.connect(self._take)
        comparing.edited.failed.connect(self._show_problem)
        pane = self._pane
        pane.edit_requested.connect(self.begin)
        pane.reset_requested.connect(self.reset)
        pane.side_chosen.connect(self.show_side)
        pane.name_given.connect(self._name)
        pane.editor.textChanged.connect(self._follow_text)
        pane.editor.text_typed.connect(self._try)
        pane.editor.left.connect(self.leave)

    # Which side.

    @property
    def side(self) -> int:
        """Whose step the inspector shows."""
        return B if self._inspector.beside is not None else A

    @Slot(int)
    def show_side(self, side: int) -> None:
        """Show the step of A or of B in the inspector."""
        has_edits = bool(self._session.document.edits)
        if side == B and not has_edits:
            side = A
        elif self._hides_right and has_edits:
            side = B
        if side == A and self._pane.is_editing:
            self._end_editing()
        self._set_side(side)

    def _set_side(self, side: int) -> None:
        is_other = side != self.side
        self._inspector.beside = self._second if side == B else None
        self._pane.show_side(side)
        if is_other:
            if side == B:
                self._page.show_view("compare")
            self._inspector.refresh_run(self._session.moment)

    def _second(self) -> Step | None:
        """Return where B is; what is said where it is nowhere."""
        self._inspector.hint_beside = self._comparing.refusal
        return self._comparing.second

    @Slot()
    def _follow_second(self) -> None:
        """Show where B is now."""
        if self.side == B:
            self._inspector.refresh_step(self._session.moment)
            self._inspector.refresh_history(self._session.moment)

    @property
    def _hides_right(self) -> bool:
        """Whether the listing as it is, and where the edited one differs, stays hidden: an exercise asks for it."""
        return self._asked is not None and self._session.document.scene is self._asked

    def show_right(self, *, is_asked: bool) -> None:
        """Show B beside the listing as it is, or no listing as it is while an exercise asks for it."""
        self._asked = self._session.document.scene if is_asked else None
        if is_asked:
            self.show_side(B)
        self._show_head(self._inspector.shown_listing)

    def show_lent(self, edits: "tuple[Edit, ...]") -> None:
        """Take edits as those of an exercise: unless they are edited on, they end with its scene."""
        self._lent = edits

    @property
    def typed(self) -> "tuple[Edit, ...]":
        """The edits that the user has typed here, which go along to the next scene."""
        return tuple(edit for edit in self._session.document.edits if edit not in self._lent)

    def begin_anew(self) -> None:
        """Leave the editor: another scene was opened. What did not run is kept, as what ran is."""
        self._end_editing()

    @property
    def drafts(self) -> list[DraftRecord]:
        """The texts that do not run, also the one that is being typed."""
        texts = dict(self._drafts)
        if self._place is not None and self._has_not_run:
            texts[self._place] = self._pane.editor.text
        # No file holds half of a character that takes two units.
        whole = {place: text.encode("utf-8", "replace").decode() for place, text in texts.items()}
        return [DraftRecord(part=part, of=of, text=text[:DRAFT_LIMIT]) for (part, of), text in whole.items()]

    @property
    def _has_not_run(self) -> bool:
        """Whether the text in the editor cannot run, or was stopped."""
        return self._pane.editor.has_problem or self._is_stopped

    def show_drafts(self, drafts: Iterable[DraftRecord]) -> None:
        """Keep the texts of a state that do not run: *Edit* opens them."""
        self._drafts = {(draft.part, draft.of): draft.text for draft in drafts}
        self._show_head(self._inspector.shown_listing)

    def refresh(self, moment: Moment) -> None:
        """Follow the document: its edits may have been undone, or another scene has none."""
        document = moment.document
        # Nothing of B is shown where no edit runs on the scene.
        sleeps = bool(document.edits) and not self._pane.is_editing and self._comparing.edits_sleep(document)
        if moment.is_predicting or moment.is_asked_about or not document.edits or sleeps:
            if moment.is_predicting or moment.is_asked_about:
                self._end_editing()
            self._set_side(A)
        elif self._hides_right or self._page.lessons.is_before_a_class:
            self._set_side(B)
        if self._pane.is_editing and self._place is not None:
            from app.session.listing_runs import edit_of
            from core.edits.edit import original

            edit = edit_of(document, self._place)
            self._pane.editor.show_text(edit.text if edit else original(*self._place).source)
            self._pane.editor.show_problem(None)
        self.outcome.cancel()
        self._pane.show_message("")
        self._comparing.show_old(False)
        self._show_head(self._inspector.shown_listing)
        if document.edits and not (sleeps or moment.is_predicting or moment.is_asked_about):
            self.outcome.tell()

    def _show_head(self, listing: Listing | None) -> None:
        """Offer what can be done with the listing that is shown."""
        moment = self._session.moment
        document, stage = moment.document, moment.cursor.stage
        has_head = stage in EDITED_STAGES
        if moment.is_predicting or moment.is_asked_about:
            self._pane.show_head(PaneHead(refusal=HIDDEN))
            return
        if load_stages().is_alive():
            # The window opens without the evaluator: the head has its room, and soon its button.
            self._pane.show_head(PaneHead(has_head, LOADING))
            self._later.start(LATER_MS)
            return
        from app.session.listing_runs import changed_lines, changed_text, edit_of, edited_place, why_not
        from core.edits.edit import original

        place = self._place if self._pane.is_editing else edited_place(listing, document)
        edit = edit_of(document, place)
        refusal = why_not(listing, stage, document) if listing is not None else HAS_NONE
        lines: tuple[frozenset[int], frozenset[int]] = (frozenset(), frozenset())
        note = resets = ""
        text = self._text_of(place) or (edit.text if edit is not None else "")
        hides = self._hides_right and edit is not None
        if hides:
            note = ASKED
            self._pane.editor.show_changed_lines(frozenset())
        elif place is not None and text:
            old = original(*place).source
            note, resets = changed_text(old, text), LISTING_CHANGES if text != old else ""
            typed = changed_lines(old, text)
            self._pane.editor.show_changed_lines(typed[B])
            if edit is not None or self._pane.is_editing:
                lines = typed if edit is None or edit.text == text else changed_lines(old, edit.text)
            if place in self._drafts and not self._pane.is_editing:
                note = DRAFT_KEPT
        if self._pane.message.text() == KEPT and place not in self._drafts:
            self._pane.show_message("")
        if not text and document.edits:
            note, resets = f"Edited: {self._last_edit(document)}", f"the edit of {self._last_edit(document)}"
        self._pane.listing.show_changed_lines(lines[self.side])
        is_shown = has_head or bool(document.edits)
        name = edit.name if edit is not None else ""
        self._pane.show_head(PaneHead(is_shown, refusal, edit is not None and not hides, note, resets, name))

    def _text_of(self, place: tuple[str, str] | None) -> str:
        """Return the text that stands in the editor, or is kept for it, in place of what has run; empty: none."""
        if self._pane.is_editing:
            return self._pane.editor.text
        return "" if place is None else self._drafts.get(place, "")

    @staticmethod
    def _last_edit(document: Document) -> str:
        """Return what is edited elsewhere, in words."""
        return document.edits[-1].title.removeprefix("the edited ")

    @Slot()
    def _follow_text(self) -> None:
        """Mark the lines that are changed while they are typed."""
        if self._pane.is_editing and self._place is not None:
            self._show_head(self._inspector.shown_listing)

    @Slot(str)
    def _name(self, name: str) -> None:
        """Name the edited version."""
        from app.session.listing_runs import edited_place, named

        document = self._session.latest
        place = self._place or edited_place(self._inspector.shown_listing, document)
        if place is not None:
            self._session.edit(named(document, place, name))

    @Slot()
    def _show_head_later(self) -> None:
        self._show_head(self._inspector.shown_listing)

    # Editing.

    def edit_chosen_line(self) -> None:
        """Edit the line that is chosen in the listing, or that of the step."""
        pane = self._pane
        if pane.is_editing:
            self.leave()
        else:
            self.begin(pane.listing.chosen_line or 0)

    @Slot(int)
    def begin(self, line: int = 0) -> None:
        """Edit the listing that is shown, from a line (from 1) on; 0: the line of the step."""
        from app.session.listing_runs import edit_of, edited_place, why_not
        from core.edits.edit import Edit, original

        moment, listing = self._session.moment, self._inspector.shown_listing
        if moment.is_predicting or moment.is_asked_about:
            self._page.tell(HIDDEN)
            return
        place = edited_place(listing, moment.document)
        if listing is None or place is None:
            self._page.tell(why_not(listing, moment.cursor.stage, moment.document) or HAS_NONE)
            return
        self._place, edit = place, edit_of(moment.document, place)
        line = line or self._pane.listing.line or 1
        text = original(*place).source if edit is None else edit.text
        draft = self._drafts.get(place)
        if not isinstance(listing, EditedListing):
            line = moved_lines(listing.source, text).get(line, line)
        self._page.show_view("compare")
        if "inspector" not in self._page.shown_panes():
            self._page.show_panes(["inspector", *self._page.shown_panes()])
        self._comparing.show_begun(Edit(*place, original(*place).source))
        self.show_side(B)
        self._pane.begin_editing(draft or text, line)
        if draft:
            self._drafts.pop(place)
            self._try(draft)
        self._show_head(self._inspector.shown_listing)

    @Slot()
    def leave(self) -> None:
        """Stop what runs, or else leave the editor; the edit stays."""
        if self._comparing.is_drawing:
            self._comparing.cancel_drawing()
            self._is_stopped = self._pane.is_editing
            self.drafts_changed.emit()
            self._pane.show_message("Stopped: B is the last version that ran.", is_problem=True)
            self._comparing.show_old(True)
            return
        if self._pane.is_editing:
            self._pane.editor.settle()
            self._end_editing()
            self._inspector.refresh_step(self._session.moment)

    def _end_editing(self) -> None:
        """Put the listing in the place of the editor; what ran stays, and what does not run is kept for later."""
        place, self._place = self._place, None
        self._pane.end_editing()
        if self._has_not_run:
            self._show_right()
            if place is not None:
                self._drafts[place] = self._pane.editor.text
                self._pane.show_message(KEPT)
                self.drafts_changed.emit()
        self._comparing.show_begun(None)

    @Slot()
    def reset(self) -> None:
        """Take all changes of the listing that is shown back, or else the last edit of another one."""
        from app.session.listing_runs import edit_of, edited_place, without_edit
        from core.edits.edit import original

        document = self._session.latest
        place = self._place if self._pane.is_editing else None
        place = place or edited_place(self._inspector.shown_listing, document)
        if self._drafts.pop(place, None) is not None if place is not None else False:
            self.drafts_changed.emit()
        elif edit_of(document, place) is None and not self._pane.is_editing and document.edits:
            place = document.edits[-1].part, document.edits[-1].of
        if place is None:
            return
        self._session.edit(without_edit(document, place[0]))
        if self._pane.is_editing:
            self._pane.editor.show_text(original(*place).source)
            self._show_right()
        self._show_head(self._inspector.shown_listing)

    def show_edited(self) -> str:
        """Show A | B with the edited listings; return why they cannot run on the open scene, else nothing."""
        document = self._session.document
        if self._comparing.edits_sleep(document):
            why = document.edits[-1].passed_over(document.settings, document.scene)
            return f"{SLEEPS}: {why[0].lower()}{why[1:].rstrip('.')}."
        before = self._page.current_view()
        self._page.show_view("compare")
        if self._comparing.second is not None or self._comparing.is_drawing:
            return ""
        said = self._comparing.refusal.removeprefix("B cannot be drawn: ")
        self._page.show_view(before)
        return f"{SLEEPS}: {said}"

    @Slot(str)
    def _try(self, text: str) -> None:
        """Run what is typed; B stays the last version that ran where it cannot."""
        from app.session.listing_runs import edit_of, with_edit
        from core.edits.edit import Edit

        if self._place is None:
            return
        self._is_stopped = False
        document = self._session.latest
        known = edit_of(document, self._place)
        edited = with_edit(document, Edit(*self._place, text, known.name if known is not None else ""))
        if edited.edits == document.edits:
            self._show_right()
            if document.edits:
                self.outcome.tell()
        elif not edited.edits:
            self._session.edit(edited)
        else:
            self._comparing.try_edit(edited)

    @Slot(object)
    def _take(self, edited: Document) -> None:
        """Take over a text that has run: one entry of undo."""
        self._show_right()
        self._session.edit(edited)
        if self._pane.is_editing:
            self._set_side(B)

    def _show_right(self) -> None:
        self._is_stopped = False
        self._pane.editor.show_problem(None)
        self._pane.show_message("")
        self._comparing.show_old(False)

    @Slot(object)
    def _show_problem(self, error: Exception) -> None:
        """Say why what is typed does not run, at its place."""
        self.outcome.cancel()
        from core.lanes.problem import Problem

        place = (error.line, error.column) if isinstance(error, Problem) else None
        self._pane.editor.show_problem(place)
        self._pane.show_message(f"✕ {escape(str(error))}.{OLD_STEP}", is_problem=True)
        self._comparing.show_old(True)
        self.drafts_changed.emit()

    @Slot(int)
    def _run_to_line(self, line: int) -> None:
        """Go to the next step of B that is of a line."""
        listing = self._inspector.shown_listing
        if listing is not None:
            self._comparing.meeting.run_to_line(listing, line)
