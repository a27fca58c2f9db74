"""The stages' own views of one session: 3D scene, clip space, (x, y, w), texture. Only what is seen is drawn."""

from PySide6.QtCore import QEvent, QObject, Signal, Slot
from PySide6.QtWidgets import QWidget

from app.session.session import Session
from app.views.clip_diagram import clip_diagram, clip_state
from app.views.pointed_pixel import pointed_pixels, shown_triangle
from app.views.pyramid_diagram import pyramid_diagram
from app.views.scene3d_presenter import Scene3dPresenter
from app.views.texture_footprint import texture_pictures
from core import STAGES
from widgets.space.scene_view import SceneView
from widgets.space.texture_levels import TextureLevels
from widgets.space.view import SpaceView

TITLES = {"scene": "3D scene", "clip": "Clip space", "pyramid": "(x, y, w)", "texture": "Texture"}


class StageViews(QObject):
    """Makes the four views and keeps the visible one up to date."""

    triangle_picked = Signal(int)
    """A triangle of the scene was clicked in the 3D view."""
    refused = Signal(str)
    """Why a drag in a view did nothing."""
    frame_measured = Signal(object)
    """:class:`~app.views.scene_figures.FrameFigures` of a picture of the 3D view; None: it is not in sight."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._scene, self._clip, self._pyramid, self._texture = (
            SceneView(),
            SpaceView(),
            SpaceView(),
            TextureLevels(),
        )
        self._clip.setAccessibleName("Clip space")
        self._pyramid.setAccessibleName("Homogeneous rasterization: triangle in (x, y, w)")
        self._views: dict[str, QWidget] = {
            "scene": self._scene,
            "clip": self._clip,
            "pyramid": self._pyramid,
            "texture": self._texture,
        }
        self._stale = set(self._views)
        self._shown: dict[str, object] = {}
        """What each drawing was made from; the same again is not drawn again."""
        self._scene_presenter = Scene3dPresenter(session, self._scene, self)
        self._scene_presenter.triangle_picked.connect(self.triangle_picked)
        self._scene_presenter.refused.connect(self.refused)
        self._scene_presenter.frame_measured.connect(self.frame_measured)
        for widget in self._views.values():
            widget.installEventFilter(self)
        session.document_changed.connect(self._refresh_visible)
        session.cursor_changed.connect(self._refresh_visible)
        session.pin_changed.connect(self._refresh_visible)
        session.hover_changed.connect(self._refresh_visible)

    @property
    def widgets(self) -> list[tuple[str, str, QWidget]]:
        """Name, title and widget of every view, in order."""
        return [(name, TITLES[name], widget) for name, widget in self._views.items()]

    @property
    def scene_presenter(self) -> Scene3dPresenter:
        """What drives the 3D view."""
        return self._scene_presenter

    @property
    def is_drawing(self) -> bool:
        """Whether a picture is still being drawn in the background."""
        return self._scene_presenter.is_drawing

    def show(self, name: str) -> None:
        """Bring a view up to date, as when it is about to be seen."""
        if name not in self._views:
            raise ValueError(f"view must be one of {', '.join(self._views)}, got {name}")
        self._refresh(name)

    def look_at_focus(self) -> None:
        """Magnify the triangle in focus in the 3D view."""
        self._scene_presenter.look_at_focus()

    def stop(self) -> None:
        """End drawing in the background."""
        self._scene_presenter.stop()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Bring a view up to date when it appears, and tell the 3D view whether it is in sight."""
        if watched is self._scene and event.type() in (QEvent.Type.Show, QEvent.Type.Hide):
            self._scene_presenter.set_shown(event.type() == QEvent.Type.Show)
        if event.type() == QEvent.Type.Show:
            for name, widget in self._views.items():
                if widget is watched and name in self._stale:
                    self._refresh(name)
        return False

    @Slot()
    def _refresh_visible(self) -> None:
        """Bring the visible views up to date, and remember that the others are not."""
        for name, widget in self._views.items():
            if widget.isVisible():
                self._refresh(name)
            else:
                self._stale.add(name)

    def _refresh(self, name: str) -> None:
        self._stale.discard(name)
        session = self._session
        if name == "scene":
            self._scene_presenter.refresh()
            return
        triangle, pixels = shown_triangle(session), pointed_pixels(session)
        shown: object = (session.trace, triangle, pixels)
        if name == "clip":
            shown = (session.trace, triangle, self._clip_position())
        elif name == "pyramid":
            shown = (session.trace, triangle, pixels[:1])
        if self._shown.get(name) == shown:
            return
        self._shown[name] = shown
        if name == "clip":
            state = clip_state(session.trace, triangle, self._clip_position())
            self._clip.show_diagram(clip_diagram(state))
        elif name == "pyramid":
            pixel = pixels[0] if pixels else None
            self._pyramid.show_diagram(pyramid_diagram(session.trace.source, triangle, pixel))
        else:
            self._texture.show_pictures(*texture_pictures(session))

    def _clip_position(self) -> int | None:
        """Return how much of the clipping is done at the cursor; None: all of it."""
        cursor = self._session.cursor
        if cursor.stage == "clip":
            return cursor.position
        return 0 if STAGES.index(cursor.stage) < STAGES.index("clip") else None
