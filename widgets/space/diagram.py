"""A drawing in space: lines, faces, points and words as records, painted far to near along parallel lines.

The space is right-handed with y up; the viewer at rest looks along -z. An ``ink`` is a name of
:mod:`widgets.basics.theme`. Coordinates may be anything: what is not finite is left out, what is far away is cut.
"""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QLineF, QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from widgets.basics.drawing import FURTHER, LabelPlaces
from widgets.basics.theme import Theme, faded, ink_color, ink_text_color, text_font
from widgets.grid.view import clip_segments
from widgets.space.orbit import Orbit

# What a drawing in space consists of: lines, faces, points and words, as frozen records.


Dash = Literal["solid", "dash", "dot"]
SpotShape = Literal["disc", "ring", "square", "cross"]


CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
"""(8, 3) corners of the cube around the origin that is two units wide."""


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line through points."""

    points: NDArray[np.float64] = field(repr=False)
    """(N, 3) float64."""
    ink: str = "text"
    width: float = 1.5
    """Logical pixels."""
    dash: Dash = "solid"
    is_closed: bool = False
    opacity: float = 1.0

    def __post_init__(self) -> None:
        _check_points("points of a stroke", self.points)


@dataclass(frozen=True, eq=False)
class Patch:
    """A flat, convex, translucent face."""

    points: NDArray[np.float64] = field(repr=False)
    """(N, 3) float64, its corners in turn."""
    ink: str = "muted_text"
    opacity: float = 0.15

    def __post_init__(self) -> None:
        _check_points("points of a patch", self.points)


@dataclass(frozen=True, eq=False)
class Spot:
    """A point with a mark and a name."""

    point: NDArray[np.float64] = field(repr=False)
    """(3,) float64."""
    ink: str = "text"
    shape: SpotShape = "disc"
    radius: float = 4.0
    label: str = ""

    def __post_init__(self) -> None:
        if self.point.shape != (3,):
            raise ValueError(f"point must be (3,), got {self.point.shape}")


@dataclass(frozen=True, eq=False)
class Word:
    """Text at a point of the space."""

    point: NDArray[np.float64] = field(repr=False)
    """(3,) float64."""
    text: str
    ink: str = "muted_text"

    def __post_init__(self) -> None:
        if self.point.shape != (3,):
            raise ValueError(f"point must be (3,), got {self.point.shape}")


@dataclass(frozen=True, eq=False)
class Diagram:
    """A drawing in space."""

    patches: tuple[Patch, ...] = ()
    strokes: tuple[Stroke, ...] = ()
    spots: tuple[Spot, ...] = ()
    words: tuple[Word, ...] = ()
    frame: NDArray[np.float64] = field(default_factory=lambda: CUBE, repr=False)
    """(N, 3) float64, points that the whole view shows; from step to step they should change little."""
    azimuth: float = 0.6
    elevation: float = 0.35
    """Radians, the direction from which it is first seen; see :class:`~widgets.space.orbit.Orbit`."""
    caption: str = ""
    """What the drawing shows, in one to three sentences."""


def _check_points(name: str, points: NDArray[np.float64]) -> None:
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name} must be (N, 3), got {points.shape}")


# How a drawing in space is painted: along parallel lines, far to near, cut in float64 before Qt sees it.


PIECE = 60.0
"""Logical pixels after which a line is cut, so that faces can come between its parts."""
MOST_PIECES = 10
FARTHEST = 1e12
"""A segment longer than so many logical pixels is left out."""
MARGIN = 24.0
_DASHES = {"solid": None, "dash": [5.0, 4.0], "dot": [1.2, 3.2]}


@dataclass(frozen=True, eq=False)
class Projection:
    """A view of the space along parallel lines."""

    axes: NDArray[np.float64]
    """(3, 3) right, up, towards the viewer."""
    target: NDArray[np.float64]
    """(3,)."""
    scale: float
    """Logical pixels per unit."""
    middle: tuple[float, float]
    """Where the target appears."""

    def project(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (N, 3): widget x, y (down) and nearness of points (N, 3)."""
        with np.errstate(over="ignore", invalid="ignore"):
            offset = points - self.target
            seen = np.stack([offset @ axis for axis in self.axes], axis=1)
            return np.stack(
                [
                    self.middle[0] + seen[:, 0] * self.scale,
                    self.middle[1] - seen[:, 1] * self.scale,
                    seen[:, 2] * self.scale,
                ],
                axis=1,
            )

    def place(self, point: NDArray[np.float64]) -> QPointF | None:
        """Return the widget position of a point (3,), or None if it is not finite or very far away."""
        x, y, _ = self.project(point[None])[0].tolist()
        return QPointF(x, y) if abs(x) < 1e7 and abs(y) < 1e7 else None


def projection_of(orbit: Orbit, area: QRectF) -> Projection:
    """Return the projection that shows an orbit in an area."""
    scale = area.height() / (2 * orbit.extent)
    middle = area.center()
    return Projection(orbit.axes(), np.array(orbit.target), scale, (middle.x(), middle.y()))


def paint_diagram(
    painter: QPainter, diagram: Diagram, projection: Projection, area: QRectF, theme: Theme
) -> None:
    """Paint faces and lines from far to near, then points, then words."""
    painter.save()
    painter.setClipRect(area)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    box = (area.left() - MARGIN, area.top() - MARGIN, area.right() + MARGIN, area.bottom() + MARGIN)
    faces = []
    for patch in diagram.patches:
        corners = projection.project(patch.points)
        if len(corners) >= 3 and np.isfinite(corners).all():
            faces.append((float(corners[:, 2].mean()), patch, corners[:, :2]))
    pieces = line_pieces(diagram.strokes, projection, box)
    nearness = np.concatenate([[face[0] for face in faces], pieces.nearness])
    pens = [_pen(stroke, theme) for stroke in diagram.strokes]
    lines, offsets = pieces.lines.tolist(), pieces.offset.tolist()
    strokes = pieces.stroke.tolist()
    for index in np.argsort(nearness, kind="stable").tolist():
        if index < len(faces):
            _paint_patch(painter, faces[index][1], faces[index][2], box, theme)
            continue
        piece = index - len(faces)
        pen = pens[strokes[piece]]
        dashes = _DASHES[diagram.strokes[strokes[piece]].dash]
        if dashes is not None:
            pen.setDashOffset((offsets[piece] / pen.widthF()) % sum(dashes))
        painter.setPen(pen)
        painter.drawLine(QLineF(*lines[piece]))
    spots = [(spot, place) for spot in diagram.spots if (place := projection.place(spot.point)) is not None]
    words = [(word, place) for word in diagram.words if (place := projection.place(word.point)) is not None]
    for spot, place in spots:
        paint_spot(painter, place, spot, theme)
    _paint_words(painter, spots, words, area, theme)
    painter.restore()


@dataclass(frozen=True, eq=False)
class LinePieces:
    """Strokes cut into P short pieces inside of the view."""

    lines: NDArray[np.float64]
    """(P, 4) float64, x and y of both ends in the widget."""
    nearness: NDArray[np.float64]
    """(P,) float64, by which they are sorted."""
    stroke: NDArray[np.intp]
    """(P,) the stroke that each is a part of."""
    offset: NDArray[np.float64]
    """(P,) float64, where it begins along its stroke, for dashes that run on."""


def line_pieces(
    strokes: tuple[Stroke, ...], projection: Projection, box: tuple[float, float, float, float]
) -> LinePieces:
    """Project strokes and cut them into pieces, between which faces can come."""
    parts, owner = [np.empty((0, 2, 3))], [np.empty(0, np.intp)]
    for index, stroke in enumerate(strokes):
        points = stroke.points
        if stroke.is_closed and len(points) > 1:
            points = np.concatenate([points, points[:1]])
        parts.append(np.stack([points[:-1], points[1:]], axis=1))
        owner.append(np.full(len(points) - 1, index, np.intp))
    which = np.concatenate(owner)
    seen = projection.project(np.concatenate(parts).reshape(-1, 3)).reshape(-1, 2, 3)
    with np.errstate(over="ignore", invalid="ignore"):
        length = np.hypot(*(seen[:, 1, :2] - seen[:, 0, :2]).T)
    known = np.isfinite(seen).all(axis=(1, 2)) & (length < FARTHEST)
    which, seen, length = which[known], seen[known], length[known]

    # Where each segment begins along its stroke.
    along = np.cumsum(length) - length
    first = np.searchsorted(which, which)
    along = along - along[first] if len(along) else along

    # Thin lines are not cut: they belong to a face.
    widths = np.array([stroke.width for stroke in strokes])[which] if len(which) else np.empty(0)
    count = np.where(widths < 1, 1, np.clip(np.ceil(length / PIECE), 1, MOST_PIECES)).astype(np.intp)
    segment = np.repeat(np.arange(len(which)), count)
    place = np.arange(len(segment)) - np.repeat(np.cumsum(count) - count, count)
    stops = np.stack([place, place + 1], axis=1) / count[segment, None]
    ends = seen[segment, :1] + stops[..., None] * (seen[segment, 1:] - seen[segment, :1])
    lines, source = clip_segments(ends[..., :2], box)
    skipped = np.hypot(*(lines[:, 0] - ends[source, 0, :2]).T)
    return LinePieces(
        lines=lines.reshape(-1, 4),
        # Of lines at one place the thicker one is seen, and lines before faces.
        nearness=ends[source, :, 2].mean(axis=1) + widths[segment[source]],
        stroke=which[segment[source]],
        offset=along[segment[source]] + stops[source, 0] * length[segment[source]] + skipped,
    )


def _pen(stroke: Stroke, theme: Theme) -> QPen:
    pen = QPen(faded(ink_color(stroke.ink, theme), stroke.opacity), stroke.width * theme.text_px / 13)
    dashes = _DASHES[stroke.dash]
    is_round = dashes is None and stroke.opacity == 1 and stroke.width >= 1
    pen.setCapStyle(Qt.PenCapStyle.RoundCap if is_round else Qt.PenCapStyle.FlatCap)
    if dashes is not None:
        pen.setDashPattern(dashes)
    return pen


def _paint_patch(
    painter: QPainter,
    patch: Patch,
    corners: NDArray[np.float64],
    box: tuple[float, float, float, float],
    theme: Theme,
) -> None:
    inside = clip_polygon(corners, box)
    if len(inside) < 3:
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(faded(ink_color(patch.ink, theme), patch.opacity))
    painter.drawPolygon(QPolygonF([QPointF(x, y) for x, y in inside.tolist()]))


def clip_polygon(corners: NDArray[np.float64], box: tuple[float, float, float, float]) -> NDArray[np.float64]:
    """Cut a polygon (N, 2) to a box (left, top, right, bottom): (M, 2), float64."""
    polygon = corners
    for axis, limit, sign in ((0, box[0], 1.0), (0, box[2], -1.0), (1, box[1], 1.0), (1, box[3], -1.0)):
        if len(polygon) == 0:
            break
        distance = sign * (polygon[:, axis] - limit)
        if (distance >= 0).all():
            continue
        result = []
        for k in range(len(polygon)):
            here, there = distance[k - 1], distance[k]
            if (here < 0) != (there < 0):
                t = here / (here - there)
                result.append(polygon[k - 1] + t * (polygon[k] - polygon[k - 1]))
            if there >= 0:
                result.append(polygon[k])
        polygon = np.array(result).reshape(-1, 2)
    return polygon


def paint_spot(
    painter: QPainter,
    place: QPointF,
    spot: Spot,
    theme: Theme,
    *,
    is_handle: bool = False,
    is_held: bool = False,
) -> None:
    """Paint the mark of a point; a handle, which can be dragged, has a ring, and is larger in the hand."""
    radius = spot.radius * theme.text_px / 13 + (1.5 if is_held else 0.0)
    color = QColor(ink_color(spot.ink, theme))
    halo = faded(theme.halo(), 0.75)
    if spot.shape == "cross":
        lines = [
            QLineF(place + QPointF(-radius, -radius), place + QPointF(radius, radius)),
            QLineF(place + QPointF(-radius, radius), place + QPointF(radius, -radius)),
        ]
        for pen in (QPen(halo, 4.0), QPen(color, 1.8)):
            painter.setPen(pen)
            painter.drawLines(lines)
        return
    is_hollow = spot.shape == "ring"
    painter.setBrush(Qt.BrushStyle.NoBrush if is_hollow else color)
    for pen in (QPen(halo, 4.2), QPen(color, 2.0)) if is_hollow else (QPen(QColor("#ffffff"), 1.6),):
        painter.setPen(pen)
        if spot.shape == "square":
            painter.drawRect(QRectF(place.x() - radius, place.y() - radius, 2 * radius, 2 * radius))
        else:
            painter.drawEllipse(place, radius, radius)
    if is_handle:
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor("#000000"), 0.8))
        painter.drawEllipse(place, radius + 1.2, radius + 1.2)


def _paint_words(
    painter: QPainter,
    spots: list[tuple[Spot, QPointF]],
    words: list[tuple[Word, QPointF]],
    area: QRectF,
    theme: Theme,
) -> None:
    """Write names of points first, then words, each where there is room."""
    places = LabelPlaces(area.adjusted(2, 2, -2, -2))
    for _, place in spots:
        places.take(QRectF(place.x() - 5, place.y() - 5, 10, 10))
    for spot, place in spots:
        if spot.label:
            is_vertex = spot.ink.startswith("vertex ")
            paint_label(painter, places, place, spot.label, spot.ink, theme, spot.radius + 3, is_vertex)
    for word, place in words:
        paint_label(painter, places, place, word.text, word.ink, theme, 3.0)


def paint_label(
    painter: QPainter,
    places: LabelPlaces,
    point: QPointF,
    text: str,
    ink: str,
    theme: Theme,
    reach: float,
    is_bold: bool = False,
    further: tuple[float, ...] = FURTHER,
) -> None:
    """Write a text on a chip beside a point, if there is room; ``further`` as of `LabelPlaces.find`."""
    font = text_font(theme)
    font.setBold(is_bold)
    painter.setFont(font)
    metrics = painter.fontMetrics()
    size = QSizeF(metrics.horizontalAdvance(text) + 8, metrics.height())
    box = places.find(point, size, reach, further)
    if box is None:
        return
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(faded(theme.panel, 0.85))
    painter.drawRoundedRect(box, 3, 3)
    painter.setPen(QColor(ink_text_color(ink, theme)))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)
