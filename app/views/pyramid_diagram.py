"""Homogeneous rasterization drawn: the triangle in (x, y, w), the eye, and the double pyramid through both.

Every point of the triangle lies on a ray through the eye at the origin, and the ray meets the plane w = 1 at
the pixel where the point is seen. The three planes through the eye and an edge are the edge functions; behind
the eye, at w < 0, they go on as the second half of the pyramid.

References
----------
M. Zwicker, *Computergrafik*, lecture "Homogeneous rasterization", Bern 2016.
"""

from dataclasses import dataclass

import numpy as np

from app.views.pointed_pixel import PointedPixel, fragment_at
from core.interpolation.interpolation import numerators, plane_value, set_up_planes, value_plane
from core.records.arrays import Floats
from core.records.words import nouns
from core.trace.source import TraceSource
from core.transform.vertex_stage import VertexStage
from widgets.grid.layers import number_text
from widgets.space.diagram import Diagram, Patch, Spot, Stroke, Word, clip_polygon

LARGEST_W = 4.0
SMALLEST_W = 0.4
"""A triangle whose largest \\|w\\| is not between these is drawn smaller or larger by one factor."""
MOST_LINES = 25
"""Lines of the raster that are drawn each way."""
LEAST_W = 1e-6
MIRRORED = 0.45
"""The half of the pyramid behind the eye is drawn so many times as long."""
FARTHEST_SHOWN = 3.2
"""The whole view follows a corner so far away, in half heights of the raster."""


@dataclass(frozen=True, eq=False)
class PyramidFrame:
    """How (x, y, w) in pixels is laid into the space of the drawing: linear, the eye stays at the origin."""

    matrix: Floats
    """(3, 3) float64."""
    factor: float
    """The triangle is drawn divided by this, which changes no pixel."""
    aspect: float

    def place(self, homogeneous: Floats) -> Floats:
        """Return (N, 3) places of homogeneous window positions (N, 3): x right, y up, w away."""
        placed: Floats = homogeneous @ self.matrix.T
        return placed


def pyramid_frame(source: TraceSource, homogeneous: Floats) -> PyramidFrame:
    """Return the frame in which the raster on w = 1 is two units high, seen from its middle."""
    first_column, first_row, end_column, end_row = source.raster.bounds
    middle_x, middle_y = (first_column + end_column) / 2, (first_row + end_row) / 2
    half = max((end_row - first_row) / 2, (end_column - first_column) / 3)
    matrix = np.array([[1 / half, 0, -middle_x / half], [0, 1 / half, -middle_y / half], [0, 0, -1.0]])
    largest = float(np.abs(homogeneous[:, 2]).max())
    factor = 1.0 if SMALLEST_W <= largest <= LARGEST_W or largest == 0 else largest / 2
    return PyramidFrame(matrix, factor, (end_column - first_column) / (end_row - first_row))


def pyramid_diagram(source: TraceSource, triangle: int, pixel: PointedPixel | None) -> Diagram:
    """Draw a triangle in (x, y, w) with the ray of a pixel.

    Parameters
    ----------
    triangle : int
        One of the traced triangles.
    """
    homogeneous = homogeneous_corners(source, triangle)
    w = homogeneous[:, 2]
    frame = pyramid_frame(source, homogeneous)
    corners, vertices = frame.place(homogeneous / frame.factor), source.geometry.vertices
    shapes = [
        _raster(source, frame),
        _pyramid(corners, vertices),
        *(_image(source, frame, homogeneous[ring]) for ring in vertices.ring_slices),
    ]
    sentences = [_sentence(w, frame)]
    if pixel is not None:
        ray, sentence = _ray(source, frame, triangle, homogeneous, pixel)
        shapes.append(ray)
        sentences.append(sentence)
    axes = (("x", [0.5, 0, 0]), ("y", [0, 0.5, 0]), ("w", [0, 0, -1.25]))
    axis_strokes = tuple(Stroke(np.array([[0, 0, 0], end], float), "text", 1.4) for _, end in axes)
    axis_words = tuple(Word(np.array(end, float), name, "text") for name, end in axes)
    return Diagram(
        patches=tuple(patch for shape in shapes for patch in shape.patches),
        strokes=(*axis_strokes, *(stroke for shape in shapes for stroke in shape.strokes)),
        spots=(
            Spot(np.zeros(3), "text", radius=4.0, label="eye"),
            *(spot for shape in shapes for spot in shape.spots),
        ),
        words=(*axis_words, *(word for shape in shapes for word in shape.words)),
        frame=_frame_points(corners, frame),
        azimuth=1.05,
        elevation=0.33,
        caption=nouns(source.scene.corner_count).text(" ".join(sentences)),
    )


def _frame_points(corners: Floats, frame: PyramidFrame) -> Floats:
    """Return what the whole view shows: eye, raster, and the double pyramid unless it is very large."""
    x, y = max(frame.aspect, 1.0), 1.0
    raster = np.array([[x, y, -1.0], [-x, y, -1.0], [x, -y, -1.0], [-x, -y, -1.0]])
    both = np.concatenate([corners, -MIRRORED * corners])
    length = np.abs(both).max(axis=1, keepdims=True)
    shown = both * np.minimum(1.0, FARTHEST_SHOWN / np.maximum(length, 1e-300))
    return np.concatenate([np.zeros((1, 3)), raster, shown])


def hit_point(homogeneous: Floats, x: float, y: float) -> tuple[Floats, Floats, float]:
    """Return where the ray of a window position meets a triangle's plane: point (3,), weights (3,), 1/w.

    The point is homogeneous, (x w, y w, w), as the corners (3, 3) are. It is found with the rules of
    perspective interpolation; where 1/w is 0 the ray is parallel to the plane and the point is not finite.
    """
    planes, one = set_up_planes(homogeneous[None]), np.zeros(1, np.int64)
    shares = np.stack(numerators(planes, one, np.array([x]), np.array([y])), axis=1)[0]
    inverse_w = float(plane_value(value_plane(planes, np.ones((1, 3))), one, np.array([x]), np.array([y]))[0])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return np.array([x, y, 1.0]) / inverse_w, shares / shares.sum(), inverse_w


def homogeneous_corners(source: TraceSource, triangle: int) -> Floats:
    """Return (3, 3) corners of a triangle, (C, 3) of a polygon, as (x, y, w), x and y in pixels times w."""
    vertices = source.geometry.vertices
    clip = vertices.clip[vertices.corners_of(triangle)]
    width, height = source.scene.size
    x, y, w = clip[:, 0], clip[:, 1], clip[:, 3]
    return np.stack([(x + w) * (width / 2), (y + w) * (height / 2), w], axis=1)


def _sentence(w: Floats, frame: PyramidFrame) -> str:
    parts = ["Eye at the origin, raster on the plane w = 1."]
    if (w == w[0]).all() and w[0] > 0:
        parts.append("All w are equal, as in every parallel projection: the {one} keeps its shape.")
    elif (w > 0).all():
        parts.append("All w > 0: the whole {one} is in front of the eye.")
    elif (w <= 0).all():
        parts.append("All w ≤ 0: the {one} lies behind the eye and only its mirror image meets the raster.")
    else:
        parts.append("Some w ≤ 0: the {one} reaches behind the eye; edge planes decide without clipping.")
    if frame.factor != 1:
        parts.append(
            f"The drawing divides x, y and w by {number_text(frame.factor, 3)}: the rays stay the same."
        )
    return " ".join(parts)


def _pyramid(corners: Floats, vertices: VertexStage) -> Diagram:
    """Return the primitive and the planes through eye and sides, before and behind the eye; holes stay open."""
    patches = [Patch(corners, "covered", 0.38)] if len(vertices.ring_slices) == 1 else []
    strokes: list[Stroke] = []
    inks, sides = [f"vertex {color}" for color in vertices.colors], vertices.sides
    for k, ink in enumerate(inks):
        ends = corners[sides[k]]
        strokes.append(Stroke(ends, ink, 2.4))
        patches.append(Patch(np.concatenate([np.zeros((1, 3)), ends]), ink, 0.13))
        patches.append(Patch(np.concatenate([np.zeros((1, 3)), -ends * MIRRORED]), ink, 0.07))
        strokes.append(Stroke(-ends * MIRRORED, ink, 1.0, "dash"))
    for k in range(len(corners)):
        # A ray goes on to the plane of the raster where the corner lies before it.
        w = -float(corners[k, 2])
        reach = corners[k] * (1.0 / w) if 0 < w < 1 else corners[k]
        strokes.append(Stroke(np.stack([np.zeros(3), corners[k]]), "muted_text", 1.1))
        if 0 < w < 1:
            strokes.append(Stroke(np.stack([corners[k], reach]), "muted_text", 1.0, "dot"))
        strokes.append(Stroke(np.stack([np.zeros(3), -corners[k] * MIRRORED]), "muted_text", 1.0, "dash"))
    spots = tuple(Spot(corners[k], inks[k], label=str(k)) for k in range(vertices.corner_count))
    return Diagram(tuple(patches), tuple(strokes), spots)


def _raster(source: TraceSource, frame: PyramidFrame) -> Diagram:
    """Return the raster on the plane w = 1."""
    first_column, first_row, end_column, end_row = source.raster.bounds

    def on_plane(x: float, y: float) -> Floats:
        placed: Floats = frame.place(np.array([[x, y, 1.0]]))[0]
        return placed

    step = max(-(-(end_column - first_column) // MOST_LINES), -(-(end_row - first_row) // MOST_LINES))
    strokes = [
        Stroke(np.stack([on_plane(x, first_row), on_plane(x, end_row)]), "grid_line", 0.6, opacity=0.7)
        for x in range(first_column + step, end_column, step)
    ]
    strokes += [
        Stroke(np.stack([on_plane(first_column, y), on_plane(end_column, y)]), "grid_line", 0.6, opacity=0.7)
        for y in range(first_row + step, end_row, step)
    ]
    border = np.stack(
        [
            on_plane(first_column, first_row),
            on_plane(end_column, first_row),
            on_plane(end_column, end_row),
            on_plane(first_column, end_row),
        ]
    )
    strokes.append(Stroke(border, "text", 1.6, is_closed=True))
    word = Word(border[2], f"w = 1, {end_column - first_column}×{end_row - first_row} pixels")
    return Diagram((Patch(border, "empty", 0.55),), tuple(strokes), words=(word,))


def _image(source: TraceSource, frame: PyramidFrame, homogeneous: Floats) -> Diagram:
    """Return what the triangle covers of the raster, exactly."""
    first_column, first_row, end_column, end_row = source.raster.bounds
    # In front of the eye first, then divided by w and cut to the raster.
    front = _in_front(homogeneous)
    if len(front) < 3:
        return Diagram()
    window = front[:, :2] / front[:, 2:]
    inside = clip_polygon(window, (first_column, first_row, end_column, end_row))
    if len(inside) < 3:
        return Diagram()
    places = frame.place(np.column_stack([inside, np.ones(len(inside))]))
    return Diagram((Patch(places, "covered", 0.75),), (Stroke(places, "text", 1.2, is_closed=True),))


def _in_front(polygon: Floats) -> Floats:
    """Cut a triangle (3, 3) of homogeneous positions to w above almost nothing."""
    least = LEAST_W * max(float(np.abs(polygon[:, 2]).max()), 1e-300)
    result = []
    for k in range(3):
        start, end = polygon[k - 1], polygon[k]
        if (start[2] < least) != (end[2] < least):
            t = (least - start[2]) / (end[2] - start[2])
            result.append(start + t * (end - start))
        if end[2] >= least:
            result.append(end)
    return np.array(result).reshape(-1, 3)


def _ray(
    source: TraceSource, frame: PyramidFrame, triangle: int, homogeneous: Floats, pixel: PointedPixel
) -> tuple[Diagram, str]:
    """Return the ray of a pixel, and where it meets the triangle's plane."""
    center = source.raster.center
    x, y = pixel.column + center, pixel.row + center
    on_raster = frame.place(np.array([[x, y, 1.0]]))[0]
    square = np.array([[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0]])
    cell = frame.place(np.array([x, y, 1.0]) + square)
    strokes = [
        Stroke(cell, "text", 2.4, is_closed=True),
        Stroke(np.stack([np.zeros(3), on_raster]), "text", 2.0),
    ]
    spots = [Spot(on_raster, "text", "disc", 3.0)]
    if source.scene.corner_count < 3:
        sentence = f"The ray of the {pixel.name} meets only the raster: a {{one}} has no area."
        return Diagram((), tuple(strokes), tuple(spots)), sentence
    vertices = source.geometry.vertices
    if vertices.rings is not None:
        # Its plane goes through three of its corners.
        homogeneous = homogeneous[vertices.corners[triangle] - vertices.corners_of(triangle)[0]]
    point, weights, inverse_w = hit_point(homogeneous, x, y)
    if not np.isfinite(point).all():
        strokes.append(Stroke(np.stack([on_raster, on_raster * 3]), "text", 1.4, "dot"))
        sentence = f"The ray of the {pixel.name} is parallel to the {{one}}'s plane."
        return Diagram((), tuple(strokes), tuple(spots)), sentence
    hit = frame.place(point[None] / frame.factor)[0]
    is_in_front = inverse_w > 0
    start, width = (on_raster, 2.0) if is_in_front else (np.zeros(3), 1.4)
    strokes.append(Stroke(np.stack([start, hit]), "text", width, "solid" if is_in_front else "dot"))
    w_text = number_text(1 / inverse_w)
    is_covered = fragment_at(source, pixel.column, pixel.row, triangle, is_required=True) >= 0
    spots.append(Spot(hit, "text", "disc" if is_covered else "cross", 4.5, label=f"w = {w_text}"))
    if not is_in_front:
        where = "behind the eye"
    elif is_covered if vertices.rings is not None else (weights >= 0).all():
        where = "inside the {one}"
    else:
        where = "beyond an edge"
    shares = ", ".join(number_text(float(weight), 3) for weight in weights)
    of_corners = f": weights ({shares})" if vertices.rings is None else ""
    sentence = f"The ray of the {pixel.name} meets the {{one}}'s plane at w = {w_text}, {where}{of_corners}."
    return Diagram((), tuple(strokes), tuple(spots)), sentence
