"""One choice per family of methods."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QComboBox, QGridLayout, QLabel, QToolButton, QWidget

from widgets.basics.accessibility import ArrowGroup, KeptInSight
from widgets.basics.choice_box import ChoiceBox
from widgets.basics.controls import button_with_tip, column_layout, flat_button, row_layout, text_label

MORE, FEWER = "More methods", "Fewer methods"


@dataclass(frozen=True)
class SettingChoice:
    """One value a setting can take."""

    value: str
    label: str
    tooltip: str = ""
    refusal: str = ""
    """Why it cannot be chosen now; empty: it can."""
    is_more: bool = False
    """Whether it is offered among the others only where the user wants them, or where it is the present one."""


@dataclass(frozen=True)
class Setting:
    """One family with its choices."""

    family: str
    label: str
    choices: tuple[SettingChoice, ...]
    current: str
    """Value of the present choice."""
    refusal: str = ""
    """Why the whole family has no effect now; empty: it has."""
    group: str = ""
    """Heading above the first setting of a group; empty: none."""
    is_more: bool = False
    """Whether it stands among the others, which the user unfolds."""


class SettingsPanel(QWidget):
    """A row per family: label, choice and a button that explains it; what cannot be chosen says why.

    A button under the rows unfolds the others, families and methods.
    """

    setting_chosen = Signal(str, str)
    """The user has chosen another value: family and value."""
    reference_requested = Signal(str, str)
    """The user asks what a choice is: family and its present value."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._settings: tuple[Setting, ...] = ()
        self._combos: dict[str, ChoiceBox] = {}
        self._labels: dict[str, QLabel] = {}
        self._buttons: dict[str, QToolButton] = {}
        self._headings: dict[str, QLabel] = {}
        """Heading of each family's group, by family."""
        self._body: QWidget | None = None
        self._wanted: dict[str, str] = {}
        """Values that a task wants, by family."""
        self._sight = KeptInSight(self)
        self._layout = column_layout(self)
        self._empty = text_label("Choose the methods of each stage here.", self, role="muted")
        self._empty.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._empty.setWordWrap(True)
        self._empty.setContentsMargins(8, 8, 8, 8)
        self.more_button = button_with_tip(MORE, "Show the families and methods beyond a first course", self)
        self.more_button.setCheckable(True)
        self.more_button.toggled.connect(self._unfold)
        self.more_button.hide()
        foot = row_layout(margins=(8, 0, 8, 8))
        foot.addWidget(self.more_button)
        foot.addStretch(1)
        self._layout.addWidget(self._empty)
        self._layout.addLayout(foot)
        self._layout.addStretch(1)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Settings")

    @Slot(object)
    def show_settings(self, settings: Sequence[Setting]) -> None:
        """Show families and their present choices; rows are kept while the families stay."""
        settings = tuple(settings)
        shown = {setting.family: setting for setting in self._settings}
        if list(shown) != [setting.family for setting in settings] or self._body is None:
            self._build(settings)
            shown.clear()
            self._seek()
        self._settings = settings
        for setting in settings:
            # A choice that was refused is still what the control shows.
            if setting != shown.get(setting.family) or self._shown_value(setting.family) != setting.current:
                self._fill(setting)
        self._show_rows()

    def show_wanted(self, values: Mapping[str, str]) -> None:
        """Show the rows that a task is about, list the values that it wants, and scroll to the first row."""
        if self._wanted or values:
            before, self._wanted = self._wanted, dict(values)
            changed = {family for family, _ in before.items() ^ values.items()}
            for setting in self._settings:
                if setting.family in changed:
                    self._fill(setting)
            self._show_rows()
            self._seek()

    def _seek(self) -> None:
        """Keep the first row that is wanted in sight, until the user acts."""
        self._sight.keep(next((self._combos[each] for each in self._wanted if each in self._combos), None))

    @Slot(bool)
    def show_more(self, is_unfolded: bool) -> None:
        """Show all families and methods, or those of a first course and those in use."""
        self.more_button.setChecked(is_unfolded)

    @Slot(bool)
    def _unfold(self, is_unfolded: bool) -> None:
        self.more_button.setText(FEWER if is_unfolded else MORE)
        for setting in self._settings:
            self._fill(setting)
        self._show_rows()

    def _show_rows(self) -> None:
        """Show the rows that are wanted, and the headings that something stands under."""
        is_all = self.more_button.isChecked()
        has_more = any(
            setting.is_more or any(c.is_more for c in setting.choices) for setting in self._settings
        )
        self.more_button.setVisible(has_more)
        used: dict[QLabel, bool] = dict.fromkeys(self._headings.values(), False)
        for setting in self._settings:
            is_shown = is_all or not setting.is_more or setting.family in self._wanted
            for widget in (self._labels, self._combos, self._buttons):
                widget[setting.family].setVisible(is_shown)
            if setting.family in self._headings:
                used[self._headings[setting.family]] |= is_shown
        for heading, is_used in used.items():
            heading.setVisible(is_used)

    def _offered(self, setting: Setting) -> list[SettingChoice]:
        """Return the choices of a family that its control lists."""
        more = {choice.value for choice in setting.choices if choice.is_more}
        is_all = self.more_button.isChecked() or len(more) == len(setting.choices)
        is_all |= self._wanted.get(setting.family) in more
        return [c for c in setting.choices if is_all or not c.is_more or c.value == setting.current]

    def combo(self, family: str) -> QComboBox:
        """Return the control of a family."""
        return self._combos[family]

    def _build(self, settings: tuple[Setting, ...]) -> None:
        if self._body is not None:
            self._body.hide()
            self._body.deleteLater()
        self._combos.clear()
        self._labels.clear()
        self._buttons.clear()
        self._headings.clear()
        self._empty.setVisible(not settings)
        body = QWidget(self)
        self._body = body
        grid = QGridLayout(body)
        grid.setContentsMargins(8, 8, 8, 8)
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(4)
        grid.setColumnStretch(1, 1)
        row = 0
        heading = None
        for setting in settings:
            if setting.group:
                heading = text_label(setting.group, body, role="muted")
                heading.setContentsMargins(0, 4 if row else 0, 0, 0)
                grid.addWidget(heading, row, 0, 1, 3)
                row += 1
            if heading is not None:
                self._headings[setting.family] = heading
            combo = ChoiceBox(body, most_rows=3)
            combo.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            combo.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
            combo.setMinimumContentsLength(5)
            combo.setAccessibleName(setting.label)
            combo.setObjectName(setting.family)
            combo.activated.connect(self._choose)
            label = QLabel(setting.label, body, wordWrap=True)
            label.setBuddy(combo)
            grid.addWidget(label, row, 0)
            grid.addWidget(combo, row, 1, Qt.AlignmentFlag.AlignVCenter)
            self._combos[setting.family] = combo
            self._labels[setting.family] = label
            button = flat_button(
                "i",
                f"About {setting.label}",
                f"What {setting.label} is, and what this method does (F1 on the choice)",
                body,
            )
            button.setObjectName(setting.family)
            button.setMinimumSize(24, 24)
            button.clicked.connect(self._ask)
            grid.addWidget(button, row, 2)
            self._buttons[setting.family] = button
            row += 1
        ArrowGroup(list(self._buttons.values()), body, is_upright=True)
        self._layout.insertWidget(0, body)

    def _shown_value(self, family: str) -> str:
        return str(self._combos[family].currentData(Qt.ItemDataRole.UserRole))

    def _fill(self, setting: Setting) -> None:
        combo = self._combos[setting.family]
        model = QStandardItemModel(combo)
        offered = self._offered(setting)
        for choice in offered:
            item = QStandardItem(choice.label)
            item.setEnabled(not choice.refusal)
            note = f"Not possible now: {choice.refusal}" if choice.refusal else ""
            item.setToolTip("\n".join(part for part in (choice.tooltip, note) if part))
            item.setData(choice.value, Qt.ItemDataRole.UserRole)
            model.appendRow(item)
        # The combo box deletes the model it owned before.
        combo.setModel(model)
        values = [choice.value for choice in offered]
        place = values.index(setting.current) if setting.current in values else -1
        combo.setCurrentIndex(place)
        combo.setEnabled(not setting.refusal)
        chosen = offered[place] if place >= 0 else None
        tip = "\n".join(part for part in (chosen.label, chosen.tooltip) if part) if chosen else ""
        tip = f"Not used now: {setting.refusal}" if setting.refusal else tip
        combo.setToolTip(tip or setting.label)
        combo.setAccessibleDescription(tip)
        label = self._labels[setting.family]
        label.setToolTip(tip or setting.label)
        label.setEnabled(not setting.refusal)

    @Slot()
    def _ask(self) -> None:
        family = self.sender().objectName()
        self.reference_requested.emit(family, self._shown_value(family))

    @Slot(int)
    def _choose(self, place: int) -> None:
        combo = self.sender()
        if not isinstance(combo, QComboBox):
            return
        self._sight.keep(None)
        family = combo.objectName()
        value = str(combo.itemData(place, Qt.ItemDataRole.UserRole))
        current = next(setting.current for setting in self._settings if setting.family == family)
        if value != current:
            self.setting_chosen.emit(family, value)
