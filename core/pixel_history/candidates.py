"""Which triangles could matter at a pixel: those whose box contains it; the others are only counted."""

from dataclasses import dataclass, replace
from weakref import WeakKeyDictionary

import numpy as np

from core.antialiasing.resolve import at_sample, finer_scene, finer_settings, in_squares
from core.coverage.active_edges import fill_rings
from core.coverage.binning import bound
from core.coverage.edges import EdgeFunctions, edge_functions, is_inside
from core.coverage.fills import Fragments, PixelTests, examine_pixels
from core.coverage.number_formats import CornerPositions
from core.coverage.pixel_runs import PROJECTED, Boxes, Raster, Runs, make_raster
from core.coverage.snapping import place_corners
from core.lines.line_method import LineSteps
from core.lines.wireframe import LineFragments, Outlines, draw_outlines, join_batches
from core.methods import table
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.frame import StageCount
from core.resolved import resolve
from core.scene import AnyScene
from core.settings import Settings
from core.stages.bin_and_raster import schedule
from core.stages.declared import STAGES
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.trace.source import TraceSource

ROUNDING_REACH = 2
"""Pixels by which a fill that rounds corners, or a line, may leave the triangle's box."""

_geometries: "WeakKeyDictionary[AnyScene, tuple[Settings, Geometry]]" = WeakKeyDictionary()

_finer: list[tuple[AnyScene, Settings, AnyScene, Geometry]] = []
"""The last scene and settings that were asked about, the scene at n times its size, and its geometry."""


def check_pixel(scene: AnyScene, column: int, row: int) -> None:
    """Raise ValueError for a pixel that the image of a scene does not have."""
    width, height = scene.size
    if not (0 <= column < width and 0 <= row < height):
        raise ValueError(f"pixel must be inside the {width}x{height} image, got ({column}, {row})")


def whole_geometry(source: TraceSource) -> Geometry:
    """Return the geometry of all triangles; that of a scene is kept for its next pixel."""
    if source.triangle is None:
        return source.geometry
    found = _geometries.get(source.scene)
    if found is None or found[0] != source.settings:
        counts = {stage: StageCount() for stage in STAGES}
        found = source.settings, process_geometry(source.scene, source.settings, counts)
        _geometries[source.scene] = found
    return found[1]


@dataclass(frozen=True, eq=False)
class EdgeTests:
    """Q primitives at one pixel centre: the numbers of the inside test."""

    values: Floats
    """(Q, 3) float64, the edge functions."""
    inside: Flags
    """(Q, 3) bool, by the fill rule; all three where the pixel is covered, see `EdgeFunctions.decide`."""
    distance: Floats
    """(Q, 3) float64, signed distance from the edges in pixels, positive inside; NaN: no direction."""
    ulps: Floats
    """(Q, 3) float64, the value in units of the last place of its largest term."""

    @property
    def clearance(self) -> Floats:
        """(Q,) float64, the least distance: how far inside, or (negative) how far past the worst edge."""
        return np.asarray(np.where(np.isnan(self.distance), -np.inf, self.distance).min(axis=1))


def examine_edges(edges: EdgeFunctions, x: float, y: float) -> EdgeTests:
    """Apply the inside test of all edges to one pixel centre."""
    numbers, a, b, c = edges.numbers, edges.shown_a, edges.shown_b, edges.shown_c
    held, sides = edges.decide(np.arange(len(edges)), *(np.full(len(edges), place) for place in (x, y)))
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        values = numbers.shown_values(held)
        largest = np.maximum(np.abs(a * x), np.maximum(np.abs(b * y), np.abs(c)))
        distance = values / np.hypot(a, b)
        ulps = values / numbers.spacing(largest)
    return EdgeTests(values, sides, distance, ulps)


@dataclass(frozen=True, eq=False)
class PixelCandidates:
    """The primitives that could matter at one pixel, and what the fill did with them there."""

    scene: AnyScene
    settings: Settings
    geometry: Geometry
    column: int
    row: int
    focus: int | None
    """A triangle that is a candidate in any case."""
    colored_by: Geometry | None = None
    """Where colours are taken from, if not from ``geometry``: at the pixel's centre, for any of its samples."""

    @cached_property
    def raster(self) -> Raster:
        """The pixel as a raster of its own."""
        return make_raster(self.scene.size, self.settings.pixel_center, (self.column, self.row, 1, 1))

    @property
    def center(self) -> tuple[float, float]:
        """X and y of the pixel's centre."""
        return self.column + self.raster.center, self.row + self.raster.center

    @property
    def image(self) -> Raster:
        """The whole picture."""
        return make_raster(self.scene.size, self.settings.pixel_center)

    @property
    def rounds_corners(self) -> bool:
        """Whether the fill may leave the box of a triangle."""
        is_filled = self.geometry.outlines is None
        return is_filled and "projected" in table.get("fill", self.settings.fill).needs

    @cached_property
    def primitive(self) -> Integers:
        """(Q,) int64, primitives whose box contains the pixel, and those of the focus; in drawing order.

        A fill that looks everywhere has no boxes: numbers that wrap around may cover any pixel.
        """
        if self.geometry.polygons is not None:
            return np.arange(len(self.geometry.primitives))
        if self.rounds_corners or self.geometry.outlines is not None:
            contains = boxes_reach(self.geometry.edges.corners, self.center, ROUNDING_REACH)
        else:
            boxes = bound(self.geometry.edges, self.raster)
            contains = (boxes.column_end > boxes.column) & (boxes.row_end > boxes.row)
            if resolve(self.settings).looks_everywhere:
                edges = self.geometry.edges
                inside = examine_edges(edges, *self.center).inside.all(axis=1)
                contains |= inside & (edges.doubled_area != 0)
        if self.focus is not None:
            contains |= self.geometry.primitives.triangle == self.focus
        return np.flatnonzero(contains)

    @cached_property
    def edges(self) -> EdgeFunctions:
        """Edge functions of the candidates."""
        return self.geometry.edges.take(self.primitive)

    @cached_property
    def triangle(self) -> Integers:
        """(Q,) int64, the triangle of every candidate."""
        return self.geometry.primitives.triangle[self.primitive]

    @cached_property
    def boxes(self) -> Boxes:
        """Boxes of the candidates in the whole image."""
        return bound(self.edges, self.image)

    @cached_property
    def runs(self) -> Runs:
        """What the fill looks at, of this pixel."""
        if self.geometry.polygons is not None:
            rule = resolve(self.settings).polygon_fill
            return fill_rings(self.geometry.polygons, self.raster, rule)
        return schedule(self.edges, self.settings, self.raster)[1]

    @cached_property
    def row_runs(self) -> Runs:
        """What the fill looks at in the whole row of the pixel."""
        row = make_raster(self.scene.size, self.settings.pixel_center, (0, self.row, self.scene.size[0], 1))
        return schedule(self.edges, self.settings, row)[1]

    @cached_property
    def pixel_tests(self) -> PixelTests:
        """The tests of this pixel as the picture makes them; ``primitive`` counts the candidates."""
        return examine_pixels(self.edges, self.runs, self.raster)

    @cached_property
    def fragments(self) -> Fragments:
        """(F,) fragments at this pixel in drawing order, as the picture makes them; a wireframe's are lines."""
        if self.geometry.outlines is not None:
            return self.lines[0]
        tests = self.pixel_tests
        primitive = self.primitive[tests.primitive[tests.covered]]
        return Fragments(primitive, *self._here(len(primitive)))

    @cached_property
    def lines(self) -> tuple[LineFragments, LineSteps]:
        """The fragments of a wireframe at this pixel, and the numbers that chose them."""
        outlines = self.geometry.outlines
        assert outlines is not None
        near = np.flatnonzero(np.isin(outlines.primitive, self.primitive))
        taken = Outlines(*(values[near] for values in vars(outlines).values()))
        found, steps = join_batches(list(draw_outlines(taken, self.raster, self.settings.line)))
        segment = near[found.segment]
        return replace(found, primitive=outlines.primitive[segment], segment=segment), steps

    @cached_property
    def covering(self) -> Integers:
        """(F,) int64, the candidate of every fragment; which of Q."""
        return np.searchsorted(self.primitive, self.fragments.primitive)

    def _here(self, count: int) -> tuple[Integers, Integers]:
        return np.full(count, self.column), np.full(count, self.row)

    @cached_property
    def edge_tests(self) -> EdgeTests:
        """The inside test of every candidate, whether the fill made it or not; the fill's own values, where it adds."""
        tests = examine_edges(self.edges, *self.center)
        if self.runs.stepping is None:
            return tests
        values, stepped = tests.values.copy(), self.pixel_tests
        values[stepped.primitive] = stepped.values
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            distance = values / np.hypot(self.edges.shown_a, self.edges.shown_b)
            ulps = tests.ulps * (values / tests.values)
        return EdgeTests(values, is_inside(values, self.edges.owns_tie), distance, ulps)

    @cached_property
    def culled(self) -> Integers:
        """(C,) int64, culled triangles to be listed: their box contains the pixel."""
        return self._undrawn(np.flatnonzero(~self.geometry.culled.kept))

    @cached_property
    def clipped_away(self) -> Integers:
        """(C,) int64, triangles of which clipping left nothing, to be listed."""
        if self.geometry.clipped is None:
            return np.empty(0, np.int64)
        return self._undrawn(np.setdiff1d(self.geometry.kept.triangle, self.geometry.primitives.triangle))

    def placed(self, clip: Floats) -> CornerPositions:
        """Return the corners of triangles (C, 3, 4) in the window, moved as the geometry is."""
        corners = place_corners(clip, self.scene.size, self.settings.coverage)
        shift = self.geometry.shift
        return corners.moved(*shift) if any(shift) else corners

    def unclipped(self, triangle: Integers) -> EdgeFunctions:
        """Return the edge functions that triangles (C,) would have as they are."""
        corners = self.placed(self.geometry.assembled.clip[triangle])
        resolved = resolve(self.settings)
        return edge_functions(corners, resolved.owns_tie, resolved.pixel_rule)

    def _undrawn(self, triangle: Integers) -> Integers:
        """Choose those whose box contains the pixel; one that crosses the eye must cover it too."""
        # A box first, for all; edge functions for those that are left.
        clip = self.geometry.assembled.clip
        corners = self.placed(clip[triangle])
        x, y = self.center
        near = boxes_reach(corners, (x, y), 0)
        near &= (corners.homogeneous[..., 2] > 0).any(axis=1)
        chosen = triangle[near]
        if len(chosen):
            edges = self.unclipped(chosen)
            inside = examine_edges(edges, x, y).inside.all(axis=1) & (edges.doubled_area != 0)
            crossing = bound(edges, self.image).case != PROJECTED
            chosen = chosen[inside | ~crossing]
        if self.focus is not None and self.focus in triangle:
            chosen = np.union1d(chosen, [self.focus])
        return np.asarray(chosen, np.int64)


def boxes_reach(corners: CornerPositions, center: tuple[float, float], reach: float) -> Flags:
    """Return (P,) bool: the box of the corners, grown by ``reach`` pixels, contains a pixel centre.

    A triangle with a corner that cannot be projected has no box, and might be anywhere.
    """
    low, high = corners.decided.min(axis=1) - reach, corners.decided.max(axis=1) + reach
    within = (low <= center) & (high >= center)
    return np.asarray(~corners.is_projected.all(axis=1) | within.all(axis=1))


def candidates_at(
    source: TraceSource, column: int, row: int, triangle: int | None, sample: int
) -> PixelCandidates:
    """Return the candidates at one sample of a pixel; ``sample`` counts as in `core.records.frame.Samples`."""
    scene, settings = source.scene, source.settings
    side = resolve(settings).sampling.side
    if not side:
        whole = whole_geometry(source)
        moved = at_sample(whole, sample)
        return PixelCandidates(scene, settings, moved, column, row, triangle, whole)
    finer, geometry = _finer_geometry(scene, settings, side)
    up, across = divmod(sample, side)
    at = side * column + across, side * row + up
    return PixelCandidates(finer, finer_settings(settings), geometry, *at, triangle)


def _finer_geometry(scene: AnyScene, settings: Settings, side: int) -> tuple[AnyScene, Geometry]:
    """Return the scene at ``side`` times its size and its geometry; those of the last scene are kept."""
    for of_scene, of_settings, finer, known in _finer:
        if of_scene is scene and of_settings == settings:
            return finer, known
    finer = finer_scene(scene, side)
    counts = {stage: StageCount() for stage in STAGES}
    geometry = in_squares(process_geometry(finer, finer_settings(settings), counts), settings, side)
    _finer[:] = [(scene, settings, finer, geometry)]
    return finer, geometry
