"""Study of fills, number formats and fill rules: which pixels triangles cover, against rational arithmetic."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from core.raster.pixel_runs import make_raster
from core.records.arrays import Floats, Integers
from core.records.cached import cached_property
from core.records.frame import Frame, StageCount
from core.settings import Settings
from core.stages.bin_and_raster import schedule
from core.stages.declared import STAGES
from core.stages.vertices import process_geometry
from core.study.accuracy.family import Assignment, StudyFamily
from core.study.accuracy.frame_task import MILLION, FrameTask, per_million, scalar_pictures
from core.study.accuracy.record import Axis, ErrorMeasure, Judgement, Opening, Pictures, WorkKind, judged
from core.study.accuracy.workloads import (
    clip_of_window,
    flat_scene,
    random_triangles,
    sliver_triangles,
    window_mesh,
)
from core.study.exact.coverage import count_pixels, exact_spans

SIZE = (256, 256)
COUNT = 48
SLIVERS = 64
MISCLASSIFIED = ErrorMeasure("misclassified", "Misclassified pixels", "per million")
CRACKS = ErrorMeasure("cracks", "Pixels of a mesh not covered exactly once", "per million")
NO_MESH = "Only a mesh without gaps defines how often each pixel must be covered."

SIZES = Axis("size", "Triangle size", "pixels", (2, 4, 8, 16, 32, 64, 128, 256), default=16, is_cost=True)
CHOSEN_SIZES = replace(SIZES, is_cost=False, default=64)
BLOCK_SIZES = Axis(
    "block-size",
    "Block size",
    "pixels",
    (1, 2, 4, 8, 16, 32, 64, 128, 256),
    default=8,
    is_cost=True,
    setting="block_size",
)
ANGLES = Axis("angle", "Angle of the tip", "degrees", (0.05, 0.1, 0.25, 0.5, 1, 2, 4, 8), default=1)
CELLS = Axis("cells", "Cells along a side", "", (4, 8, 16, 32, 64), default=16, is_cost=True)
WORKS = (
    WorkKind("triangles", "Random triangles", "triangle", (SIZES,)),
    WorkKind("slivers", "Slivers in all directions", "triangle", (ANGLES,)),
    WorkKind("mesh", "Mesh without gaps", "triangle", (CELLS,)),
    WorkKind("ties", "Mesh with corners on pixel centres", "triangle", (CELLS,)),
)
BLOCKS = WorkKind(
    "block-size", "Random triangles, by the size of blocks", "triangle", (BLOCK_SIZES, CHOSEN_SIZES)
)
"""Zwicker's question: which size of blocks is the best? It is found by experiment."""


class CoverageTask(FrameTask):
    """Triangles in the window; the reference is how often each pixel is covered, exactly."""

    def __init__(self, assignment: Assignment, stages: tuple[str, ...], is_snapped: bool) -> None:
        self.work = assignment.work
        window = window_triangles(assignment)
        level = np.ones(window.shape[:2])
        clip = clip_of_window(window, SIZE, 0.5 * level, level)
        super().__init__(flat_scene(clip, SIZE), len(clip), stages)
        self._clip, self._is_snapped = clip, is_snapped
        self._block_size = int(assignment.dials.get("block-size", assignment.settings.block_size))

    def start(self, settings: Settings) -> Callable[[], Frame]:
        """Prepare the drawing, with blocks of the size that is measured."""
        return super().start(replace(settings, block_size=self._block_size))

    def opening(self, settings: Settings, made: Frame) -> Opening | None:
        """Return the scene, drawn with these blocks."""
        return super().opening(replace(settings, block_size=self._block_size), made)

    @cached_property
    def reference(self) -> Integers:
        """(H, W) int64, how many triangles cover each pixel."""
        if self.work in ("mesh", "ties") and not self._is_snapped:
            return np.ones(SIZE[::-1], np.int64)
        _, column, row = exact_spans(self._clip, SIZE, is_snapped=self._is_snapped).pixels()
        return count_pixels(column, row, SIZE)

    @cached_property
    def looked_at(self) -> int:
        """Pixels in the boxes around the triangles, by which errors are counted."""
        corners = self._clip[..., :2] / self._clip[..., 3:]
        window = np.clip((corners + 1) * np.array(SIZE) / 2, 0, SIZE)
        width, height = np.ceil(np.ptp(window, axis=1)).T
        return int((width * height).sum())

    def counts(self, settings: Settings, made: Frame) -> dict[str, int]:
        """Return the counts of the frame, and how many blocks or rows the fill looked at in place of pixels."""
        counts = super().counts(settings, made)
        settings = replace(settings, block_size=self._block_size)
        geometry = process_geometry(self.scene, settings, {stage: StageCount() for stage in STAGES})
        _, runs = schedule(geometry.edges, settings, make_raster(SIZE, settings.pixel_center))
        counts["blocks tested"] = 0 if runs.blocks is None else len(runs.blocks.triangle)
        counts["rows solved"] = 0 if runs.crossings is None else len(runs)
        return counts

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count pixels that are covered too often or too seldom, over all triangles."""
        wrong = int(np.abs(made.cover_count - self.reference).sum())
        is_mesh = self.work in ("mesh", "ties")
        cracks = MILLION * float((made.cover_count != 1).mean()) if is_mesh else NO_MESH
        return judged({MISCLASSIFIED.name: per_million(wrong, self.looked_at), CRACKS.name: cracks})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return how often each pixel is covered."""
        return scalar_pictures(made.cover_count, self.reference)


def window_triangles(assignment: Assignment) -> Floats:
    """Return the window corners (T, 3, 2) of the work."""
    dials, seed = assignment.dials, assignment.seed
    match assignment.work:
        case "triangles" | "block-size":
            return random_triangles(SIZE, COUNT, dials["size"], seed)
        case "slivers":
            return sliver_triangles(SIZE, SLIVERS, dials["angle"], seed)
        case "mesh":
            return window_mesh(SIZE, int(dials["cells"]), seed)
    return window_mesh(SIZE, int(dials["cells"]), seed, steps=2)


def make_fill(assignment: Assignment) -> CoverageTask:
    """Make the work of the fills: they decide on corners that are on the grid, and so does the referee."""
    return CoverageTask(assignment, ("bin", "raster"), is_snapped=True)


def make_coverage(assignment: Assignment) -> CoverageTask:
    """Make the work of the number formats: the referee takes the corners as they are."""
    return CoverageTask(assignment, (), is_snapped=False)


FILL = StudyFamily(
    "fill", "Fills of triangles", ("fill",), (*WORKS, BLOCKS), (MISCLASSIFIED, CRACKS), make_fill
)
COVERAGE = StudyFamily(
    "coverage",
    "Number formats and fill rules of coverage",
    ("coverage", "fill_rule"),
    (WORKS[2], WORKS[3], WORKS[0], WORKS[1]),
    (MISCLASSIFIED, CRACKS),
    make_coverage,
    # Any fill takes any coverage; one that tests every pixel shows what the format alone decides.
    Settings(fill="bounding-box"),
)
