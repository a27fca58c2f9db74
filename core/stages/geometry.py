"""The record of the stages before the raster; what only some pictures need is computed when it is first asked for.

Outlines and exact comparisons of rays come with many files, which are imported no earlier.
"""

from copy import copy
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from core.clipping.planes import DEPTH_CLIPPING
from core.clipping.sutherland_hodgman import Clipped
from core.coverage.edges import EdgeFunctions, edge_functions
from core.coverage.number_formats import CornerPositions
from core.coverage.snapping import WindowVertices, place_corners_in
from core.culling.culling import (
    RANGE_BIT,
    CullVerdicts,
    Outcodes,
    has_bits,
    joined_bits,
    outcodes,
    plane_distances,
)
from core.depth.fixed_depth import FixedPlanes, set_up_fixed_planes
from core.interpolation.interpolation import Planes, set_up_planes, value_plane
from core.records.arrays import Flags, Floats, Integers, cached_property
from core.records.frame import StageCount
from core.records.primitives import DrawingOrder, IndexedPrimitives, Pieces, Primitives, Rings
from core.resolved import resolve
from core.settings import Settings
from core.transform.matrices import reversed_clip_depth
from core.transform.vertex_stage import VertexStage

if TYPE_CHECKING:
    from core.lines.wireframe import Outlines
    from core.stages.object_tree import ObjectTree
    from core.stages.primitives import OutlineClip, PolygonClip
    from core.visibility.ray_casting import RayPlanes
    from core.visibility.rays_in_tree import TreeRays


@dataclass(frozen=True, eq=False)
class Geometry:
    """Everything that is known of the triangles before the first pixel is looked at.

    The corners of P primitives stand in rows: the first, second and third of all of them.
    """

    vertices: VertexStage
    assembled: IndexedPrimitives
    """All triangles of the scene."""
    culled: CullVerdicts
    kept: IndexedPrimitives
    """Those that were not culled, in drawing order; where the order cuts triangles, their pieces."""
    kept_pieces: Pieces | None
    """What ``kept`` are, one each, where the order cuts triangles; ``None``: they are whole."""
    clipped: Clipped | None
    """``None``: nothing was clipped against."""
    clipping_inserted: str
    """Why clipping runs although the settings have none: the method that needs it, else empty."""
    primitives: IndexedPrimitives
    """What is drawn, in drawing order: kept triangles and pieces."""
    window: WindowVertices
    """The (M,) vertices of ``primitives`` in the window."""
    outcode: Outcodes
    """(M,) uint8, of the same vertices."""
    doubled_area: Floats
    """(P,) float64: twice the signed snapped area where all corners are projected, else the 3x3 determinant."""
    drawing: DrawingOrder
    """The order of all triangles of the scene, and what decides who is seen."""
    settings: Settings
    count: StageCount
    """The time of what is computed on demand is added here."""
    object_tree: "ObjectTree | None" = None
    """The boxes that objects are culled by, or rays find triangles with; ``None``: no method asks for them."""
    shift: tuple[float, float] = (0.0, 0.0)
    """By how many pixels x and y are moved against the scene: another place of the pixels is then at their centres."""

    def moved(self, x: float, y: float) -> "Geometry":
        """Return the geometry ``x`` and ``y`` pixels further; exact where they are multiples of 1/256."""
        window = replace(self.window, x=self.window.x + x, y=self.window.y + y)
        return replace(self, window=window, shift=(self.shift[0] + x, self.shift[1] + y))

    def counted_in(self, count: StageCount) -> "Geometry":
        """Return the same geometry, whose time from now on is added to ``count``; what is computed stays so."""
        same = copy(self)
        object.__setattr__(same, "count", count)
        return same

    @cached_property
    def window_x(self) -> Floats:
        """(3, P) float64 pixels, x of the corners as coverage sees them (snapped); NaN where not projected."""
        with self.count:
            return self.window.x.take(self.primitives.corner)

    @cached_property
    def window_y(self) -> Floats:
        """(3, P) float64 pixels, likewise y."""
        with self.count:
            return self.window.y.take(self.primitives.corner)

    @cached_property
    def depth(self) -> Floats:
        """(3, P) float64, window depth (z/w + 1)/2 of the corners; infinite or NaN where w = 0."""
        with self.count, np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            _, _, z, w = self.primitives.vertex_clip
            depth: Floats = (z / w + 1) * 0.5
            return depth.take(self.primitives.corner)

    @cached_property
    def is_projected(self) -> Flags:
        """(P,) bool, all corners are projected, so that coverage is decided on ``window_x`` and ``window_y``."""
        with self.count:
            return all_projected(self.window, self.primitives.corner)

    @cached_property
    def is_in_range(self) -> Flags:
        """(P,) bool, every corner lies between the near and the far plane: depth is clamped, not tested."""
        if self.vertices.rings is None:
            return ~has_bits(joined_bits(self.outcode, self.primitives.corner), RANGE_BIT)
        own = self.vertices.all_corners[self.primitives.triangle]
        return ~has_bits(np.bitwise_or.reduce(outcodes(self.vertices.clip)[own], axis=1), RANGE_BIT)

    @cached_property
    def corners(self) -> CornerPositions:
        """The corners of the primitives in the homogeneous window and on the grid."""
        numbers = resolve(self.settings).numbers
        placed = place_corners_in(self.primitives.clip, self.vertices.size, numbers)
        return placed.moved(*self.shift) if any(self.shift) else placed

    @cached_property
    def edges(self) -> EdgeFunctions:
        """The edge functions of the primitives."""
        with self.count:
            resolved = resolve(self.settings)
            return edge_functions(self.corners, resolved.owns_tie, resolved.pixel_rule)

    @cached_property
    def planes(self) -> Planes:
        """The linear functions over the window that attributes are interpolated with."""
        with self.count:
            return set_up_planes(self.corners.homogeneous)

    @cached_property
    def depth_plane(self) -> tuple[Floats, Floats, Floats]:
        """(P,) float64 each: window depth as a linear function of the pixel."""
        with self.count:
            clip = self.primitives.clip
            return value_plane(self.planes, (clip[..., 2] + clip[..., 3]) / 2)

    @cached_property
    def inverse_w_plane(self) -> tuple[Floats, Floats, Floats]:
        """(P,) float64 each: 1/w as a linear function of the pixel."""
        with self.count:
            return value_plane(self.planes, np.ones((len(self.primitives), 3)))

    @cached_property
    def reversed_plane(self) -> tuple[Floats, Floats, Floats]:
        """(P,) float64 each: reversed depth as a linear function of the pixel."""
        with self.count:
            clip = self.primitives.clip
            at_corners = reversed_clip_depth(clip[..., 2], clip[..., 3], self.vertices.view_range)
            return value_plane(self.planes, at_corners)

    @cached_property
    def fixed_planes(self) -> FixedPlanes:
        """Depth in whole numbers as integer planes."""
        with self.count:
            center = resolve(self.settings).center
            return set_up_fixed_planes(
                self.window_x, self.window_y, self.depth, self.doubled_area, self.is_in_range, center
            )

    @cached_property
    def ray_planes(self) -> "RayPlanes":
        """What tells exactly which of two triangles of the scene is nearer at a pixel; by z where w is no distance."""
        from core.visibility.ray_casting import set_up_ray_planes

        with self.count:
            vertices = self.vertices
            clip = vertices.clip_rows.take(vertices.corner_rows, axis=1).T
            return set_up_ray_planes(clip, vertices.size, vertices.view_range is not None, self.shift)

    @cached_property
    def tree_rays(self) -> "TreeRays | None":
        """The rays of the picture among the boxes of ``object_tree``; ``None``: no ray asks these.

        Of wireframes and polygons every ray asks all: what covers a pixel there may lie beside the boxes.
        """
        if not self.drawing.walks_tree or self.object_tree is None or not self.is_cut_to_pixels:
            return None
        from core.stages.object_tree import rays_in_tree

        with self.count:
            reach = farthest_from_grid(
                self.window, self.primitives.vertex_clip, self.vertices.size, self.shift
            )
            return rays_in_tree(self.object_tree, self.vertices, self.ray_planes, reach)

    @cached_property
    def outlines(self) -> "Outlines | None":
        """The edges that a wireframe draws; ``None``: triangles are filled."""
        if not resolve(self.settings).is_outlined:
            return None
        return self.whole_outlines if self.outline_clip is None else self.outline_clip.outlines

    @cached_property
    def outline_clip(self) -> "OutlineClip | None":
        """What line clipping did to the outlines; ``None``: they are drawn as they are."""
        if not resolve(self.settings).clips_lines or self.whole_outlines is None:
            return None
        from core.stages.primitives import clip_outlines

        with self.count:
            method, center = self.settings.line_clipping, resolve(self.settings).center
            vertices = self.vertices
            window = vertices.size, center, vertices.clip_region, line_reach(self.settings)
            return clip_outlines(self.whole_outlines, method, *window)

    @cached_property
    def whole_outlines(self) -> "Outlines | None":
        """The edges before line clipping; ``None``: triangles are filled."""
        if not resolve(self.settings).is_outlined:
            return None
        from core.lines.line_method import has_intensities
        from core.lines.wireframe import set_up_outlines
        from core.lines.wireframe_fragments import run_rightwards

        with self.count:
            outlines = set_up_outlines(
                self.primitives.gathered(),
                self.corners,
                self._cut_sides() if self.draws_last is None else None,
                self.vertices.size,
                self.draws_last,
            )
            return run_rightwards(outlines) if has_intensities(self.settings.line) else outlines

    @cached_property
    def polygons(self) -> Rings | None:
        """The rings of the primitives that are filled, in the window; ``None``: no polygons."""
        if self.vertices.rings is None:
            return None
        with self.count:
            clip = self.polygon_clip
            rings = self.vertices.rings_of(self.primitives.triangle) if clip is None else clip.rings
            return rings.moved(*self.shift)

    @cached_property
    def polygon_clip(self) -> "PolygonClip | None":
        """What clipping did to the polygons; ``None``: they are filled as they are."""
        if self.vertices.rings is None or not resolve(self.settings).clips_polygons:
            return None
        from core.stages.primitives import clip_polygons

        method, center = self.settings.polygon_clipping, resolve(self.settings).center
        return clip_polygons(self.vertices, self.primitives.triangle, method, center)

    @cached_property
    def kept_of_primitive(self) -> Integers:
        """(P,) int64, which of ``kept`` each primitive is, or was clipped from."""
        if self.kept_pieces is None:
            place = np.empty(int(self.kept.triangle.max(initial=-1)) + 1, np.int64)
            place[self.kept.triangle] = np.arange(len(self.kept))
            return np.asarray(place[self.primitives.triangle])
        count = np.ones(len(self.kept), np.int64)
        if self.clipped is not None:
            count[self.clipped.clipped] = np.maximum(self.clipped.counts[-1] - 2, 0)
        return np.repeat(np.arange(len(self.kept)), count)

    @property
    def has_pieces(self) -> bool:
        """Whether primitives may be pieces of triangles, which clipping or the drawing order has cut."""
        return self.clipped is not None or self.kept_pieces is not None

    @property
    def is_cut_to_pixels(self) -> bool:
        """Whether exact areas apply: triangles are filled. Outlines and polygons are drawn at pixels' centres."""
        return self.polygons is None and self.outlines is None

    @property
    def draws_last(self) -> Flags | None:
        """(P,) bool, the last pixel of a segment or point is drawn; ``None``: the primitives are triangles."""
        draws_last = self.vertices.draws_last
        return None if draws_last is None else draws_last.take(self.primitives.triangle)

    def _cut_sides(self) -> tuple[Floats, Integers] | None:
        """Return what `core.lines.wireframe.trace_sides` finds the sides of triangles by; ``None``: nothing is cut."""
        kept, fan = self.kept, np.arange(len(self.kept))
        is_clipped = self.clipped is not None and len(self.clipped.clipped) > 0
        if not is_clipped and self.kept_pieces is None:
            return None
        whole_shares = np.tile(np.eye(3), (len(kept), 1, 1))
        shares = whole_shares if self.kept_pieces is None else self.kept_pieces.shares
        if not is_clipped:
            return shares, fan
        whole = Primitives(kept.clip, shares, fan, kept.mesh, {})
        distances = clipping_distances(kept, self.clipping_inserted)
        clipping = DEPTH_CLIPPING if self.clipping_inserted else resolve(self.settings).clipping
        cut = clipping.clip(whole, distances, 3).primitives
        return cut.varyings, cut.triangle


def farthest_from_grid(
    window: WindowVertices, clip: Floats, size: tuple[int, int], shift: tuple[float, float]
) -> float:
    """Return how many pixels the vertices of clip positions (4, M) lie from where coverage sees them, at most."""
    x, y, _, w = clip
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        across = np.abs((x / w + 1) * (size[0] / 2) + shift[0] - window.x)
        up = np.abs((y / w + 1) * (size[1] / 2) + shift[1] - window.y)
    farthest = np.fmax(across, up)[window.is_projected]
    return float(farthest.max(initial=0.0))


def line_reach(settings: Settings) -> float:
    """Return how far outside the raster the lines of an outline may lie, in pixels, whose pixels get something."""
    if not resolve(settings).is_outlined:
        return 0.0
    from core.lines.line_method import line_traits

    return line_traits(settings.line).reach


def all_projected(window: WindowVertices, corner: Integers) -> Flags:
    """Return (P,) bool: the three corners (3, P) of a primitive are projected."""
    if window.is_projected.all():
        return np.ones(corner.shape[1], bool)
    first, second, third = (window.is_projected.take(index) for index in corner)
    is_projected: Flags = first & second & third
    return is_projected


def clipping_distances(kept: IndexedPrimitives, inserted: str) -> Floats:
    """Return the distances (P, 3, 6) from the planes that decide what is clipped."""
    distances = plane_distances(kept.clip)
    if inserted:
        # Only what needs it, whatever is drawn with it.
        distances[(kept.clip[..., 3] > 0).all(axis=1)] = 0
    return distances
