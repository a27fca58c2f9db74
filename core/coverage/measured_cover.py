"""How often each pixel is covered: number formats on slivers and far corners, meshes without gaps, added slopes."""

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass
from functools import lru_cache, partial

import numpy as np

from core.coverage.measured_exactly import count_pixels, exact_spans
from core.coverage.number_formats import number_format
from core.coverage.pixel_runs import make_raster
from core.records.arrays import Floats, Integers
from core.records.frame import StageCount
from core.scene import ClipScene
from core.settings import Settings
from core.stages.bin_and_raster import covered
from core.stages.declared import STAGES
from core.stages.vertices import Geometry, process_geometry
from core.study.case_text import clip_text, cover_text, settings_text
from core.study.experiment import Case, Experiment
from core.study.family import settings_of
from core.study.record import Axis, Judgement, Outcome, Verdict
from core.study.workloads import (
    clip_of_window,
    flat_scene,
    grid_triangles,
    on_grid,
    random_source,
    window_mesh,
)

# Experiments on coverage: triangles are drawn, and how often each pixel is covered is counted.


EVERY_PIXEL = Settings(fill="bounding-box")
"""Any number format can be drawn so, and every pixel of a triangle's box is tested by it."""
Wanted = Callable[[ClipScene, Settings], Integers]
"""How often each pixel of a scene is to be covered, (H, W) int64."""
Cover = tuple[Integers, Geometry]
"""How often each pixel is covered, (H, W) int64, and the geometry."""


def as_given(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64, how many triangles cover each pixel in rational arithmetic, corners where they are."""
    return _exact_cover(scene, False)


def on_its_grid(scene: ClipScene, settings: Settings) -> Integers:
    """Return the same with the corners where the number format puts them: snapped for those that snap."""
    return _exact_cover(scene, number_format(settings.coverage).corner_kind == "snapped")


def once_everywhere(scene: ClipScene, settings: Settings) -> Integers:
    """Return (H, W) int64 ones: what a mesh without gaps covers that reaches beyond the window."""
    return np.ones(scene.size[::-1], np.int64)


@lru_cache(maxsize=1024)
def _exact_cover(scene: ClipScene, is_snapped: bool) -> Integers:
    _, column, row = exact_spans(scene.clip, scene.size, is_snapped=is_snapped).pixels()
    return count_pixels(column, row, scene.size)


class CoverCase(Case):
    """Triangles; wrong is a pixel that is covered more or less often than ``wanted``."""

    scene: ClipScene

    def __init__(self, scene: ClipScene, wanted: Wanted = as_given) -> None:
        super().__init__(scene)
        self.wanted = wanted

    def start(self, settings: Settings) -> Callable[[], Cover]:
        """Prepare the stages up to the rasterization."""
        return partial(count_cover, copy(self.scene), settings)

    def judge(self, settings: Settings, made: Cover) -> Judgement:
        """Say how many pixels of the cover (H, W) are missing or drawn too often, and why."""
        cover, geometry = made
        error = cover - self.wanted(self.scene, settings)
        missing, extra = int(np.maximum(-error, 0).sum()), int(np.maximum(error, 0).sum())
        if not missing and not extra:
            verdict = Verdict(Outcome.RIGHT, 0.0, f"all {error.size} pixels are right")
        else:
            verdict = self.fault(settings, geometry, cover, missing, extra)
        return Judgement(verdict, error != 0)

    def fault(
        self, settings: Settings, geometry: Geometry, cover: Integers, missing: int, extra: int
    ) -> Verdict:
        """Return what is wrong with the cover (H, W): the numbers themselves, or pixels missing or drawn too often."""
        outcome = _number_trouble(self.scene, settings, geometry, cover)
        if outcome is None:
            outcome = Outcome.HOLE if missing >= extra else Outcome.DOUBLE_HIT
        remark = f"{missing:,} of {cover.size:,} pixels missing, {extra:,} drawn too often"
        return Verdict(outcome, float(missing + extra), remark)

    def test_body(self, settings: Settings) -> str:
        """Return the statements of a test: how often each pixel should be covered."""
        rows = "\n".join(f'    "{row}",' for row in cover_text(self.wanted(self.scene, settings)))
        return (
            f"clip = {clip_text(self.scene.clip)}\n"
            f"scene = ClipScene(np.array(clip, float), size={self.scene.size})\n"
            f"cover = render(scene, {settings_text(settings)}).cover_count\n"
            f'rows = ["".join(".123456789"[min(count, 9)] for count in row) for row in cover[::-1]]\n'
            f"assert rows == [\n{rows}\n]"
        )


class MeshPartCase(CoverCase):
    """Part of a mesh without gaps; wrong is a pixel that several triangles draw and one has, or one has and none draws.

    Notes
    -----
    One triangle that draws a pixel of its neighbour is not wrong by itself: only together they tell.
    """

    def judge(self, settings: Settings, made: Cover) -> Judgement:
        """Say how many pixels of the cover (H, W) are lost or drawn twice."""
        cover, geometry = made
        wanted = self.wanted(self.scene, settings)
        extra = int(np.maximum(cover - np.maximum(wanted, 1), 0).sum())
        missing = int(((cover == 0) & (wanted > 0)).sum())
        verdict = Verdict(Outcome.RIGHT, 0.0, "no pixel is lost or drawn twice")
        if missing or extra:
            verdict = self.fault(settings, geometry, cover, missing, extra)
        return Judgement(verdict, cover != wanted)


@dataclass(frozen=True, eq=False)
class CoverageExperiment(Experiment):
    """An experiment on triangles that knows how often each pixel is to be covered.

    Of a mesh that covers everything once, parts are judged as parts.
    """

    case_of: Callable[..., CoverCase] = CoverCase
    base: Settings = EVERY_PIXEL
    wanted: Wanted = as_given

    def work(self, place: tuple[float, ...], seed: int) -> CoverCase:
        """Return the triangles at a place."""
        return self.case_of(self.make(place, seed), self.wanted)

    def part(self, scene: ClipScene) -> CoverCase:
        """Return any triangles with what is right for them."""
        return MeshPartCase(scene) if self.wanted is once_everywhere else self.case_of(scene, self.wanted)


def count_cover(scene: ClipScene, settings: Settings) -> Cover:
    """Run the stages up to the rasterization: (H, W) int64 how often each pixel is covered, and the geometry.

    Raises ValueError if a method does not take the scene.
    """
    counts = {stage: StageCount() for stage in STAGES}
    geometry = process_geometry(scene, settings, counts)
    raster = make_raster(scene.size, settings.pixel_center)
    cover = np.zeros(scene.size[::-1], np.int64)
    for fragments in covered(geometry, raster, counts):
        cover += count_pixels(fragments.column, fragments.row, scene.size)
    return cover, geometry


def _number_trouble(
    scene: ClipScene, settings: Settings, geometry: Geometry, cover: Integers
) -> Outcome | None:
    """Return whether edge functions left the range of their numbers: NaN, infinite, or wrapped around.

    Notes
    -----
    A whole number does not show that it wrapped around. But their products and sums forget nothing else:
    where pixels differ from those of exact numbers on the same grid, a value did not fit.
    """
    edges = geometry.edges
    if edges.numbers.rounding == "wrapped":
        on_grid, _ = count_cover(scene, settings_of(settings, "coverage=snapped"))
        return Outcome.OVERFLOW if (cover != on_grid).any() else None
    if edges.a.dtype == object:
        return None
    parts = np.concatenate([edges.a, edges.b, edges.c])
    if np.isnan(parts).any():
        return Outcome.NOT_A_NUMBER
    return Outcome.OVERFLOW if np.isinf(parts).any() else None


# What every number format makes of slivers, far corners, singular matrices and triangles smaller than a
# step.


SIZE = (64, 64)
"""A power of two: window positions that are multiples of 1/256 pixel are exact in clip space."""
W_RATIOS = (0.001, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1000.0)
FORMATS = (
    "coverage=float16",
    "coverage=fixed-24.8",
    "coverage=float32",
    "coverage=inverse",
    "coverage=snapped",
    "coverage=int64",
    "coverage=float64",
    "coverage=exact",
)


def scene_of_window(window: Floats, size: tuple[int, int] = SIZE) -> ClipScene:
    """Return triangles with corners (T, 3, 2) in pixels, all at one depth, w = 1."""
    level = np.ones(window.shape[:2])
    return flat_scene(clip_of_window(window, size, 0.5 * level, level), size)


def powers(first: int, last: int, step: int = 1) -> tuple[float, ...]:
    """Return 2^first to 2^last."""
    return tuple(2.0**exponent for exponent in range(first, last + 1, step))


def sliver(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle ``width`` pixels high whose long side lies ``offset`` pixels below a row of pixel centres.

    Notes
    -----
    The side has the slope 1/3 and passes under ten centres. It begins at the window's middle, where clip space has
    its 0: there it holds 2^-50 pixel.
    """
    width, offset = place
    start, end = np.array([0.5, 0.5]), np.array([27.5, 9.5])
    clip = np.array([[*point, 0.0, 1.0] for point in (start / 32, end / 32, (start + end) / 64)])
    clip[:, 1] -= offset / 32
    clip[2, 1] += width / 32
    return flat_scene(clip[None], SIZE)


def far_corners(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle whose far corners lie ``distance`` pixels away; one edge passes through the window.

    Notes
    -----
    The edge passes ``offset`` steps of 1/256 pixel below pixel centres, about in the diagonal. All corners are on the
    1/256-pixel grid, so that snapping changes nothing.
    """
    distance, steps = place
    below = np.array([32.5, 32.5 - steps / 256])
    far = distance * np.array([1.0, 0.75])
    window = np.array([below - far, below + far, below + distance * np.array([-0.5, 1.0])])
    return scene_of_window(on_grid(window, 256)[None])


def edge_on(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a triangle almost seen edge-on: its corners' matrix is about ``distance`` from a singular one.

    Notes
    -----
    It is ``distance`` pixels high, with a row of pixel centres at half its height; one corner has w = 1, another
    w = ``ratio``, the third their mean.
    """
    distance, ratio = place
    below = np.array([0.0, distance / 2])
    start, end = np.array([4.5, 8.5]) - below, np.array([58.5, 44.5]) - below
    window = np.array([start, end, (start + end) / 2 + 4 * below])
    w = np.array([1.0, ratio, (1.0 + ratio) / 2])
    return flat_scene(clip_of_window(window[None], SIZE, np.full((1, 3), 0.5), w[None]), SIZE)


def crowded_mesh(place: tuple[float, ...], seed: int) -> ClipScene:
    """Return a mesh whose grid lines crowd around the pixel centres, ``cell`` pixels apart: small cells and long ones.

    Notes
    -----
    Every pixel belongs to exactly one triangle. ``shift`` moves the lines, in cells. Corners are moved by less than a
    quarter of a cell, so that no triangle turns over.
    """
    cell, shift = place
    side, reach = 4, 2
    source = random_source(seed)
    around = cell * (np.arange(-reach, reach + 1) + shift)
    lines = np.concatenate([[-1.0], (0.5 + np.arange(side)[:, None] + around).ravel(), [side + 1.0]])
    points = np.stack(np.meshgrid(lines, lines), axis=-1)
    points[1:-1, 1:-1] += cell * on_grid(source.uniform(-0.24, 0.24, (len(lines) - 2, len(lines) - 2, 2)))
    return scene_of_window(grid_triangles(points), (side, side))


SLIVERS = CoverageExperiment(
    "slivers",
    "Slivers by width and offset",
    "The lower side of a long thin triangle lies just below ten pixel centres. How thin may it be, and how "
    "close?",
    (
        Axis("width", "Height of the sliver", "pixels", powers(-24, 0, 3), True),
        Axis("offset", "Distance of the centres from its side", "pixels", powers(-50, -2, 3), True),
    ),
    FORMATS,
    "Snapped corners lose slivers thinner than 1/256 pixel. float32 errs from 2^-17 pixel on, float64 from "
    "2^-47. Whole numbers of any length are right at every width and offset.",
    sliver,
)
COORDINATES = CoverageExperiment(
    "coordinates",
    "Coordinates from 1 to 2^30 pixels",
    "An edge passes just below pixel centres of the window while its ends move away. When is a pixel lost?",
    (
        Axis("distance", "Distance of the corners", "pixels", powers(3, 30, 1), True),
        Axis(
            "steps",
            "Distance of the edge from the centres",
            "1/256 pixel",
            tuple(map(float, range(-4, 5))),
        ),
    ),
    FORMATS,
    "32 bits wrap around from 128 pixels on, 64 bits beyond 4 million. float32 errs from 2^17 pixels on. "
    "float64 and whole numbers of any length are right up to 2^30.",
    far_corners,
)
SINGULAR = CoverageExperiment(
    "singular-matrix",
    "Triangles seen almost edge-on",
    "The 3x3 matrix of the corners is nearly singular. Do its inverse, its adjugate and whole numbers agree?",
    (
        Axis("distance", "Distance from a singular matrix", "pixels", powers(-54, 0, 3), True),
        Axis("ratio", "w of the second corner over the first", "", W_RATIOS, True),
    ),
    ("coverage=float32", "coverage=inverse", "coverage=snapped", "coverage=float64", "coverage=exact"),
    "Floats err where a triangle is flatter than their spacing, snapped corners where it is flatter than "
    "1/256 pixel. Whole numbers of any length are right at any distance.",
    edge_on,
)
SNAPPING = CoverageExperiment(
    "snapping",
    "Corners snapped or not",
    "The grid lines of a mesh move closer and closer around pixel centres. Is every pixel drawn exactly once?",
    (
        Axis("cell", "Size of a cell", "pixels", powers(-20, -3, 1), True),
        Axis(
            "shift",
            "Place of the lines",
            "cells",
            (-0.5, -0.375, -0.25, -0.125, 0.0, 0.125, 0.25, 0.375, 0.5),
        ),
    ),
    ("coverage=float32", "coverage=snapped", "coverage=int64", "coverage=float64", "coverage=exact"),
    "Snapping can turn over triangles of about 1/256 pixel, and they are drawn twice. float32 errs below 2^-9"
    " pixel, whatever the grid. float64 and whole numbers draw every pixel once.",
    crowded_mesh,
    wanted=once_everywhere,
)
FORMAT_EXPERIMENTS = (SLIVERS, COORDINATES, SINGULAR, SNAPPING)


# Meshes without gaps: every pixel of the window is to be covered exactly once.


SIDE = 32
"""Columns and rows of the pictures."""


def uneven_grid(cells: int, steps: int, seed: int) -> ClipScene:
    """Return a mesh of uneven cells that reaches beyond the window, with corners at multiples of 1/steps pixel."""
    return scene_of_window(window_mesh((SIDE, SIDE), cells, seed, steps), (SIDE, SIDE))


def through_the_eye(tilt: float, cells: int, seed: int) -> ClipScene:
    """Return a plane that fills the window and goes on behind the eye, as a grid of ``cells`` x ``cells`` cells.

    Notes
    -----
    Its points are (s, t, 1 - tilt t) in clip x, y, w. The window's top sees t = 1 / (1 + tilt), its bottom
    t = -1 / (1 - tilt); the grid reaches to t = 4, where w is negative for a tilt above 1/4.
    """
    source = random_source(seed)
    low, high = -1.0 / (1.0 - tilt) - 1.0, 4.0
    across, along = np.meshgrid(np.linspace(-5, 5, cells + 1), np.linspace(low, high, cells + 1))
    points = np.stack([across, along], axis=-1)
    step = np.array([10.0, high - low]) / cells
    points[1:-1, 1:-1] += source.uniform(-0.24, 0.24, (cells - 1, cells - 1, 2)) * step
    x, y = on_grid(points).transpose(2, 0, 1)
    clip = np.stack([x, y, np.zeros_like(x), 1.0 - tilt * y], axis=-1)
    return flat_scene(grid_triangles(clip), (SIDE, SIDE))


SHARED_EDGES = CoverageExperiment(
    "shared-edges",
    "Shared edges of a mesh",
    "A mesh fills the window, with its corners on a grid. Is every pixel drawn exactly once?",
    (
        Axis("steps", "Grid steps of the corners per pixel", "", powers(0, 10), True),
        Axis("cells", "Cells along a side", "", (4.0, 6.0, 8.0, 12.0, 16.0), True),
    ),
    (
        "fill=scanline-lecture",
        "fill_rule=exclusive",
        "fill_rule=inclusive",
        "coverage=float16",
        "coverage=inverse",
        "coverage=float32",
        "coverage=float64",
        "fill_rule=shared-edge",
        "fill=spans",
        "coverage=exact",
    ),
    "Where corners lie on pixel centres, exclusive edges leave cracks and inclusive edges are drawn twice. "
    "The shared-edge rule draws every pixel once if an edge has the same value in both triangles.",
    lambda place, seed: uneven_grid(int(place[1]), int(place[0]), seed),
    wanted=once_everywhere,
)
THROUGH_THE_EYE = CoverageExperiment(
    "mesh-through-the-eye",
    "A mesh that continues behind the eye",
    "A plane fills the window and continues behind the eye, where w is negative. Is every pixel drawn exactly"
    " once?",
    (
        Axis("tilt", "Decrease of w per unit of y", "", tuple((np.arange(9) / 10).tolist())),
        Axis("cells", "Cells along a side", "", (2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0), True),
    ),
    (
        "clipping=project-first",
        "clipping=after-divide",
        "clipping=sutherland-hodgman-lecture",
        "clipping=sutherland-hodgman",
        "clipping=homogeneous",
        "coverage=float64",
        "coverage=exact",
    ),
    "Projecting first mirrors corners with w < 0 and draws the wrong triangle. Clipping in clip space and "
    "homogeneous edge functions draw every pixel once.",
    lambda place, seed: through_the_eye(place[0], int(place[1]), seed),
    wanted=once_everywhere,
)
MESH_EXPERIMENTS = (SHARED_EDGES, THROUGH_THE_EYE)
