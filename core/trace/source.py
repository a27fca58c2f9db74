"""What the stage traces are made from: the pipeline run on the traced triangles, and how long a trace may be."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.coverage.active_edges import fill_rings
from core.coverage.binning import bound
from core.coverage.fills import Fragments, PixelTests, examine_pixels
from core.coverage.pixel_runs import Boxes, Raster, Runs, fill_traits, make_raster
from core.depth.depth import DepthFormat, DepthTests, stack_fragments
from core.families import suited
from core.lines.line_method import LineSteps
from core.lines.wireframe import LineFragments, draw_outlines, join_batches
from core.lines.wireframe_fragments import writes_depth
from core.pipeline import draw
from core.records.arrays import Flags, Floats, Integers, Singles, cached_property
from core.records.frame import Frame, StageCount
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import Settings, no_effect
from core.stages.before_matrices import before_matrices
from core.stages.bin_and_raster import schedule
from core.stages.declared import STAGES
from core.stages.fragment_color import Surface, vertex_stage
from core.stages.fragments import (
    fragment_depth,
    fragment_inverse_w,
    fragment_values,
    not_discarded,
    surface_of,
    texture_slopes,
)
from core.stages.geometry import Geometry
from core.stages.hidden_surfaces import StartBuffers, run_visibility_tests, shades
from core.stages.needs import check_edits
from core.stages.vertices import Before, drawing_order, process_geometry
from core.visibility.exact_case import ExactTests

# How long a trace is at most: each pixel test keeps all its numbers, so some runs are too long to be kept.


LONGEST_RUN = 1_500_000
"""Pixel tests that a trace may have."""


def most_tests(scene: AnyScene, settings: Settings, triangle_count: int, pixel_count: int) -> int:
    """Return the pixel tests of a trace at most where every pixel is tested, else a guess."""
    pixels = pixel_count * resolve(settings).sampling.count
    if fill_traits(settings.fill).looks_everywhere and not no_effect(settings, "fill", scene):
        return triangle_count * pixels
    return min(triangle_count, 60) * pixels // 4


# What the stage traces are made from: the pipeline run on the traced triangles, every stage at most once.


@dataclass(frozen=True, eq=False)
class TraceSource:
    """Lazily computed results of the pipeline for the traced triangles; all arrays in drawing order."""

    scene: AnyScene
    settings: Settings
    triangle: int | None = None
    """The triangle that is traced; ``None``: all of them."""
    region: tuple[int, int, int, int] | None = None
    """(first column, first row, columns, rows) of the buffers; ``None``: the whole image."""
    before: str = "earlier"
    """Buffers at the start: as the ``"earlier"`` triangles left them, or ``"cleared"``."""
    lanes: str = "one"
    """Order of a shader's steps: ``"one"`` lane after another, or those of a triangle ``"together"``."""

    def __post_init__(self) -> None:
        check_edits(self.scene, self.settings)
        if self.scene.makes_positions:
            object.__setattr__(self, "scene", before_matrices(self.scene, self.settings))
        if self.scene.corner_count != 3:
            object.__setattr__(self, "settings", suited(self.settings, self.scene))

    @cached_property
    def raster(self) -> Raster:
        """The pixels of the buffers."""
        return make_raster(self.scene.size, self.settings.pixel_center, self.region)

    @cached_property
    def order(self) -> Integers:
        """(T,) int64, all triangles of the scene in drawing order."""
        return drawing_order(self.scene, vertex_stage(self.scene), self.settings).order

    @cached_property
    def geometry(self) -> Geometry:
        """The traced triangles up to their edge functions."""
        chosen = None if self.triangle is None else np.array([self.triangle])
        if chosen is not None and isinstance(self.scene, ClipScene):
            chosen = np.flatnonzero(self.scene.numbers == self.triangle)
        return process_geometry(self.scene, self.settings, {s: StageCount() for s in STAGES}, chosen)

    @cached_property
    def start(self) -> Frame:
        """The buffers before the first row."""
        first = 0
        if self.triangle is not None and self.before == "earlier":
            number = self.scene.numbers[self.order] if isinstance(self.scene, ClipScene) else self.order
            is_own = number == self.triangle
            # A patch without fragments is drawn after those before it.
            first = int(is_own.argmax()) if is_own.any() else int((number < self.triangle).sum())
        # Pictures before this one are mixed in at the end, and are no part of the buffers.
        is_mixed = resolve(self.settings).sampling.is_temporal
        settings = replace(self.settings, antialiasing="none") if is_mixed else self.settings
        return draw(self.scene, settings, self.raster, Before(first))

    @property
    def fill(self) -> str:
        """The fill that runs: see ``core.coverage.fills.effective_fill``."""
        return resolve(self.settings).fill_name

    @cached_property
    def _schedule(self) -> tuple[Boxes, Runs]:
        if self.geometry.polygons is not None:
            boxes = bound(self.geometry.edges, self.raster)
            return boxes, fill_rings(self.geometry.polygons, self.raster, resolve(self.settings).polygon_fill)
        return schedule(self.geometry.edges, self.settings, self.raster)

    @property
    def boxes(self) -> Boxes:
        """What the triangles may touch."""
        return self._schedule[0]

    @property
    def runs(self) -> Runs:
        """What the fill looks at."""
        return self._schedule[1]

    @cached_property
    def tests(self) -> PixelTests:
        """Every pixel that is looked at."""
        return examine_pixels(self.geometry.edges, self.runs, self.raster)

    @cached_property
    def fragments(self) -> Fragments:
        """(F) covered pixels, whether in depth range or not; a wireframe's are ``LineFragments``."""
        if self.geometry.outlines is not None:
            return self.lines[0]
        tests = self.tests
        return Fragments(tests.primitive, tests.column, tests.row).select(tests.covered)

    @cached_property
    def lines(self) -> tuple[LineFragments, LineSteps]:
        """The (F) pixels of a wireframe's outlines, and the numbers that chose them."""
        outlines = self.geometry.outlines
        assert outlines is not None
        return join_batches(list(draw_outlines(outlines, self.raster, self.settings.line)))

    @property
    def place(self) -> Integers:
        """(F,) int64, where each fragment stands in flattened buffers."""
        return self.raster.index(self.fragments.column, self.fragments.row)

    @property
    def place_count(self) -> int:
        """Pixels of the buffers."""
        return self.raster.shape[0] * self.raster.shape[1]

    @property
    def centers(self) -> tuple[Floats, Floats]:
        """X and y (F,) of the fragments' pixel centres."""
        return self.raster.centers(self.fragments.column, self.fragments.row)

    @property
    def triangle_of_fragment(self) -> Integers:
        """(F,) int64, number of the triangle in the scene."""
        return self.geometry.primitives.triangle[self.fragments.primitive]

    @cached_property
    def interpolated(self) -> tuple[Floats, Floats]:
        """Weights (F, 3) and values (F, K) of the fragments."""
        return fragment_values(self.geometry, self.fragments, self.raster)

    @cached_property
    def uv_slopes(self) -> Floats | None:
        """(4, F) float64 du/dx, dv/dx, du/dy, dv/dy of the fragments; ``None``: the texture filter needs none."""
        return texture_slopes(self.geometry, self.raster, self.fragments, self.interpolated[1])

    @cached_property
    def inverse_w(self) -> Floats:
        """(F,) float64, 1/w at the fragments."""
        return fragment_inverse_w(self.geometry, self.fragments, self.raster)

    @cached_property
    def surface(self) -> Surface:
        """The fragments' colours."""
        values = self.interpolated[1]
        return surface_of(self.scene, self.geometry, self.raster, self.fragments, values, self.uv_slopes)

    @cached_property
    def depth_format(self) -> DepthFormat:
        """How depth is stored."""
        return resolve(self.settings).depth_format

    @cached_property
    def depths(self) -> tuple[Floats, Flags, Singles]:
        """Window depth (F,), whether it is in range and not discarded (F,), stored value (F,)."""
        depth, keeps, stored = fragment_depth(self.geometry, self.fragments, self.raster, self.depth_format)
        return depth, keeps & self.goes_on, stored

    @cached_property
    def goes_on(self) -> Flags:
        """(F,) bool, what the fragment shader of the scene does not discard; it comes before the depth test."""
        return not_discarded(self.scene, self.geometry, self.raster, self.fragments)

    @cached_property
    def writes_depth(self) -> Flags | None:
        """(F,) bool, fragments that are stored if they pass the depth test; ``None``: all."""
        return writes_depth(self.fragments)

    @cached_property
    def _visibility_tests(self) -> tuple[DepthTests, ExactTests | None]:
        """The tests of the fragments in depth range."""
        _, keeps, stored = self.depths
        start = StartBuffers(self.start.depth.ravel(), self.start.primitive.ravel().astype(np.int64))
        stacks = stack_fragments(self.place[keeps])
        return run_visibility_tests(
            self.geometry,
            self.fragments.select(keeps),
            stored[keeps],
            stacks,
            start,
            self.raster,
            self.depth_format,
            keeps_visits=True,
        )

    @property
    def exact_tests(self) -> ExactTests | None:
        """How the fragments in depth range were compared exactly; ``None``: they were not."""
        return self._visibility_tests[1]

    @cached_property
    def depth_tests(self) -> DepthTests:
        """Depth test of every fragment; one out of range leaves the buffer alone and fails."""
        _, keeps, stored = self.depths
        tests, _ = self._visibility_tests
        before = np.full(len(stored), np.nan, stored.dtype)
        passes = np.zeros(len(stored), bool)
        before[keeps], passes[keeps] = tests.before, tests.passes
        left = None
        if tests.left is not None:
            left = before.copy()
            left[keeps] = tests.left
        return DepthTests(before, passes, left)

    @property
    def drawn(self) -> Integers:
        """(D,) int64, the fragments that pass, in the order in which they are drawn."""
        if self.exact_tests is not None and self.exact_tests.turn is not None:
            return np.flatnonzero(self.depths[1])[self.exact_tests.turn]
        return np.flatnonzero(self.depth_tests.passes)

    @property
    def is_tested_alone(self) -> bool:
        """Whether each fragment has one depth test of its own, not one for each sample."""
        return True

    @cached_property
    def shaded(self) -> Flags:
        """(F,) bool, the fragments that are shaded: all, those that pass an early test, or those left in the end."""
        which = shades(self.scene, self.geometry)
        if which == "all":
            return np.ones(len(self.fragments), bool)
        return self._passed if which == "passing" else self._left

    @property
    def _passed(self) -> Flags:
        """(F,) bool, the fragments that pass the depth test."""
        return self.depth_tests.passes

    @property
    def _left(self) -> Flags:
        """(F,) bool, the fragments whose depth is left in the end: of each place the last that passes."""
        passed, place = np.flatnonzero(self.depth_tests.passes), self.place
        last = np.full(self.place_count, -1)
        np.maximum.at(last, place[passed], passed)
        left = np.zeros(len(place), bool)
        left[last[last >= 0]] = True
        if self.triangle is not None and self.before == "earlier":
            # The prepass has drawn all triangles, not only this one.
            left &= self.seen.reshape(-1).take(place) == self.triangle
        return left

    @property
    def seen(self) -> NDArray[np.int32]:
        """(H, W) int32, the triangle that is seen in the end, -1: none."""
        return self.picture.primitive

    @cached_property
    def picture(self) -> Frame:
        """The buffers after the last row, drawn in batches."""
        return draw(self.scene, self.settings, self.raster)
