"""The types of answers that the page takes, by name."""

from app.pages.exercises.answer_kind import AnswerKind
from app.pages.exercises.marked_kinds import PixelKind, SpotKind
from app.pages.exercises.run_kinds import BreakKind, CheapestKind, PlaceKind, StepsKind
from app.pages.exercises.typed_kinds import ChoiceKind, LineKind, NumberKind, OrderKind, TableKind
from lessons.exercises.answers.amounts import NumberAnswer
from lessons.exercises.answers.choices import ChoiceAnswer, OrderAnswer
from lessons.exercises.answers.listings import LineAnswer
from lessons.exercises.answers.pixels import PixelAnswer
from lessons.exercises.answers.places import PlaceAnswer
from lessons.exercises.answers.spots import SpotAnswer
from lessons.exercises.answers.steps import StepsAnswer
from lessons.exercises.answers.tables import TableAnswer
from lessons.exercises.answers.trials import BreakAnswer, CheapestAnswer

KINDS: dict[str, AnswerKind] = {
    PixelAnswer.kind: PixelKind(),
    NumberAnswer.kind: NumberKind(),
    TableAnswer.kind: TableKind(),
    OrderAnswer.kind: OrderKind(),
    ChoiceAnswer.kind: ChoiceKind(),
    PlaceAnswer.kind: PlaceKind(),
    LineAnswer.kind: LineKind(),
    SpotAnswer.kind: SpotKind(),
    StepsAnswer.kind: StepsKind(),
    BreakAnswer.kind: BreakKind(),
    CheapestAnswer.kind: CheapestKind(),
}
"""By `Answer.kind`."""
