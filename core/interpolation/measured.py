"""Interpolation measured: texture coordinates against exact ones, and how far they stray without perspective.

The three corners of a triangle in the homogeneous window, multiplied to whole numbers, have whole-number cross
products n_k: the shares of the corners in a point of the window are in proportion to them. A value is
sum(n_k v_k) / sum(n_k), the depth z/w is sum(n_k z_k) / det.

References
----------
M. Zwicker, *Computergrafik*, lecture "Perspective correct interpolation", Bern 2016.

References
----------
J. Blinn, *Hyperbolic interpolation*, 1992.
"""

from dataclasses import dataclass
from fractions import Fraction
from math import lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.measured_exactly import doubled_center, exact_spans, homogeneous_corner
from core.interpolation.corrected_affine import largest_affine_error
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.frame import Frame
from core.records.primitives import interpolation_form
from core.scene import ClipScene
from core.settings import Settings
from core.study.case_text import pixels_text
from core.study.experiment import VALUED_TRIANGLES, Case, Experiment, check_in_view_volume
from core.study.family import Assignment, Candidate, StudyFamily
from core.study.frame_task import FrameTask, scalar_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Outcome, Pictures, Verdict, WorkKind, judged
from core.study.workloads import receding_quad
from core.trace import trace

# Depth and attributes of triangles at pixel centres, in Python's integers, rounded once at the end.


Whole = NDArray[Any]
"""Python integers, as an array of objects."""


@dataclass(frozen=True, eq=False)
class ExactPlanes:
    """Linear functions of one triangle over doubled pixel positions, in whole numbers."""

    coefficients: tuple[tuple[int, int, int], ...]
    """a, b, c of n_k, for doubled x and y."""
    determinant: int
    """Of the (x, y, w) matrix, in the same unit; 0: seen edge-on."""
    depth: tuple[int, int, int, int]
    """a, b, c of the window depth over doubled x and y, and what it is to be divided by (positive)."""


def exact_planes(corners: Floats, size: tuple[int, int]) -> ExactPlanes:
    """Return the planes of a triangle given in clip space, (3, 4) float64, before snapping."""
    placed = [homogeneous_corner(corner, size) for corner in corners]
    scale = lcm(*(value.denominator for corner in placed for value in corner))
    rows = [tuple(int(value * scale) for value in corner) for corner in placed]
    coefficients = []
    for k in range(3):
        (x1, y1, w1), (x2, y2, w2) = rows[k - 2], rows[k - 1]
        a, b, c = y1 * w2 - w1 * y2, w1 * x2 - x1 * w2, x1 * y2 - y1 * x2
        coefficients.append((a, b, 2 * c))
    (x, y, w), (a, b, c) = rows[0], coefficients[0]
    determinant = x * a + y * b + w * c // 2
    return ExactPlanes(
        tuple(coefficients), determinant, _depth_plane(corners, coefficients, determinant, scale)
    )


def _depth_plane(
    corners: Floats, coefficients: list[tuple[int, int, int]], determinant: int, scale: int
) -> tuple[int, int, int, int]:
    """Return (z/w + 1)/2 over doubled positions: sum(n_k z_k) / det, which is measured in ``scale`` units of w."""
    z = [Fraction(float(corner[2])) for corner in corners]
    unit = lcm(*(value.denominator for value in z))
    heights = [int(value * unit) for value in z]
    a, b, c = (
        sum(part[i] * height for part, height in zip(coefficients, heights, strict=True)) for i in range(3)
    )
    # z/w = scale sum(n_k z_k) / (2 det), n_k taken at doubled positions; half of it and a half are the depth.
    divisor = 4 * determinant * unit
    sign = -1 if divisor < 0 else 1
    return sign * scale * a, sign * scale * b, sign * (scale * c + divisor // 2), abs(divisor)


def _at(plane: tuple[int, int, int], doubled_x: Whole, doubled_y: Whole) -> Whole:
    a, b, c = plane
    return np.asarray(a * doubled_x + b * doubled_y + c)


def _doubled(index: Integers, doubled_center: int) -> Whole:
    return np.asarray((2 * index + doubled_center).astype(object))


def exact_values(
    corners: Floats,
    values: Floats,
    size: tuple[int, int],
    column: Integers,
    row: Integers,
    pixel_center: str = "half",
) -> Floats:
    """Return perspective-correct values (F, K) float64, correctly rounded, of values (3, K) at the corners (3, 4).

    Notes
    -----
    NaN for a triangle that is seen edge-on, or where 1/w is 0.
    """
    planes, center = exact_planes(corners, size), doubled_center(pixel_center)
    x, y = _doubled(column, center), _doubled(row, center)
    shares = [_at(plane, x, y) for plane in planes.coefficients]
    total = shares[0] + shares[1] + shares[2]
    result = np.full((len(column), values.shape[1]), np.nan)
    defined = np.flatnonzero(total != 0) if planes.determinant else np.empty(0, np.int64)
    for k, of_corners in enumerate(values.T):
        exact = [Fraction(float(value)) for value in of_corners]
        unit = lcm(*(value.denominator for value in exact))
        first, second, third = (int(value * unit) for value in exact)
        mixed = first * shares[0] + second * shares[1] + third * shares[2]
        result[defined, k] = (mixed[defined] / (unit * total[defined])).astype(np.float64)
    return result


@dataclass(frozen=True, eq=False)
class ExactFragments:
    """F covered pixels whose depth is in range, in drawing order."""

    triangle: Integers
    """(F,) int64."""
    column: Integers
    row: Integers
    depth: Floats
    """(F,) float64, window depth, correctly rounded."""
    planes: dict[int, ExactPlanes]
    """By triangle, to compare depths that round to the same number."""


def exact_fragments(clip: Floats, size: tuple[int, int]) -> ExactFragments:
    """Return the pixels of triangles (T, 3, 4), of corners on the grid, that lie between the near and the far plane.

    Notes
    -----
    Depth comes from the corners before snapping. A triangle that is in range as a whole keeps all its pixels, as its
    depth is clamped where snapping makes it reach a hair farther; only others are decided pixel by pixel.
    """
    triangle, column, row = exact_spans(clip, size).pixels()
    depth, keeps = np.zeros(len(triangle)), np.ones(len(triangle), bool)
    planes: dict[int, ExactPlanes] = {}
    center = doubled_center("half")
    ends = np.flatnonzero(np.diff(triangle, append=-1)) + 1
    for first, end in zip([0, *ends][:-1], ends, strict=True):
        part, number = slice(first, end), int(triangle[first])
        plane = planes[number] = exact_planes(clip[number], size)
        above = _at(plane.depth[:3], _doubled(column[part], center), _doubled(row[part], center))
        below = plane.depth[3]
        if below == 0:
            keeps[part] = False
            continue
        depth[part] = (above / below).astype(np.float64)
        _, _, z, w = clip[number].T
        if ((np.abs(z) > w) | (w <= 0)).any():
            keeps[part] = (above >= 0) & (above <= below)
    depth = np.clip(depth, 0.0, 1.0)
    return ExactFragments(triangle[keeps], column[keeps], row[keeps], depth[keeps], planes)


def exact_visible(fragments: ExactFragments, size: tuple[int, int]) -> Integers:
    """Return the triangle that is nearest at every pixel, (H, W) int64, -1 for none; a tie keeps the first drawn."""
    width, height = size
    pixel = fragments.row * width + fragments.column
    order = np.lexsort((fragments.triangle, fragments.depth, pixel))
    seen = np.full(width * height, -1)
    starts = np.flatnonzero(np.diff(pixel[order], prepend=-1))
    seen[pixel[order[starts]]] = fragments.triangle[order[starts]]

    # Depths that are hardly apart are compared as fractions.
    first, second = order[:-1], order[1:]
    close = (pixel[first] == pixel[second]) & (fragments.depth[second] - fragments.depth[first] <= 2.0**-50)
    for at in np.unique(pixel[first[close]]):
        candidates = np.flatnonzero(pixel == at)
        nearest = min(candidates, key=lambda k: (_exact_depth(fragments, int(k)), fragments.triangle[k]))
        seen[at] = fragments.triangle[nearest]
    return seen.reshape(height, width)


def exact_nearest(clip: Floats, size: tuple[int, int]) -> Integers:
    """Return (H, W) int64, the nearest of triangles (T, 3, 4) in clip space, whichever way it faces; -1: none."""
    return exact_visible(exact_fragments(clip, size), size)


def _exact_depth(fragments: ExactFragments, index: int) -> Fraction:
    a, b, c, below = fragments.planes[int(fragments.triangle[index])].depth
    center = doubled_center("half")
    x, y = 2 * int(fragments.column[index]) + center, 2 * int(fragments.row[index]) + center
    return min(max(Fraction(a * x + b * y + c, below), Fraction(0)), Fraction(1))


# Study of interpolation: texture coordinates over a square in perspective, against exact ones.


TEXELS = 256
"""Texels on a side of the texture that coordinates are measured by."""
MEAN_TEXEL = ErrorMeasure("mean-texel", "Mean error of the texture coordinate", "texels")
LARGEST_TEXEL = ErrorMeasure("largest-texel", "Largest error of the texture coordinate", "texels")

RATIOS = Axis("w-ratio", "Ratio of w, far over near", "", (1, 1.25, 1.5, 2, 3, 4, 8, 16, 64), default=4)
SIDES = Axis("side", "Side of the picture", "pixels", (16, 32, 64, 128, 256), default=64, is_cost=True)


class InterpolationTask(FrameTask):
    """A square in perspective with texture coordinates; the reference is every coordinate, correctly rounded."""

    stage = "interpolate"

    def __init__(self, assignment: Assignment) -> None:
        side, far = int(assignment.dials["side"]), assignment.dials["w-ratio"]
        self._receding = 1 if assignment.work == "square" else 0
        w = np.array([[1.0, far, far, 1.0], [1.0, 1.0, far, far]][self._receding])
        self._quad = receding_quad((side, side), w)
        super().__init__(self._quad, side * side, ("interpolate",))

    def _coordinates(self, settings: Settings) -> tuple[Floats, Floats]:
        """Return coordinates (H, W, 2) of the method, before they are rounded to float32, and exact ones; in texels."""
        width, height = self.scene.size
        source = trace(self._quad, settings).source
        result, exact = np.full((2, height, width, 2), np.nan)
        fragments, triangle = source.fragments, source.triangle_of_fragment
        values = source.interpolated[1]
        assert self._quad.attributes is not None
        for number in range(len(self._quad.clip)):
            chosen = np.flatnonzero(triangle == number)
            column, row = fragments.column[chosen], fragments.row[chosen]
            result[row, column] = values[chosen]
            exact[row, column] = exact_values(
                self._quad.clip[number],
                self._quad.attributes[number],
                self.scene.size,
                column,
                row,
                settings.pixel_center,
            )
        return TEXELS * result, TEXELS * exact

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and how often 1/w is divided by: once for each pixel or anchor."""
        divisions = 0
        if interpolation_form(settings.interpolation) == "perspective":
            traced = trace(self._quad, settings)
            fragments, (x, _) = traced.source.fragments, traced.source.centers
            places = traced.stage("interpolate").columns.get("anchor_x", x[:, None])
            rows = np.broadcast_to((fragments.primitive * len(x) + fragments.row)[:, None], places.shape)
            divisions = len(np.unique(np.stack([rows.ravel(), places.ravel()]), axis=1).T)
        return super().counts(settings, made) | {"divisions by 1/w": divisions}

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Return how far the coordinates are off."""
        result, exact = self._coordinates(settings)
        distance = np.abs(result - exact).max(axis=2)
        distance = distance[np.isfinite(distance)]
        errors = {MEAN_TEXEL.name: float(distance.mean()), LARGEST_TEXEL.name: float(distance.max())}
        return judged(errors, LARGEST_TEXEL.name, tolerance=0.5)

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return the coordinate, u or v, that runs towards the far side, in texels."""
        result, exact = self._coordinates(settings)
        return scalar_pictures(result[..., self._receding], exact[..., self._receding])


INTERPOLATION = StudyFamily(
    "interpolation",
    "Interpolation",
    ("interpolation",),
    (
        WorkKind("aside", "A square that recedes to the right", "pixel", (RATIOS, SIDES)),
        WorkKind("square", "A square that leans back", "pixel", (RATIOS, SIDES)),
    ),
    (MEAN_TEXEL, LARGEST_TEXEL),
    InterpolationTask,
    more=tuple(
        Candidate(
            f"interpolation=affine-n correction_interval={interval}",
            f"Affine, corrected every {interval} pixels",
        )
        for interval in (4, 64)
    ),
)


# How far texture coordinates stray where perspective is left out, or put in every n pixels only.


ROWS = 4
"""Rows of the picture: all of them are alike."""
HALF_TEXEL = 1 / 512
"""Half a texel of a texture of 256: a coordinate that strays less takes the same texel, about."""


class StripCase(Case):
    """Triangles that lead away, u their first value; right is u with perspective, by fractions.

    Raises ValueError if a triangle is cut by a plane of depth: its pieces have other ratios of w.
    """

    scene: ClipScene
    stage = "interpolate"

    def __init__(self, scene: ClipScene) -> None:
        super().__init__(scene)
        check_in_view_volume(scene)
        w = scene.clip[..., 3]
        self.bound = float(largest_affine_error(w.max(axis=1) / w.min(axis=1)).max())

    @cached_property
    def wanted(self) -> Floats:
        """(T, H, W) float64, u of every triangle at every pixel, whether it covers it or not."""
        width, height = self.scene.size
        row, column = (index.ravel() for index in np.mgrid[0:height, 0:width])
        attributes = self.scene.attributes
        assert attributes is not None
        u = [
            exact_values(corners, values[:, :1], self.scene.size, column, row)
            for corners, values in zip(self.scene.clip, attributes, strict=True)
        ]
        return np.stack(u).reshape(-1, height, width)

    def _shown_and_wanted(self, frame: Frame) -> tuple[Floats, Floats]:
        """Return u as it is drawn and as it should be, (H, W) float64 each; the same where nothing is drawn."""
        shown = frame.attributes[..., 0].astype(np.float64)
        of_seen = np.take_along_axis(self.wanted, np.maximum(frame.primitive, 0)[None], axis=0)[0]
        return shown, np.where(frame.primitive >= 0, of_seen, shown)

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Return the largest error as a part of the edge, and what it may be without any correction."""
        shown, wanted = self._shown_and_wanted(made)
        error = np.abs(shown - wanted)
        largest = float(error.max())
        remark = (
            f"u is off by {largest:.4g} of the edge; without perspective by (sqrt r - 1)/(sqrt r + 1) = "
            f"{self.bound:.4g} at most"
        )
        outcome = Outcome.RIGHT if largest <= HALF_TEXEL else Outcome.WRONG_PICTURE
        return Judgement(Verdict(outcome, largest, remark), error > HALF_TEXEL)

    def assertions(self, settings: Settings, made: Frame, wrong: Flags) -> str:
        """Return statements that, where ``wrong`` (H, W) bool, u is within half a texel of what it should be."""
        _, wanted = self._shown_and_wanted(made)
        return pixels_text(wrong, wanted, f"abs(frame.attributes[row, column, 0] - wanted) <= {HALF_TEXEL}")


def leaning_strip(w_ratio: float, width: int) -> ClipScene:
    """Return a rectangle of ``width`` x 4 pixels whose right side is ``w_ratio`` times as far as its left side."""
    return receding_quad((width, ROWS), np.array([1.0, w_ratio, w_ratio, 1.0]))


AFFINE = Experiment(
    "affine-w-ratio",
    "Affine interpolation by the ratio of w",
    "A strip recedes from the eye. How far off are texture coordinates without perspective correction, or "
    "with it every n pixels? Right is within half a texel of 256.",
    (
        Axis("w-ratio", "Ratio of w, far over near", "", (1, 1.005, 1.02, 1.1, 1.25, 1.5, 2, 4, 8, 16), True),
        Axis("width", "Length on screen", "pixels", (8, 16, 32, 64, 128, 256, 512), True),
    ),
    (
        "interpolation=affine",
        "interpolation=affine-n correction_interval=64",
        "interpolation=affine-n correction_interval=16",
        "interpolation=affine-n correction_interval=4",
        "interpolation=affine-n correction_interval=1",
        "interpolation=perspective",
    ),
    "Affine interpolation is off by up to (sqrt r - 1)/(sqrt r + 1) of the edge at every length. Corrected "
    "every n pixels, the same bound holds with the ratio of w within n pixels. Perspective-correct "
    "interpolation is right.",
    lambda place, _: leaning_strip(place[0], int(place[1])),
    StripCase,
    kind=VALUED_TRIANGLES,
)
