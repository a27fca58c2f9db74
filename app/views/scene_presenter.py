"""The 3D view of the session: draws while the user turns it, picks triangles, and drags vertices."""

from dataclasses import replace

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.document import Document
from app.session import Session
from app.views.pixel_ray import pixel_marks
from app.views.pointed_pixel import pointed_pixels
from app.views.scene_lines import SpaceLine
from app.views.scene_picture import (
    DrawnScene,
    draw_scene,
    fractions,
    moved_parallel,
    space_lines,
    space_words,
)
from app.views.scene_worker import SceneWorker
from app.views.vertex_drag import move_corner_to
from app.views.view_space import ViewSpace, make_space, thinned
from core.arrays import Integers
from core.scene import AnyScene, Scene
from widgets.orbit import Orbit, fitted
from widgets.scene_view import SceneHandle, ScenePicture, SceneView
from widgets.theme import current_theme, theme_notifier

DRAFT_SECONDS = 0.04
"""What a picture may take while it is turned; if it takes more, the next ones are coarser."""
COARSEST = 3
DRAFT_TRIANGLES = 9000
"""A scene of more triangles is thinned while it is turned."""
FULL_TRIANGLES = 600_000
"""A scene of more is thinned to so many at rest too."""
REST_MS = 140
"""When the view has rested so long, the whole picture is drawn."""


class ScenePresenter(QObject):
    """Shows the session's scene in a :class:`~widgets.scene_view.SceneView`."""

    triangle_picked = Signal(int)
    """A triangle that was clicked."""
    refused = Signal(str)
    """Why a drag did nothing, or a picture could not be drawn."""

    def __init__(self, session: Session, view: SceneView, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._view = session, view
        self._space: ViewSpace | None = None
        self._document: Document | None = None
        self._drafts: tuple[AnyScene, Integers | None] | None = None
        self._drawn: DrawnScene | None = None
        self._scale = 2
        self._drags = 0
        self._worker = SceneWorker(self)
        self._worker.drawn.connect(self._take_drawn)
        self._worker.failed.connect(self._take_failure)
        self._rest = QTimer(self)
        self._rest.setSingleShot(True)
        self._rest.setInterval(REST_MS)
        self._rest.timeout.connect(self._draw_full)
        view.view_changed.connect(self._turned)
        view.size_changed.connect(self._resized)
        view.picked.connect(self._pick)
        view.vertex_dragged.connect(self._drag)
        view.vertex_drag_finished.connect(self._end_drag)
        theme_notifier().theme_changed.connect(self._theme_changed)

    def refresh(self) -> None:
        """Show the session's document as it is now."""
        document = self._session.document
        if self._document is document and self._space is not None:
            self.refresh_marks()
            return
        before = self._document
        self._document = document
        if before is None or self._drafts is None or before.scene is not document.scene:
            self._drafts = None
        space = make_space(document.traced_scene, self._session.trace.source.geometry.vertices)
        is_new = self._space is None or before is None or _place_of(before) != _place_of(document)
        self._space = space
        if is_new:
            self._go_home()
        self._view.set_caption(self._caption())
        self._draw_draft()

    def look_at_focus(self) -> None:
        """Magnify the triangle in focus, from the present direction."""
        if self._space is None or self.focus is None:
            return
        corners = self._space.corners(self.focus)
        if np.isfinite(corners).all():
            x, y, z = corners.mean(axis=0).tolist()
            reach = float(np.linalg.norm(corners - corners.mean(axis=0), axis=1).max())
            width, height = self._view.picture_size()
            self._view.set_orbit(fitted(self._view.orbit(), (x, y, z), 2 * reach, width / height))
            self._draw_draft()

    def refresh_marks(self) -> None:
        """Show pin and hover over the present picture."""
        if self._drawn is not None:
            self._show(self._drawn)

    def stop(self) -> None:
        """End drawing."""
        self._rest.stop()
        self._worker.stop()

    @property
    def space(self) -> ViewSpace | None:
        """What is shown."""
        return self._space

    @property
    def drawn(self) -> DrawnScene | None:
        """The present picture."""
        return self._drawn

    @property
    def focus(self) -> int | None:
        """The triangle whose vertices can be dragged."""
        document = self._session.document
        return 0 if document.triangle is None and document.triangle_count == 1 else document.triangle

    # Drawing.

    def _job(self, scene: AnyScene, numbers: Integers | None, scale: int) -> "SceneJob":
        assert self._space is not None
        return SceneJob(
            self._space,
            scene,
            numbers,
            self._session.document,
            self._view.orbit(),
            self._view.picture_size(),
            scale,
            space_lines(self._space, self.focus),
            self._view.devicePixelRatioF() * current_theme().text_px / 13,
        )

    def _draw_draft(self) -> None:
        """Draw at once, as finely as there is time for, and the whole picture when the view rests."""
        if self._space is None:
            return
        self._worker.forget()
        if self._drafts is None:
            scene = self._space.scene
            is_large = self._session.document.triangle_count > DRAFT_TRIANGLES
            self._drafts = thinned(scene, DRAFT_TRIANGLES) if is_large else (scene, None)
        scene, numbers = self._drafts
        drawn = self._job(scene, numbers, self._scale)()
        # The work is mostly per pixel; a little slack keeps the scale from swinging.
        if drawn.seconds > DRAFT_SECONDS and self._scale < COARSEST:
            self._scale += 1
        elif (
            drawn.seconds * (self._scale / max(self._scale - 1, 1)) ** 2 < 0.7 * DRAFT_SECONDS
            and self._scale > 1
        ):
            self._scale -= 1
        self._show(drawn)
        if numbers is not None or drawn.primitive.shape != drawn.pixels.shape[:2]:
            self._rest.start()

    @Slot()
    def _draw_full(self) -> None:
        """Draw the whole picture off the GUI thread."""
        if self._space is None:
            return
        scene, numbers = self._space.scene, None
        if self._session.document.triangle_count > FULL_TRIANGLES:
            scene, numbers = thinned(scene, FULL_TRIANGLES)
        self._worker.start(self._job(scene, numbers, 1))

    @Slot(int, object)
    def _take_drawn(self, number: int, drawn: DrawnScene) -> None:
        """Show a picture, unless something has changed since it was begun."""
        if number == self._worker.latest:
            self._show(drawn)

    @Slot(int, str)
    def _take_failure(self, number: int, reason: str) -> None:
        """Say why there is no whole picture."""
        if number == self._worker.latest:
            self.refused.emit(reason)

    def _show(self, drawn: DrawnScene) -> None:
        space, orbit = self._space, self._view.orbit()
        if space is None:
            return
        self._drawn = drawn
        size = self._view.picture_size()
        handles = []
        if self.focus is not None:
            for index, (x, y) in enumerate(fractions(space, orbit, size, space.corners(self.focus)).tolist()):
                if np.isfinite([x, y]).all():
                    handles.append(SceneHandle(index, x, y))
        words = space_words(space)
        places = fractions(space, orbit, size, np.stack([place for place, _ in words]))
        labels = tuple(
            (x, y, text, "muted_text")
            for (x, y), (_, text) in zip(places.tolist(), words, strict=True)
            if 0 <= x <= 1 and 0 <= y <= 1
        )
        if drawn.part > 1:
            labels += ((0.01, 0.985, f"draft: one triangle in {drawn.part}", "muted_text"),)
        marks = pixel_marks(self._session.trace.source, space, orbit, size, pointed_pixels(self._session))
        caption = self._caption()
        self._view.show_picture(ScenePicture(drawn.pixels, tuple(handles), marks, labels, caption))

    def _caption(self) -> str:
        document = self._session.document
        count = document.triangle_count
        noun = "triangle" if count == 1 else "triangles"
        parts = [f"{count:,} {noun}."]
        if isinstance(document.scene, Scene):
            parts.append("Camera and view volume are drawn as lines, the near plane thick.")
        else:
            parts.append("Given in clip space: the box is the view volume, its near face in front.")
        if self.focus is not None:
            parts.append("Drag a corner to move it; click another triangle to choose it.")
        else:
            parts.append("Click a triangle to choose it.")
        if count > FULL_TRIANGLES:
            parts.append(f"One in {-(-count // FULL_TRIANGLES)} is drawn.")
        return " ".join(parts)

    # Acting.

    def _go_home(self) -> None:
        """Look at the whole space from where it is first seen."""
        if self._space is None:
            return
        width, height = self._view.picture_size()
        home = fitted(self._space.home, self._space.center, self._space.radius, width / height)
        self._view.set_home(home)
        self._view.set_orbit(home)

    @Slot(object)
    def _turned(self, orbit: Orbit) -> None:
        self._draw_draft()

    @Slot()
    def _resized(self) -> None:
        if self._view.isVisible():
            self._draw_draft()

    @Slot(object)
    def _theme_changed(self, theme: object) -> None:
        if self._view.isVisible():
            self._draw_draft()
        else:
            self._document = None

    @Slot(int, int)
    def _pick(self, column: int, row: int) -> None:
        triangle = self._drawn.triangle_at(column, row) if self._drawn is not None else -1
        if triangle >= 0:
            self.triangle_picked.emit(triangle)

    @Slot(int, float, float)
    def _drag(self, index: int, x: float, y: float) -> None:
        document, space, triangle = self._session.document, self._space, self.focus
        if space is None or triangle is None:
            return
        corner = space.corners(triangle)[index]
        place = moved_parallel(space, self._view.orbit(), self._view.picture_size(), corner, x, y)
        try:
            moved = move_corner_to(space, triangle, index, place)
        except ValueError as error:
            self.refused.emit(str(error))
            return
        scene = replace(moved, size=document.scene.size)
        self._session.edit(replace(document, scene=scene), f"drag in space {self._drags}")

    @Slot(int)
    def _end_drag(self, index: int) -> None:
        self._drags += 1
        self._session.end_gesture()


class SceneJob:
    """One picture to draw, with everything that it needs; it may run in another thread."""

    def __init__(
        self,
        space: ViewSpace,
        scene: AnyScene,
        numbers: Integers | None,
        document: Document,
        orbit: Orbit,
        size: tuple[int, int],
        scale: int,
        lines: tuple[SpaceLine, ...],
        thickness: float,
    ) -> None:
        self._space, self._scene, self._numbers = space, scene, numbers
        self._settings, self._orbit, self._size = document.settings, orbit, size
        self._scale, self._theme = scale, current_theme()
        self._lines = tuple(replace(line, width=max(round(line.width * thickness), 1)) for line in lines)

    def __call__(self) -> DrawnScene:
        """Draw it."""
        return draw_scene(
            self._space,
            self._scene,
            self._numbers,
            self._settings,
            self._orbit,
            self._size,
            self._scale,
            self._lines,
            self._theme,
        )


def _place_of(document: Document) -> tuple[str, str, int, bool]:
    """Return what stays the same while one scene is edited."""
    return document.title, document.path, document.triangle_count, isinstance(document.scene, Scene)
