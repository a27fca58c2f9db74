"""What the corner of the 3D view says of its pictures: how often they come, and what the last one took."""

from PySide6.QtCore import QObject, Qt, QTimer, Slot

from app.views.scene_figures import drawing_text, figures_text
from app.views.scene_picture import DrawnScene
from core.records.nouns import nouns
from widgets.space.frame_corner import FrameRate
from widgets.space.scene_view import SceneView

FIGURES_MS = 200
"""Figures change at most this often: faster, nobody could read them."""


class FrameReport(QObject):
    """Counts the pictures that are painted, and shows the figures of the newest."""

    def __init__(self, view: SceneView, parent: QObject) -> None:
        super().__init__(parent)
        self._view = view
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(FIGURES_MS)
        self._timer.timeout.connect(self._tell)
        self.begin_anew()
        # Queued: what the figures change is not to be laid out while the view is painted.
        view.picture_painted.connect(self._count, Qt.ConnectionType.QueuedConnection)

    def begin_anew(self) -> None:
        """Forget the pictures of another scene."""
        self._rate = FrameRate()
        self._has_new = False
        self._drawn: DrawnScene | None = None
        self._view.show_figures("")

    def take(self, drawn: DrawnScene) -> None:
        """Report of this picture from now on."""
        self._drawn = drawn

    def stop(self) -> None:
        """Report no more."""
        self._timer.stop()

    @Slot(float)
    def _count(self, seconds: float) -> None:
        """Take a picture that was painted, and report its figures unless others were reported just now."""
        self._rate.add(seconds)
        self._has_new = True
        if not self._timer.isActive():
            self._tell()

    @Slot()
    def _tell(self) -> None:
        if self._has_new and self._drawn is not None:
            self._has_new = False
            self._timer.start()
            drawn = nouns(self._drawn.shot.scene.corner_count)
            self._view.show_figures(figures_text(self._drawn.figures, self._rate.per_second(), drawn))
            self._view.corner().show_details(drawing_text(self._drawn.figures))
