"""Transport, level, position and speed over the chapters of the run and the bar of the present one."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QPointF, QSize, Qt, QTimer, Signal, Slot
from PySide6.QtGui import QColor, QIcon, QKeyEvent, QPainter, QPixmap, QPolygonF
from PySide6.QtWidgets import QButtonGroup, QComboBox, QLabel, QSizePolicy, QToolButton, QWidget

from core.records.steps import Level
from widgets.basics.accessibility import ArrowGroup
from widgets.basics.controls import FlowLayout, column_layout, row_layout, text_label
from widgets.basics.theme import current_theme, theme_notifier
from widgets.basics.typed_value import NumberEdit
from widgets.timeline.bar import TimelineBar
from widgets.timeline.chapters import ChapterRow
from widgets.timeline.run_picture import TimelineRun

SPEEDS = (1.0, 2.0, 4.0, 10.0, 30.0, 60.0)
"""Steps a second that can be chosen."""

_AT_LAST = "The picture is finished."
_BUTTONS = (
    ("Go to the start", "Home", "The stage is at its start."),
    ("Step back", "Left", "Nothing comes before this."),
    ("Play", "Space", _AT_LAST),
    ("Step forward", "Right", _AT_LAST),
    ("Go to the end", "End", "The stage is at its end."),
)
"""Name, key and why it cannot be used, of the buttons that step and play."""
_LEVEL_NAMES = {
    Level.STAGE: "Stage",
    Level.TRIANGLE: "Triangle",
    Level.GROUP: "Row",
    Level.PIXEL: "Pixel",
    Level.OPERATION: "Operation",
}


class Timeline(QWidget):
    """Stepping by hand or in time; what a step means is the level chosen here."""

    position_requested = Signal(int)
    """The user wants this position."""
    step_requested = Signal(int)
    """One step at the present level: 1 forward, -1 back; by button or by the playing clock."""
    ends_requested = Signal(int)
    """The user wants the start (-1) or the end (1) of the stage."""
    leap_requested = Signal(int)
    """The user wants to go on (1) or back (-1) by many steps."""
    level_chosen = Signal(object)
    """The user has chosen another `Level`."""
    speed_changed = Signal(float)
    """The user has chosen another number of steps a second."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.takes_leaps = True
        """Whether Page Down and Page Up are its own; else the window's, where that has a use for them."""
        self._count = 0
        self._position = 0
        self._level = Level.PIXEL
        self.clock = QTimer(self, interval=round(1000 / SPEEDS[2]))
        self.clock.timeout.connect(self._tick)
        self.chapters = ChapterRow(self)
        self.bar = TimelineBar(self)
        self.bar.position_requested.connect(self.position_requested)
        buttons = [self._button(name) for name, _, _ in _BUTTONS]
        self.first_button, self.back_button, self.play_button, self.forward_button, self.last_button = buttons
        self.first_button.clicked.connect(self._go_first)
        self.back_button.clicked.connect(self._step_back)
        self.play_button.clicked.connect(self.toggle_play)
        self.forward_button.clicked.connect(self._step_forward)
        self.last_button.clicked.connect(self._go_last)
        self.level_buttons = {level: self._level_button(level) for level in Level}
        self._level_group = QButtonGroup(self)
        for level, button in self.level_buttons.items():
            self._level_group.addButton(button, int(level))
        self._level_group.idClicked.connect(self._choose_level)
        self.position_box = NumberEdit(self)
        self.position_box.setAlignment(Qt.AlignmentFlag.AlignRight)
        self.position_box.setAccessibleName("Position")
        self.position_box.setToolTip("Steps done; type a number to go there")
        self.position_box.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.position_box.editingFinished.connect(self._request_position)
        self.position_box.returnPressed.connect(self.position_box.clearFocus)
        self.count_label = QLabel("/ 0", self)
        self.speed_box = QComboBox(self)
        for speed in SPEEDS:
            self.speed_box.addItem(f"{speed:g} / s", speed)
        self.speed_box.setCurrentIndex(2)
        self.speed_box.setAccessibleName("Speed")
        self.speed_box.setToolTip("Steps a second while playing (+ and −)")
        self.speed_box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.speed_box.activated.connect(self._choose_speed)
        self._arrange()
        ArrowGroup(self.transport_buttons(), self)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()
        self.show_level(Level.PIXEL)
        self._update_state()

    @Slot(object)
    def show_run(self, run: TimelineRun) -> None:
        """Show another run; the position is kept inside it."""
        self._count = run.count
        self._position = min(self._position, run.count)
        self._fit_position_box()
        self.count_label.setText("/ ?" if run.is_open else f"/ {run.count:,}")
        self.bar.show_run(run)
        self._update_state()

    @Slot(int)
    def show_position(self, position: int) -> None:
        """Show how many steps are done; playing stops at the end of the last run."""
        self._position = position
        self.bar.show_position(position)
        self.chapters.show_share_done(position / self._count if self._count else 0.0)
        if not self._can_go_on():
            self.clock.stop()
        self._update_state()

    @Slot(object)
    def show_level(self, level: Level) -> None:
        """Mark the level that steps go by."""
        self._level = Level(level)
        self.level_buttons[self._level].setChecked(True)

    @Slot(object)
    def show_level_names(self, names: Mapping[Level, str]) -> None:
        """Name the levels as the stage has them (``Clip plane``, ``Row``); missing ones keep theirs."""
        for level, button in self.level_buttons.items():
            name = names.get(level, _LEVEL_NAMES[level])
            button.setText(name)
            button.setAccessibleName(f"Step by {name.lower()}")
            button.setToolTip(f"Step by {name.lower()} (Up: larger steps, Down: smaller)")

    @Slot(float)
    def show_speed(self, speed: float) -> None:
        """Show and use a speed in steps a second; the nearest of `SPEEDS` is taken."""
        place = min(range(len(SPEEDS)), key=lambda k: abs(SPEEDS[k] - speed))
        self.speed_box.setCurrentIndex(place)
        self.clock.setInterval(round(1000 / SPEEDS[place]))

    @Slot(bool)
    def show_playing(self, is_playing: bool) -> None:
        """Start or stop the clock."""
        if is_playing and self._can_go_on():
            self.clock.start()
        else:
            self.clock.stop()
        self._follow_play()

    @Slot()
    def toggle_play(self) -> None:
        """Start or pause playing as the user; at the end nothing starts."""
        is_playing = not self.clock.isActive()
        if is_playing and not self._can_go_on():
            return
        self.show_playing(is_playing)

    @Slot(int)
    def change_speed(self, steps: int) -> None:
        """Go `steps` places up or down the list of speeds as the user."""
        place = min(max(self.speed_box.currentIndex() + steps, 0), len(SPEEDS) - 1)
        if place != self.speed_box.currentIndex():
            self.speed_box.setCurrentIndex(place)
            self._choose_speed(place)

    def event(self, event: QEvent) -> bool:
        """Keep Page Down and Page Up from the window, while the chapters or the bar have the focus."""
        is_asked = event.type() == QEvent.Type.ShortcutOverride
        if self.takes_leaps and is_asked and isinstance(event, QKeyEvent) and _leap(event):
            event.accept()
            return True
        return super().event(event)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Leap through the run with these keys."""
        leap = _leap(event)
        if leap:
            self.leap_requested.emit(leap)
        else:
            super().keyPressEvent(event)

    def add_control(self, widget: QWidget) -> None:
        """Put another control into the row above the bar, left of the position."""
        self._guests.addWidget(widget)

    def is_playing(self) -> bool:
        """Return whether the clock runs."""
        return self.clock.isActive()

    def level(self) -> Level:
        """Return the level that is marked."""
        return self._level

    def transport_buttons(self) -> tuple[QToolButton, ...]:
        """Return the buttons that step and play, from left to right."""
        return self.first_button, self.back_button, self.play_button, self.forward_button, self.last_button

    def _button(self, name: str) -> QToolButton:
        button = QToolButton(self)
        button.setProperty("flat", True)
        button.setAccessibleName(name)
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        return button

    def _level_button(self, level: Level) -> QToolButton:
        button = QToolButton(self)
        button.setProperty("flat", True)
        button.setCheckable(True)
        button.setText(_LEVEL_NAMES[level])
        button.setAccessibleName(f"Step by {_LEVEL_NAMES[level].lower()}")
        button.setToolTip(f"Step by {_LEVEL_NAMES[level].lower()} (Up: larger steps, Down: smaller)")
        button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        return button

    def _arrange(self) -> None:
        steps, places = QWidget(self), QWidget(self)
        row = row_layout(steps, spacing=4)
        for button in self.transport_buttons():
            row.addWidget(button)
        row.addSpacing(12)
        row.addWidget(text_label("Step by", steps, role="muted"))
        for level_button in self.level_buttons.values():
            row.addWidget(level_button)
        row = row_layout(places, spacing=4)
        self._guests = row_layout(spacing=4)
        row.addLayout(self._guests)
        row.addWidget(self.position_box)
        row.addWidget(self.count_label)
        row.addSpacing(12)
        row.addWidget(self.speed_box)
        # Below one another in a narrow window, or in large type.
        controls = FlowLayout(spacing=4, is_spread=True)
        controls.addWidget(steps)
        controls.addWidget(places)
        layout = column_layout(self, 4, margins=(4, 0, 0, 0))
        layout.addLayout(controls)
        chapters = column_layout(spacing=0)
        chapters.addWidget(self.chapters)
        chapters.addWidget(self.bar)
        layout.addLayout(chapters)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Minimum)

    def _can_go_on(self) -> bool:
        return self._position < self._count or self.bar.run().has_after

    def _fit_position_box(self) -> None:
        text = "0" * (len(str(self._count)) + 1)
        self.position_box.setFixedWidth(self.position_box.fontMetrics().horizontalAdvance(text) + 16)

    def _update_state(self) -> None:
        is_after_start, can_go_on = self._position > 0, self._can_go_on()
        can_go_back = is_after_start or self.bar.run().has_before
        are_usable = (is_after_start, can_go_back, can_go_on, can_go_on, self._position < self._count)
        for button, is_usable, how in zip(self.transport_buttons(), are_usable, _BUTTONS, strict=True):
            if is_usable != button.isEnabledTo(self) or not button.toolTip():
                button.setEnabled(is_usable)
                _explain(button, *how)
        if not (self.position_box.hasFocus() and self.position_box.isModified()):
            self.position_box.setText(str(self._position))
        self._follow_play()

    def _follow_play(self) -> None:
        is_playing = self.clock.isActive()
        icon = self._icons["pause" if is_playing else "play"]
        if icon.cacheKey() == self.play_button.icon().cacheKey():
            return  # A button that is given an icon has the whole window laid out again.
        self.play_button.setIcon(icon)
        name = "Pause" if is_playing else "Play"
        self.play_button.setAccessibleName(name)
        _explain(self.play_button, name, "Space", _AT_LAST)

    @Slot()
    def _tick(self) -> None:
        self.step_requested.emit(1)

    @Slot()
    def _go_first(self) -> None:
        self.ends_requested.emit(-1)

    @Slot()
    def _go_last(self) -> None:
        self.ends_requested.emit(1)

    @Slot()
    def _step_back(self) -> None:
        self.step_requested.emit(-1)

    @Slot()
    def _step_forward(self) -> None:
        self.step_requested.emit(1)

    @Slot(int)
    def _choose_level(self, number: int) -> None:
        level = Level(number)
        if level is not self._level:
            self._level = level
            self.level_chosen.emit(level)

    @Slot(int)
    def _choose_speed(self, place: int) -> None:
        speed = SPEEDS[place]
        interval = round(1000 / speed)
        if interval != self.clock.interval():
            self.clock.setInterval(interval)
            self.speed_changed.emit(speed)

    @Slot()
    def _request_position(self) -> None:
        if not self.position_box.isModified():
            return
        text = self.position_box.text().replace(",", "").strip()
        if not text.isdecimal():
            self.position_box.tell(f"expected a number of steps from 0 to {self._count:,}, got {text[:20]!r}")
        position = min(int(text), self._count) if text.isdecimal() else self._position
        self.position_box.setText(str(position))
        if position != self._position:
            self.position_requested.emit(position)

    @Slot()
    def _follow_theme(self) -> None:
        side = round(18 * current_theme().text_px / 13)
        self._icons = {name: _transport_icon(name, side) for name in _SHAPES}
        for button in self.transport_buttons():
            button.setIconSize(QSize(side, side))
        self._fit_position_box()
        self.first_button.setIcon(self._icons["first"])
        self.back_button.setIcon(self._icons["back"])
        self.forward_button.setIcon(self._icons["forward"])
        self.last_button.setIcon(self._icons["last"])
        self._follow_play()


def _explain(button: QToolButton, name: str, key: str, why: str) -> None:
    """Name a button and its key in its tooltip, and why it cannot be used where that is so."""
    button.setToolTip(f"{name} ({key})" + ("" if button.isEnabled() else f"\n{why}"))


_Corners = tuple[tuple[float, float], ...]


def _chevron(left: float) -> _Corners:
    return tuple(
        (left + x, y) for x, y in ((0, 0.1), (0.16, 0.1), (0.5, 0.5), (0.16, 0.9), (0, 0.9), (0.34, 0.5))
    )


def _bar(left: float, width: float) -> _Corners:
    return ((left, 0.1), (left + width, 0.1), (left + width, 0.9), (left, 0.9))


def _mirrored(corners: _Corners) -> _Corners:
    return tuple((1.0 - x, y) for x, y in corners)


_SHAPES: dict[str, tuple[_Corners, ...]] = {
    "first": (_mirrored(_chevron(0.2)), _mirrored(_bar(0.78, 0.12))),
    "back": (_mirrored(_chevron(0.28)),),
    "play": (((0.18, 0.06), (0.92, 0.5), (0.18, 0.94)),),
    "pause": (_bar(0.18, 0.22), _bar(0.6, 0.22)),
    "forward": (_chevron(0.28),),
    "last": (_chevron(0.2), _bar(0.78, 0.12)),
}


def _transport_icon(name: str, side: int) -> QIcon:
    """Draw a transport sign of `side` logical pixels in the theme's text colour, and greyed out."""
    theme = current_theme()
    icon = QIcon()
    for mode, color in ((QIcon.Mode.Normal, theme.text), (QIcon.Mode.Disabled, theme.outline)):
        for ratio in (1, 2, 3):
            pixmap = QPixmap(side * ratio, side * ratio)
            pixmap.setDevicePixelRatio(ratio)
            pixmap.fill(Qt.GlobalColor.transparent)
            painter = QPainter(pixmap)
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(color))
            inner = side - 4.0
            for corners in _SHAPES[name]:
                painter.drawPolygon(
                    QPolygonF([QPointF(2.0 + x * inner, 2.0 + y * inner) for x, y in corners])
                )
            painter.end()
            icon.addPixmap(pixmap, mode)
    return icon


def _leap(event: QKeyEvent) -> int:
    """Return where a key leaps: on (1), back (-1), or nowhere (0)."""
    leaps = {Qt.Key.Key_PageDown: 1, Qt.Key.Key_PageUp: -1}
    is_plain = event.modifiers() == Qt.KeyboardModifier.NoModifier
    return leaps.get(Qt.Key(event.key()), 0) if is_plain else 0
