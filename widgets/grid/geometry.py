"""Primitives over a pixel grid: exact thin outlines, also behind the eye, and handles at the vertices."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen, QPolygonF, QRegion

from core.explain.number_text import position_text
from core.records.arrays import cached_property
from widgets.basics.theme import Theme, text_font
from widgets.grid.view import GridPlacement, widget_lines

# Both ends of edges in the window, also of those that end behind the eye: there they have no end in sight.


FAR = 2.0**22
"""Pixels that an edge goes on towards a vertex behind the eye: beyond every raster."""


def edge_segments(
    vertices: NDArray[np.float64], behind: NDArray[np.float64] | None, pairs: NDArray[np.integer]
) -> NDArray[np.float64]:
    """Return (N, 2, 2) float64 the ends of edges in the window.

    Parameters
    ----------
    vertices : (V, 2) float64 array
        Window positions; NaN: none.
    behind : (V, 3) float64 array or None
        Homogeneous window coordinates (x w, y w, w) of the vertices at w <= 0, else NaN.
    pairs : (N, 2) integer array
        The vertices at both ends of each edge.

    Notes
    -----
    From the end p in front, the edge to (X, Y, W) begins in the direction (X, Y) - W p, for any W: what is seen of it
    is a ray, since it meets the plane w = 0 infinitely far away.
    """
    ends: NDArray[np.float64] = vertices[pairs]
    if behind is None:
        return ends
    for here, there in ((0, 1), (1, 0)):
        start = ends[:, here]
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            direction = towards(start, behind[pairs[:, there]])
            reached = start + direction / np.linalg.norm(direction, axis=1, keepdims=True) * FAR
        is_ray = np.isfinite(reached).all(axis=1)
        ends[is_ray, there] = reached[is_ray]
    return ends


def towards(start: NDArray[np.float64], goal: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return (..., 2) the direction in which goals (..., 3) in homogeneous window coordinates lie, of any length."""
    direction: NDArray[np.float64] = goal[..., :2] - start * goal[..., 2:]
    return direction


# Primitives over a pixel grid: exact thin outlines, handles at the vertices, and the snapped positions.


HANDLE_RADIUS = 5.0
"""Radius of a vertex handle in logical pixels."""
SPOKEN = 4
"""Most triangles, segments or points whose corners are said."""
_GRAB_RADIUS = 11.0
"""How near the pointer must come to a vertex to take it."""
_LEAST_HANDLE = 0.4
"""Handles on a tiny triangle are that part of their size, so that they hide less of it."""
HALO_WIDTH = 2.4
HALO_OPACITY = 0.75
"""Of what sets thin outlines off from the cells."""
CASING, RIM = 3.0, 4.6
"""How much wider than a coloured edge its dark casing is, and the light rim around that.

No colour of an edge has 3:1 against every cell. Each has it against the casing, and casing or rim against any cell.
"""
SIDES = {3: (0, 1, 2), 2: (2,), 1: ()}
"""By the vertices of the primitive in focus, the edges that it has, each opposite to the vertex of its number."""
NameBox = tuple[QRectF, str, str]
"""Where a name is written, the name and its colour."""


@dataclass(frozen=True, eq=False)
class GridGeometry:
    """Triangles, segments, points or polygons in window coordinates (y up)."""

    vertices: NDArray[np.float64] = field(repr=False)
    """(V, 2) float64 window positions; any value, also far away, infinite or NaN (a vertex at w <= 0)."""
    triangles: NDArray[np.integer] = field(repr=False)
    """(T, 3) integers into ``vertices``; of a segment the second stands twice, of a point the only one three times.

    (T, C) of polygons with C corners, more than three.
    """
    focus: int = 0
    """The triangle whose vertices and edges have the colours 0, 1, 2; -1: none. Edge k faces vertex k."""
    snapped: NDArray[np.float64] | None = field(default=None, repr=False)
    """(V, 2) float64 snapped positions, or None."""
    draggable: bool = True
    """Whether the vertices of the triangle in focus can be dragged."""
    names: tuple[str, ...] = ()
    """A name per triangle, for who writes them; empty: none."""
    owner: str = ""
    """What the names of edges end in, where they are not those of the step's triangle: ``of triangle 1``."""
    behind: NDArray[np.float64] | None = field(default=None, repr=False)
    """(V, 3) float64 homogeneous window coordinates (x w, y w, w) of the vertices at w <= 0, else NaN; None: none."""

    rings: tuple[int, ...] = (0,)
    """First corner of each ring of a polygon; the rings have the colours of the vertices 0, 1, 2 in turn."""

    def __post_init__(self) -> None:
        if self.vertices.ndim != 2 or self.vertices.shape[1] != 2:
            raise ValueError(f"vertices must be (V, 2), got {self.vertices.shape}")
        if self.triangles.ndim != 2 or self.triangles.shape[1] < 3:
            raise ValueError(f"triangles must be (T, 3 or more), got {self.triangles.shape}")
        if self.triangles.size and not 0 <= self.triangles.min() <= self.triangles.max() < len(self.vertices):
            raise ValueError(f"triangles must index {len(self.vertices)} vertices")
        if self.snapped is not None and self.snapped.shape != self.vertices.shape:
            raise ValueError(f"snapped must be {self.vertices.shape}, got {self.snapped.shape}")
        if self.behind is not None and self.behind.shape != (len(self.vertices), 3):
            raise ValueError(f"behind must be {(len(self.vertices), 3)}, got {self.behind.shape}")

    @property
    def focus_vertices(self) -> tuple[int, ...]:
        """Indices of the vertices of the primitive in focus; empty if there is none."""
        if not 0 <= self.focus < len(self.triangles):
            return ()
        return tuple(dict.fromkeys(self.triangles[self.focus].tolist()))

    @property
    def outlined(self) -> NDArray[np.integer]:
        """(K, C) the triangles with quiet outlines: all, as coloured edges hide their own; a point has no edges."""
        is_bare = len(self.focus_vertices) == 1 or (self.focus_vertices and len(self.triangles) == 1)
        return np.delete(self.triangles, self.focus, axis=0) if is_bare else self.triangles

    @cached_property
    def outline_key(self) -> tuple[object, ...]:
        """All that the quiet outlines depend on, to compare; empty: there are none."""
        if not len(self.outlined):
            return ()
        behind = b"" if self.behind is None else self.behind.tobytes()
        return self.vertices.tobytes(), behind, self.outlined.tobytes(), self.outlined.shape, self.rings

    @property
    def sides(self) -> NDArray[np.integer]:
        """(S, 2) integers, the corners that sides run between: side k of a triangle faces its corner k."""
        count = self.triangles.shape[1]
        if count == 3:
            return np.array([[1, 2], [2, 0], [0, 1]])
        following = np.arange(1, count + 1)
        following[np.array([*self.rings[1:], count]) - 1] = self.rings
        return np.stack([np.arange(count), following], axis=1)

    def color(self, corner: int) -> int:
        """Return 0, 1 or 2, the colour of a corner of the primitive in focus: its own, or that of a polygon's ring."""
        if self.triangles.shape[1] == 3:
            return corner
        return (int(np.searchsorted(self.rings, corner, "right")) - 1) % 3

    def edges(self, pairs: NDArray[np.integer]) -> NDArray[np.float64]:
        """Return (N, 2, 2) float64 the ends in the window of the edges between pairs (N, 2) of vertices."""
        return edge_segments(self.vertices, self.behind, pairs)

    def label(self, vertex: int) -> str:
        """Return the name of a vertex: 0, 1 or 2 of the primitive in focus, else nothing."""
        return str(self.focus_vertices.index(vertex)) if vertex in self.focus_vertices else ""


def outline_text(geometry: GridGeometry) -> str:
    """Return the corners of what is outlined, as sentences behind others, where it is little enough to be heard."""
    said = ""
    for number, corners in enumerate(
        geometry.triangles.tolist() if len(geometry.triangles) <= SPOKEN else ()
    ):
        places = [position_text(geometry.vertices[corner].tolist()) for corner in dict.fromkeys(corners)]
        kind = {1: "Point", 2: "Segment", 3: "Triangle"}.get(len(places), "Polygon")
        said += f" {kind} {geometry.names[number] if geometry.names else number}: {', '.join(places)}."
    return said


def vertex_near(geometry: GridGeometry, placement: GridPlacement, position: QPointF) -> int | None:
    """Return the draggable vertex under a widget position: the nearest within reach, or None."""
    if not geometry.draggable:
        return None
    best, reach = None, _GRAB_RADIUS
    for index in geometry.focus_vertices:
        place = vertex_place(geometry, placement, index)
        if place is not None:
            distance = QLineF(place, position).length()
            if distance <= reach:
                best, reach = index, distance
    return best


def vertex_place(geometry: GridGeometry, placement: GridPlacement, vertex: int) -> QPointF | None:
    """Return the widget position of a vertex, or None if it is not near the viewport."""
    return _place(placement, geometry.vertices[vertex])


def outline_lines(placement: GridPlacement, geometry: GridGeometry) -> list[QLineF]:
    """Return the visible edges of the outlined triangles as widget lines, shared ones once.

    Triangles share an edge where its ends are at the same places: they need not have vertices in common.
    """
    pairs = geometry.outlined[:, geometry.sides].reshape(-1, 2)
    told_apart = geometry.vertices
    if geometry.behind is not None:
        told_apart = np.where(np.isfinite(told_apart), told_apart, geometry.behind[:, :2])
    places = np.ascontiguousarray(told_apart, np.float64).view(np.complex128)
    _, place = np.unique(places.ravel(), return_inverse=True)
    low, high = np.sort(place[pairs], axis=1).T
    _, once = np.unique(low * len(place) + high, return_index=True)
    lines, _ = widget_lines(geometry.edges(pairs[once]), placement)
    return lines


def paint_outlines(painter: QPainter, lines: list[QLineF], theme: Theme) -> None:
    """Paint the outlines below the triangle in focus: quiet and thin."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    halo = QColor(theme.halo())
    halo.setAlphaF(HALO_OPACITY)
    painter.setPen(QPen(halo, HALO_WIDTH))
    painter.drawLines(lines)
    painter.setPen(QPen(QColor(theme.text), 1.0))
    painter.drawLines(lines)
    painter.restore()


def paint_focus(
    painter: QPainter,
    placement: GridPlacement,
    geometry: GridGeometry,
    theme: Theme,
    held: int | None,
    free: QRegion | None,
    names: list[NameBox],
) -> None:
    """Paint the triangle in focus: edges and vertices in their colours, snapped positions as hollow diamonds.

    ``held`` is the vertex under the pointer or being dragged; ``free`` is where lines may go, which cross no number of
    the rulers, while handles and ``names`` may lie on them. ``None``: a thumbnail, without rulers, handles and names.
    """
    small = free is None
    corners = geometry.focus_vertices
    if not corners:
        return
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    own = np.array(SIDES.get(len(corners), range(len(corners))), int)
    sides = [geometry.color(int(k)) for k in own]
    lines, source = widget_lines(
        geometry.edges(geometry.triangles[geometry.focus][geometry.sides[own]]), placement
    )
    scale = theme.text_px / 13
    width = 1.2 if small else 2.2 * scale
    if free is not None:
        painter.setClipRegion(free)
    else:
        painter.setClipRect(placement.seen_raster)
    # Round ends take eight times as long; where there are handles, these cover the ends.
    ends = Qt.PenCapStyle.RoundCap if small else Qt.PenCapStyle.FlatCap
    for color, more in ((theme.edge_rim, RIM), (theme.edge_casing, CASING)):
        painter.setPen(QPen(QColor(color), width + more, Qt.PenStyle.SolidLine, ends))
        painter.drawLines(lines)
    for line, index in zip(lines, source.tolist(), strict=True):
        painter.setPen(QPen(QColor(theme.vertex[sides[index]]), width, Qt.PenStyle.SolidLine, ends))
        painter.drawLine(line)
    if not small:
        scale *= handle_part(placement, geometry)
        for place in range(len(corners)):
            position = vertex_place(geometry, placement, corners[place])
            if position is None:
                continue
            _clip_handle(painter, placement, position)
            radius = HANDLE_RADIUS * scale + (1.5 if corners[place] == held else 0.0)
            painter.setPen(Qt.PenStyle.NoPen)
            for color, more in (
                (theme.edge_rim, RIM),
                (theme.edge_casing, CASING),
                (theme.vertex[geometry.color(place)], 0.0),
            ):
                painter.setBrush(QColor(color))
                painter.drawEllipse(position, radius + more / 2, radius + more / 2)
        _paint_snapped(painter, placement, geometry, corners, scale)
        painter.setClipRect(placement.viewport)
        painter.setFont(name_font(theme))
        for box, text, color in names:
            paint_chip(painter, box, text, color, theme)
    painter.restore()


def handle_part(placement: GridPlacement, geometry: GridGeometry) -> float:
    """Return the part of their size that the handles of the triangle in focus have: all of it where there is room."""
    corners = geometry.vertices[list(geometry.focus_vertices)]
    with np.errstate(over="ignore", invalid="ignore"):
        sides = np.hypot(*(corners - np.roll(corners, 1, axis=0)).T) * placement.cell
    if len(corners) == 1:
        return 1.0
    shortest = np.nan_to_num(sides, nan=np.inf).min()
    return float(np.clip(shortest / (4 * HANDLE_RADIUS), _LEAST_HANDLE, 1.0))


def _clip_handle(painter: QPainter, placement: GridPlacement, position: QPointF) -> None:
    """Leave a handle whole whose middle is in sight, as on the border of the raster, and cut another off."""
    painter.setClipRect(placement.viewport)
    if QRectF(placement.viewport).adjusted(-1, -1, 1, 1).contains(position):
        painter.setClipping(False)


def _paint_snapped(
    painter: QPainter,
    placement: GridPlacement,
    geometry: GridGeometry,
    corners: tuple[int, ...],
    scale: float,
) -> None:
    """Paint the snapped positions as hollow diamonds around the vertices."""
    if geometry.snapped is None:
        return
    size = (HANDLE_RADIUS + 5.0) * scale
    for corner in corners:
        place = _place(placement, geometry.snapped[corner])
        if place is None:
            continue
        _clip_handle(painter, placement, place)
        tips = (QPointF(0, -size), QPointF(size, 0), QPointF(0, size), QPointF(-size, 0))
        diamond = QPolygonF([place + tip for tip in tips])
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for color, width in (("#ffffff", 2.6), ("#000000", 1.2)):
            painter.setPen(QPen(QColor(color), width))
            painter.drawPolygon(diamond)


def name_font(theme: Theme) -> QFont:
    """Return the font of names over a picture."""
    font = text_font(theme)
    font.setBold(True)
    return font


def paint_chip(painter: QPainter, box: QRectF, text: str, color: str, theme: Theme) -> None:
    """Write a name on a ground of its own."""
    chip = QColor(theme.panel)
    chip.setAlphaF(0.88)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(chip)
    painter.drawRoundedRect(box, 3, 3)
    painter.setPen(QColor(color))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


def _place(placement: GridPlacement, position: NDArray[np.float64]) -> QPointF | None:
    """Return the widget position of a window position if it is finite and near the viewport."""
    x, y = float(position[0]), float(position[1])
    if not (abs(x) < 1e9 and abs(y) < 1e9):
        return None
    place = placement.to_widget(x, y)
    reach = 4 * HANDLE_RADIUS
    return (
        place if QRectF(placement.viewport).adjusted(-reach, -reach, reach, reach).contains(place) else None
    )
