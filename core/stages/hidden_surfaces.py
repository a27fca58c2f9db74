"""Which fragments are seen: by the depth buffer, by drawing order, or as a method of visibility decides exactly.

Picture, trace and history of a pixel ask it alike.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.fills import Fragments, join_fragments
from core.coverage.pixel_runs import Raster
from core.depth.depth import (
    DepthFormat,
    DepthTests,
    PixelStacks,
    Stored,
    replay_depths,
    run_depth_tests,
    stack_fragments,
)
from core.framebuffer.blending import blend_stacks, resolve_stacks
from core.lines.wireframe_fragments import writes_depth
from core.methods import is_registered
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.resolved import MIXING, resolve
from core.scene import AnyScene
from core.stages.fragments import fragments_at, owner_of
from core.stages.geometry import Geometry
from core.visibility.exact_case import ExactCase, ExactTests


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
    keeps_visits: bool = False,
) -> tuple[DepthTests, ExactTests | None]:
    """Decide of F fragments in drawing order which are kept, each against what is there before it.

    Parameters
    ----------
    stored : (F,) of the format's ``stored_type``
        What the depth buffer gets of each.
    keeps_visits : bool
        Whether the boxes that rays ask are listed, see `core.visibility.tree_walk`.

    Returns
    -------
    tests : DepthTests
        The buffer before each fragment, and which pass.
    exact : ExactTests, optional
        Where triangles are compared exactly: how that was decided.
    """
    writes = writes_depth(fragments)
    decides = geometry.drawing.decides
    if decides is None:
        is_tested = geometry.drawing.uses_depth_test
        return run_depth_tests(stored, stacks, start.depth, depth_format, is_tested, writes), None
    case = ExactCase(
        planes=geometry.ray_planes,
        fragments=fragments,
        triangle=geometry.primitives.triangle.take(fragments.primitive),
        stacks=stacks,
        initial=start.triangle,
        center=raster.center,
        writes=writes,
        tree=geometry.tree_rays,
        is_mixed=resolve(geometry.settings).is_mixed,
        is_outlined=geometry.outlines is not None,
        keeps_visits=keeps_visits,
        stored=stored,
        initial_depth=start.depth,
        depth_format=depth_format,
    )
    passes, exact = decides(case)
    kept = passes if writes is None else passes & writes
    turned = stacks if exact.turn is None else stack_in_turn(case.pixel, passes, exact.turn)
    return DepthTests(replay_depths(stored, turned, start.depth, kept), passes), exact


def stack_in_turn(pixel: Integers, passes: Flags, drawn: Integers) -> PixelStacks:
    """Stack fragments on their pixels (F,), those ``drawn`` (D,) in their order, behind the others."""
    turn = np.concatenate([np.flatnonzero(~passes), drawn])
    stacks = stack_fragments(pixel.take(turn))
    return replace(stacks, fragment=turn.take(stacks.fragment))


def shades(scene: AnyScene, geometry: Geometry) -> str:
    """Return which fragments are shaded, see `core.depth.early_depth`: all where a shader might discard them."""
    return "all" if scene.program is not None else resolve(geometry.settings).shades


def resolves_from_front(geometry: Geometry) -> bool:
    """Return whether the fragments of a pixel are blended from its front to its back, see `add_behind`."""
    return geometry.drawing.resolves_lists and is_registered(resolve(geometry.settings).blend_name, MIXING)


@dataclass(frozen=True, eq=False)
class DecidedFragments:
    """F fragments of a picture in drawing order, and which of them pass."""

    fragments: Fragments
    stored: Stored
    """(F,) what the depth buffer gets."""
    stacks: PixelStacks
    passes: Flags
    """(F,) bool."""
    left: Stored | None = None
    """(F,) what the depth buffer holds after each, where an edited depth test says so."""
    from_front: bool = False
    """Whether the stacks, sorted from back to front, are resolved from their tops."""

    @property
    def passing(self) -> Fragments:
        """The (G,) fragments that pass."""
        return self.fragments.select(self.passes)

    def blend_into(self, color: Singles, source: Floats, rule: Callable[..., Any]) -> None:
        """Blend colours (G, 4) of those that pass into ``color`` (H*W, 4) by a method of the family ``blend``."""
        number = np.cumsum(self.passes) - 1
        if self.from_front:
            resolve_stacks(color, source, number, self.stacks)
        else:
            blend_stacks(color, source, number, self.stacks, self.passes, rule)

    def last_kept(self, raster: Raster) -> tuple[Integers, Integers]:
        """Return the pixels that something is seen at (V,), and the fragment (V,) that was kept there last."""
        writes = writes_depth(self.fragments)
        kept = np.flatnonzero(self.passes if writes is None else self.passes & writes)
        last = np.full(raster.shape[0] * raster.shape[1], -1)
        last[raster.index(self.fragments.column[kept], self.fragments.row[kept])] = kept
        pixel = np.flatnonzero(last >= 0)
        return pixel, last[pixel]

    def resolve(self, raster: Raster, depth_format: DepthFormat) -> tuple[Integers, Integers, Stored]:
        """Return the pixels that something is seen at (V,), the owner there (V,), and the depth buffer (H*W,)."""
        pixel, last = self.last_kept(raster)
        depth = cleared_buffers(raster.shape[0] * raster.shape[1], depth_format).depth.copy()
        if self.left is None:
            depth[pixel] = self.stored[last]
        else:
            # Of several fragments of a pixel, the last one's value stays.
            depth[raster.index(self.fragments.column, self.fragments.row)] = self.left
        return pixel, owner_of(self.fragments)[last], depth


@dataclass(frozen=True, eq=False)
class Visible:
    """What is seen of a picture at one sample a pixel."""

    pixel: Integers
    """(V,) int64, the pixels that something is seen at."""
    owner: Integers
    """(V,) int64, what the fragment there belongs to, see ``owner_of``."""
    depth: Stored
    """(H*W,) the depth buffer."""
    cover_count: NDArray[np.int32]
    """(H*W,) int32, fragments in depth range."""
    decided: DecidedFragments | None
    """All of these fragments, where they are blended or rays are cast."""


def decide_fragments(
    geometry: Geometry, batches: Sequence[tuple[Fragments, Stored]], raster: Raster
) -> DecidedFragments:
    """Put all fragments of a picture in drawing order, and test them over cleared buffers.

    A batch of fragments (F,) comes with what the depth buffer gets of each, (F,).
    """
    depth_format = resolve(geometry.settings).depth_format
    if batches:
        fragments = join_fragments([part for part, _ in batches])
        stored = np.concatenate([part for _, part in batches])
    else:
        none = np.empty(0, np.int64)
        fragments, stored = fragments_at(geometry, none, none, none), np.empty(0, depth_format.stored_type)
    owner = owner_of(fragments)
    if (owner[1:] < owner[:-1]).any():
        order = np.argsort(owner, kind="stable")
        fragments, stored = fragments.take(order), stored[order]
    stacks = stack_fragments(raster.index(fragments.column, fragments.row))
    start = cleared_buffers(raster.shape[0] * raster.shape[1], depth_format)
    tests, exact = run_visibility_tests(geometry, fragments, stored, stacks, start, raster, depth_format)
    if exact is not None and exact.turn is not None:
        fragments, stored = fragments.take(exact.turn), stored[exact.turn]
        stacks = stack_fragments(raster.index(fragments.column, fragments.row))
        from_front = resolves_from_front(geometry)
        return DecidedFragments(fragments, stored, stacks, np.ones(len(stored), bool), None, from_front)
    return DecidedFragments(fragments, stored, stacks, tests.passes, tests.left)
