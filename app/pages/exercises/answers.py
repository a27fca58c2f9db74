"""Questions on the Exercises page: how they are drawn, how answers are checked, and what can be undone."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from random import SystemRandom
from typing import Any

import numpy as np
from PySide6.QtCore import QObject, Slot

from app.background import Progress
from app.files.kept_work import Unfinished
from app.files.user_folders import attempt_file
from app.pages.step.grid_records import geometry_of
from app.session.document import STEPPED, Document, open_document
from app.session.history import History
from app.session.moment import Cursor, Step
from core import render
from core.framebuffer.display import to_display
from core.lanes.run import bounded
from core.records.cells import Marks, Place
from core.records.frame import Frame
from core.scene import AnyScene
from core.settings import DEFAULTS
from lessons.attempts.practice import telling_apart
from lessons.attempts.record import Attempt, attempt_of
from lessons.exercises.answers.answer import NotCheckedError, Response, Verdict
from lessons.exercises.answers.fields import NumberAnswer
from lessons.exercises.answers.listings import CannotRunError, CodeAnswer, Opened
from lessons.exercises.answers.marked import PixelAnswer, PlaceAnswer
from lessons.exercises.answers.spot import SpotAnswer
from lessons.exercises.answers.trials import BreakAnswer
from lessons.exercises.coding.shader_task import Beside
from lessons.exercises.drafting import frame_art
from lessons.exercises.numbers import read_number
from lessons.exercises.question import Draft, Judgement, Question, Template, ask, judge
from widgets.exercises.mark_grid import MarkGrid
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import CellMark, GridBuffer, MaskOverlay, Overlay

# The outline of a question's scene on the grid: where its corners lie, and nothing of what is drawn.


NAMES = "ABCD"
"""As questions call several triangles, in the order of the scene."""
NAMED = range(2, len(NAMES) + 1)
"""How many triangles have names."""
HIDDEN = ("transform",)
"""Stages whose questions ask where the corners lie."""


def document_of(draft: Draft, title: str) -> Document:
    """Return the document in which the question's scene is stepped, with the plainest fill where none is asked for."""
    assert draft.scene is not None
    settings = draft.settings
    if settings.fill == DEFAULTS.fill:
        settings = replace(settings, fill=STEPPED.fill)
    return open_document(draft.scene, title, settings=settings)


def outline_of(draft: Draft, stage: str) -> GridGeometry | None:
    """Return the outlines of the scene; ``None``: it shows fragments, has none, or they are what is asked for."""
    if draft.scene is None or stage in HIDDEN:
        return None
    outline = scene_outline(draft.outlined or draft.scene)
    if _is_fragments(outline):
        return None
    names = NAMES[: len(outline.triangles)]
    if len(outline.triangles) in NAMED and all(f"{name}: " in draft.given for name in names):
        # None stands out: the question is about all of them.
        return replace(outline, focus=-1, names=tuple(names))
    return outline


def _is_fragments(outline: GridGeometry) -> bool:
    """Return whether each of several triangles lies in one pixel: it stands for a fragment, its shape says nothing."""
    pixels, corners = np.floor(outline.vertices[outline.triangles]), outline.triangles
    # All corners of a point are one.
    return len(corners) > 1 and bool(
        (corners[:, 0] != corners[:, 1]).all() and (pixels == pixels[:, :1]).all()
    )


def scene_outline(scene: AnyScene) -> GridGeometry:
    """Return the outlines of a scene as they are before culling: what is dropped may be what is asked for."""
    outlines = geometry_of(Step(open_document(scene, "").make_trace(), Cursor("cull")))
    return replace(outlines, draggable=False, snapped=None)


# What is drawn of an answer: the raster it is given on, its picture while it is given, and its marks.


FARTHEST = 100.0
"""Farthest coordinate that a sketch of the plane shows."""


@dataclass(frozen=True, eq=False)
class Live:
    """What is drawn of an answer while it is given."""

    outline: GridGeometry | None
    picture: GridBuffer | None = None
    overlays: Sequence[Overlay] = ()


def size_of(draft: Draft) -> tuple[int, int] | None:
    """Return columns and rows of the picture, whose cells may be blocks; ``None``: the question has none."""
    answer = draft.answer
    if isinstance(answer, PixelAnswer | SpotAnswer | PlaceAnswer):
        return answer.size
    if isinstance(answer, CodeAnswer) and answer.picture is not None:
        rows, columns = answer.picture.primitive.shape
        return columns, rows
    if isinstance(answer, BreakAnswer):
        return answer.scene_of(answer.start).size
    return None if draft.scene is None else draft.scene.size


def shown_frame(draft: Draft) -> Frame | None:
    """Return the picture that the question gives as text; ``None``: it gives none."""
    answer = draft.answer
    if isinstance(answer, SpotAnswer | CodeAnswer):
        return answer.picture
    if not isinstance(answer, PlaceAnswer) or answer.scene_of is None or answer.is_right is None:
        return None
    frame = render(answer.scene_of(answer.reference), draft.settings)
    return frame if frame_art(frame) in draft.given else None


def numbers_of(draft: Draft) -> str:
    """Return the numbers of a question as text, but for the picture that the grid shows."""
    frame = shown_frame(draft)
    return draft.given if frame is None else draft.given.replace(frame_art(frame), "").strip("\n")


def place_of(draft: Draft, given: Any) -> Place | None:
    """Return the point of the plane that is in the form; ``None``: it is none, or not typed yet."""
    answer = draft.answer
    if not isinstance(answer, NumberAnswer) or answer.names != ("x", "y"):
        return None
    try:
        x, y = (float(read_number(text)) for (text,) in given)
    except ValueError:
        return None
    return (x, y) if max(abs(x), abs(y)) <= FARTHEST else None


def is_live(draft: Draft) -> bool:
    """Return whether an answer is drawn while it is given."""
    answer = draft.answer
    return isinstance(answer, BreakAnswer) or (
        isinstance(answer, PlaceAnswer) and answer.scene_of is not None
    )


def live(draft: Draft, response: Response | None) -> Live:
    """Return what is drawn of a response, or before there is one.

    Of points, the outlines over the picture that is to be covered; of dials, the picture of the weak method, marked
    where the other one draws another or it draws twice.
    """
    answer = draft.answer
    if isinstance(answer, PlaceAnswer):
        assert answer.scene_of is not None
        frame = shown_frame(draft)
        picture = None if frame is None else coverage_of(frame, "to be covered")
        return Live(None if response is None else scene_outline(answer.scene_of(response)), picture)
    assert isinstance(answer, BreakAnswer)
    scene = answer.scene_of(answer.start if response is None else response)
    weak, robust = render(scene, answer.weak), render(scene, answer.robust)
    differs = np.asarray(weak.primitive != robust.primitive)
    overlays = (
        MaskOverlay("differs", CellMark.DIFFERENCE, differs, title="the other method draws otherwise"),
        MaskOverlay("double", CellMark.DOUBLE, np.asarray(weak.cover_count > 1), title="drawn twice"),
    )
    return Live(scene_outline(scene), coverage_of(weak, "weak method"), overlays)


def marks_of(question: Question, verdict: Verdict) -> Marks:
    """Return the marks; where one primitive's pixels are asked, an extra one that another covers is double."""
    marks, draft, scene = verdict.marks, question.draft, question.draft.scene
    asks_coverage = isinstance(draft.answer, PixelAnswer) and question.template.stage == "raster"
    if not asks_coverage or not marks["extra"] or scene is None or scene.size != size_of(draft):
        return marks
    primitive = render(scene, draft.settings).primitive
    asked = {int(primitive[row, column]) for column, row in draft.answer.reference}
    if len(asked) != 1:
        return marks
    is_other = (primitive >= 0) & (primitive != asked.pop())
    double = {(column, row) for column, row in marks["extra"] if is_other[row, column]}
    return {**marks, "extra": frozenset(marks["extra"]) - double, "double": frozenset(double)}


def are_marks_shown(draft: Draft, *, is_right: bool, is_first: bool) -> bool:
    """Return whether marks are shown: those of a first answer in pixels would tell the whole solution."""
    return is_right or not (is_first and isinstance(draft.answer, PixelAnswer))


def coverage_of(frame: Frame, title: str) -> GridBuffer:
    """Return what a frame covers: its primitives where it has several, else where anything is."""
    primitive = frame.primitive
    if int(primitive.max(initial=-1)) > 0:
        return GridBuffer("picture", primitive, "ids", title=title)
    return GridBuffer("picture", primitive >= 0, "bool", title=title)


def picture_of(frame: Frame) -> GridBuffer:
    """Return the colours of a frame, or the pixels it covers where all have one colour."""
    colors = frame.color[frame.primitive >= 0]
    if len(colors) and (colors != colors[0]).any():
        return GridBuffer("picture", to_display(frame.color).pixels, "color", title="the picture")
    return coverage_of(frame, "the picture")


# What the Exercises page does off the GUI thread: draws a question, checks an answer, keeps the attempt.


SECONDS = 10.0
"""Longest that the runs of one check may take together."""
Work = Callable[[Progress, Callable[[], bool]], "Asked"]


@dataclass(frozen=True, eq=False)
class Asked:
    """A question that is drawn."""

    question: Question
    outline: GridGeometry | None
    is_afresh: bool = False
    """Whether it is asked anew where its answer was checked before."""


@dataclass(frozen=True, eq=False)
class Checked:
    """An answer that is checked."""

    given: object
    """What was in the form."""
    response: Response
    judgement: Judgement
    marks: Marks
    attempt: Attempt | None
    """The attempt to keep; ``None``: the model answer was shown before."""
    trouble: str
    """What to tell of keeping it, in sentences; empty: all is well."""
    opened: Opened | Beside | None = None
    """Of a wrong listing, the smallest input that shows it, for A | B; ``None``: there is none."""
    drawn: Frame | None = None
    """Of a wrong listing, its picture where one is wanted."""


VARIANTS = 10_000
"""Seeds that new variants are drawn from: short ones, to be read out."""


def new_seed() -> int:
    """Return the seed of a new variant."""
    return SystemRandom().randrange(VARIANTS)


def wanted_seed(template: Template, seed: int | None, kept: Mapping[str, Unfinished]) -> int:
    """Return the seed that is wanted, or that of the last question, or a new one."""
    if seed is not None:
        return seed
    last = kept.get(template.name)
    return last.seed if last is not None and last.version == template.version else new_seed()


def asking(template: Template, seed: int | None, kept: Mapping[str, Unfinished]) -> Callable[..., Asked]:
    """Return the work that draws a question of `wanted_seed`; it raises ValueError where none can be drawn."""
    chosen = wanted_seed(template, seed, kept)
    return lambda *_: drawn(ask(template, chosen), is_afresh=seed is not None)


def drawn(question: Question, *, is_afresh: bool = False) -> Asked:
    """Return a question with its outline."""
    return Asked(question, outline_of(question.draft, question.template.stage), is_afresh)


def asking_apart(template: Template, mistakes: Sequence[str], seeds: Sequence[int]) -> Work:
    """Return the work that draws the first variant that tells the mistakes of an answer apart, or else any."""

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Asked:
        return drawn(telling_apart(mistakes, ((template, seed) for seed in seeds)) or ask(template, seeds[0]))

    return work


def drawing(question: Question, given: object) -> Callable[[Progress, Callable[[], bool]], Live] | None:
    """Return the work that draws an answer while it is given; ``None``: nothing is drawn of this type."""
    draft = question.draft

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Live:
        try:
            response = draft.answer.read(given)
        except NotCheckedError:
            response = None
        return live(draft, response)

    return work if is_live(draft) else None


@dataclass(frozen=True, eq=False)
class Tried:
    """A listing that is being typed, and why it cannot run."""

    given: object
    problem: CannotRunError | None


def trying(draft: Draft, given: object) -> Callable[[Progress, Callable[[], bool]], Tried] | None:
    """Return the work that finds why a listing cannot run while it is typed; ``None``: the answer is no listing."""
    answer = draft.answer

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Tried:
        assert isinstance(answer, CodeAnswer)
        with bounded(SECONDS, is_cancelled):
            return Tried(given, answer.problem(str(given)))

    return work if isinstance(answer, CodeAnswer) else None


def checking(
    question: Question, given: object, response: Response, user: str, seconds: float, *, is_kept: bool
) -> Callable[[Progress, Callable[[], bool]], Checked]:
    """Return the work that checks an answer that was read, and keeps the attempt before anybody sees the verdict."""

    def work(progress: Progress, is_cancelled: Callable[[], bool]) -> Checked:
        with bounded(SECONDS, is_cancelled):  # A listing may not end by itself.
            judgement = judge(question, response)
            opened, drawn = _seen(question, response, judgement)
        marks = marks_of(question, judgement.verdict)
        if not is_kept:
            return Checked(given, response, judgement, marks, None, "", opened, drawn)
        attempt = attempt_of(user, question, response, judgement, seconds, datetime.now(UTC))
        try:
            trouble = attempt_file().add(attempt)
        except OSError as problem:
            trouble = f"The attempt is not saved: {problem}."
        return Checked(given, response, judgement, marks, attempt, trouble, opened, drawn)

    return work


def _seen(
    question: Question, response: Response, judgement: Judgement
) -> tuple[Opened | Beside | None, Frame | None]:
    """Return what can be shown of a wrong listing: the smallest input in A | B, and its picture."""
    answer = question.draft.answer
    if not isinstance(answer, CodeAnswer) or judgement.verdict.score == 1:
        return None, None
    try:
        drawn = None if answer.picture is None else answer.drawn(response)
        return answer.opened(response), drawn
    except ValueError:  # On a whole picture its run does not end: what is wrong with it is said all the same.
        return None, None


# What was in the form of an answer, for undo: what one stroke or one key changed on the picture goes
# together.


class AnswerHistory(QObject):
    """Values of a form in the order in which they were given."""

    def __init__(self, grid: MarkGrid, parent: QObject | None = None) -> None:
        """Listen to the picture before any form does."""
        super().__init__(parent)
        self._grid = grid
        self._values: History[object] = History(None)
        self._gesture = ""
        """Of the change on the picture that the form takes now."""
        for changed in (grid.pixels_painted, grid.point_moved, grid.point_nudged):
            changed.connect(self._begin_gesture)

    @Slot()
    def _begin_gesture(self) -> None:
        self._gesture = f"{self._grid.gesture}"

    def begin(self, given: object) -> None:
        """Forget everything: another question is asked."""
        self._values = History(given)

    def put(self, given: object) -> None:
        """Take over a change."""
        self._values.put(given, self._gesture)
        self._gesture = ""

    def can_go(self, direction: int) -> bool:
        """Return whether there is a value before (-1) or after (1) the present one."""
        return self._values.can_undo if direction < 0 else self._values.can_redo

    def go(self, direction: int) -> object:
        """Return the value before (-1) or after (1), which is the present one now."""
        return self._values.undo() if direction < 0 else self._values.redo()
