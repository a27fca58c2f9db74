"""Studies of coverage: which pixels triangles and rings cover, and on which side of a line a point lies.

One point moves over a grid of the smallest steps u at 1/2, p = (0.5 + x u, 0.5 + y u); q = (12, 12), r = (24, 24). The
sign of (q - p) x (r - p) says on which side of the line through q and r it lies; multiplied out it is 12 (b - a) for
p = (a, b), the sign of y - x. Any of the points may be the pivot, which is taken from the two others.

References
----------
L. Kettner, K. Mehlhorn, S. Pion, S. Schirra, C. Yap, *Classroom examples of robustness problems in geometric
computations*, Computational Geometry 40 (2008): figure 2 and the choice of a pivot point.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from core.coverage.measured_exactly import count_pixels, exact_cover, exact_spans
from core.coverage.pixel_runs import make_raster
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.clip_region import region_of_window
from core.records.frame import Frame, StageCount
from core.records.primitives import Rings, join_rings
from core.scene import ClipScene
from core.settings import Settings
from core.stages.bin_and_raster import schedule
from core.stages.declared import STAGES
from core.stages.vertices import process_geometry
from core.study.family import Assignment, Candidate, StudyFamily, Task
from core.study.frame_task import MILLION, FrameTask, per_million, scalar_pictures
from core.study.record import Axis, ErrorMeasure, Judgement, Pictures, WorkKind, judged
from core.study.workloads import clip_of_window, flat_scene, random_triangles, sliver_triangles, window_mesh

# Study of fills, number formats and fill rules: which pixels triangles cover, against rational arithmetic.


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
        self.turned = {"block_size": int(assignment.dials.get("block-size", assignment.settings.block_size))}

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
        settings = self.with_dials(settings)
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


# Study of the orientation of three points: a published map of wrong signs, for every float format and
# pivot.


FORMATS: Mapping[str, Any] = {
    "float16": np.float16,
    "float32": np.float32,
    "float64": np.float64,
    "exact": np.float64,
}
"""Number formats by what holds the points; ``exact`` computes with whole numbers of 2^-53."""
PIVOTS = ("pivot-p", "pivot-q", "pivot-r")

WRONG = ErrorMeasure("wrong-signs", "Wrong signs", "points")
TURNED = ErrorMeasure("turned-signs", "Signs turned round", "points")
SIDES = Axis("side", "Side of the map", "points", (16, 32, 64, 128, 256), default=256, is_cost=True)


class OrientationTask(Task):
    """The signs of a map of points, with one pivot."""

    def __init__(self, assignment: Assignment) -> None:
        steps = np.arange(int(assignment.dials["side"]))
        self.unit_count = len(steps) ** 2
        self._pivot = PIVOTS.index(assignment.work)
        self.reference: Integers = np.sign(steps[:, None] - steps)
        """(H, W) int64, the exact signs."""

    def start(self, settings: Settings) -> Callable[[], Integers]:
        """Prepare one map."""
        number = FORMATS[settings.coverage]
        moved = number(0.5) + np.arange(len(self.reference)).astype(number) * np.spacing(number(0.5))
        x, y = ([moving, number(12), number(24)] for moving in (moved, moved[:, None]))
        if settings.coverage == "exact":
            x, y = ([_whole(each) for each in places] for places in (x, y))
        order = [(self._pivot + k) % 3 for k in range(3)]
        return partial(orientation, [x[k] for k in order], [y[k] for k in order])

    def counts(self, settings: Settings, made: Integers) -> dict[str, int]:
        """Return how many signs (H, W) are positive, and 0."""
        return {"points to the left": int((made > 0).sum()), "points on the line": int((made == 0).sum())}

    def judge(self, settings: Settings, made: Integers) -> Judgement:
        """Count the wrong signs of a map (H, W), and those of them that are not 0."""
        is_wrong = made != self.reference
        wrong, turned = (float(np.count_nonzero(each)) for each in (is_wrong, is_wrong & (made != 0)))
        return judged({WRONG.name: wrong, TURNED.name: turned})

    def pictures(self, settings: Settings, made: Integers) -> Pictures:
        """Return the maps of signs (H, W)."""
        return scalar_pictures(made, self.reference)


def orientation(x: list[Any], y: list[Any]) -> Integers:
    """Return the signs (H, W) int64 of (q - p) x (r - p) as numbers round; the first of the three is the pivot."""
    value = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])
    return np.asarray((value > 0).astype(np.int64) - (value < 0))


def _whole(places: Any) -> Any:
    """Return coordinates, any shape, as Python's whole numbers of 2^-53."""
    return np.frompyfunc(lambda place: int(float(place) * 2**53), 1, 1)(places)


class _Orientation(StudyFamily):
    """The study of the formats that round as the published code does."""

    def candidates(self, base: Settings) -> tuple[Candidate, ...]:
        """Return one point for each format."""
        return tuple(Candidate(f"coverage={name}", name) for name in FORMATS)


ORIENTATION = _Orientation(
    "orientation",
    "Orientation of three points",
    ("coverage",),
    (
        WorkKind("pivot-p", "Pivot p, moving (Kettner et al. 2008)", "point", (SIDES,)),
        WorkKind("pivot-q", "Pivot q, in the middle (Kettner et al. 2008)", "point", (SIDES,)),
        WorkKind("pivot-r", "Pivot r, far off (Kettner et al. 2008)", "point", (SIDES,)),
    ),
    (WRONG, TURNED),
    OrientationTask,
)


# Studies of polygons: which pixels rings enclose, and what is left of them in a clip window, against whole
# numbers.


SIZE_OF_POLYGONS = (48, 48)
CONNECTING = ErrorMeasure("connecting", "Edges along the window that enclose nothing", "pixels")
WINDOW = np.array([[2.0, 38.0], [46.0, 39.0], [46.0, 47.0], [2.0, 47.0]])
"""(4, 2) convex clip window, in pixels."""
ON_BORDER = 1e-6
"""How far from the window's border an edge on it may lie by rounding, in pixels."""
CORNERS = Axis("corners", "Corners of a ring", "", (4, 8, 16, 32, 64, 128, 256), default=16, is_cost=True)
WORKS_ON_POLYGONS = (
    WorkKind("holes", "A concave polygon with a hole", "polygon", (CORNERS,)),
    WorkKind("crossing", "A polygon that crosses itself", "polygon", (CORNERS,)),
)


def random_rings(work: str, count: int, seed: int) -> list[Floats]:
    """Return rings (count, 2) float64 in `SIZE`: a star with a star-shaped hole, or corners anywhere."""
    generator = np.random.default_rng(seed)
    if work == "crossing":
        return [generator.uniform(0, SIZE_OF_POLYGONS, (count, 2))]
    angle = np.arange(count) * 2 * np.pi / count
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return [
        np.array(SIZE_OF_POLYGONS) / 2 + around[::way] * generator.uniform(low, high, (count, 1))
        for way, low, high in ((1, 14, 23), (-1, 3, 10))
    ]


class PolygonTask(FrameTask):
    """One polygon that both rules fill."""

    def __init__(self, assignment: Assignment) -> None:
        rings = random_rings(assignment.work, int(assignment.dials["corners"]), assignment.seed)
        window = np.concatenate(rings)[None]
        level = np.ones(window.shape[:2])
        starts = np.cumsum([0, *(len(ring) for ring in rings)])
        clip = clip_of_window(window, SIZE_OF_POLYGONS, 0.5 * level, level)
        scene = ClipScene(clip, size=SIZE_OF_POLYGONS, kind="polygons", rings=starts[:-1])
        super().__init__(scene, 1, ("raster",))
        self._rings = Rings(window[0], starts, np.zeros(len(rings), np.int64))

    @cached_property
    def reference(self) -> dict[bool, Flags]:
        """By whether the rule is even-odd: (H, W) bool, the pixels inside."""
        return {rule: exact_cover(self._rings, 0, SIZE_OF_POLYGONS, rule) for rule in (True, False)}

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count pixels that are wrongly covered or left out."""
        wrong = (made.primitive >= 0) != self.reference[settings.polygon_fill == "even-odd"]
        return judged({MISCLASSIFIED.name: per_million(int(np.count_nonzero(wrong)), wrong.size)})

    def pictures(self, settings: Settings, made: Frame) -> Pictures:
        """Return which pixels are covered."""
        reference = self.reference[settings.polygon_fill == "even-odd"]
        return scalar_pictures(made.cover_count, reference.astype(np.int64))


class ClippedPolygonTask(PolygonTask):
    """One polygon that every method clips to the same convex window."""

    @cached_property
    def reference(self) -> dict[bool, Flags]:
        """By whether the rule is even-odd: (H, W) bool, the pixels inside both polygon and window."""
        window = exact_cover(join_rings([[WINDOW]]), 0, SIZE_OF_POLYGONS, is_even_odd=True)
        return {rule: found & window for rule, found in super().reference.items()}

    def __init__(self, assignment: Assignment) -> None:
        super().__init__(assignment)
        assert isinstance(self.scene, ClipScene)
        self.scene = replace(self.scene, clip_region=region_of_window(WINDOW, SIZE_OF_POLYGONS))

    def judge(self, settings: Settings, made: Frame) -> Judgement:
        """Count wrong pixels, and add up the edges along the window's border that enclose nothing."""
        geometry = process_geometry(self.scene, settings, {stage: StageCount() for stage in STAGES})
        assert geometry.polygons is not None
        errors = super().judge(settings, made).errors
        return judged({**errors, CONNECTING.name: _connecting_length(geometry.polygons)})


def _connecting_length(rings: Rings) -> float:
    """Return how long the sides are, in pixels, that run along each other in opposite directions on the window."""
    total = 0.0
    start, end = rings.corners, rings.corners[rings.following]
    for a, b in zip(WINDOW, np.roll(WINDOW, -1, axis=0), strict=True):
        along = (b - a) / np.hypot(*(b - a))
        across = np.array([-along[1], along[0]])
        lies_on = (np.abs((start - a) @ across) < ON_BORDER) & (np.abs((end - a) @ across) < ON_BORDER)
        ends = np.stack([(start[lies_on] - a) @ along, (end[lies_on] - a) @ along], axis=1)
        marks = np.unique(ends)
        for low, high in pairwise(marks.tolist()):
            there = int(np.count_nonzero((ends[:, 0] <= low) & (ends[:, 1] >= high)))
            back = int(np.count_nonzero((ends[:, 1] <= low) & (ends[:, 0] >= high)))
            total += 2 * min(there, back) * (high - low)
    return total


POLYGON_CLIPPING = StudyFamily(
    "polygon_clipping",
    "Clipping of polygons",
    ("polygon_clipping",),
    WORKS_ON_POLYGONS[:1],
    (MISCLASSIFIED, CONNECTING),
    ClippedPolygonTask,
)
POLYGON_FILL = StudyFamily(
    "polygon_fill", "Fills of polygons", ("polygon_fill",), WORKS_ON_POLYGONS, (MISCLASSIFIED,), PolygonTask
)
