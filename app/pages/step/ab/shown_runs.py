"""Both runs of A | B in the view, where they are, and their difference."""

from dataclasses import replace
from functools import lru_cache, partial

from app.pages.step.ab.lock_step import LockStep
from app.pages.step.ab.pictures import differing_buffer, nothing, pictured, seen_of
from app.pages.step.ab.side_b import SideB
from app.pages.step.grid_records import geometry_of
from app.session.moment import Cursor, Moment, Step
from core import Trace
from widgets.grid.compare_view import CompareView, Side
from widgets.grid.geometry import GridGeometry

PREDICTING = "Hidden until the answer is shown."
SHOWN_ONLY = (
    "B is shown for comparison only, as a listing in print or with a mistake: A keeps its own method."
)
EDITED = "B runs your edited listing, and A keeps the method itself, so that both can be compared."

OLD = "B is the last version that ran."

CLIPS = ", clips the near plane"
"""What a run does that needs w > 0, after its name."""


class ShownRuns:
    """Shows both runs, and the buffer in which they are compared."""

    def __init__(self, view: CompareView) -> None:
        self._view = view
        self.buffers: dict[str, str] = {}
        """Name of the buffer in which both are compared, by stage, where it was chosen."""
        self._fitting = ""
        """Name of the buffer that shows what an edit or a mistake does, where none was chosen; empty: the first one."""
        self.is_old = False
        """Whether B is the last run that went well, of a text that is another one by now."""
        outlines = lru_cache(maxsize=4)(_outlines)
        self.look = lru_cache(maxsize=4)(partial(seen_of, outlines))
        """Returns what is seen of a run where it is: kept for both, and for those that may be shown next."""

    def fit(self, moment: Moment, second: Trace, b: SideB) -> None:
        """Find the buffer that shows what an edit or a mistake does."""
        has_fault = bool(b.edits) or (bool(b.title) and not b.printed)
        beside = Step(second, replace(moment.cursor, position=0))
        self._fitting = differing_buffer(moment, beside) if has_fault else ""

    def show(
        self, moment: Moment, second: Step | None, steps: LockStep | None, b: SideB, refusal: str
    ) -> None:
        """Show A and B, which has no step for the reason of its ``refusal``; ``steps``: where both are."""
        if moment.is_predicting:
            blanks = (Side(name, name, reason=PREDICTING) for name in "AB")
            self._view.show_sides(*blanks, nothing(PREDICTING))
            return
        texts = ("", "") if steps is None else (steps.text(0), steps.text(1))
        sides = [
            Side(name, f"{name}: {title}", text, reason=refusal)
            for name, title, text in zip("AB", titles(moment, second, b), texts, strict=True)
        ]
        self._view.show_refusal((EDITED if b.edits else SHOWN_ONLY) if b.title else "")
        shown_steps: list[Step] = [moment] if second is None else [moment, second]
        wanted = self.buffers.get(moment.cursor.stage, "") or self._fitting
        buffers, shown, pictures = pictured(sides, shown_steps, self.look, wanted, bool(b.printed))
        self._view.buffer_box.show_buffers(buffers, shown)
        if self.is_old:
            pictures = pictures[0], replace(pictures[1], is_old=True), nothing(OLD)
        self._view.show_sides(*pictures)
        self.show_pointing(moment)

    def show_pointing(self, moment: Moment) -> None:
        """Mark pin and hover."""
        self._view.linked.show_pointing(*moment.pointed_places)


def titles(moment: Moment, second: Step | None, b: SideB) -> tuple[str, str]:
    """Return A and B in words, with the clipping that only one of them needs."""
    mine, other = b.titles(moment.document)
    if second is None:
        return mine, other
    needs = [bool(run.source.geometry.clipping_inserted) for run in (moment.trace, second.trace)]
    clips = [CLIPS if need and needs[0] != needs[1] else "" for need in needs]
    return mine + clips[0], other + clips[1]


def _outlines(trace: Trace, cursor: Cursor) -> GridGeometry:
    """Return the triangles of a run."""
    return geometry_of(Step(trace, cursor))
