"""Which fragments are seen: by the depth buffer, by drawing order, or by exact rays.

It joins the depth buffer and ray casting; picture, trace and history of a pixel ask it alike.
"""

from dataclasses import dataclass

import numpy as np

from core.framebuffer.depth import DepthFormat, DepthTests, Stored, replay_depths, run_depth_tests
from core.framebuffer.stacks import PixelStacks, stack_fragments
from core.raster.coverage import Fragments
from core.raster.lines.intensities import writes_depth
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Integers, read_only
from core.stages.geometry import Geometry
from core.visibility.ray_casting import RayTests, run_ray_tests


@dataclass(frozen=True, eq=False)
class StartBuffers:
    """What the buffers of U pixels hold before the first fragment."""

    depth: Stored
    """(U,) as the depth method stores it."""
    triangle: Integers
    """(U,) int64, number of the triangle that is seen, -1: none."""


def cleared_buffers(pixel_count: int, depth_format: DepthFormat) -> StartBuffers:
    """Return what clearing leaves."""
    depth = np.full(pixel_count, depth_format.cleared, depth_format.stored_type)
    return StartBuffers(read_only(depth), read_only(np.full(pixel_count, -1)))


def run_visibility_tests(
    geometry: Geometry,
    fragments: Fragments,
    stored: Stored,
    stacks: PixelStacks,
    start: StartBuffers,
    raster: Raster,
    depth_format: DepthFormat,
) -> tuple[DepthTests, RayTests | None]:
    """Decide of F fragments in drawing order which are kept, each against what is there before it.

    Parameters
    ----------
    geometry : Geometry
    fragments : Fragments
    stored : (F,) of the format's ``stored_type``
        What the depth buffer gets of each.
    stacks : PixelStacks
    start : StartBuffers
    raster : Raster
    depth_format : DepthFormat

    Returns
    -------
    tests : DepthTests
        The buffer before each fragment, and which pass.
    rays : RayTests, optional
        Where the scene casts rays: how that was decided.
    """
    if not geometry.casts_rays:
        is_tested, writes = geometry.uses_depth_test, writes_depth(fragments)
        return run_depth_tests(stored, stacks, start.depth, depth_format, is_tested, writes), None
    planes = geometry.ray_planes
    m, n = planes.rays(fragments.column, fragments.row, raster.center)
    triangle = geometry.primitives.triangle.take(fragments.primitive)
    rays = run_ray_tests(planes, triangle, m, n, stacks.layers(), start.triangle.take(stacks.pixel))
    return DepthTests(replay_depths(stored, stacks, start.depth, rays.passes), rays.passes), rays


@dataclass(frozen=True, eq=False)
class DecidedFragments:
    """F fragments of a picture in drawing order, and which of them pass."""

    fragments: Fragments
    stored: Stored
    """(F,) what the depth buffer gets."""
    stacks: PixelStacks
    passes: Flags
    """(F,) bool."""

    def last_passing(self, raster: Raster) -> tuple[Integers, Integers]:
        """Return the pixels that something is seen at (V,), and the fragment (V,) that was kept there last."""
        passing = np.flatnonzero(self.passes)
        last = np.full(raster.shape[0] * raster.shape[1], -1)
        last[raster.index(self.fragments.column[passing], self.fragments.row[passing])] = passing
        pixel = np.flatnonzero(last >= 0)
        return pixel, last[pixel]


def decide_fragments(
    geometry: Geometry, fragments: Fragments, stored: Stored, raster: Raster, depth_format: DepthFormat
) -> DecidedFragments:
    """Test all fragments (F,) of a picture over cleared buffers; ``stored`` (F,) is what the depth buffer gets."""
    stacks = stack_fragments(raster.index(fragments.column, fragments.row))
    start = cleared_buffers(raster.shape[0] * raster.shape[1], depth_format)
    tests, _ = run_visibility_tests(geometry, fragments, stored, stacks, start, raster, depth_format)
    return DecidedFragments(fragments, stored, stacks, tests.passes)
