"""The inspector: what the step just done did, in words, formula, listing and variables; and the pixel's history."""

from collections.abc import Callable, Iterable

from PySide6.QtCore import QObject, Signal, Slot

from app.pages.step.inspector_column import InspectorColumn
from app.pages.step.number_origins import variable_of, writer_of
from app.pages.step.pixel_stories import story_of
from app.pages.step.stepping_presenter import SteppingPresenter
from app.pages.step.steps_ahead import StepsAhead, sentence_at
from app.session.moment import Moment, Step
from app.session.session import Session
from core import STAGES
from core.explain import formula, stage_card, variables
from core.explain.records import Variable
from core.records.listing import Listing
from core.stages.declared import stage_of
from core.trace import Explanation
from core.trace.origins import Origin, origin
from widgets.inspector.formula_layout import FormulaNumber
from widgets.inspector.history_view import HINT as NO_HISTORY
from widgets.inspector.listing import HINT, ListingText

HIDDEN_HISTORY = "The pixel's history is hidden until the answer is shown."
NO_FORMULA, NO_LISTING = "This step has no formula.", "This step has no listing."


class InspectorPresenter(QObject):
    """Shows the step of the session's cursor, or that of B, and the history of its pinned (or hovered) pixel."""

    line_beside_clicked = Signal(int)
    """The user wants the next step of a line (from 1) of the listing that B runs."""

    def __init__(
        self,
        session: Session,
        stepping: SteppingPresenter,
        column: InspectorColumn,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._stepping, self._column = session, stepping, column
        self._sentence, self._card, self._formula = column.sentence, column.card, column.formula
        self._listing, self._variables, self._history = column.listing, column.variables, column.history
        self._shown: Listing | None = None
        self._stage = ""
        self.beside: Callable[[], Step | None] | None = None
        """Returns the step that is shown instead of that of the session: where B of A | B is."""
        self.listing_shown: Callable[[Listing | None], object] = lambda _: None
        """Is told which listing is shown now, or that it is one of another stage or run."""
        self.hint_beside = ""
        """What is said where there is no such step."""
        self._triangles: list[int | None] = []
        self._told: tuple[object, ...] = ()
        """What the history shows: it is made anew only if this changes."""
        self._folded = set(STAGES)
        self.ahead = StepsAhead(session.moment, column.formula, self)
        column.variables.origin_requested.connect(self._go_to_variable)
        column.formula.number_pointed.connect(self._tell_origin)
        column.formula.number_clicked.connect(self._go_to_number)
        column.listing.line_clicked.connect(self._run_to_line)
        column.listing.breakpoint_toggled.connect(self._toggle_breakpoint)
        column.history.row_activated.connect(self._go_to_event)
        column.history.history_shown.connect(self._show_history)
        column.card.card_folded.connect(self._fold)
        self.refresh_run(session.moment)

    def refresh_run(self, moment: Moment) -> None:
        """Show another trace."""
        self._stage = ""
        self.refresh_step(moment)
        self.refresh_history(moment)

    def step_of(self, moment: Moment) -> Step | None:
        """Return the step that is shown; ``None``: B has none."""
        return moment if self.beside is None or moment.is_predicting else self.beside()

    @property
    def shown_listing(self) -> Listing | None:
        """The listing that is shown."""
        return self._shown

    def refresh_step(self, moment: Moment) -> None:
        """Show the step just done."""
        step = self.step_of(moment)
        if step is None:
            self._sentence.setText(self.hint_beside)
            self._column.show_formula(None, False)
            self._variables.show_variables([])
            self._listing.show_line(None)
            return
        trace, cursor = step.stage_trace, step.cursor
        is_new_stage = cursor.stage != self._stage
        if is_new_stage:
            self._stage = cursor.stage
            self._card.show_card(stage_card(cursor.stage, trace.method, trace.corner_count))
            self._card.show_folded(cursor.stage in self._folded)
            self._listing.keep_room_for(listing.source for listing in trace.listings.values())
        self._sentence.setText(sentence_at(step))
        explanation = step.explanation
        if explanation is None:
            self._formula.show_hint("The formula of each step appears here.")
            self._column.show_formula(None, is_new_stage)
            self._variables.show_variables([])
            first = None if moment.is_predicting else trace.explain(1)
            self._listing.show_hint(HINT if first is None else NO_LISTING)
            self._show_listing(first.listing if first else None, is_new_stage)
            self._show_line(None)
            self._listing.show_shares({})
            return
        self._formula.show_hint(NO_FORMULA)
        self._column.show_formula(formula(explanation), is_new_stage)
        self._variables.show_variables(variables(explanation))
        self._listing.show_hint(NO_LISTING)
        self._show_listing(explanation.listing, is_new_stage)
        self._show_line(explanation.line or None)
        self._listing.show_shares(trace.line_shares(step.row))

    def _show_line(self, line: int | None) -> None:
        """Mark the line that has run, also where that listing is being edited."""
        self._listing.show_line(line)
        self._column.code.editor.show_step(line, self._shown.source if self._shown else "")

    def _show_listing(self, listing: Listing | None, is_new_stage: bool) -> None:
        is_new = listing is not self._shown
        if is_new:
            self._shown = listing
            shown = ListingText(listing.name, listing.source, listing.purpose) if listing else None
            self._listing.show_listing(shown)
            self._show_breakpoints()
        if is_new or is_new_stage:
            self.listing_shown(listing)

    def _show_breakpoints(self) -> None:
        """Mark the lines with breakpoints: they stand in the listings of A."""
        self._listing.show_breakpoints(
            {line for name, line in self._stepping.breaks.lines if name == self._function}
        )

    @property
    def _function(self) -> str:
        return "" if self._shown is None or self.beside is not None else self._shown.name

    @Slot()
    def _show_history(self) -> None:
        self.refresh_history(self._session.moment)

    def refresh_history(self, moment: Moment) -> None:
        """Show the history of the pinned pixel, or of the one under the pointer, if the pane is in sight."""
        if not self._history.isVisible():
            return
        pixel = moment.pin or moment.hover
        if pixel is not None and (moment.is_predicting or not moment.has_pixel(pixel)):
            pixel = None
        step = self.step_of(moment) or moment
        told = (pixel, step.trace if pixel else None, moment.is_predicting)
        if told == self._told:
            return
        self._told = told
        if pixel is None:
            self._history.show_story(None, HIDDEN_HISTORY if moment.is_predicting else NO_HISTORY)
            self._triangles = []
            return
        story, self._triangles = story_of(step.trace.source, *pixel, moment.document.triangle)
        self._history.show_story(story)

    def folded(self) -> list[str]:
        """Return the stages whose card is folded."""
        return sorted(self._folded, key=STAGES.index)

    def set_folded(self, stages: Iterable[str]) -> None:
        """Fold the cards of these stages, and open the others."""
        self._folded = set(stages) & set(STAGES)
        self._card.show_folded(self._session.cursor.stage in self._folded)

    @Slot(bool)
    def _fold(self, is_folded: bool) -> None:
        (self._folded.add if is_folded else self._folded.discard)(self._session.cursor.stage)

    @Slot(int)
    def _go_to_event(self, index: int) -> None:
        """Go to the depth test of a fragment of the history, or to the test that rejected the pixel."""
        pixel = self._session.pin or self._session.hover
        triangle = self._triangles[index] if index < len(self._triangles) else None
        if pixel is None or triangle is None:
            return
        for stage in ("depth", "raster"):
            trace = self._session.trace.stage(stage)
            rows = trace.rows_at_pixel(*pixel)
            rows = rows[trace.triangle[rows] == triangle]
            if len(rows):
                self._session.set_stage(stage, trace.steps.position_after(int(rows[0])))
                return

    @Slot(object)
    def _go_to_variable(self, variable: Variable) -> None:
        """Go to the step that made a variable's number."""
        self._go_to_origin(variable.column, variable.element, variable.name, variable.is_changed())

    @Slot(object)
    def _go_to_number(self, shown: FormulaNumber) -> None:
        """Go to the step that made a number of the formula."""
        explanation = self._explanation()
        found = None if explanation is None else variable_of(explanation, shown)
        if explanation is None or found is None:
            self._stepping.tell(f"{shown.text} is worked out here, or is a constant of the formula.")
            return
        column, element = found
        self._go_to_origin(column, element, shown.name, column in explanation.changed)

    @Slot(object)
    def _tell_origin(self, shown: FormulaNumber) -> None:
        """Say where a number of the formula comes from, before it is clicked."""
        explanation = self._explanation()
        found = None if explanation is None else variable_of(explanation, shown)
        made = None if found is None else self._origin(*found)
        if made is not None:
            is_here = made.stage == self._session.cursor.stage
            where = "an earlier step of this stage" if is_here else stage_of(made.stage).short_title
            self._formula.show_where(
                f"{shown.name} was made in {where}. Click to go there; Ctrl+[ comes back."
            )

    def _explanation(self) -> Explanation | None:
        """Return what the step that is shown did."""
        step = self.step_of(self._session.moment)
        return None if step is None else step.explanation

    def _origin(self, column: str, element: int | None) -> Origin | None:
        if self.beside is not None:
            return None
        cursor = self._session.cursor
        return origin(self._session.trace, cursor.stage, cursor.position, column, element)

    def _go_to_origin(self, column: str, element: int | None, name: str, is_new: bool) -> None:
        """Go to the step that made a number, or say why there is none."""
        made = self._origin(column, element)
        if made is not None:
            self._session.set_stage(made.stage, made.position)
            what = f"Set up like {name}, but from snapped corners" if made.is_alike else f"Made here: {name}"
            self._stepping.tell(f"{what}. Ctrl+[ goes back.")
        elif is_new:
            self._stepping.tell(f"Made in this step: {name}.")
        elif self.beside is not None:
            self._stepping.tell(f"{name} was made by an earlier line: step back.")
        else:
            self._stepping.tell(f"No step shows how {name} was made: it comes in from outside.")

    def go_to_writer(self, buffer: str, label: str) -> None:
        """Go to the step that wrote what the main grid holds at the pinned pixel."""
        session = self._session
        if session.pin is None:
            self._stepping.tell("Pin a pixel first: click it.")
            return
        made = writer_of(session.moment, buffer, session.pin)
        at = f"pixel ({session.pin[0]}, {session.pin[1]})"
        if made is None:
            self._stepping.tell(f"No step of this stage has written {label} at {at} yet.")
        elif made.position == session.cursor.position:
            self._stepping.tell(f"{label[:1].upper()}{label[1:]} at {at} was written in this step.")
        else:
            session.set_stage(made.stage, made.position)
            self._stepping.tell(f"{label[:1].upper()}{label[1:]} at {at} was written here. Ctrl+[ goes back.")

    @Slot(int)
    def _run_to_line(self, line: int) -> None:
        if self.beside is None:
            self._stepping.run_to_line(self._function, line)
        else:
            self.line_beside_clicked.emit(line)

    @Slot(int)
    def _toggle_breakpoint(self, line: int) -> None:
        if self.beside is not None:
            self._stepping.tell("Breakpoints stand in the listing of A.")
            return
        self._stepping.toggle_line_breakpoint(self._function, line)
        self._show_breakpoints()
