"""The inspector: what the step just done did, and what the next ones will say, made before they are shown."""

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache, partial
from importlib import import_module
from threading import Thread

from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.background import Job
from app.pages.step.inspector_column import InspectorColumn
from app.pages.step.pixel_origins import variable_of, writer_of
from app.pages.step.stepping_presenter import SteppingPresenter
from app.session.moment import Moment, Step, stage_for
from app.session.session import Session
from app.session.tracing import QUICK_SECONDS
from core import STAGES, Trace
from core.explain.records import Formula, Variable
from core.explain.stage_texts import initial_sentence, stage_card, summary_sentence
from core.explain.steps import formula, load_subjects, remarks, row_sentence, sentence, variables
from core.records.listing import Listing
from core.records.steps import Level
from core.shaders.told import statements_summary
from core.stages.declared import stage_of
from core.trace.origins import Origin, origin
from core.trace.stage_trace import Explanation
from core.trace.tracers import load_tracers
from widgets.inspector.formula_layout import FormulaNumber
from widgets.inspector.formula_view import FormulaView
from widgets.inspector.listing import HINT, ListingText
from widgets.inspector.pixel_history import HINT as NO_HISTORY

# What the next steps say, and the next stage, made before they are shown, while the user looks at this one.


QUIET_MS = 20
"""Time after a step is painted, in milliseconds, from which the user is taken to look at it."""
FIRST_MS = 300
"""The same for a window that opens: first it is painted."""
STEPS_AHEAD = 3


def sentence_at(step: Step) -> str:
    """Return what is said of the step just done: of a row, what decided comes first; a larger one is summed up."""
    trace, row, level = step.stage_trace, step.row, step.cursor.level
    if row < 0:
        has_steps = trace.steps.row_count > 0
        return initial_sentence(trace.stage, trace.corner_count, has_steps=has_steps)
    first = trace.steps.rows_done(trace.steps.back(step.cursor.position, level))
    if level <= Level.GROUP and row > first and "statement" in trace.steps.kinds:
        return statements_summary(trace, first, row, level)
    if level <= Level.GROUP and row > first:
        counts = trace.summary(first, row + 1)
        of_trace = trace.corner_count, trace.method, trace.order, tuple(trace.pixel[row].tolist())
        said = summary_sentence(trace.stage, level, counts, step.triangle, *of_trace)
        return " ".join([said, *remarks(trace, first, row + 1)])
    if level != Level.OPERATION:
        return row_sentence(trace, step.cursor.position)
    explanation = step.explanation
    assert explanation is not None
    return sentence(explanation, step.triangle, step.pixel)


@cache
def load_stages() -> Thread:
    """Begin to load what stages are traced and explained with, off the GUI thread; later calls only return it."""
    loading = Thread(target=_load, name="stages", daemon=True)
    loading.start()
    return loading


def _load() -> None:
    load_tracers()
    load_subjects()
    import_module("app.session.listing_runs")  # It says whether a listing can be edited.
    import_module("app.pages.step.pixel_story")  # It is wanted for the first pixel that is clicked.


class StepsAhead(QObject):
    """Explains the steps around the cursor and typesets their formulas, a cell when nothing else is due."""

    def __init__(self, moment: Moment, view: FormulaView, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._moment, self._view = moment, view
        self._positions = [1]
        """What is still to be prepared, the nearest first: when the window opens, the first step."""
        self._elsewhere: Step | None = None
        """The step of another run that may be shown next; it comes after those."""
        self._also: Callable[[], object] | None = None
        """What is prepared beside it, after all."""
        self._formula: Formula | None = None
        self._tracing = Job(self)
        """Traces the stage that comes next."""
        self._traced: tuple[Trace, str] | None = None
        """The run and the stage that it was given last."""
        self.is_drawing: Callable[[], bool] = lambda: False
        """Returns whether a picture of the step, or another step of a lesson, is still being made in the background."""
        self._is_resting = True
        """Whether the step is painted with its pictures and its whole formula, a pause ago."""
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._prepare)
        self._timer.start(FIRST_MS)

    @property
    def is_working(self) -> bool:
        """Whether something is left to be prepared."""
        return self._timer.isActive() or self._tracing.is_running

    def stop(self) -> None:
        """Prepare nothing more, and wait for the thread."""
        self._timer.stop()
        self._tracing.shut_down()

    def begin(self, moment: Moment) -> None:
        """Look ahead from where the cursor is now, as soon as the user pauses."""
        self._moment, steps, cursor = moment, moment.steps, moment.cursor
        ahead = [cursor.position]
        for _ in range(STEPS_AHEAD):
            ahead.append(steps.forward(ahead[-1], cursor.level))
        self._positions = list(dict.fromkeys([*ahead[1:], steps.back(cursor.position, cursor.level)]))
        self._formula = None
        self._is_resting = False
        self._timer.start(0)  # It waits for what there is to paint, however long that takes.

    def look_at(self, step: Step, also: Callable[[], object]) -> None:
        """Prepare a step of another run, too, which may be shown next, and ``also`` what else it shows."""
        self._elsewhere, self._also = step, also
        if not self._timer.isActive():
            self._timer.start(QUIET_MS)

    @Slot()
    def _prepare(self) -> None:
        """Explain one step, or typeset one cell of its formula."""
        is_shown = self._view.is_complete() and not self.is_drawing()
        if load_stages().is_alive() or not self._is_resting or not is_shown:
            self._is_resting = is_shown
            self._timer.start(QUIET_MS)
            return
        self._trace_next()
        if self._formula is None:
            moment, step = self._moment, self._elsewhere
            if self._positions:
                step = Step(moment.trace, replace(moment.cursor, position=self._positions.pop(0)))
            else:
                self._elsewhere = None
            if step is None:
                also, self._also = self._also, None
                if also is not None:
                    also()
                return
            sentence_at(step)
            explanation = step.explanation
            if explanation is not None:
                variables(explanation)
                self._formula = formula(explanation)
        elif self._view.prepare(self._formula):
            self._formula = None
        self._timer.start(0 if self._view.can_prepare() else QUIET_MS)

    def _trace_next(self) -> None:
        """Have the stage after the one that is shown traced in the background, unless that takes long."""
        trace, here = self._moment.trace, STAGES.index(self._moment.cursor.stage)
        next_stage = (trace, stage_for(trace.source.scene, STAGES[min(here + 1, len(STAGES) - 1)]))
        if next_stage != self._traced and self._moment.document.estimated_seconds <= QUICK_SECONDS:
            self._traced = next_stage
            self._tracing.call(partial(trace.stage, next_stage[1]))


# The inspector: what the step just done did, in words, formula, listing and variables; and the pixel's
# history.


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
        from app.pages.step.pixel_story import story_of  # As in `_load`: not before a pixel is clicked.

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
