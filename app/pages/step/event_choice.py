"""The choice of events above the timeline's bar, with a button to each side that runs to the next one of the kind."""

from PySide6.QtCore import QObject, Qt, Slot
from PySide6.QtWidgets import QComboBox

from app.pages.step.stepping_presenter import EVENT_TITLES, SteppingPresenter
from widgets.basics.controls import flat_button
from widgets.timeline.transport import Timeline


class EventChoice(QObject):
    """Keeps the kind of event that the stepping runs to."""

    def __init__(self, stepping: SteppingPresenter, timeline: Timeline, parent: QObject) -> None:
        super().__init__(parent)
        self._stepping = stepping
        self.box = QComboBox(timeline)
        for name, title in EVENT_TITLES.items():
            self.box.addItem(f"Run to: {title}", name)
        self.box.setAccessibleName("Kind of event")
        self.box.setToolTip("What N (next) and Shift+N (previous) run to")
        self.box.activated.connect(self._choose)
        self.previous_button = flat_button(
            "<", "Previous event", "Previous event of this kind (Shift+N)", timeline
        )
        self.next_button = flat_button(">", "Next event", "Next event of this kind (N)", timeline)
        self.previous_button.clicked.connect(self._run_back)
        self.next_button.clicked.connect(self._run_on)
        for widget in (self.previous_button, self.box, self.next_button):
            widget.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            timeline.add_control(widget)

    @Slot()
    def _run_back(self) -> None:
        self._stepping.run_to_event(-1)

    @Slot()
    def _run_on(self) -> None:
        self._stepping.run_to_event(1)

    @Slot(int)
    def _choose(self, index: int) -> None:
        self._stepping.event_kind = self.box.itemData(index)

    def choose(self, name: str) -> None:
        """Choose the kind of event that N runs to."""
        if name in EVENT_TITLES:
            self.box.setCurrentIndex(self.box.findData(name))
            self._stepping.event_kind = name
