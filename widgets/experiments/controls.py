"""What stands above an experiment: what is measured or claimed, with which methods, how much work, how often."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QSize, Qt, Signal, Slot
from PySide6.QtGui import QColor, QPainter, QResizeEvent
from PySide6.QtWidgets import (
    QLabel,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QSlider,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QWidget,
)

from core.explain.number_text import number_text
from widgets.basics.controls import row_layout, text_label
from widgets.basics.drawing import Mark, mark_pixmap
from widgets.basics.message_bar import Named, RunPanel, fill_box, set_number
from widgets.basics.theme import current_theme, theme_notifier
from widgets.basics.typed_value import TypedValue

# One dial of a study's work: a slider over the values that are usual, and a field for any between them.


@dataclass(frozen=True)
class DialChoice:
    """One dial with its present value."""

    name: str
    title: str
    unit: str
    values: tuple[float, ...]
    """The stops of the slider, rising."""
    value: float


class DialControl(QWidget):
    """A label, a slider and a typed value; whatever changes one changes the others."""

    value_chosen = Signal(str, float)
    """Name of the dial and the value that the user has chosen."""

    def __init__(self, dial: DialChoice, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._dial = dial
        unit = f" ({dial.unit})" if dial.unit else ""
        self.label = QLabel(f"{dial.title}{unit}", self)
        self.slider = QSlider(Qt.Orientation.Horizontal, self)
        self.slider.setRange(0, len(dial.values) - 1)
        self.slider.setPageStep(1)
        self.slider.setFixedWidth(112)
        self.slider.setAccessibleName(dial.title)
        self.field = TypedValue(dial.title, self, is_compact=True)
        self.field.set_range(dial.values[0], dial.values[-1])
        self.field.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        stops = ", ".join(number_text(value) for value in dial.values)
        self.setToolTip(f"{dial.title}{unit}: {stops}, or any value between them")
        row = row_layout(self, 4)
        for widget in (self.label, self.slider, self.field):
            row.addWidget(widget)
        self.show_value(dial.value)
        self.slider.valueChanged.connect(self._slide)
        self.field.value_committed.connect(self._choose)

    @property
    def dial(self) -> DialChoice:
        """What is shown."""
        return self._dial

    def show_value(self, value: float) -> None:
        """Show a value set by the program; the slider stands at the nearest stop."""
        self.slider.blockSignals(True)
        self.slider.setValue(int(np.argmin(np.abs(np.array(self._dial.values) - value))))
        self.slider.blockSignals(False)
        self.field.show_value(value)

    @Slot(int)
    def _slide(self, stop: int) -> None:
        self.field.show_value(self._dial.values[stop])
        self._choose(self._dial.values[stop])

    @Slot(float)
    def _choose(self, value: float) -> None:
        self.show_value(value)
        self.value_chosen.emit(self._dial.name, value)


# What stands above the charts of a study: the work and its size, the axes, and measuring.


MOST_ROUNDS = 99


@dataclass(frozen=True)
class StudyChoices:
    """Everything that can be chosen, and what is."""

    works: Named
    work: str
    dials: tuple[DialChoice, ...]
    measures: Named
    measure: str
    costs: Named
    """What the methods may be charged with: time, or a count of work."""
    cost: str
    rounds: int
    seed: int
    can_measure: bool = True


class StudyControls(RunPanel):
    """Offers the work, the axes of the chart, and measuring."""

    dial_chosen = Signal(str, float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            "Work and measuring",
            "Which method is fast, and which one is right? Choose a family at the left and press Measure (F5): all its "
            "methods do the same work, and each gets a mark, further left if it is faster and lower if its error is "
            "smaller.",
            "Measure",
            "Measure all methods on this work (F5). It continues while you use other families and pages. The last "
            "result of each family is kept for the next start.",
            "Stop measuring; the previous results are unchanged (Escape)",
            parent,
        )
        self.work_box = self.box("work", "Work", "The work that all methods do")
        self.measure_box = self.box("measure", "Error", "The error on the vertical axis of the chart")
        self.cost_box = self.box(
            "cost", "Cost", "Time on this machine, or a count of work that is the same on every machine"
        )
        self.rounds_box = self.number(
            "rounds", "Rounds", "Rounds of measurement, more until the order is stable", 1, MOST_ROUNDS
        )
        self.seed_box = self.number("seed", "Seed", "Seed of the random work", 0, 9999)
        self._dials: dict[str, DialControl] = {}
        self._work_flow = self.add_row(
            (("Work", self.work_box), ("Rounds", self.rounds_box), ("Seed", self.seed_box))
        )
        running = (self.start_button, self.cancel_button, self.progress, self.doing)
        self.add_row((("Error", self.measure_box), ("Cost", self.cost_box), *running))
        self.show_progress(None)

    # Showing.

    def show_choices(self, choices: StudyChoices) -> None:
        """Show what can be chosen and what is."""
        for box, named, current in (
            (self.work_box, choices.works, choices.work),
            (self.measure_box, choices.measures, choices.measure),
            (self.cost_box, choices.costs, choices.cost),
        ):
            fill_box(box, named, current)
        set_number(self.rounds_box, choices.rounds)
        set_number(self.seed_box, choices.seed)
        self._show_dials(choices.dials)
        self.start_button.setEnabled(choices.can_measure)
        self.keep_height()

    def dial(self, name: str) -> DialControl:
        """Return the control of a dial."""
        return self._dials[name]

    def _show_dials(self, dials: tuple[DialChoice, ...]) -> None:
        same = [(d.name, d.title, d.values) for d in dials] == [
            (c.dial.name, c.dial.title, c.dial.values) for c in self._dials.values()
        ]
        if not same:
            for control in self._dials.values():
                self._work_flow.removeWidget(control)
                control.hide()
                control.deleteLater()
            self._dials = {dial.name: DialControl(dial, self) for dial in dials}
            for place, control in enumerate(self._dials.values()):
                control.value_chosen.connect(self.dial_chosen)
                self._work_flow.insert_widget(place + 1, control)
                control.show()
        for dial in dials:
            self._dials[dial.name].show_value(dial.value)


# The families that can be compared; those that have been measured have a tick.


Index = QModelIndex | QPersistentModelIndex
_ENDS_GROUP = int(Qt.ItemDataRole.UserRole)
_GROUP_GAP = 9
"""Pixels below a group, with a line in their middle."""


@dataclass(frozen=True)
class FamilyEntry:
    """One family."""

    name: str
    title: str
    note: str = ""
    """Tooltip: what is compared, and what has been measured."""
    is_measured: bool = False
    ends_group: bool = False
    """Whether a line below it sets it off from what follows."""


class _GroupLines(QStyledItemDelegate):
    """Draws a line below every row that ends a group."""

    def sizeHint(self, option: QStyleOptionViewItem, index: Index) -> QSize:
        """Leave room for the line."""
        size = super().sizeHint(option, index)
        return size + QSize(0, _GROUP_GAP) if index.data(_ENDS_GROUP) else size

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: Index) -> None:
        """Draw the row above the line."""
        if not index.data(_ENDS_GROUP):
            super().paint(painter, option, index)
            return
        row, middle = QStyleOptionViewItem(option), option.rect.bottom() - _GROUP_GAP // 2
        row.rect = option.rect.adjusted(0, 0, 0, -_GROUP_GAP)
        super().paint(painter, row, index)
        painter.save()
        painter.setPen(QColor(current_theme().outline))
        painter.drawLine(row.rect.left() + 4, middle, row.rect.right() - 4, middle)
        painter.restore()


class FamilyList(QListWidget):
    """One row for each family."""

    family_chosen = Signal(str)
    """The user has gone to another family."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._entries: tuple[FamilyEntry, ...] = ()
        self.setAccessibleName("Families of methods")
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setWordWrap(True)
        self.setResizeMode(QListWidget.ResizeMode.Adjust)
        self.setItemDelegate(_GroupLines(self))
        self.currentRowChanged.connect(self._choose)
        theme_notifier().theme_changed.connect(self._refresh)

    def show_families(self, entries: Sequence[FamilyEntry], current: str) -> None:
        """Show families, and which of them the page is about."""
        self.blockSignals(True)
        if [entry.name for entry in entries] != [entry.name for entry in self._entries]:
            self.clear()
            for _ in entries:
                self.addItem(QListWidgetItem())
        self._entries = tuple(entries)
        self._refresh()
        self.setCurrentRow([entry.name for entry in entries].index(current))
        self.blockSignals(False)

    @Slot()
    def _refresh(self) -> None:
        side = current_theme().text_px
        for row, entry in enumerate(self._entries):
            item = self.item(row)
            item.setText(entry.title)
            item.setToolTip(f"{entry.title}\n{entry.note}")
            mark = mark_pixmap(Mark.RIGHT, side, self.devicePixelRatioF())
            if not entry.is_measured:
                mark.fill("transparent")
            item.setIcon(mark)
            item.setData(_ENDS_GROUP, entry.ends_group)
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Wrap long titles again."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        """Take no more height than the rows need."""
        rows = sum(self.sizeHintForRow(row) for row in range(self.count()))
        self.setMaximumHeight(max(rows + 2 * self.frameWidth(), self.minimumSizeHint().height()))

    @Slot(int)
    def _choose(self, row: int) -> None:
        if 0 <= row < len(self._entries):
            self.family_chosen.emit(self._entries[row].name)


# What stands above the maps of an experiment: what it claims, how fine it is run, and running it.


class StabilityControls(RunPanel):
    """Shows question and claim; offers the grid, the seed, and running."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(
            "Experiment and running it",
            "When does a method go wrong? Choose an experiment at the left and press Run (F5): each method gets a map, "
            "and each cell of it shows whether one run on a harder and harder scene was right.",
            "Run",
            "Run every method at every place of the grid (F5). It continues while you use other experiments and pages. "
            "The last maps of each experiment are kept for the next start.",
            "Stop running; the previous maps are unchanged (Escape)",
            parent,
        )
        self.question, self.claim = self._sentence("Question"), self._sentence("Claim")
        self.question.setProperty("role", "muted")
        self.resolution_box = self.box("resolution", "Grid", "Number of cells in a map")
        self.seed_box = self.number("seed", "Seed", "Seed of the random scenes", 0, 9999)
        self.rows.setSpacing(4)
        running = (self.start_button, self.cancel_button, self.progress, self.doing)
        self.add_row((("Grid", self.resolution_box), ("Seed", self.seed_box), *running))
        self.show_progress(None)

    def _sentence(self, name: str) -> QLabel:
        label = text_label("", self, name=name, wraps=True, is_selectable=True)
        self.rows.addWidget(label)
        return label

    def show_sentences(self, question: str, claim: str) -> None:
        """Show what is asked, and what is claimed and tested."""
        self.question.setText(question)
        self.claim.setText(claim)
        self.keep_height()

    def show_choices(self, resolutions: Named, current: str, seed: int, can_run: bool) -> None:
        """Show the grids and which is chosen; the seed; and whether it can be run."""
        fill_box(self.resolution_box, resolutions, current)
        set_number(self.seed_box, seed)
        self.start_button.setEnabled(can_run)
        self.keep_height()
