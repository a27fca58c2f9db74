"""The core's picture of a case against OpenGL's, and which pixels OpenGL may draw otherwise where it clips.

Coverage is decided on corners snapped to 1/256 pixel, and a snapped corner lies up to sqrt(2)/512 pixel from its place.
OpenGL snaps the corners that clipping makes too, and computes all window positions in float32, which may put a corner
on the next step. So its edges and the core's both lie beside the given edge, together by at most a step's
diagonal, sqrt(2)/256 pixel: only centres nearer to an edge may show another triangle. Where near and far plane cut a
triangle are edges like the others.

How exact a value must be follows from how OpenGL implementations compute it: as a linear function of the
pixel in float32, as if the sample lay up to 2^-18 of the raster's side beside its place. A value may be off by
what it changes over that distance, and by a small amount that is always allowed. So triangles that are steep in
a value (slivers, those seen edge-on) need no tolerances of their own.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from app.opengl_check.cases import STEP, Case, Picture
from app.opengl_check.families import CLIPPED_FAMILIES
from core import draw_triangles
from core.coverage.measured_exactly import Corner, homogeneous_corner
from core.coverage.snapping import place_corners
from core.interpolation.interpolation import Planes, set_up_planes, value_plane
from core.lines.drawing import draw_lines, interpolate_line
from core.records.arrays import Floats, Integers

# Which pixels OpenGL may draw otherwise where it clips: those beside an edge, in exact arithmetic.


BOUND = np.sqrt(2) * STEP
"""Pixels from an edge within which another triangle may be seen."""

Line = tuple[Fraction, Fraction, Fraction]


def edge_distances(case: Case, differing: Integers) -> Floats:
    """Return how far pixels that show different triangles are from the nearest edge that may decide it.

    Parameters
    ----------
    case : Case
        Its triangles are drawn in order, the last one stays.
    differing : (D, 4) int64
        Column, row, and the two triangles seen; -1: none.

    Returns
    -------
    (D,) float64
        Pixels, rounded once from a rational number. Of the two triangles the later one is covered in one picture and
        not in the other: the edges are its own.
    """
    lines: dict[int, list[Line]] = {}
    distances = []
    for column, row, ours, theirs in differing.tolist():
        triangle = max(ours, theirs)
        if triangle not in lines:
            lines[triangle] = edge_lines(case.clip[triangle].astype(float), case.size)
        x, y = Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2)
        squared = [(a * x + b * y + c) ** 2 / (a * a + b * b) for a, b, c in lines[triangle]]
        distances.append(float(min(squared)) ** 0.5 if squared else np.inf)
    return np.array(distances)


def edge_lines(corners: Floats, size: tuple[int, int]) -> list[Line]:
    """Return the lines a x + b y + c = 0 in the window of a triangle's edges (3, 4) and of its cuts by near and far."""
    placed = [homogeneous_corner(corner, size) for corner in corners]
    edges = [_line_through(placed[k - 2], placed[k - 1]) for k in range(3)]
    cuts = []
    for sign in (1, -1):
        beyond = [Fraction(float(w)) + sign * Fraction(float(z)) for _, _, z, w in corners]
        cuts.append(tuple(sum(f * edge[k] for f, edge in zip(beyond, edges, strict=True)) for k in range(3)))
    return [(Fraction(a), Fraction(b), Fraction(c)) for a, b, c in (*edges, *cuts) if a or b]


def _line_through(first: Corner, second: Corner) -> Line:
    (x1, y1, w1), (x2, y2, w2) = first, second
    return y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2


# The core's picture of a case against OpenGL's: pixels that show another primitive, and errors of values.


DISPLACEMENT = 2.0**-18
"""How far a sample may lie beside its place, in sides of the raster; four times as far where OpenGL makes new corners
by clipping, plane after plane in float32."""
DEPTH_TOLERANCE = 2e-6
COLOR_TOLERANCE = 2e-5
BILINEAR_TOLERANCE = 5e-4
"""Implementations weigh the texels of the bilinear filter with fewer bits than float32 has."""
BESIDE_EDGES = frozenset({"clipped", "near", *CLIPPED_FAMILIES})
"""Families in which pixels beside an edge may show another triangle: see `app.opengl_check.compare`."""
PIXELS_ALLOWED = {"line-ends": 4}
"""Pixels per case that may show another primitive, by family; none of the others, but those beside an edge. Where
OpenGL moves the end of a line to the border of its pixel, the new corner is snapped to 1/256 pixel and the line moves
by as much. (A line through another pixel than ours makes two of them.)"""


@dataclass(frozen=True, eq=False)
class Comparison:
    """One case, ours against OpenGL's."""

    pixels: int
    """Pixels compared: the whole raster."""
    drawn: int
    """Those on which OpenGL drew."""
    differing: Integers
    """(D, 4) int64: column, row, our primitive, OpenGL's primitive, where these are not the same."""
    distance: Floats
    """(D,) float64, pixels from the edge that may decide them; infinite in families where no pixel may differ."""
    allowed: int
    """How many may differ, but for those beside an edge."""
    depth_error: float
    """Largest difference of depth where the primitives agree."""
    color_error: float
    """Largest difference of a colour component there; texels on whose border the sample lies left out."""
    depth_excess: float
    """Largest difference of depth as a share of what is tolerated: at most 1."""
    color_excess: float
    """The same for colours."""

    @property
    def agrees(self) -> bool:
        """Whether the pictures are the same within the tolerances."""
        return self.unexplained <= self.allowed and self.depth_excess <= 1 and self.color_excess <= 1

    @property
    def unexplained(self) -> int:
        """How many of the differing pixels do not lie beside an edge."""
        return int((self.distance > BOUND).sum())


@dataclass(frozen=True, eq=False)
class OurPicture:
    """What the core drew, with how much of an error each value may have; row 0 is the bottom row."""

    color: Floats
    """(H, W, 4)."""
    depth: Floats
    """(H, W)."""
    primitive: Integers
    """(H, W)."""
    color_tolerance: Floats
    """(H, W)."""
    depth_tolerance: Floats
    """(H, W)."""


def compare(case: Case, expected: Picture, fill: str = "hierarchy", line: str = "diamond-exit") -> Comparison:
    """Draw ``case`` with the core and compare with what OpenGL drew.

    Parameters
    ----------
    fill : str
        A method of the family ``fill``, for triangles.
    line : str
        A method of the family ``line``, for lines.
    """
    ours = draw_with_core(case, fill, line)
    is_same = ours.primitive == expected.primitive
    row, column = np.nonzero(~is_same)
    primitives = (ours.primitive[~is_same], expected.primitive[~is_same])
    depth_error = np.abs(ours.depth - expected.depth)[is_same]
    color_error = np.abs(ours.color - expected.color).max(axis=-1)[is_same]
    color_tolerance = ours.color_tolerance[is_same]
    is_compared = np.isfinite(color_tolerance)
    differing = np.stack([column, row, *primitives], axis=1).astype(np.int64)
    is_beside = case.family in BESIDE_EDGES
    return Comparison(
        pixels=is_same.size,
        drawn=int((expected.primitive >= 0).sum()),
        differing=differing,
        distance=edge_distances(case, differing) if is_beside else np.full(len(differing), np.inf),
        allowed=PIXELS_ALLOWED.get(case.family, 0),
        depth_error=float(depth_error.max(initial=0)),
        color_error=float(color_error[is_compared].max(initial=0)),
        depth_excess=float((depth_error / ours.depth_tolerance[is_same]).max(initial=0)),
        color_excess=float((color_error / color_tolerance).max(initial=0)),
    )


def draw_with_core(case: Case, fill: str = "hierarchy", line: str = "diamond-exit") -> OurPicture:
    """Draw ``case`` with the core, triangles with ``fill``, lines with ``line``."""
    return _draw_lines(case, line) if case.is_lines else _draw_triangles(case, fill)


def _draw_triangles(case: Case, fill: str) -> OurPicture:
    frame = draw_triangles(case.clip, *case.size, case.attributes, case.texture, case.settings(fill))
    depth_tolerance = np.full(frame.depth.shape, DEPTH_TOLERANCE)
    color_tolerance = np.full(frame.depth.shape, COLOR_TOLERANCE)
    primitive = frame.primitive.astype(np.int64)
    row, column = np.nonzero(primitive >= 0)
    triangle = primitive[row, column]
    reach = DISPLACEMENT * max(case.size) * (4 if case.family in BESIDE_EDGES else 1)

    # Depth is linear in the window, attributes are or are not.
    clip = case.clip.astype(float)
    homogeneous = place_corners(clip, case.size, "snapped").homogeneous
    planes = set_up_planes(homogeneous)
    depth_slope = _slopes(planes, (clip[..., 2] + clip[..., 3]) / 2, triangle, None)
    depth_tolerance[row, column] += reach * depth_slope
    if case.interpolation != "flat":
        x, y = column.astype(float) + 0.5, row.astype(float) + 0.5
        if case.interpolation == "affine":
            planes = set_up_planes(homogeneous / homogeneous[..., 2:])
        slopes = [
            _slopes(planes, case.attributes[..., k].astype(float), triangle, (x, y))
            for k in range(case.attributes.shape[-1])
        ]
        steepest = np.max(slopes, axis=0)
        if case.texture is None:
            color_tolerance[row, column] += reach * steepest
        elif case.texture_filter == "nearest":
            # The texel is another one only where the sample lies on its border.
            texels = np.array(case.texture.pixels.shape[1::-1])
            position = frame.attributes[row, column, :2].astype(float) * texels
            margin = (reach * steepest + 1e-6)[:, None] * texels
            is_on_border = (np.abs(position - np.rint(position)) <= margin).any(axis=1)
            color_tolerance[row[is_on_border], column[is_on_border]] = np.inf
        else:
            texels_moved = reach * steepest * max(case.texture.pixels.shape[:2])
            color_tolerance[row, column] = BILINEAR_TOLERANCE + texels_moved
    return OurPicture(
        frame.color.astype(float), frame.depth.astype(float), primitive, color_tolerance, depth_tolerance
    )


def _slopes(planes: Planes, values: Floats, triangle: Integers, at: tuple[Floats, Floats] | None) -> Floats:
    """Return (F,): how much values (T, 3) change per pixel; without ``at`` they are linear in the window."""
    a, b, c = (plane[triangle] for plane in value_plane(planes, values))
    if at is None:
        return np.hypot(a, b)
    x, y = at
    a_w, b_w, c_w = (plane[triangle] for plane in value_plane(planes, np.ones_like(values)))
    inverse_w = a_w * x + b_w * y + c_w
    value = (a * x + b * y + c) / inverse_w
    return np.hypot(a - value * a_w, b - value * b_w) / np.abs(inverse_w)


def _draw_lines(case: Case, line: str) -> OurPicture:
    width, height = case.size
    clip = case.clip.astype(float)
    w = clip[..., 3]
    window = (clip[..., :2] / w[..., None] + 1) * np.array(case.size) / 2
    drawn = draw_lines(window, width, height, line=line)
    owner, t = drawn.owner, drawn.steps.t
    length = np.maximum(np.abs(window[:, 1] - window[:, 0]).max(axis=1), 1e-3)[owner]
    reach = DISPLACEMENT * max(case.size) / length

    values = np.zeros((*case.clip.shape[:2], 4))
    values[..., 3] = 1
    values[..., : case.attributes.shape[2]] = case.attributes
    depths = ((clip[..., 2] / w + 1) / 2)[..., None]
    buffers = {
        "color": (np.zeros((height, width, 4)), interpolate_line(owner, t, values, w)),
        # A pixel beyond an end may be deeper than any buffer: OpenGL clamps.
        "depth": (np.ones((height, width)), np.clip(interpolate_line(owner, t, depths)[:, 0], 0, 1)),
        "primitive": (np.full((height, width), -1), owner),
        "color_tolerance": (
            np.full((height, width), COLOR_TOLERANCE),
            COLOR_TOLERANCE + _spread(owner, t, reach, values, w),
        ),
        "depth_tolerance": (
            np.full((height, width), DEPTH_TOLERANCE),
            DEPTH_TOLERANCE + _spread(owner, t, reach, depths, None),
        ),
    }
    column, row = drawn.pixels.T
    for buffer, pixels in buffers.values():
        buffer[row, column] = pixels  # the last drawn of one pixel stays
    return OurPicture(**{name: buffer for name, (buffer, _) in buffers.items()})


def _spread(owner: Integers, t: Floats, reach: Floats, values: Floats, w: Floats | None) -> Floats:
    """Return (P,): how much interpolated values change if t changes by ``reach`` (P,)."""
    after, before = (interpolate_line(owner, t + step, values, w) for step in (reach, -reach))
    return np.asarray(np.abs(after - before).max(axis=1) / 2)
