"""Which widget takes which form of answer."""

from PySide6.QtWidgets import QWidget

from widgets.exercises.answer_view import AnswerView
from widgets.exercises.choice_answer import ChoiceAnswerView
from widgets.exercises.dial_answer import DialAnswerView
from widgets.exercises.field_answer import FieldAnswerView
from widgets.exercises.listing_answer import ListingAnswerView
from widgets.exercises.mark_grid import MarkGrid
from widgets.exercises.method_answer import MethodAnswerView
from widgets.exercises.order_answer import OrderAnswerView
from widgets.exercises.pixel_answer import PixelAnswerView
from widgets.exercises.place_answer import PlaceAnswerView
from widgets.exercises.records import (
    AnswerForm,
    ChoiceForm,
    DialForm,
    FieldForm,
    ListingForm,
    MethodForm,
    OrderForm,
    PixelForm,
    PlaceForm,
    SpotForm,
    StepsForm,
)
from widgets.exercises.spot_answer import SpotAnswerView
from widgets.exercises.steps_answer import StepsAnswerView

VIEWS: dict[type[AnswerForm], type[AnswerView]] = {
    PixelForm: PixelAnswerView,
    FieldForm: FieldAnswerView,
    OrderForm: OrderAnswerView,
    ChoiceForm: ChoiceAnswerView,
    PlaceForm: PlaceAnswerView,
    ListingForm: ListingAnswerView,
    SpotForm: SpotAnswerView,
    StepsForm: StepsAnswerView,
    DialForm: DialAnswerView,
    MethodForm: MethodAnswerView,
}


def make_view(form: AnswerForm, grid: MarkGrid, parent: QWidget) -> AnswerView:
    """Return an empty form for an answer; ``grid`` is the picture beside it."""
    return VIEWS[type(form)](form, grid, parent)
