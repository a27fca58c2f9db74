"""Which widget takes which form of answer."""

from PySide6.QtWidgets import QWidget

from widgets.exercises.answer_view import AnswerView
from widgets.exercises.choice_answer import ChoiceAnswerView
from widgets.exercises.field_answer import FieldAnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.order_answer import OrderAnswerView
from widgets.exercises.pixel_answer import PixelAnswerView
from widgets.exercises.records import AnswerForm, ChoiceForm, FieldForm, OrderForm, PixelForm

VIEWS: dict[type[AnswerForm], type[AnswerView]] = {
    PixelForm: PixelAnswerView,
    FieldForm: FieldAnswerView,
    OrderForm: OrderAnswerView,
    ChoiceForm: ChoiceAnswerView,
}


def make_view(form: AnswerForm, grid: MarkGrid, parent: QWidget) -> AnswerView:
    """Return an empty form for an answer; ``grid`` is the picture beside it."""
    return VIEWS[type(form)](form, grid, parent)
