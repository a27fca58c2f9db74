"""A | B | difference: two settings on the same input, three linked grids."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

from PySide6.QtCore import QEvent, QObject, Qt, Signal, Slot
from PySide6.QtGui import QGuiApplication, QKeyEvent, QResizeEvent
from PySide6.QtWidgets import (
    QBoxLayout,
    QComboBox,
    QGraphicsOpacityEffect,
    QLabel,
    QPushButton,
    QSizePolicy,
    QWidget,
)

from widgets.basics.choice_box import ChoiceBox
from widgets.basics.controls import CutLabel, FlowLayout, button_with_tip, column_layout, row_layout
from widgets.basics.settings_panel import Setting
from widgets.basics.theme import theme_notifier
from widgets.grid.buffer_strip import BufferChoice
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer, Overlay
from widgets.grid.linked_grids import SPACING, LinkedGrids
from widgets.grid.marks import StepMark
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.listing import ListingText, ListingView

LINES, LINES_WITH_CODE = (4, 5), (3, 4)
"""Lines above a picture, the last one says how far its run is, and below it."""
FAMILY_ROOM, METHOD_ROOM = 12, 20
"""Letters that the boxes for what B does otherwise have room for."""
FOLDED_LINES = (3, 3)
"""The same where the difference stands below A and B, with all notes beside it: there they are wider."""
MOST_ABOVE = 2 / 3
"""Largest part of the height that A and B have then: the difference is at least half as large."""
FOLDED_GAIN = 1.15
"""How many times larger the pictures become at least where the difference is put below A and B."""
TITLE_LINES, PICTURE_LINES = 3, 9
"""Lines above a picture at most, and none below, where it would be lower than so many lines of text."""
OLD_OPACITY = 0.4
"""Of a picture that is no longer that of what stands there."""
SWAP_TIP, USE_TIP = "Swap the settings of A and B", "Give the page the settings of B"
CHOICES_SPACING = 8
CODE_LINES = 10
"""Lines of text that the listings of A and B are high at least, where they are shown."""
LEAST_LINES, LEAST_LINES_WITH_CODE = (5, 0), (4, 5)
"""Lines that pictures and listings are high in the least room: what has none above that is left out."""


@dataclass(frozen=True, eq=False)
class Side:
    """One of the pictures: of A, of B, or their difference."""

    name: str
    title: str
    """What it is drawn with."""
    place: str = ""
    """How far its run is."""
    sentence: str = ""
    """What its last step did."""
    buffer: GridBuffer | None = None
    """``None``: there is no picture."""
    reason: str = ""
    """Why there is none."""
    is_old: bool = False
    """Whether its picture is no longer that of what stands there: it is greyed, and its place says so."""
    overlays: tuple[Overlay, ...] = ()
    geometry: GridGeometry | None = None
    """Its triangles."""
    pixel_center: str = "half"
    """Where its centres lie, as ``PixelGrid.set_pixel_center``."""
    step: StepMark = field(default_factory=StepMark)
    """What its last step was about."""
    listing: ListingText | None = None
    """The listing of its last step, where both are shown."""
    line: int = 0
    """The line of it that has just run, from 1; 0: none."""


class CompareView(QWidget):
    """Three linked grids; what B does otherwise is chosen above them."""

    setting_chosen = Signal(str, str)
    """The user has chosen another value for B: family and value."""
    reset_requested = Signal()
    """The user wants B to be like A again."""
    swap_requested = Signal()
    """The user wants A to become B and B to become A."""
    use_requested = Signal()
    """The user wants the page to use the settings of B."""
    divergence_requested = Signal()
    """The user wants both runs to go to the first step that differs."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.figure = QWidget(self)
        """The pictures with what is said of them, without the choices: what is exported and copied."""
        self.figure.setAccessibleName("A, B and difference")
        self.linked = LinkedGrids(("A", "B", "Difference"), self.figure)
        self.grids, self.titles = self.linked.grids, self.linked.titles
        self.buffer_box, self.family_box, self.value_box = (
            BufferChoice(self),
            ChoiceBox(self),
            ChoiceBox(self),
        )
        self.listings = (ListingView(self.figure), ListingView(self.figure))
        """Those of A and B, where what runs is compared line by line."""
        self.notes = tuple(CutLabel(self.figure) for _ in self.grids)
        self._settings: tuple[Setting, ...] = ()
        self._sides: tuple[Side, ...] = ()
        self._is_flipped = self._is_tight = False
        self._wants_choices, self._room, self._least = True, 0, 0
        """Whether choices are offered where there is room, the height that they leave, and what of it is needed."""
        self._buttons: dict[str, QPushButton] = {}
        for box, name, tip in (
            (self.buffer_box, "Buffer", "Which buffer is compared"),
            (
                self.family_box,
                "Family of B",
                "A family of methods; a dot marks those in which B differs from A",
            ),
            (self.value_box, "Method of B", "The method that B uses. B may differ in any number of families"),
        ):
            box.setAccessibleName(name)
            box.setToolTip(tip)
        self.family_box.activated.connect(self._show_values)
        self.value_box.activated.connect(self._choose_value)
        self._lay_out()
        theme_notifier().theme_changed.connect(self._show_again)

    def _lay_out(self) -> None:
        self._boxes, self._button_row = QWidget(self), QWidget(self)
        boxes, buttons = FlowLayout(self._boxes, 8), FlowLayout(self._button_row, 8)
        for box, room in ((self.family_box, FAMILY_ROOM), (self.value_box, METHOD_ROOM)):
            # What is chosen must not move what stands beside it.
            box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
            box.setMinimumContentsLength(room)
        boxes.addWidget(self._named("Compare", self.buffer_box))
        boxes.addWidget(self._named("B:", self.family_box, self.value_box))
        for text, tip, signal in (
            (
                "First divergence",
                "Go to the first step that differs, in both runs",
                self.divergence_requested,
            ),
            ("Swap", SWAP_TIP, self.swap_requested),
            ("Use B", USE_TIP, self.use_requested),
            ("B = A", "Give B the settings of A", self.reset_requested),
        ):
            button = button_with_tip(text, tip, self)
            button.clicked.connect(signal)
            buttons.addWidget(button)
            self._buttons[text] = button
        self.flip_button = button_with_tip("Flip", "Swap the two pictures while it is held (X)", self)
        self.flip_button.pressed.connect(partial(self.show_flipped, True))
        self.flip_button.released.connect(partial(self.show_flipped, False))
        buttons.addWidget(self.flip_button)
        layout = column_layout(self, CHOICES_SPACING, margins=(0, 4, 0, 0))
        layout.addWidget(self._boxes)
        layout.addWidget(self._button_row)
        layout.addWidget(self.figure, 1)
        figure = self._figure_layout = column_layout(self.figure, 8, margins=(8, 8, 8, 8))
        figure.addWidget(self.linked, 1)
        self._notes = QWidget(self.figure)
        self._notes_layout = QBoxLayout(QBoxLayout.Direction.LeftToRight, self._notes)
        self._notes_layout.setContentsMargins(0, 0, 0, 0)
        for note in self.notes:
            note.setProperty("role", "muted")
            note.setAlignment(Qt.AlignmentFlag.AlignTop)
            self._notes_layout.addWidget(note, 1)
        self._notes_layout.addStretch(0)
        figure.addWidget(self._notes)
        self._code = QWidget(self.figure)
        code = row_layout(self._code, 8)
        for name, listing in zip("AB", self.listings, strict=True):
            listing.setAccessibleName(f"Listing of {name}")
            code.addWidget(listing, 1)
        figure.addWidget(self._code, 1)
        self._code.hide()
        self.summary = self.notes[2]

    def _named(self, name: str, *boxes: QWidget) -> QWidget:
        """Return boxes in a row after their name, which stays with them."""
        group = QWidget(self._boxes)
        row = row_layout(group, spacing=8)
        row.addWidget(QLabel(name, group))
        for box in boxes:
            row.addWidget(box, 1)
        return group

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Put the difference below A and B where that makes the pictures larger."""
        super().resizeEvent(event)
        before = self._is_tight
        self._make_room()
        self._fold_if_larger()
        if self._is_tight != before:
            self._show_again()

    def _make_room(self) -> None:
        """Leave out what the pictures need the room of: first most that is said of them, then buttons and choices."""
        line = self.fontMetrics().lineSpacing()
        self._room = self.height()
        self._least = sum(LEAST_LINES_WITH_CODE if self._has_code() else LEAST_LINES) * line
        for row, lines in ((self._boxes, 1), (self._button_row, TITLE_LINES)):
            height = row.heightForWidth(self.width()) + CHOICES_SPACING
            is_shown = self._wants_choices and self._room - height >= self._least + lines * line
            row.setVisible(is_shown)
            self._room -= height if is_shown else 0
        wanted = sum(LINES_WITH_CODE) + CODE_LINES if self._has_code() else sum(LINES)
        self._is_tight = self._room < (wanted + PICTURE_LINES) * line and not self.linked.is_folded

    def _has_code(self) -> bool:
        """Return whether listings are compared."""
        return any(side.listing is not None for side in self._sides)

    def _fold_if_larger(self) -> None:
        gain, upper = self._gain()
        is_folded = gain > FOLDED_GAIN
        if is_folded != self.linked.is_folded:
            self._fold(is_folded)
        if is_folded:
            self.linked.share_height(upper)

    def _fold(self, is_folded: bool) -> None:
        # The notes are parted from their place before they get the other one.
        self._figure_layout.removeWidget(self._notes)
        self.linked.fold(self._notes if is_folded else None)
        if not is_folded:
            self._figure_layout.insertWidget(1, self._notes)
        direction = QBoxLayout.Direction.TopToBottom if is_folded else QBoxLayout.Direction.LeftToRight
        self._notes_layout.setDirection(direction)
        # Beside the difference, notes of any length leave the pictures their size.
        vertical = QSizePolicy.Policy.Ignored if is_folded else QSizePolicy.Policy.Preferred
        self._notes.setSizePolicy(QSizePolicy.Policy.Preferred, vertical)
        for note in self.notes:
            self._notes_layout.setStretchFactor(note, 0 if is_folded else 1)
        self._notes_layout.setStretch(len(self.notes), 1 if is_folded else 0)
        self._show_again()
        self._notes.show()

    def _gain(self) -> tuple[float, float]:
        """Return how many times larger A and B are with the difference below them, and their part of the height then.

        0 times: there is no room for the notes beside the difference.
        """
        buffer = next((side.buffer for side in self._sides if side.buffer is not None), None)
        if buffer is None or self._has_code():
            return 0.0, 1.0
        line = self.fontMetrics().lineSpacing()
        width, height = self.width(), self._room  # The figure has its new size a moment later.
        above, below = (lines * line for lines in LINES)
        folded_above, folded_below = (lines * line for lines in FOLDED_LINES)
        both = height - 2 * (folded_above + SPACING)
        notes = len(self.notes) * (folded_below + SPACING) - folded_above
        if both / 2 < notes:
            return 0.0, 1.0
        most = min(both - notes, MOST_ABOVE * both)
        upper = max(both / 2, min(width / 2 * buffer.rows / buffer.columns, most))
        flat, folded = (
            min(wide / buffer.columns, high / buffer.rows)
            for wide, high in ((width / 3, height - above - below), (width / 2, upper))
        )
        return (folded / flat if flat > 0 else 0.0), upper / both

    def show_choices(self, is_shown: bool) -> None:
        """Offer buffers, methods and buttons, or leave all the room to the pictures."""
        self._wants_choices = is_shown
        self._make_room()

    def show_settings(self, settings: Sequence[Setting], changed: frozenset[str]) -> None:
        """Show the settings of B, and mark the families in which it differs."""
        family = self.family_box.currentData()
        self._settings = tuple(settings)
        self.family_box.clear()
        for setting in settings:
            mark = "\u2022 " if setting.family in changed else ""
            self.family_box.addItem(mark + setting.label, setting.family)
        self.family_box.setCurrentIndex(max(self.family_box.findData(family), 0))
        self._show_values()

    def show_refusal(self, reason: str) -> None:
        """Let the page take over the settings of B; with a reason: it cannot, and the two buttons say why."""
        for name, tip in (("Swap", SWAP_TIP), ("Use B", USE_TIP)):
            button = self._buttons[name]
            button.setEnabled(not reason)
            button.setToolTip(reason or tip)
            button.setAccessibleDescription(reason)

    def show_family(self, family: str) -> None:
        """Bring a family to the choice."""
        index = max(self.family_box.findData(family), 0)
        if index != self.family_box.currentIndex():
            self.family_box.setCurrentIndex(index)
            self._show_values()

    def show_sides(self, *sides: Side) -> None:
        """Show A, B and their difference."""
        self._sides = sides
        if self._is_flipped:
            sides = sides[1], sides[0], sides[2]
        has_code = self._has_code()
        above, below = LINES_WITH_CODE if has_code else LINES
        self._make_room()
        # Before a class the listings need the room; the note tells the difference.
        self.linked.show_last(not has_code or (self._wants_choices and not self._is_tight))
        if self.linked.is_folded:
            above, below = FOLDED_LINES
        elif self._is_tight:
            spare = (self._room - self._least) // self.fontMetrics().lineSpacing()
            above, below = min(max(spare, 1), TITLE_LINES), 0
        self._notes.setVisible(below > 0)
        _, upper = self._gain()
        folded = self._room / self.fontMetrics().lineSpacing() - 2 * FOLDED_LINES[0]
        notes = int((folded * (1 - upper) + FOLDED_LINES[0] - 1) / len(self.notes))
        for side, grid, title, note in zip(sides, self.grids, self.titles, self.notes, strict=True):
            grid.empty_text = side.reason
            grid.set_pixel_center(side.pixel_center)
            grid.show_buffer(side.buffer)
            grid.show_overlays(side.overlays)
            grid.show_geometry(side.geometry)
            grid.show_step(side.step)
            place = "the last version that ran" if side.is_old else side.place
            self._write(title, f"{side.title}\n{place}".rstrip(), above)
            _grey(grid, side.is_old)
            # Away from its picture a note names it.
            name = f"{side.name}: " if self.linked.is_folded and side.sentence else ""
            self._write(note, name + side.sentence, notes if self.linked.is_folded else below)
            if self.linked.is_folded:
                note.setMinimumHeight(0)  # No higher than its text: the notes stand one below the other.
        self._code.setVisible(has_code)
        lines = LEAST_LINES_WITH_CODE[1] if self._is_tight else CODE_LINES
        self._code.setMinimumHeight(lines * self.fontMetrics().lineSpacing())
        for view, side in zip(self.listings, sides, strict=False):
            if view.toPlainText() != ("" if side.listing is None else side.listing.source.rstrip("\n")):
                view.show_listing(side.listing)
            view.show_line(side.line or None)
        self._fold_if_larger()

    def show_flipped(self, is_flipped: bool) -> None:
        """Show B in the place of A and A in the place of B, or both in their own places."""
        if is_flipped != self._is_flipped:
            self._is_flipped = is_flipped
            self._show_again()

    @Slot()
    def _show_again(self) -> None:
        if self._sides:
            self.show_sides(*self._sides)

    def flip_while_held(self) -> None:
        """Show B in the place of A and A in the place of B until the key is released."""
        self.show_flipped(True)
        QGuiApplication.instance().installEventFilter(self)  # type: ignore[union-attr]

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Put A and B back when a key is released, or the window is left while it is held."""
        is_release = isinstance(event, QKeyEvent) and not event.isAutoRepeat()
        if event.type() == QEvent.Type.WindowDeactivate or (
            is_release and event.type() == QEvent.Type.KeyRelease
        ):
            QGuiApplication.instance().removeEventFilter(self)  # type: ignore[union-attr]
            self.show_flipped(False)
        return False

    @staticmethod
    def _write(label: QLabel, text: str, lines: int) -> None:
        """Show a text in the place of some lines: longer and shorter ones do not move the pictures."""
        label.setText(text)
        label.setToolTip(text)
        height = lines * label.fontMetrics().lineSpacing() + 4
        label.setMinimumHeight(height)
        label.setMaximumHeight(height)

    @Slot()
    def _show_values(self) -> None:
        setting = next((s for s in self._settings if s.family == self.family_box.currentData()), None)
        self.value_box.clear()
        if setting is None:
            return
        for choice in setting.choices:
            self.value_box.addItem(choice.label, choice.value)
            tip = choice.refusal or choice.tooltip
            self.value_box.setItemData(self.value_box.count() - 1, tip, Qt.ItemDataRole.ToolTipRole)
        self.value_box.setCurrentIndex(self.value_box.findData(setting.current))

    @Slot()
    def _choose_value(self) -> None:
        self.setting_chosen.emit(self.family_box.currentData(), self.value_box.currentData())


def _grey(grid: PixelGrid, is_grey: bool) -> None:
    """Show a picture faintly, or as ever."""
    if is_grey != (grid.graphicsEffect() is not None):
        if is_grey:
            effect = QGraphicsOpacityEffect(grid)
            effect.setOpacity(OLD_OPACITY)
            grid.setGraphicsEffect(effect)
        else:
            grid.setGraphicsEffect(None)  # type: ignore[arg-type]
