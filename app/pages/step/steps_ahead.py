"""What the next steps say, and the next stage, made before they are shown, while the user looks at this one."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache, partial
from importlib import import_module
from threading import Thread

from PySide6.QtCore import QObject, QTimer, Slot

from app.background.workers import Job
from app.session.cursor import stage_for
from app.session.moment import Moment, Step
from app.session.tracing import QUICK_SECONDS
from core import STAGES, Trace
from core.explain import (
    formula,
    initial_sentence,
    remarks,
    row_sentence,
    sentence,
    summary_sentence,
    variables,
)
from core.explain.steps import load_subjects
from core.explain.subjects.shaders import statements_summary
from core.records.steps import Level
from core.trace.tracers import load_tracers
from widgets.inspector.formula_view import Formula, FormulaView

QUIET_MS = 20
"""Time after a step is painted, in milliseconds, from which the user is taken to look at it."""
FIRST_MS = 300
"""The same for a window that opens: first it is painted."""
STEPS_AHEAD = 3


def sentence_at(step: Step) -> str:
    """Return what is said of the step just done: of a row, what decided comes first; a larger one is summed up."""
    trace, row, level = step.stage_trace, step.row, step.cursor.level
    if row < 0:
        return initial_sentence(trace.stage, trace.corner_count)
    first = trace.steps.rows_done(trace.steps.back(step.cursor.position, level))
    if level <= Level.GROUP and row > first and "statement" in trace.steps.kinds:
        return statements_summary(trace, first, row, level)
    if level <= Level.GROUP and row > first:
        counts = trace.summary(first, row + 1)
        said = summary_sentence(trace.stage, level, counts, step.triangle, trace.corner_count, trace.method)
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
    import_module("numpy.ma")  # np.unique asks for it when it is first called.
    import_module("app.session.edited_run")  # It says whether a listing can be edited.


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
