"""The colour range of the main grid in two numbers: a legend that opens the control of the range."""

from PySide6.QtCore import QSize, Qt, Slot
from PySide6.QtGui import QIcon, QImage, QPixmap
from PySide6.QtWidgets import QToolButton, QWidget

from widgets.basics.colormaps import colormap_table
from widgets.basics.image import value_range
from widgets.grid.buffer import GridBuffer, number_text
from widgets.grid.range_control import RangeControl

_BAND = QSize(40, 10)


class RangeButton(QToolButton):
    """Shows the colours and both ends of the range; the control opens below it, over the grid."""

    def __init__(self, control: RangeControl, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._control = control
        self._buffer: GridBuffer | None = None
        self._colormap = ""
        self.setCheckable(True)
        self.setProperty("flat", True)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.setIconSize(_BAND)
        self.setToolTip("The colour range of the picture: click to change it")
        self.toggled.connect(self._open)
        self.show_buffer(None)

    def show_buffer(self, buffer: GridBuffer | None) -> None:
        """Show the range of a buffer; kinds that have none leave the place empty."""
        self._buffer = buffer
        if buffer is None or buffer.kind not in ("scalar", "signed"):
            self.setChecked(False)
            self.hide()
            return
        low, high = value_range(buffer)
        text = f"{number_text(low, 3)} … {number_text(high, 3)}"
        if text != self.text():
            self.setText(text)
            self.setAccessibleName(f"Colour range {number_text(low, 3)} to {number_text(high, 3)}")
        self._show_colors(buffer.colormap)
        self.show()
        if self.isChecked():
            self._control.show_buffer(buffer)

    def _show_colors(self, colormap: str) -> None:
        if colormap == self._colormap:
            return
        self._colormap = colormap
        table = colormap_table(colormap)
        band = QImage(table.tobytes(), len(table), 1, 3 * len(table), QImage.Format.Format_RGB888)
        self.setIcon(QIcon(QPixmap.fromImage(band.scaled(_BAND))))

    @Slot(bool)
    def _open(self, is_open: bool) -> None:
        if is_open:
            self._control.show_buffer(self._buffer)
        self._control.setVisible(is_open)
