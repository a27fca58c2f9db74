"""What Predict asks at a step: a question of the exercises, as the pane shows and judges it."""

from dataclasses import dataclass, replace

from app.pages.step.grid_overlays import Guesses
from core.coverage.pixel_runs import Raster
from core.explain.records import AnswerKind, Question, Verdict
from core.trace.stage_trace import StageTrace
from lessons.exercises.answers.choices import ChoiceAnswer
from lessons.exercises.answers.marked import PixelAnswer
from lessons.exercises.question import Draft, coverage_sentence, next_draft, pixel_sentence

KINDS = {"pixels": AnswerKind.GRID, "numbers": AnswerKind.NUMBER, "choice": AnswerKind.CHOICE}


@dataclass(frozen=True, eq=False)
class Prediction:
    """A question with what was clicked so far, where pixels are asked for."""

    draft: Draft
    raster: Raster
    guesses: Guesses | None

    @property
    def question(self) -> Question:
        """The question as the pane shows it."""
        answer = self.draft.answer
        choices = answer.options if isinstance(answer, ChoiceAnswer) else ()
        return Question(self.draft.text, KINDS[answer.kind], choices)

    def verdict(self, value: float) -> Verdict:
        """Judge a number, or the place of a choice."""
        answer = self.draft.answer
        given = answer.options[int(value)] if isinstance(answer, ChoiceAnswer) else repr(value)
        return Verdict(answer.check(answer.read(given)).score == 1, self.draft.reveal)

    def clicked(self, column: int, row: int) -> "tuple[Prediction, Verdict] | None":
        """Judge a pixel that is said to be covered; ``None`` where none is asked for, or no longer this one."""
        guesses = self.guesses
        if guesses is None or guesses.is_revealed or (column, row) in guesses.clicked:
            return None
        pixel = (column, row)
        text = pixel_sentence(guesses.answer, pixel, self.raster)
        now = replace(self, guesses=replace(guesses, clicked=guesses.clicked | {pixel}))
        return now, Verdict(pixel in guesses.answer.reference, text)

    def revealed(self) -> "tuple[Prediction, Verdict]":
        """Show what is right, and of pixels how the clicked ones compare with it."""
        guesses = self.guesses
        if guesses is None:
            return self, Verdict(None, self.draft.reveal)
        text = coverage_sentence(guesses.answer, guesses.clicked)
        return replace(self, guesses=replace(guesses, is_revealed=True)), Verdict(None, text)


def predict(trace: StageTrace, raster: Raster, position: int) -> Prediction | None:
    """Ask about what comes after a position; ``None`` where nothing is to be predicted."""
    draft = next_draft(trace, raster, position)
    if draft is None:
        return None
    answer = draft.answer
    guesses = Guesses(frozenset(), answer) if isinstance(answer, PixelAnswer) else None
    return Prediction(draft, raster, guesses)
