"""What stands above the maps of an experiment: what it claims, how fine it is run, and running it."""

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QSizePolicy, QSpinBox, QVBoxLayout, QWidget

from widgets.basics.flow_layout import FlowLayout
from widgets.basics.message_bar import Progress
from widgets.basics.run_controls import RunControls


class StabilityControls(QWidget):
    """Tells what the user chooses; emits nothing when it is set by the program."""

    resolution_chosen = Signal(str)
    seed_chosen = Signal(int)
    running_requested = Signal()
    cancel_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Experiment and running it")
        self.question, self.claim = self._sentence("Question"), self._sentence("Claim")
        self.question.setProperty("role", "muted")
        self.resolution_box = QComboBox(self)
        self.resolution_box.setAccessibleName("Grid")
        self.resolution_box.setToolTip("How many cells a map has")
        self.resolution_box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self.seed_box = QSpinBox(self)
        self.seed_box.setRange(0, 9999)
        self.seed_box.setAccessibleName("Seed")
        self.seed_box.setToolTip("The random numbers that the scenes are made from")
        self.seed_box.setKeyboardTracking(False)
        self.running = RunControls(
            "Run",
            "Run every method at every place of the grid (F5). It goes on while other experiments and pages are looked "
            "at; the last maps of every experiment are there again at the next start.",
            "Stop running; the maps of before stay (Escape)",
            self,
        )
        self._lay_out()
        self.resolution_box.activated.connect(self._choose_resolution)
        self.seed_box.valueChanged.connect(self.seed_chosen)
        self.running.start_button.clicked.connect(self.running_requested)
        self.running.cancel_button.clicked.connect(self.cancel_requested)
        self.show_progress(None)

    def _sentence(self, name: str) -> QLabel:
        label = QLabel(self)
        label.setWordWrap(True)
        label.setAccessibleName(name)
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        return label

    def _lay_out(self) -> None:
        row = QWidget(self)
        row.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Minimum)
        flow = FlowLayout(row, 12)
        for text, control in (("Grid", self.resolution_box), ("Seed", self.seed_box)):
            pair = QWidget(row)
            beside = QHBoxLayout(pair)
            beside.setContentsMargins(0, 0, 0, 0)
            beside.setSpacing(4)
            label = QLabel(text, pair)
            label.setBuddy(control)
            beside.addWidget(label)
            beside.addWidget(control)
            flow.addWidget(pair)
        for widget in self.running.widgets:
            flow.addWidget(widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 8, 8, 8)
        layout.setSpacing(4)
        layout.addWidget(self.question)
        layout.addWidget(self.claim)
        layout.addWidget(row)

    def show_sentences(self, question: str, claim: str) -> None:
        """Show what is asked, and what is claimed and tested."""
        self.question.setText(question)
        self.claim.setText(claim)
        self._keep_height()

    def show_choices(
        self, resolutions: Sequence[tuple[str, str]], current: str, seed: int, can_run: bool
    ) -> None:
        """Show the grids, as names and titles, and which is chosen; the seed; and whether it can be run."""
        box = self.resolution_box
        if [(box.itemData(k), box.itemText(k)) for k in range(box.count())] != list(resolutions):
            box.clear()
            for name, title in resolutions:
                box.addItem(title, name)
        box.setCurrentIndex(max(box.findData(current), 0))
        self.seed_box.blockSignals(True)
        self.seed_box.setValue(seed)
        self.seed_box.blockSignals(False)
        self.running.start_button.setEnabled(can_run)
        self._keep_height()

    def show_progress(self, progress: Progress | None) -> None:
        """Show how far running has come; ``None``: nothing runs."""
        self.running.show_progress(progress)
        self._keep_height()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep room for all lines."""
        super().resizeEvent(event)
        self._keep_height()

    def _keep_height(self) -> None:
        """Ask for the height that this width needs: a splitter does not ask by itself."""
        self.setMinimumHeight(self.heightForWidth(self.width()))

    @Slot(int)
    def _choose_resolution(self, index: int) -> None:
        self.resolution_chosen.emit(self.resolution_box.itemData(index))
