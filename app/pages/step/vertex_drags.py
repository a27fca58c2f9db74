"""Vertices dragged in pixel grids: the scene follows, and one drag is undone as a whole."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from PySide6.QtCore import QObject

from app.pages.page_bar import Page
from app.pages.step.grid_records import outlined_triangles
from app.session.document import Document
from app.session.drag_gestures import DragGestures
from app.session.session import Session
from lessons.scene_edits import move_corner
from widgets.grid.pixel_grid import PixelGrid


class VertexDrags(QObject):
    """Takes the drags in grids that show ``app.pages.step.grid_records.geometry_of`` to the session."""

    def __init__(
        self,
        session: Session,
        grids: Sequence[PixelGrid],
        focus: Callable[[], int | None],
        take: Callable[[Document, str], None],
        name: str,
        page: Page,
    ) -> None:
        """Listen to the grids.

        Parameters
        ----------
        focus : callable
            Returns the triangle with handles where the document has none in focus.
        take : callable
            Takes over a moved document and its gesture: ``Session.drag``, or ``Session.edit`` where the whole picture
            is looked at.
        name : str
            Of these drags, other than of those in other views.
        """
        super().__init__(page)
        self._page = page
        self._session, self._focus, self._take = session, focus, take
        self._drags = DragGestures(session, name, self._move, self)
        for grid in grids:
            grid.vertex_dragged.connect(self._drags.drag)
            grid.vertex_drag_finished.connect(self._drags.end)
            grid.vertex_drag_taken_back.connect(self._drags.take_back)

    def _move(self, vertex: int, x: float, y: float) -> None:
        document, latest, trace = self._session.document, self._session.latest, self._session.trace
        first_column, first_row, _, _ = trace.source.raster.bounds
        wanted = document.triangle if document.triangle is not None else self._focus()
        place, corner = divmod(vertex, trace.source.scene.corner_count)
        triangle = int(outlined_triangles(trace, wanted)[place])
        position, size = (x + first_column, y + first_row), document.traced_scene.size
        try:
            scene = move_corner(latest.scene, triangle, corner, position, size)
            self._take(replace(latest, scene=scene), self._drags.name)
        except ValueError as error:
            self._page.refuse(f"The vertex was not moved: {error}")
