"""Predict, then reveal: asks about the next step, or about coverage as a whole, and says at once what is right."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isclose, isfinite

import numpy as np
from PySide6.QtCore import QObject, Slot

from app.pages.step.grid_records import grid_buffer
from app.session.session import Session
from core.explain.records import AnswerKind, Question, Verdict
from core.records.steps import Level
from core.trace import StageTrace
from core.trace.stage_trace import Value
from widgets.grid.buffer import number_text
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.prediction import PredictionView

TOLERANCE = 0.01
"""Relative error of a typed number that still counts as right."""


@dataclass(frozen=True)
class Asked:
    """A question with its answer."""

    question: Question
    answer: float
    """The number, or the place of the right choice."""
    reveal: str
    """The value in words."""


class PredictionPresenter(QObject):
    """Runs the questions while it is active."""

    def __init__(
        self, session: Session, view: PredictionView, grid: PixelGrid, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._view, self._grid = session, view, grid
        self._asked: Asked | None = None
        self._is_active = False
        self._right = self._count = 0
        self._found: set[tuple[int, int]] = set()
        view.answer_given.connect(self._answer)
        view.reveal_requested.connect(self._reveal)
        view.next_requested.connect(self._next)
        grid.pixel_clicked.connect(self._click)
        session.cursor_changed.connect(self._cursor_moved)
        session.document_changed.connect(self._cursor_moved)

    @property
    def is_active(self) -> bool:
        """Whether results are hidden."""
        return self._is_active

    def set_active(self, is_active: bool) -> None:
        """Start asking, or stop and show everything."""
        self._is_active = is_active
        self._right = self._count = 0
        self._found.clear()
        self._view.show_count(0, 0)
        self._session.set_predicting(is_active)
        if is_active:
            self._ask()
        else:
            self._asked = None
            self._grid.set_brush(False)
            self._view.show_question(None)

    def _ask(self) -> None:
        """Ask about the next row of the stage, or about coverage as a whole before the first one."""
        trace, cursor = self._session.stage_trace, self._session.cursor
        if trace.stage == "raster" and cursor.position == 0:
            self._asked = None
            self._found.clear()
            text = "Click the pixels that are covered, each is judged at once; or step on to be asked one by one."
            self._view.show_question(Question(text, AnswerKind.GRID))
            self._grid.set_brush(True)
            self._hide_coverage()
            return
        self._grid.set_brush(False)
        row = trace.steps.rows_done(cursor.position)
        self._asked = question_about(trace, row) if row < trace.steps.row_count else None
        if self._asked is None:
            at_end = row >= trace.steps.row_count
            what = "This stage is done." if at_end else "There is nothing to predict in the next step."
            self._view.show_question(
                None, f"{what} The results stay hidden until prediction is turned off (P)."
            )
            return
        self._view.show_question(self._asked.question)

    def _hide_coverage(self) -> None:
        """Show the coverage as it will be, with every pixel covered up that has not been clicked."""
        session = self._session
        trace = session.stage_trace
        track = next(track for track in trace.buffers if track.name == "coverage")
        buffer = grid_buffer(track, trace.steps.row_count, session.trace.source.raster.bounds[:2])
        hidden = np.ones((buffer.rows, buffer.columns), bool)
        for column, row in self._found:
            hidden[row, column] = False
        self._grid.show_buffer(buffer)
        self._grid.show_hidden(hidden)

    @Slot(object)
    def _answer(self, answer: float) -> None:
        asked = self._asked
        if asked is None:
            return
        if asked.question.kind is AnswerKind.CHOICE:
            is_right = int(answer) == int(asked.answer)
        else:
            is_right = isclose(answer, asked.answer, rel_tol=TOLERANCE, abs_tol=1e-9)
        self._judge(is_right, asked.reveal)

    @Slot()
    def _reveal(self) -> None:
        if self._asked is not None:
            self._view.show_verdict(Verdict(None, self._asked.reveal))
        elif self._is_active:
            covered = self._covered()
            found = len(covered & self._found)
            wrong = len(self._found - covered)
            text = f"{found} of {len(covered)} covered pixels were found, {wrong} clicks were wrong."
            self._session.go_to(self._session.stage_trace.steps.count)
            self._view.show_verdict(Verdict(None, text))

    def _covered(self) -> set[tuple[int, int]]:
        """Return the pixels of the grid that are covered in the end."""
        trace = self._session.stage_trace
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        pixels = trace.pixel[trace.marks["covered"]] - (first_column, first_row)
        return {(column, row) for column, row in pixels.tolist()}

    @Slot()
    def _next(self) -> None:
        self._session.step(1, Level.PIXEL)

    @Slot(int, int)
    def _click(self, column: int, row: int) -> None:
        """Judge a pixel that is said to be covered."""
        cursor = self._session.cursor
        is_asked = (
            self._is_active and self._asked is None and cursor.stage == "raster" and cursor.position == 0
        )
        if not is_asked or (column, row) in self._found:
            return
        self._found.add((column, row))
        self._hide_coverage()
        is_covered = (column, row) in self._covered()
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        at = f"({column + first_column}, {row + first_row})"
        self._judge(is_covered, f"{at} is covered." if is_covered else f"{at} is not covered.")

    def _judge(self, is_right: bool, text: str) -> None:
        self._count += 1
        self._right += is_right
        self._view.show_verdict(Verdict(is_right, text))
        self._view.show_count(self._right, self._count)

    @Slot()
    def _cursor_moved(self) -> None:
        if self._is_active:
            self._ask()


def question_about(trace: StageTrace, row: int) -> Asked | None:
    """Return a question about a row of a trace, with its answer; ``None`` where there is nothing to predict."""
    values = trace.variables(row)
    kind = trace.kind_of(row)
    column, line = (int(n) for n in trace.pixel[row])
    pixel = f"pixel ({column}, {line})"
    triangle = int(trace.triangle[row])

    def choice(text: str, options: tuple[str, ...], answer: int, reveal: str) -> Asked:
        return Asked(Question(text, AnswerKind.CHOICE, options), answer, reveal)

    def number(text: str, answer: float, reveal: str) -> Asked | None:
        if not isfinite(answer):
            return None
        return Asked(Question(text, AnswerKind.NUMBER, tolerance="within 1 %"), answer, reveal)

    yes_no = ("Yes", "No")
    if trace.stage == "raster" and kind == "test":
        covered = bool(values["covered"])
        numbers = ", ".join(number_text(_number(values[f"value_{k}"])) for k in range(3))
        reveal = f"{pixel} is {'inside' if covered else 'outside'}; the edge functions are {numbers}."
        return choice(f"Does triangle {triangle} cover {pixel}?", yes_no, 0 if covered else 1, reveal)
    if trace.stage == "depth" and kind in ("test", "rounded"):
        passes = bool(values["passes"])
        new, old = number_text(_number(values["stored"])), number_text(_number(values["before"]))
        reveal = f"{new} against {old}: it {'passes' if passes else 'fails'}."
        return choice(
            f"The buffer holds {old} at {pixel}. Does {new} pass?", yes_no, 0 if passes else 1, reveal
        )
    if trace.stage == "depth" and kind in ("ray", "ray-exact"):
        passes, nearest = bool(values["passes"]), int(_number(values["nearest"]))
        how = "nearer" if passes else "not nearer"
        reveal = f"compared exactly, triangle {triangle} is {how} than triangle {nearest}."
        text = f"The ray of {pixel} has met triangle {nearest}. Is triangle {triangle} nearer?"
        return choice(text, yes_no, 0 if passes else 1, reveal)
    if trace.stage == "interpolate":
        weights = np.asarray(values["weights"])
        reveal = "the weights are " + ", ".join(number_text(float(w)) for w in weights) + "."
        return number(f"What is the weight of vertex 0 at {pixel}?", float(weights[0]), reveal)
    if trace.stage == "bin" and kind == "block":
        options = ("Outside", "Inside", "Neither")
        verdict = str(values["verdict"])
        answer = {"outside": 0, "inside": 1}.get(verdict, 2)
        size = _whole(values["size"])
        where = f"the {size} × {size} block at ({values['column']}, {values['row']})"
        reveal = f"{where} is {verdict}." if answer < 2 else f"an edge crosses {where}."
        return choice(f"Where does {where} lie against triangle {triangle}?", options, answer, reveal)
    if trace.stage == "clip" and kind in ("in-in", "in-out", "out-in", "out-out"):
        count = {"in-in": 1, "in-out": 1, "out-in": 2, "out-out": 0}[kind]
        text = f"How many corners does this edge hand on at the {values['plane']} plane?"
        return choice(text, ("0", "1", "2"), count, f"the edge is {kind.replace('-', ' to ')}: {count}.")
    if trace.stage == "edges" and kind == "edge":
        k = _whole(values["edge"])
        return number(
            f"What is a{k}, the change of edge {k} per column?", _number(values["a"]), _edge_text(values, k)
        )
    if trace.stage == "transform":
        after = np.asarray(values["after"])
        vertex = _whole(values["corner"])
        text = f"What is x of vertex {vertex} after the step “{kind.replace('-', ' ')}”?"
        numbers = ", ".join(number_text(float(n)) for n in after)
        return number(text, float(after[0]), f"({numbers}).")
    if trace.stage == "blend":
        after = np.asarray(values["after"])
        return number(
            f"What is red at {pixel} afterwards?", float(after[0]), f"red is {number_text(float(after[0]))}."
        )
    if trace.stage == "resolve":
        stored = np.asarray(values["bytes"])
        return number(
            f"Which byte does red become at {pixel}?", float(stored[0]), f"red is {int(stored[0])}."
        )
    return None


def _edge_text(values: Mapping[str, Value], k: int) -> str:
    numbers = ", ".join(number_text(_number(values[name])) for name in ("a", "b", "c"))
    return f"a, b, c of edge {k} are {numbers}."


def _number(value: Value) -> float:
    """Return a scalar variable as a float."""
    return float(np.asarray(value, float))


def _whole(value: Value) -> int:
    """Return a scalar variable as an integer."""
    return int(np.asarray(value, np.int64))
