"""The views beside the pixel grid: the 3D scene and `VIEWS`. Only what is seen is drawn."""

from collections.abc import Mapping

from PySide6.QtCore import QEvent, QObject, Signal
from PySide6.QtWidgets import QWidget

from app.session.moment import Moment
from app.session.session import Session
from app.views.flow_view import FlowView
from app.views.scene3d_presenter import Scene3dPresenter
from app.views.stage_view import ClipView, PyramidView, StageView, TextureView
from widgets.space.orbit import Orbit
from widgets.space.orbit_area import OrbitArea
from widgets.space.scene_view import SceneView

VIEWS: tuple[type[StageView], ...] = (
    ClipView,
    PyramidView,
    TextureView,
    FlowView,
)
"""The views behind the 3D scene, in the order of their tabs."""


class StageViews(QObject):
    """Makes the 3D view and all others, and keeps the visible ones up to date."""

    triangle_picked = Signal(int)
    """A triangle of the scene was clicked in the 3D view."""
    refused = Signal(str)
    """Why a drag in a view did nothing."""
    message_sent = Signal(str)
    """What a click in a view found."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._moment = session.moment
        self._scene = SceneView()
        self._others = {view.name: view for view in (make(session) for make in VIEWS)}
        self._views: dict[str, QWidget] = {
            "scene": self._scene,
            **{name: view.widget for name, view in self._others.items()},
        }
        self._stale = set(self._views)
        self._scene_presenter = Scene3dPresenter(session, self._scene, self)
        self._scene_presenter.triangle_picked.connect(self.triangle_picked)
        self._scene_presenter.refused.connect(self.refused)
        self._scene_presenter.message_sent.connect(self.message_sent)
        for widget in self._views.values():
            widget.installEventFilter(self)

    @property
    def widgets(self) -> list[tuple[str, str, QWidget]]:
        """Name, title and widget of every view, in order."""
        others = [(name, view.title, view.widget) for name, view in self._others.items()]
        return [("scene", "3D scene", self._scene), *others]

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

    def show_figures(self, is_shown: bool) -> None:
        """Say below the 3D scene what it shows and in its corner what each picture took, or leave it out."""
        self._scene.corner().set_wanted(is_shown)
        self._scene.show_caption(is_shown)

    def chosen_orbits(self) -> dict[str, Orbit]:
        """Return from where the views in space are seen that the user has turned, by their names."""
        found = {
            name: widget.chosen_orbit()
            for name, widget in self._views.items()
            if isinstance(widget, OrbitArea)
        }
        return {name: orbit for name, orbit in found.items() if orbit is not None}

    def look_from(self, orbits: Mapping[str, Orbit]) -> None:
        """Look from there in these views in space, and in the others from where they are first seen."""
        for name, widget in self._views.items():
            if isinstance(widget, OrbitArea):
                if name in orbits:
                    self._refresh(name)  # What is seen first would be seen from where it is first seen.
                widget.look_from(orbits.get(name))

    def look_at_focus(self) -> None:
        """Magnify the triangle in focus in the 3D view."""
        self._scene_presenter.look_at_focus()

    def look_home(self) -> None:
        """Show the whole scene in the 3D view again."""
        self._scene_presenter.look_home()

    def stop(self) -> None:
        """End drawing in the background."""
        self._scene_presenter.stop()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Bring a view up to date when it appears."""
        if watched is self._scene and event.type() == QEvent.Type.Show:
            self._scene_presenter.appear()
        if event.type() == QEvent.Type.Show:
            for name, widget in self._views.items():
                if widget is watched and name in self._stale:
                    self._refresh(name)
        return False

    def refresh(self, moment: Moment) -> None:
        """Bring the visible views up to date, and remember that the others are not."""
        self._moment = moment
        for name, widget in self._views.items():
            if widget.isVisible():
                self._refresh(name)
            else:
                self._stale.add(name)

    def _refresh(self, name: str) -> None:
        self._stale.discard(name)
        if name in self._others:
            self._others[name].refresh(self._moment)
        else:
            self._scene_presenter.refresh(self._moment)
