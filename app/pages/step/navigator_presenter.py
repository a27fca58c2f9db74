"""The navigator over the grid: the scene in small, and which part of it the grid magnifies.

Until the run is done it shows the outline of the scene alone: its colours are still to come.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPoint, QPointF, QRectF, QTimer, Slot
from PySide6.QtGui import QImage, QPolygonF

from app.pages.page_bar import Page
from app.session.document import Document
from app.session.document_edits import LatestCall
from app.session.moment import Moment
from app.session.session import Session
from app.views.scene_frames import SceneWorker
from core import STAGES
from core.fast_path.draw import draw_picture
from core.framebuffer.display import Bytes
from core.records.arrays import Floats
from core.scene import AnyScene
from core.settings import Settings
from widgets.basics.image import display_image, transparent_image
from widgets.grid.insets import Navigator
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView

LONGER_SIDE = 320
"""Pixels of the small picture's longer side."""
DRAWN_AFTER_MS = 150
"""The picture is drawn anew when nothing has changed for so long: not at every move of a drag."""
MARGIN = 8
AXIS = 32
"""Width and height of the numbers beside the raster, in logical pixels."""
OUTLINE = (128, 128, 128)
"""Colour of the outline, 3 : 1 on both themes."""
INSIDE = 0.25
"""How much of this colour the inside has."""
PART_OF_GRID = 0.3
"""Part of the grid's shorter side that the navigator takes at most."""


class NavigatorPresenter(QObject):
    """Shows the navigator while the grid shows less than the whole picture, and moves what it shows."""

    def __init__(self, session: Session, navigator: Navigator, grid: PixelGrid, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session, self._navigator, self._grid = session, navigator, grid
        self._moment = session.moment
        self._is_wanted = True
        self._gestures = 0
        self._drawn: tuple[AnyScene, Settings] | None = None
        self._pictures: tuple[QImage, QImage] | None = None
        """The outline and the finished picture."""
        self._worker = SceneWorker(self)
        self._worker.done.connect(self._take_picture)
        self._pause = QTimer(self, singleShot=True, interval=DRAWN_AFTER_MS)
        self._pause.timeout.connect(self._draw)
        self._moves = LatestCall(self._move, self)
        navigator.region_moved.connect(self._moves.call)
        navigator.drag_ended.connect(self._end_move)
        navigator.hide()
        grid.installEventFilter(self)
        grid.view_changed.connect(self._show)

    def set_wanted(self, is_wanted: bool) -> None:
        """Show it where there is something to navigate, or never."""
        self._is_wanted = is_wanted
        self._show()

    @property
    def is_wanted(self) -> bool:
        """Whether it is shown where there is something to navigate."""
        return self._is_wanted

    @property
    def is_drawing(self) -> bool:
        """Whether the picture is still to come."""
        return self._pause.isActive() or self._worker.is_busy

    def stop(self) -> None:
        """Draw no more."""
        self._pause.stop()
        self._worker.stop()

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Keep to the corner of the grid."""
        if watched is self._grid and event.type() in (QEvent.Type.Resize, QEvent.Type.Show):
            self._show()
        return False

    def refresh(self, moment: Moment) -> None:
        """Show what the grid shows of the picture; nothing of it where that is all, or is to be predicted."""
        self._moment = moment
        self._show()

    @Slot()
    def _show(self) -> None:
        region = self._seen()
        is_whole = region.width() > 0.999 and region.height() > 0.999
        is_shown = self._is_wanted and not is_whole and not self._moment.is_predicting
        if self._navigator.hasFocus() and not is_shown:
            self._grid.setFocus()
        self._navigator.setVisible(is_shown)
        if not is_shown:
            return
        document = self._moment.document
        width, height = document.scene.size
        most = round(PART_OF_GRID * min(self._grid.width(), self._grid.height()))
        self._navigator.show_shape(width / height, most)
        self._navigator.show_region(region, _words(region, document))
        self._navigator.show_triangle(self._focus_corners())
        self._place()
        if self._drawn != (document.scene, document.settings):
            self._pause.start()

    def _seen(self) -> QRectF:
        """Return the part of the picture that the grid shows."""
        document, view = self._moment.document, self._grid.view()
        placement = self._grid.placement()
        column0, row0, column1, row1 = placement.visible_cells()
        left, bottom, columns, rows = _region_of(document)
        if view.zoom <= 1.0:
            return QRectF(left, bottom, columns, rows)
        raster = document.raster
        part = QRectF(
            column0 / raster.columns,
            row0 / raster.rows,
            (column1 - column0) / raster.columns,
            (row1 - row0) / raster.rows,
        )
        return QRectF(
            left + part.left() * columns,
            bottom + part.top() * rows,
            part.width() * columns,
            part.height() * rows,
        )

    def _focus_corners(self) -> Floats | None:
        """Return the corners (C, 2) of the triangle in focus as parts of the picture, if it has a place there."""
        document = self._moment.document
        if document.triangle is None:
            return None
        vertices = self._moment.trace.source.geometry.vertices
        corners = vertices.corners_of(document.triangle)
        window: Floats = vertices.window[corners, :2] / document.traced_scene.size
        is_seen = (vertices.clip[corners, 3] > 0).all() and np.abs(window).max() < 100
        return window if is_seen else None

    def _place(self) -> None:
        """Put it into the corner of the grid where it hides neither the step nor a vertex, nor much of the triangle."""
        navigator, placement = self._navigator, self._grid.placement()
        inside = placement.viewport.adjusted(MARGIN, MARGIN, -MARGIN, -MARGIN)
        box = navigator.rect()
        triangle, corners = QPolygonF(), self._focus_corners()
        if corners is not None:
            own = corners * self._moment.document.traced_scene.size - np.array(placement.origin)
            triangle = QPolygonF([placement.to_widget(*corner) for corner in own.tolist()])
        raster = placement.seen_raster
        places = [
            QPoint(round(x), round(y))
            for x in (inside.right() - box.width() + 1, inside.left(), raster.left() + MARGIN)
            for y in (
                inside.top(),
                inside.bottom() - box.height() + 1,
                raster.bottom() - MARGIN - box.height(),
            )
        ]
        axes = (
            QRectF(raster.left() - AXIS, raster.top(), AXIS, raster.height()),
            QRectF(raster.left(), raster.bottom(), raster.width(), AXIS),
        )
        step = self._step_cell()

        def hidden(place: QPoint) -> tuple[bool, int, int, float]:
            own = QRectF(place, box.size())
            part = triangle.intersected(QPolygonF(own))
            corners = sum(map(own.contains, triangle.toList()))
            return own.intersects(step), corners, sum(map(own.intersects, axes)), _area(part)

        navigator.move(min(places, key=hidden))
        navigator.raise_()

    def _step_cell(self) -> QRectF:
        """Return the cell of the step just done in the grid; an empty one where it has none."""
        moment = self._moment
        if moment.pixel is None:
            return QRectF()
        return self._grid.placement().cells_rect(*moment.place_of(moment.pixel))

    def follow_step(self, moment: Moment) -> None:
        """Show no more than is done, and go to another corner where the step just done would be hidden."""
        self._moment = moment
        self._show_picture()
        if self._navigator.isVisible() and self._step_cell().intersects(QRectF(self._navigator.geometry())):
            self._place()

    @Slot()
    def _draw(self) -> None:
        document = self._moment.document
        scale = LONGER_SIDE / max(document.scene.size)
        width, height = (max(round(side * min(scale, 1.0)), 1) for side in document.scene.size)
        self._drawn = document.scene, document.settings
        self._worker.start(
            partial(_draw_both, replace(document.scene, size=(width, height)), document.settings)
        )

    @Slot(object)
    def _take_picture(self, drawn: tuple[Bytes, Bytes]) -> None:
        outline, finished = drawn
        self._pictures = transparent_image(outline), display_image(finished)
        self._show_picture()

    def _show_picture(self) -> None:
        """Show the finished picture at the end of the run, and before that the outline."""
        moment, pictures = self._moment, self._pictures
        if pictures is not None and self._navigator.isVisible():
            is_done = moment.cursor.stage == STAGES[-1] and moment.is_stage_done
            self._navigator.show_picture(pictures[is_done])

    # Acting.

    def _move(self, x: float, y: float) -> None:
        """Bring the middle of what is seen to a place of the picture: pan the grid, and move its region."""
        document, view = self._session.latest, self._grid.view()
        left, bottom, columns, rows = _region_of(document)
        if document.raster.origin is not None:
            width, height = document.scene.size
            raster = document.raster
            origin = (
                _kept(round(x * width - view.x * raster.columns), width - raster.columns),
                _kept(round(y * height - view.y * raster.rows), height - raster.rows),
            )
            if origin != raster.origin:
                moved = replace(document, raster=replace(raster, origin=origin))
                self._session.edit(moved, f"move the region {self._gestures}")
        else:
            self._grid.change_view(GridView((x - left) / columns, (y - bottom) / rows, view.zoom))

    @Slot()
    def _end_move(self) -> None:
        self._moves.flush()
        self._gestures += 1
        region, corners = QRectF(*_region_of(self._session.latest)), self._focus_corners()
        if corners is not None:
            low, high = corners.min(axis=0).tolist(), corners.max(axis=0).tolist()
            if not region.intersects(QRectF(QPointF(*low), QPointF(*high))):
                triangle = self._session.document.triangle
                self._page.tell(f"Triangle {triangle} is not in this region. F goes back to it.")


def _draw_both(scene: AnyScene, settings: Settings) -> tuple[Bytes, Bytes]:
    """Return the outline (H, W, 4) uint8 of what is drawn, transparent elsewhere, and the picture, sRGB."""
    bare = draw_picture(replace(scene, background=np.zeros(4)), settings).pixels
    finished = bare if not np.any(scene.background) else draw_picture(scene, settings).pixels
    inside = np.pad(bare[..., 3] > 0, 1)
    middle = inside[1:-1, 1:-1]
    around = inside[:-2, 1:-1] & inside[2:, 1:-1] & inside[1:-1, :-2] & inside[1:-1, 2:]
    outline = np.zeros_like(bare)
    outline[..., :3] = OUTLINE
    outline[..., 3] = np.where(middle, np.where(around, round(255 * INSIDE), 255), 0)
    return outline, finished


def _area(polygon: QPolygonF) -> float:
    x, y = np.array([(point.x(), point.y()) for point in polygon.toList()]).reshape(-1, 2).T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _region_of(document: Document) -> tuple[float, float, float, float]:
    """Return left, bottom, width and height of the raster as parts of the picture."""
    region = document.region
    if region is None:
        return 0.0, 0.0, 1.0, 1.0
    width, height = document.scene.size
    return region[0] / width, region[1] / height, region[2] / width, region[3] / height


def _kept(place: int, most: int) -> int:
    return min(max(place, 0), most)


def _words(region: QRectF, document: Document) -> str:
    """Say which pixels a region holds."""
    width, height = document.traced_scene.size
    columns = round(region.left() * width), round(region.right() * width) - 1
    rows = round(region.top() * height), round(region.bottom() * height) - 1
    return f"Columns {columns[0]} to {columns[1]} of {width}, rows {rows[0]} to {rows[1]} of {height}"
