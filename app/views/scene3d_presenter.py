"""The 3D view of the session: draws while the user turns it, picks triangles, and drags vertices."""

from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.session.document import Document
from app.session.document_edits import DragGestures
from app.session.moment import Moment
from app.session.session import Session
from app.views.pointed_pixel import pixel_marks, pointed_pixels
from app.views.scene_frames import OWN_SIZE, FrameReport, SceneWorker, fixed_size, size_choices
from app.views.scene_picture import (
    MOST_TRIANGLES,
    DrawnScene,
    HiddenBacks,
    SceneShot,
    Thinning,
    draw_thinned,
    fractions,
    moved_parallel,
    space_words,
    triangle_seen,
)
from app.views.view_space import (
    LARGEST_WITH_CAMERA,
    ViewSpace,
    fitted_home,
    is_scene_asked,
    is_scene_lit,
    make_space,
    move_corner_to,
    step_marks,
)
from core.families import mirrors_of
from core.fast_path.workers.band_workers import BandWorkers
from core.records.arrays import Integers
from core.records.words import counted, nouns
from core.scene import AnyScene, Scene
from core.stages.chosen_triangles import with_triangles
from core.transform.traced import is_dropped
from widgets.basics.theme import current_theme, theme_notifier
from widgets.space.orbit import Orbit, fitted
from widgets.space.scene_view import SceneHandle, SceneMark, ScenePicture, SceneView

DRAWING = "Drawing…"
ASKED = "Hidden while an exercise asks about this scene."


class Scene3dPresenter(QObject):
    """Shows the session's scene in a :class:`~widgets.space.scene_view.SceneView`.

    Every picture is drawn whole and off the GUI thread. While one is drawn, the user goes on turning; the next one
    is that of the newest orbit. What lies over a picture is placed by the orbit that it was drawn from.

    Pictures are drawn in this process unless `draw_with` gives workers.
    """

    triangle_picked = Signal(int)
    """A triangle that was clicked."""
    refused = Signal(str)
    """Why a drag did nothing, or a picture could not be drawn."""
    message_sent = Signal(str)
    """What a click found."""

    def __init__(self, session: Session, view: SceneView, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._moment, self._view = session, session.moment, view
        self._space: ViewSpace | None = None
        self._document: Document | None = None
        self._drawn: DrawnScene | None = None
        self._drawn_state = (False, False, b"")
        self._home = Orbit()
        self._size_name = OWN_SIZE
        self._is_picture_due = False
        """Whether a picture is to be asked for as soon as the view is seen and has its size."""
        self._entered: int | None = None
        """A triangle that was clicked to go into it, until it is in focus."""
        self._band_workers, self._backs, self._thinning = BandWorkers(1), HiddenBacks(), Thinning()
        self._worker, self._picker = SceneWorker(self), SceneWorker(self)
        self._worker.done.connect(self._take_drawn)
        self._worker.failed.connect(self.refused)
        self._picker.done.connect(self._take_picked)
        self._picker.failed.connect(self.refused)
        self._settled = QTimer(self)
        self._settled.setSingleShot(True)
        self._settled.timeout.connect(self._ask_for_picture)
        self._report = FrameReport(view, self)
        view.view_changed.connect(self._turned)
        view.size_changed.connect(self._resized)
        view.size_chosen.connect(self.choose_size)
        view.picked.connect(self._pick)
        self._drags = DragGestures(session, "drag in space", self._move, self)
        view.vertex_dragged.connect(self._drags.drag)
        view.vertex_drag_finished.connect(self._drags.end)
        view.vertex_drag_taken_back.connect(self._drags.take_back)
        theme_notifier().theme_changed.connect(self._theme_changed)

    def refresh(self, moment: Moment) -> None:
        """Show the document and its step."""
        self._moment, document = moment, moment.document
        if self._document is document and self._space is not None:
            self.refresh_marks()
            if self._state() != self._drawn_state:
                self._draw()
            return
        before = self._document
        self._document, source = document, moment.trace.source
        self._space = make_space(source.scene, source.geometry.vertices)
        if before is None or _place_of(before) != _place_of(document):
            self._begin_anew()
        self._view.set_caption(self._caption())
        self.refresh_marks()
        self._enter_picked()
        self._draw()

    def _state(self) -> tuple[bool, bool, bytes]:
        """Return what of the run the picture depends on: if it is hidden, if shaded, which triangles are dropped."""
        cursor = self._moment.cursor
        dropped = is_dropped(self._moment.trace, cursor.stage, cursor.position)
        return is_scene_asked(self._moment), is_scene_lit(self._moment), dropped.tobytes()

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
            self._draw()

    def look_home(self) -> None:
        """Show the whole scene from where it is first seen."""
        self._go_home()
        self._draw()

    def refresh_marks(self) -> None:
        """Show pin, hover and corners over the present picture."""
        if self._drawn is not None:
            self._show(self._drawn)

    def appear(self) -> None:
        """Draw at the size that the view has now that it comes in sight."""
        is_other_size = self._drawn is not None and self._drawn.shot.size != self._view.picture_size()
        if self._is_picture_due or is_other_size:
            self._resized()

    @Slot(str)
    def choose_size(self, name: str) -> None:
        """Draw at a size of ``app.views.scene_frames``, by its name."""
        self._size_name = name
        self._offer_sizes()

    def draw_with(self, workers: BandWorkers) -> None:
        """Let workers draw parts of the pictures that are worth it, from the next one on; `stop` closes them."""
        self._band_workers.close()
        self._band_workers = workers

    def stop(self) -> None:
        """End drawing, and the worker processes."""
        self._settled.stop()
        self._report.stop()
        self._worker.forget()
        self._band_workers.close()  # first: a picture may be waiting for a process that has stopped
        self._worker.stop()
        self._picker.stop()

    @property
    def space(self) -> ViewSpace | None:
        """What is shown."""
        return self._space

    @property
    def drawn(self) -> DrawnScene | None:
        """The present picture."""
        return self._drawn

    @property
    def is_drawing(self) -> bool:
        """Whether a newer picture is still to come."""
        return self._settled.isActive() or self._worker.is_busy

    @property
    def focus(self) -> int | None:
        """The triangle whose vertices can be dragged."""
        document = self._moment.document
        return 0 if document.triangle is None and document.triangle_count == 1 else document.triangle

    # Drawing.

    def _begin_anew(self) -> None:
        """Forget the pictures of another scene, and look at the whole of this one."""
        self._show_nothing(DRAWING)
        self._offer_sizes()
        self._go_home()

    def _show_nothing(self, why: str) -> None:
        """Forget the pictures, and say why none is seen."""
        self._settled.stop()
        self._is_picture_due = False
        self._worker.forget()
        self._picker.forget()
        self._drawn = None
        self._report.begin_anew()
        self._view.empty_text = why
        self._view.show_picture(None)

    def _draw(self) -> None:
        """Have a picture drawn of what is to be seen, once the view is in sight and everything is laid out."""
        was_hidden = self._drawn_state[0]
        self._drawn_state = self._state()
        if self._drawn_state[0] or was_hidden:
            self._show_nothing(ASKED if self._drawn_state[0] else DRAWING)
        if self._drawn_state[0]:
            return
        self._is_picture_due = True
        if self._view.isVisible():
            self._settled.start(0)

    @Slot()
    def _ask_for_picture(self) -> None:
        """Ask for a picture of what is to be seen now."""
        if self._space is None or not self._view.isVisible():
            return
        self._is_picture_due = False
        thickness = self._view.pixels_per_point() * current_theme().text_px / 13
        scene, numbers = self._scene_left()
        shot = SceneShot(
            self._space,
            scene,
            numbers,
            self._moment.document.settings,
            self._view.orbit(),
            self._view.picture_size(),
            self.focus,
            thickness,
            current_theme(),
            self._drawn_state[1],
        )
        self._worker.start(partial(draw_thinned, shot, self._thinning, self._band_workers, self._backs))

    def _scene_left(self) -> tuple[AnyScene, Integers | None]:
        """Return the scene without the triangles that are dropped by now, and the numbers of those left."""
        cursor, trace = self._moment.cursor, self._moment.trace
        dropped = is_dropped(trace, cursor.stage, cursor.position)
        assert self._space is not None
        scene = self._space.drawn
        if self.focus is not None or not dropped.any() or dropped.all():
            return scene, None
        left = trace.source.geometry.assembled.triangle[~dropped]
        return with_triangles(scene, left), left

    @Slot(object)
    def _take_drawn(self, drawn: DrawnScene) -> None:
        if self._document is not self._session.document:
            return  # of what was open before; the view is hidden, and is brought up to date when it is shown
        self._drawn = drawn
        self._report.take(drawn)
        self._show(drawn)

    def _show(self, drawn: DrawnScene) -> None:
        space, matrix = self._space, drawn.matrix
        if space is None:
            return
        handles = []
        if self.focus is not None:
            corners = space.corners(self.focus)[: space.scene.corner_count]
            for index, (x, y) in enumerate(fractions(matrix, corners).tolist()):
                if np.isfinite([x, y]).all():
                    handles.append(SceneHandle(index, x, y, space.vertices.colors[index]))
        words = space_words(space)
        places = fractions(matrix, np.stack([place for place, _ in words]))
        labels = tuple(
            (x, y, text, "muted_text")
            for (x, y), (_, text) in zip(places.tolist(), words, strict=True)
            if 0 <= x <= 1 and 0 <= y <= 1
        )
        found = step_marks(self._moment, space)
        points = fractions(matrix, np.concatenate([np.empty((0, 3)), *(mark.points for mark in found)]))
        ends = np.cumsum([len(mark.points) for mark in found])[:-1]
        marks = [
            SceneMark(of_mark, mark.ink, mark.label, mark.shape)
            for mark, of_mark in zip(found, np.split(points, ends), strict=False)
        ]
        marks += pixel_marks(self._moment.trace.source, space, matrix, pointed_pixels(self._moment))
        picture = ScenePicture(
            drawn.pixels, tuple(handles), tuple(marks), labels, self._caption(), drawn.sight
        )
        self._view.show_picture(picture)

    # Sizes.

    def _offer_sizes(self) -> None:
        """Show the sizes that there are, and have the chosen one drawn."""
        size = self._moment.document.scene.size
        self._view.show_sizes(size_choices(size), self._size_name)
        self._view.fix_picture_size(fixed_size(self._size_name, size))

    def _caption(self) -> str:
        document = self._moment.document
        count = document.triangle_count
        drawn = nouns(document.scene.corner_count)
        parts = [f"{counted(count, drawn.one, drawn.many)}."]
        if count > LARGEST_WITH_CAMERA:
            parts.append("Click a {one}, or press F, to go into it. Shift+F comes back.")
        elif isinstance(document.scene, Scene):
            parts.append("Camera and view volume are drawn as lines, the near plane thick.")
            parts.append("Mirrors have their own colour here." if mirrors_of(document.scene) else "")
        else:
            parts.append("Given in clip space: the box is the view volume, its near face in front.")
        if self.focus is not None:
            parts.append("Drag {a_vertex} to move it." if not document.scene.makes_positions else "")
        elif count <= LARGEST_WITH_CAMERA:
            parts.append("Click a {one} to choose it.")
        if count > MOST_TRIANGLES:
            parts.append(f"One in {-(-count // MOST_TRIANGLES)} is drawn.")
        return drawn.text(" ".join(filter(None, parts)))

    # Acting.

    def _go_home(self) -> None:
        """Look at the whole space from where it is first seen."""
        if self._space is not None:
            self._home = self._fitted_home(self._space)
            self._view.set_home(self._home)
            self._view.set_orbit(self._home)

    def _fitted_home(self, space: ViewSpace) -> Orbit:
        """Return the orbit that shows the whole space in the picture as it is now."""
        width, height = self._view.picture_size()
        return fitted_home(space, width / height)

    @Slot(object)
    def _turned(self, orbit: Orbit) -> None:
        self._draw()

    @Slot()
    def _resized(self) -> None:
        if self._space is None or not self._view.isVisible():
            return
        is_at_home, self._home = self._view.orbit() == self._home, self._fitted_home(self._space)
        self._view.set_home(self._home)
        if is_at_home:
            self._view.set_orbit(self._home)
        self._draw()

    @Slot(object)
    def _theme_changed(self, theme: object) -> None:
        self._draw()

    @Slot(int, int)
    def _pick(self, column: int, row: int) -> None:
        if self._drawn is not None:
            self._picker.start(partial(triangle_seen, self._drawn.shot, column, row))

    @Slot(object)
    def _take_picked(self, triangle: int) -> None:
        if triangle < 0:
            drawn = nouns(self._moment.document.scene.corner_count)
            self.message_sent.emit(
                f"No {drawn.one} is here: a click on one chooses it, a drag turns the scene."
            )
            return
        is_model = self._moment.document.triangle_count > LARGEST_WITH_CAMERA
        self._entered = triangle if is_model else None
        if triangle == self.focus:
            self._enter_picked()
        else:
            self.triangle_picked.emit(triangle)

    def _enter_picked(self) -> None:
        """Magnify a triangle of a model that was clicked, once it is in focus: the model is too large to see it."""
        if self._entered is not None and self._entered == self.focus:
            self._entered = None
            self.look_at_focus()

    def _move(self, index: int, x: float, y: float) -> None:
        latest, space, triangle = self._session.latest, self._space, self.focus
        if space is None or triangle is None or self._drawn is None:
            return
        place = moved_parallel(self._drawn.matrix, space.corners(triangle)[index], x, y)
        try:
            moved = move_corner_to(replace(space, scene=latest.scene), triangle, index, place)
        except ValueError as error:
            self.refused.emit(str(error))
            return
        self._session.drag(replace(latest, scene=moved), self._drags.name)


def _place_of(document: Document) -> tuple[str, str, int, bool]:
    """Return what stays the same while one scene is edited."""
    return document.title, document.path, document.triangle_count, isinstance(document.scene, Scene)
