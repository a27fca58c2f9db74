"""Names of the vertices and edges of the primitive in focus, where they hide neither numbers nor each other."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from math import cos, pi, sin

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QFontMetrics

from widgets.basics.theme import Theme
from widgets.grid.geometry import HANDLE_RADIUS, RIM, GridGeometry, NameBox, name_font, towards, vertex_place
from widgets.grid.view import GridPlacement, widget_lines

_NAMED_LENGTH = 7.0
"""Least length of an edge that is named, in heights of the text."""
_ALONG = (0.5, 0.4, 0.6, 0.3, 0.7)
"""Places along an edge at which its name may stand, the best first."""
_TURNS = tuple(sign * turn * pi / 6 for turn in range(5) for sign in (1, -1))
"""Angles by which the name of a vertex may stand beside the direction away from the triangle, the best first."""


def _everywhere(box: QRectF) -> bool:
    return True


def name_boxes(
    placement: GridPlacement,
    geometry: GridGeometry,
    theme: Theme,
    is_free: Callable[[QRectF], bool] = _everywhere,
) -> list[NameBox]:
    """Return the boxes, texts and colours of the names of the vertices and edges of the primitive in focus.

    They stand where the place ``is_free`` and no other name stands, if there is such a place at the vertex or edge.
    """
    if not geometry.focus_vertices:
        return []
    metrics = QFontMetrics(name_font(theme))
    names = _vertex_names(placement, geometry, theme, metrics, is_free)
    if len(geometry.focus_vertices) == 3:
        lines, source = widget_lines(
            geometry.edges(geometry.triangles[geometry.focus][geometry.sides]), placement
        )
        names += _edge_names(
            placement,
            geometry,
            list(zip(lines, source.tolist(), strict=True)),
            names,
            theme,
            metrics,
            is_free,
        )
    return names


def _best(boxes: Iterable[QRectF], names: Sequence[NameBox], is_free: Callable[[QRectF], bool]) -> QRectF:
    """Return the first box that is free, or at least crosses none of the names; else the first one."""
    seen, apart = [], []
    for box in boxes:
        seen.append(box)
        if not _crosses(box, names):
            apart.append(box)
            if is_free(box):
                return box
    return [*apart, *seen][0]


def _crosses(box: QRectF, names: Sequence[NameBox]) -> bool:
    return any(box.intersects(other) for other, _, _ in names)


def _vertex_names(
    placement: GridPlacement,
    geometry: GridGeometry,
    theme: Theme,
    metrics: QFontMetrics,
    is_free: Callable[[QRectF], bool],
) -> list[NameBox]:
    """Return the names of the vertices: away from the middle of the triangle, or turned from there for want of room."""
    names: list[NameBox] = []
    corners = list(geometry.focus_vertices)
    with np.errstate(over="ignore", invalid="ignore"):
        middle = geometry.vertices[corners].mean(axis=0)
    for place, corner in enumerate(corners):
        position = vertex_place(geometry, placement, corner)
        text = geometry.label(corner)
        if position is None or not text:
            continue
        with np.errstate(over="ignore", invalid="ignore"):
            away = geometry.vertices[corner] - middle
            length = float(np.hypot(away[0], away[1]))
        angle = np.arctan2(away[1], away[0]) if np.isfinite(length) and length > 0.0 else np.pi / 2
        box = QRectF(0, 0, metrics.horizontalAdvance(text) + 8, metrics.height())
        reach = HANDLE_RADIUS * theme.text_px / 13 + 8 + box.width() / 2
        viewport = QRectF(placement.viewport)
        near, far = (_around(position, box, float(angle), part * reach, viewport) for part in (1, 2.5))
        chosen = _best(near, names, is_free)
        if _crosses(chosen, names):
            chosen = _best(far, names, is_free)
        names.append((chosen, text, theme.vertex_text[geometry.color(place)]))
    return names


def _around(position: QPointF, box: QRectF, angle: float, reach: float, viewport: QRectF) -> Iterator[QRectF]:
    """Yield a box where it may stand around a vertex, the best place first: inside, if the vertex is."""
    is_seen = viewport.contains(position)
    for turn in _TURNS:
        there = QRectF(box)
        right, up = cos(angle + turn), sin(angle + turn)
        there.moveCenter(position + QPointF(right * reach, -up * (reach + 2)))
        yield moved_inside(there, viewport) if is_seen else there


def _edge_names(
    placement: GridPlacement,
    geometry: GridGeometry,
    edges: list[tuple[QLineF, int]],
    vertices: list[NameBox],
    theme: Theme,
    metrics: QFontMetrics,
    is_free: Callable[[QRectF], bool],
) -> list[NameBox]:
    """Return the name of each edge function beside its edge: outside of the triangle, or inside for want of room.

    An edge beside which other names leave no place has none.
    """
    names: list[NameBox] = []
    owner = f" {geometry.owner}" if geometry.owner else ""
    width, height = metrics.horizontalAdvance(f"E0{owner}") + 6, metrics.height()
    viewport = QRectF(placement.viewport)
    for line, edge in edges:
        inside = viewport.intersected(QRectF(line.p1(), line.p2()).normalized().adjusted(-1, -1, 1, 1))
        if line.length() < _NAMED_LENGTH * theme.text_px or inside.isEmpty():
            continue
        normal = line.normalVector().unitVector()
        away = QPointF(normal.dx(), normal.dy())
        middle = line.center()
        right, up = _facing(geometry, geometry.focus_vertices[edge], placement.to_window(middle))
        if away.x() * right - away.y() * up > 0:
            away = -away
        reach = away * (RIM + abs(away.x()) * width / 2 + abs(away.y()) * height / 2)
        places = (line.pointAt(part) + side for side in (reach, -reach) for part in _ALONG)
        box = QRectF(0, 0, width, height)
        boxes = (moved_inside(box.translated(place - box.center()), viewport) for place in places)
        chosen = _best(boxes, [*vertices, *names], is_free)
        if _crosses(chosen, [*vertices, *names]):
            continue  # Two texts on each other say nothing.
        names.append((chosen, f"E{edge}{owner}", theme.vertex_text[edge]))
    return names


def _facing(geometry: GridGeometry, vertex: int, place: tuple[float, float]) -> tuple[float, float]:
    """Return the direction to the right and up in which a vertex lies from a place in the window, of any length."""
    start = np.array(place)
    direction = geometry.vertices[vertex] - start
    if geometry.behind is not None and not np.isfinite(direction).all():
        direction = towards(start, geometry.behind[vertex])
    right, up = np.clip(direction, -1e6, 1e6).tolist()
    return right, up


def moved_inside(box: QRectF, area: QRectF) -> QRectF:
    """Return a box moved as little as it takes to lie in an area; its left and top do where it is too large."""
    left = max(min(box.left(), area.right() - box.width()), area.left())
    top = max(min(box.top(), area.bottom() - box.height()), area.top())
    return QRectF(left, top, box.width(), box.height())
