"""Which widget takes which type of answer."""

from PySide6.QtWidgets import QWidget

from core.records.cells import Form
from widgets.exercises.answer_view import AnswerView
from widgets.exercises.choice_answer import ChoiceAnswerView
from widgets.exercises.code_answer import CodeAnswerView
from widgets.exercises.dial_answer import DialAnswerView
from widgets.exercises.field_answer import FieldAnswerView
from widgets.exercises.list_answers import ListingAnswerView, OrderAnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.method_answer import MethodAnswerView
from widgets.exercises.pixel_answer import PixelAnswerView
from widgets.exercises.place_answer import PlaceAnswerView
from widgets.exercises.spot_answer import SpotAnswerView
from widgets.exercises.steps_answer import StepsAnswerView

VIEWS: dict[str, type[AnswerView]] = {
    "pixels": PixelAnswerView,
    "numbers": FieldAnswerView,
    "table": FieldAnswerView,
    "order": OrderAnswerView,
    "choice": ChoiceAnswerView,
    "places": PlaceAnswerView,
    "line": ListingAnswerView,
    "code": CodeAnswerView,
    "spot": SpotAnswerView,
    "steps": StepsAnswerView,
    "break": DialAnswerView,
    "cheapest": MethodAnswerView,
}
"""By `Form.kind`."""


def make_view(form: Form, grid: MarkGrid, parent: QWidget) -> AnswerView:
    """Return an empty form for an answer; ``grid`` is the picture beside it."""
    return VIEWS[form.kind](form, grid, parent)
