"""What can be done with one pixel: the menu of a right click in a grid."""

from PySide6.QtCore import QObject, QPoint, Signal, Slot
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QWidget

from app.pages.step.stepping_presenter import SteppingPresenter
from app.session.session import Session
from core import STAGES
from core.stages.declared import stage_of


class PixelMenu(QObject):
    """Pins the pixel, sets breakpoints at it, and goes to the first step of any stage that touches it."""

    origin_requested = Signal()
    """The user asks where the value of the pixel, which is pinned by now, comes from."""
    question_requested = Signal()
    """The value of the pixel, which is pinned by now, is to become a question."""

    def __init__(self, session: Session, stepping: SteppingPresenter, parent: QWidget) -> None:
        super().__init__(parent)
        self._session, self._stepping = session, stepping
        self.menu = QMenu(parent)
        self.menu.triggered.connect(self._run)
        self._pixel = (0, 0)

    @Slot(int, int, QPoint)
    def open_at(self, column: int, row: int, place: QPoint) -> None:
        """Offer what can be done with a pixel of the grid."""
        self.fill(column, row)
        self.menu.popup(place)

    def fill(self, column: int, row: int) -> None:
        """Make the entries for a pixel of the grid."""
        self._pixel = self._session.moment.pixel_at(column, row)
        self.menu.clear()
        heading = self.menu.addAction(f"Pixel ({self._pixel[0]}, {self._pixel[1]})")
        heading.setEnabled(False)
        is_pinned = self._session.pin == self._pixel
        self._add("Remove the pin" if is_pinned else "Pin", "pin")
        has_breakpoint = self._pixel in self._stepping.breaks.pixels
        self._add("Remove the breakpoint" if has_breakpoint else "Breakpoint", "breakpoint")
        self._add("Where does this value come from?", "origin")
        self._add("Ask for this value", "ask")
        self.menu.addSeparator()
        for stage in STAGES[STAGES.index("raster") :]:
            self._add(f"Step here in {stage_of(stage).short_title}", stage)

    def _add(self, text: str, name: str) -> None:
        self.menu.addAction(text).setData(name)

    @Slot(QAction)
    def _run(self, action: QAction) -> None:
        name = action.data()
        if name == "pin":
            self._session.set_pin(None if self._session.pin == self._pixel else self._pixel)
        elif name == "breakpoint":
            self._session.set_pin(self._pixel)
            self._stepping.toggle_pixel_breakpoint()
        elif name == "origin":
            self._session.set_pin(self._pixel)
            self.origin_requested.emit()
        elif name == "ask":
            self._session.set_pin(self._pixel)
            self.question_requested.emit()
        else:
            self._session.set_pin(self._pixel)
            self._stepping.step_into(name, *self._pixel)
