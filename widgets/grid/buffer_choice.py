"""Which buffer the main grid shows, chosen by its name."""

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal, Slot
from PySide6.QtWidgets import QComboBox, QWidget

from widgets.basics.choice_box import ChoiceBox
from widgets.grid.buffer import GridBuffer

ROOM = 11
"""Letters that the box has room for: other buffers must not move what stands beside it."""


class BufferChoice(ChoiceBox):
    """The buffers of the stage at hand; set by code, it emits nothing."""

    buffer_chosen = Signal(str)
    """Name of the buffer that was chosen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._names: list[tuple[str, str]] = []
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setAccessibleName("Buffer in the main view")
        self.setToolTip("Choose the buffer in the main view")
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(ROOM)
        self.activated.connect(self._choose)

    def show_buffers(self, buffers: Sequence[GridBuffer], chosen: str) -> None:
        """Offer buffers and mark the one that is shown; there is nothing to choose of one."""
        names = [(buffer.name, buffer.label) for buffer in buffers]
        if names != self._names:
            self._names = names
            self.clear()
            for buffer in buffers:
                self.addItem(buffer.label, buffer.name)
                self.setItemData(self.count() - 1, buffer.description, Qt.ItemDataRole.ToolTipRole)
            self.setEnabled(len(names) > 1)
        self.setCurrentIndex(self.findData(chosen))

    @Slot(int)
    def _choose(self, index: int) -> None:
        self.buffer_chosen.emit(self.itemData(index))
