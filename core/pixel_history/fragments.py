"""The fragments at one pixel through interpolation, shading, depth test and blending, one after the other."""

from dataclasses import dataclass

import numpy as np

from core.framebuffer.blending import blend_traits
from core.framebuffer.depth import DepthFormat
from core.framebuffer.stacks import stack_fragments
from core.pixel_history.candidates import PixelCandidates
from core.pixel_history.records import Link, PixelState
from core.raster.lines.intensities import weigh_alpha, writes_depth
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.resolved import resolve
from core.stages.fragment_depth import fragment_depth, fragment_inverse_w
from core.stages.fragments import fragment_values, not_discarded, surface_of
from core.stages.hidden_surfaces import cleared_buffers, run_visibility_tests
from core.stages.vertex_program import has_program


@dataclass(frozen=True, eq=False)
class PixelFragments:
    """F fragments at one pixel in drawing order, with the numbers of every stage."""

    primitive: Integers
    """(F,) int64."""
    triangle: Integers
    """(F,) int64."""
    weights: Floats
    """(F, 3) float64."""
    inverse_w: Floats
    """(F,) float64."""
    color: Floats
    """(F, 4) float64."""
    depth: Floats
    """(F,) float64 window depth."""
    keeps: Flags
    """(F,) bool, in depth range, and not discarded by a fragment shader."""
    in_range: Flags
    """(F,) bool, in depth range."""
    stored: Singles
    """(F,) float32."""
    before: Singles
    """(F,) float32, what the depth buffer held; NaN where there was no test."""
    passes: Flags
    """(F,) bool."""
    source: Floats
    """(F, 4) float64, the colours that are blended: alpha scaled by the intensity, where a line has one."""
    writes: Flags
    """(F,) bool, stored in the depth buffer if it passes."""
    scale: float
    """The number that the depth format stores a depth of 1 as: above 1 it stores whole numbers."""
    signs: Integers | None
    """(F,) int64, where rays are cast: 1 nearer than the nearest so far, -1 farther, 0 equally near or out of range."""


def run_fragments(candidates: PixelCandidates, depth_format: DepthFormat) -> PixelFragments:
    """Take the covering candidates through the stages behind the raster, by the rules of the picture."""
    geometry, raster = candidates.geometry, candidates.raster
    fragments = candidates.fragments
    primitive, count = fragments.primitive, len(fragments)
    of_colors = candidates.colored_by or geometry
    weights, values = fragment_values(of_colors, fragments, raster)
    surface = surface_of(candidates.scene, of_colors, raster, fragments, values)

    # Only what is in range gets to the depth test.
    depth, in_range, stored = fragment_depth(geometry, fragments, raster, depth_format)
    keeps = in_range
    if has_program(candidates.scene):
        keeps = in_range & not_discarded(candidates.scene, of_colors, raster, fragments)
    index = np.flatnonzero(keeps)
    here = stack_fragments(np.zeros(len(index), np.int64))
    writes = writes_depth(fragments)
    kept, cleared = fragments.select(keeps), cleared_buffers(1, depth_format)
    tests, rays = run_visibility_tests(geometry, kept, stored[index], here, cleared, raster, depth_format)
    before, passes = np.full(count, np.nan, depth_format.stored_type), np.zeros(count, bool)
    before[index], passes[index] = tests.before, tests.passes
    signs = None
    if rays is not None:
        signs = np.zeros(count, np.int64)
        signs[index] = rays.sign
    return PixelFragments(
        primitive,
        geometry.primitives.triangle[primitive],
        weights,
        fragment_inverse_w(geometry, fragments, raster),
        surface.color,
        depth,
        keeps,
        in_range,
        stored,
        before,
        passes,
        weigh_alpha(surface.color, fragments),
        np.ones(count, bool) if writes is None else writes,
        depth_format.scale,
        signs,
    )


def cleared_state(candidates: PixelCandidates, depth_format: DepthFormat) -> PixelState:
    """Return what clearing leaves."""
    color = read_only(candidates.scene.background.astype(np.float32))
    return PixelState(color, float(depth_format.cleared), -1)


@dataclass(frozen=True, eq=False)
class Passage:
    """One fragment between two states of the buffers."""

    before: PixelState
    out: PixelState
    after: PixelState
    depth_link: Link
    passes: bool


def fold(fragments: PixelFragments, start: PixelState, candidates: PixelCandidates) -> list[Passage]:
    """Lay the fragments into the buffers one by one."""
    rule = resolve(candidates.settings).blend_method.function
    tested = candidates.geometry.uses_depth_test
    state = start
    passages = []
    for k in range(len(fragments.primitive)):
        offered = fragments.source[k : k + 1]
        with np.errstate(over="ignore", invalid="ignore"):
            shown = read_only(offered[0].astype(np.float32))
        out = PixelState(shown, float(fragments.stored[k]), int(fragments.triangle[k]))
        after = state
        if fragments.passes[k]:
            blended = rule(offered, state.color[None])
            kept = out if fragments.writes[k] else state
            after = PixelState(read_only(blended[0]), kept.depth, kept.triangle)
        link = _depth_link(fragments, k, state.triangle, tested)
        passages.append(Passage(state, out, after, link, bool(fragments.passes[k])))
        state = after
    return passages


def _depth_link(fragments: PixelFragments, k: int, holder: int, tested: bool) -> Link:
    """Return what the depth test said of fragment ``k``; ``holder`` is whose depth it met."""
    depth, stored, before = fragments.depth[k], fragments.stored[k], fragments.before[k]
    values = {
        "depth": float(depth),
        "stored": float(stored),
        "before": float(before),
        "against": holder,
        "scale": fragments.scale,
        "inverse_w": float(fragments.inverse_w[k]),
    }
    if fragments.in_range[k] and not fragments.keeps[k]:
        key = "discarded"
    elif not fragments.keeps[k]:
        key = "before-near" if depth < 0 else "behind-far" if depth > 1 else "undefined"
    elif not tested:
        key = "not-tested"
    elif fragments.signs is not None:
        key = {1: "ray-nearer", 0: "ray-tied", -1: "ray-farther"}[int(fragments.signs[k])]
    elif fragments.passes[k]:
        key = "passed"
    else:
        key = "tied" if stored == before else "undefined" if np.isnan(stored) else "failed"
    return Link("depth", key, values)


def overwriters(fragments: PixelFragments, blend: str) -> list[int]:
    """Return for every fragment the triangle that later hid its colour, -1 where none did or it was not kept.

    Notes
    -----
    Opaque hides always, "over" hides what is below it where its alpha is 1, additive hides nothing.
    """
    hides = fragments.passes & blend_traits(blend).hides(fragments.source[:, 3])
    found = []
    for k in range(len(hides)):
        later = np.flatnonzero(hides[k + 1 :])
        is_hidden = fragments.passes[k] and len(later)
        found.append(int(fragments.triangle[k + 1 + later[0]]) if is_hidden else -1)
    return found
