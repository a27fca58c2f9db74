"""The colour range of a buffer: two ends, typed or dragged over a histogram, and a button that fits them."""

from PySide6.QtCore import QPoint, Qt, Signal
from PySide6.QtWidgets import QWidget

from core.explain.number_text import parse_number
from widgets.basics.controls import button_with_tip, row_layout
from widgets.basics.image import fitted_range, value_range
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.basics.typed_value import NumberEdit
from widgets.grid.buffer import GridBuffer, number_text
from widgets.grid.histogram import Histogram


class RangeControl(QWidget):
    """Low end, histogram with two handles, high end, Fit and Reset.

    A right click on Fit (or the menu key) asks to keep fitting: then the owner shows buffers without a
    range of their own, which follow their values from step to step.
    """

    range_changed = Signal(float, float)
    """Low and high end, low <= high, chosen by the user."""
    range_reset = Signal()
    """The user wants the buffer's own range back."""
    fitting_changed = Signal(bool)
    """Whether the range shall follow the values from now on."""

    def __init__(self, parent: QWidget | None = None) -> None:
        """Make a control without a buffer."""
        super().__init__(parent)
        self._buffer: GridBuffer | None = None
        self._low, self._high = 0.0, 1.0
        self._keeps_fitting = False
        self._low_edit = self._make_edit("Low end of the colour range")
        self._high_edit = self._make_edit("High end of the colour range")
        self._histogram = Histogram(self)
        self._histogram.range_dragged.connect(self._choose)
        self._fit_button = button_with_tip(
            "Fit", "Fit the range to the values; right click: keep fitting", self
        )
        self._fit_button.setAccessibleName("Fit the colour range to the values")
        self._fit_button.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self._fit_button.clicked.connect(self.fit)
        self._fit_button.customContextMenuRequested.connect(self._toggle_fitting)
        self._reset_button = button_with_tip("Reset", "Back to the buffer's own range", self)
        self._reset_button.clicked.connect(self._reset)
        row = row_layout(self, 2 * current_theme().unit)
        self._parts = (self._low_edit, self._histogram, self._high_edit, self._fit_button, self._reset_button)
        for part in self._parts:
            policy = part.sizePolicy()
            policy.setRetainSizeWhenHidden(True)
            part.setSizePolicy(policy)
            row.addWidget(part, 1 if part is self._histogram else 0)
        self.setAccessibleName("Colour range")
        theme_notifier().theme_changed.connect(self._take_font)
        self._take_font()
        self._show_ends()
        self.show_buffer(None)

    def show_buffer(self, buffer: GridBuffer | None) -> None:
        """Show the values and the range of a buffer; of kinds that have no range the place stays empty."""
        self._buffer = buffer
        has_range = buffer is not None and buffer.kind in ("scalar", "signed")
        self.setEnabled(has_range)
        for part in self._parts:
            part.setVisible(has_range)
        if buffer is None or not has_range:
            return
        self._histogram.show_values(buffer.values, buffer.colormap)
        self.show_range(*value_range(buffer))

    def show_range(self, low: float, high: float) -> None:
        """Show a range; emits nothing."""
        self._low, self._high = low, high
        self._histogram.show_range(low, high)
        self._show_ends()

    def keeps_fitting(self) -> bool:
        """Return whether the range shall follow the values."""
        return self._keeps_fitting

    def set_keeps_fitting(self, keeps: bool) -> None:
        """Say whether the range follows the values; emits nothing."""
        self._keeps_fitting = keeps
        self._fit_button.setText("Fitting" if keeps else "Fit")
        self._fit_button.setCheckable(keeps)
        self._fit_button.setChecked(keeps)

    def fit(self) -> None:
        """Take the smallest and largest finite value, as the user's wish; a kept fit ends."""
        if self._keeps_fitting:
            self.set_keeps_fitting(False)
            self.fitting_changed.emit(False)
        elif self._buffer is not None:
            low, high = fitted_range(self._buffer.values)
            if self._buffer.kind == "signed":
                high = max(abs(low), abs(high))
                low = -high
            self._choose(low, high)
            self._histogram.show_range(self._low, self._high)

    def _choose(self, low: float, high: float) -> None:
        """Take over a range that the user chose, and tell; a signed buffer's range is symmetric about 0."""
        if self._buffer is not None and self._buffer.kind == "signed":
            # The end that moved leads.
            reach = abs(low) if low != self._low else abs(high)
            low, high = -reach, reach
            self._histogram.show_range(low, high)
        if (low, high) == (self._low, self._high):
            return
        if self._keeps_fitting:
            self.set_keeps_fitting(False)
            self.fitting_changed.emit(False)
        self._low, self._high = low, high
        self._show_ends()
        self.range_changed.emit(low, high)

    def _type_ends(self) -> None:
        """Take typed ends; text that is not a number, or ends in the wrong order, are put back, and it is said why."""
        ends = (self._low_edit, self._low), (self._high_edit, self._high)
        try:
            # An end that was not touched keeps its full precision.
            low, high = (parse_number(edit.text()) if edit.isModified() else end for edit, end in ends)
            if low > high:
                raise ValueError(
                    f"expected the lower end first, got {number_text(low)} and {number_text(high)}"
                )
        except ValueError as problem:
            next(edit for edit, _ in reversed(ends) if edit.isModified()).tell(str(problem))
        else:
            self._choose(low, high)
            self._histogram.show_range(self._low, self._high)
        self._show_ends()

    def _toggle_fitting(self, position: QPoint) -> None:
        """Begin or end to keep fitting, and report it."""
        self.set_keeps_fitting(not self._keeps_fitting)
        self.fitting_changed.emit(self._keeps_fitting)

    def _reset(self) -> None:
        """Tell that the user wants the buffer's own range."""
        if self._keeps_fitting:
            self.set_keeps_fitting(False)
            self.fitting_changed.emit(False)
        self.range_reset.emit()

    def _show_ends(self) -> None:
        """Write both ends with four digits; full precision as a tooltip."""
        for edit, value in ((self._low_edit, self._low), (self._high_edit, self._high)):
            edit.setText(number_text(float(value)))
            edit.setToolTip(number_text(float(value), 0))

    def _make_edit(self, name: str) -> NumberEdit:
        """Return a field for one end."""
        edit = NumberEdit(self)
        edit.setAccessibleName(name)
        edit.setAlignment(Qt.AlignmentFlag.AlignRight)
        edit.editingFinished.connect(self._type_ends)
        edit.returnPressed.connect(edit.clearFocus)
        return edit

    def _take_font(self) -> None:
        """Use tabular figures at the present theme's size, and room for nine of them."""
        font = text_font(current_theme())
        for edit in (self._low_edit, self._high_edit):
            edit.setFont(font)
            edit.setFixedWidth(edit.fontMetrics().horizontalAdvance("0") * 9 + 12)
