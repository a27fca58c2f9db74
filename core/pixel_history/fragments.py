"""What the history of a pixel is made of, and its fragments or pieces: interpolated, shaded, tested, blended in turn.

The painter of the picture cuts this one square, as a raster of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.exact_area import ColoredPieces, PiecePainter, piece_painter, sum_areas
from core.antialiasing.pixel_pieces import area_of, split_pieces, whole_pixels
from core.coverage.pixel_runs import make_raster
from core.depth.depth import DepthFormat, stack_fragments
from core.framebuffer.blending import add_behind, blend_traits, over_background
from core.lines.wireframe_fragments import weigh_alpha, writes_depth
from core.pixel_history.candidates import PixelCandidates, check_pixel, whole_geometry
from core.pixel_history.pieces import painted_over
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.records.frame import StageCount
from core.resolved import resolve
from core.stages.declared import STAGES
from core.stages.fragment_color import has_program
from core.stages.fragments import (
    fragment_depth,
    fragment_inverse_w,
    fragment_values,
    not_discarded,
    surface_of,
)
from core.stages.hidden_surfaces import cleared_buffers, resolves_from_front, run_visibility_tests
from core.trace.source import TraceSource

# What the history of a pixel is made of: keys and numbers, no sentences.


@dataclass(frozen=True, eq=False)
class Link:
    """One fact of a chain from the vertices to the blended colour, or a verdict."""

    stage: str
    """A stage of ``core.STAGES``, or ``verdict``."""
    key: str
    """What became of it there: names the sentence."""
    values: Mapping[str, Any]
    """The numbers of the sentence, those of the rules themselves."""


@dataclass(frozen=True, eq=False)
class PixelState:
    """What the buffers hold at the pixel, or what a fragment offers to them."""

    color: Singles
    """(4,) float32, linear."""
    depth: float
    """As the depth method stores it; exactly a float32."""
    triangle: int
    """Number of the triangle in the scene, -1: none."""


@dataclass(frozen=True, eq=False)
class PixelEvent:
    """The buffers before anything, the clear, or one triangle at this pixel."""

    kind: str
    """``initial``, ``clear``, ``fragment`` (covered), ``missed``, ``culled``, ``clipped`` or ``resolve``."""
    chain: tuple[Link, ...]
    """What the stages did with it, up to the one where it ended."""
    triangle: int = -1
    primitive: int = -1
    """Index of the piece among the drawn primitives of the whole scene; -1: none was drawn."""
    before: PixelState | None = None
    """What was there; ``None``: undefined, or no fragment."""
    out: PixelState | None = None
    """What the fragment offers."""
    after: PixelState | None = None
    is_rejected: bool = False

    @property
    def reason(self) -> Link:
        """The last link: where and why it ended."""
        return self.chain[-1]

    def link(self, stage: str) -> Link | None:
        """Return the link of a stage, ``None`` where it was not reached."""
        return next((link for link in self.chain if link.stage == stage), None)


@dataclass(frozen=True, eq=False)
class PixelHistory:
    """Everything that happened to one pixel of the picture of the whole scene."""

    column: int
    row: int
    triangle: int | None
    """The triangle that was asked about, ``None``: the pixel itself."""
    verdict: Link
    """The first line: what became of the pixel, or of the triangle at this pixel."""
    events: tuple[PixelEvent, ...]
    """Initial value, clear, then triangles in drawing order; last what the colour is mixed with when it is resolved."""
    counts: Mapping[str, int]
    """Triangles that are not listed one by one: how many, by the key of their reason."""
    cover_count: int
    """Fragments here that are in depth range."""
    sample: int | None = None
    """Which of several samples it is the history of; ``None``: the pixel's centre."""

    @property
    def final(self) -> PixelState:
        """What the picture shows."""
        return next(event.after for event in reversed(self.events) if event.after is not None)

    @property
    def fragments(self) -> tuple[PixelEvent, ...]:
        """The events of covered fragments, in drawing order."""
        return tuple(event for event in self.events if event.kind == "fragment")


# The fragments at one pixel through interpolation, shading, depth test and blending, one after the other.


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
    exact: tuple[NDArray[Any], Mapping[str, Integers]] | None
    """Of those that ``keeps`` has, (K,): what is said of an exact comparison, as ``ExactTests.told`` gives it."""
    turn: Integers | None = None
    """(F,) int64, the fragments as they reach the buffers, where they are sorted; ``None``: in drawing order."""
    light_share: Floats | None = None
    """(F,) float64, what arrives of the light that casts shadows; ``None``: no shadow is looked for."""
    from_front: bool = False
    """Whether they are blended from front to back."""
    lit_color: Floats | None = None
    """(F, 4) float64, the colours before what is mirrored is added; ``None``: nothing mirrors."""

    @property
    def in_turn(self) -> list[int]:
        """The fragments in the order in which they reach the buffers."""
        found: list[int] = (np.arange(len(self.primitive)) if self.turn is None else self.turn).tolist()
        return found


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
    tests, exact = run_visibility_tests(
        geometry, kept, stored[index], here, cleared, raster, depth_format, keeps_visits=True
    )
    before, passes = np.full(count, np.nan, depth_format.stored_type), np.zeros(count, bool)
    before[index], passes[index] = tests.before, tests.passes
    turn, from_front = None, resolves_from_front(geometry)
    if exact is not None and exact.turn is not None:
        turned = exact.turn[::-1] if from_front else exact.turn
        turn = np.concatenate([np.flatnonzero(~keeps), np.setdiff1d(index, index[turned]), index[turned]])
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
        None if exact is None else exact.told(),
        turn,
        surface.light_share,
        from_front,
        surface.lit_color,
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
    """Lay the fragments into the buffers one by one; return what became of each (F).

    Blended from front to back, the colour after a fragment is what the list would give if it ended there.
    """
    rule = resolve(candidates.settings).blend_method.function
    tested = candidates.geometry.drawing.uses_depth_test
    state, below = start, -1
    added, rest = np.zeros((1, 4)), np.ones(1)
    passages: dict[int, Passage] = {}
    for k in fragments.in_turn:
        offered = fragments.source[k : k + 1]
        with np.errstate(over="ignore", invalid="ignore"):
            shown = read_only(offered[0].astype(np.float32))
        out = PixelState(shown, float(fragments.stored[k]), int(fragments.triangle[k]))
        after = state
        if fragments.passes[k]:
            if fragments.from_front:
                added, rest = add_behind(added, rest, offered)
                blended = over_background(added, rest, start.color[None])
            else:
                blended = rule(offered, state.color[None])
            is_hidden = fragments.from_front and state.triangle >= 0
            kept = out if fragments.writes[k] and not is_hidden else state
            after = PixelState(read_only(blended[0]), kept.depth, kept.triangle)
        link = _depth_link(fragments, k, state.triangle, tested)
        if link.key == "not-tested" and below >= 0:
            link = _painted_link(candidates, link, int(fragments.primitive[k]), below)
        passages[k] = Passage(state, out, after, link, bool(fragments.passes[k]))
        if fragments.passes[k] and fragments.writes[k]:
            below = int(fragments.primitive[k])
        state = after
    return [passages[k] for k in range(len(passages))]


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
    elif fragments.exact is not None:
        keys, numbers = fragments.exact
        place = int(fragments.keeps[:k].sum())
        key = str(keys[place])
        values |= {name: int(of_all[place]) for name, of_all in numbers.items()}
    elif fragments.passes[k]:
        key = "passed"
    else:
        key = "tied" if stored == before else "undefined" if np.isnan(stored) else "failed"
    return Link("depth", key, values)


def _painted_link(candidates: PixelCandidates, link: Link, primitive: int, below: int) -> Link:
    """Say why a primitive is painted over the one ``below``, where a tree has put them in order."""
    why = painted_over(candidates, primitive, below)
    return link if why is None else Link("depth", "painted-over", {**link.values, **why})


def overwriters(fragments: PixelFragments, blend: str) -> list[int]:
    """Return for every fragment the triangle that later hid its colour, -1 where none did or it was not kept.

    Notes
    -----
    Opaque hides always, "over" hides what is below it where its alpha is 1, additive hides nothing. Blended from front
    to back, it is the one in front that hides the others.
    """
    hides = fragments.passes & blend_traits(blend).hides(fragments.source[:, 3])
    found, hider = [-1] * len(hides), -1
    for k in fragments.in_turn if fragments.from_front else reversed(fragments.in_turn):
        found[k] = hider if fragments.passes[k] else -1
        hider = int(fragments.triangle[k]) if hides[k] and (hider < 0 or not fragments.from_front) else hider
    return found


# The history of a pixel of exact areas: who covers how much of its square, and how much of that is seen.


@dataclass(frozen=True, eq=False)
class PiecesEvent:
    """One triangle, or one piece that clipping made of it, at a pixel that it touches."""

    triangle: int
    area: float
    """How much of the pixel lies inside its edges, 0 to 1."""
    passed: float
    """How much of the pixel it took when it was drawn: what is in depth range and passed the depth test."""
    seen: float
    """How much of the pixel it has when everything is drawn."""
    color: Singles
    """(4,) float32, linear: the mean of what it drew; NaN where nothing passed."""
    before: Singles
    """(4,) float32, linear: the pixel when it came."""
    after: Singles
    """(4,) float32."""


@dataclass(frozen=True, eq=False)
class PixelPieces:
    """What became of one pixel of exact areas."""

    column: int
    row: int
    events: tuple[PiecesEvent, ...]
    """Triangles that touch the pixel, in drawing order."""
    background: float
    """How much of the pixel shows no triangle."""
    background_color: Singles
    """(4,) float32, linear: the pixel before anything was drawn."""
    is_blended: bool
    """Whether what is seen is the last triangle of a stack of transparent ones."""
    untouching_count: int
    """Triangles of the scene that do not touch the pixel."""


def pixel_pieces(source: TraceSource, column: int, row: int) -> PixelPieces | None:
    """Return what became of a pixel in the picture of the whole scene; ``None``: no triangles are filled.

    Parameters
    ----------
    source : TraceSource
        Scene and settings; which triangle it traces and its region do not matter here.
    column, row : int
        The pixel, row 0 at the bottom.

    Raises
    ------
    ValueError
        For a pixel outside the image.
    """
    scene, settings = source.scene, source.settings
    check_pixel(scene, column, row)
    geometry = whole_geometry(source)
    if not geometry.is_cut_to_pixels:
        return None
    raster = make_raster(scene.size, settings.pixel_center, (column, row, 1, 1))
    painter = piece_painter(scene, geometry, raster, {stage: StageCount() for stage in STAGES})

    # One pixel: every layer draws one triangle, and holds all pieces of the pixel.
    background = np.asarray(scene.background, np.float32)
    states = [painter.colored(layer.there) for layer in painter.layers()]
    primitives = painter.squares.primitive
    areas = _areas_inside(painter)
    last = states[-1] if states else None
    events, before = [], background
    for state, primitive, area in zip(states, primitives.tolist(), areas, strict=True):
        passed = _area_of(state, primitive)
        after = read_only(sum_areas(state, 1)[0])
        triangle = int(geometry.primitives.triangle[primitive])
        seen = _area_of(last, primitive) if last is not None else 0.0
        color = _mean_color(state, primitive)
        events.append(PiecesEvent(triangle, area, passed, seen, color, before, after))
        before = after
    touching = {event.triangle for event in events}
    return PixelPieces(
        column,
        row,
        tuple(events),
        1.0 if last is None else _area_of(last, -1),
        read_only(background),
        resolve(settings).is_mixed,
        len(geometry.assembled) - len(touching),
    )


def _areas_inside(painter: PiecePainter) -> list[float]:
    """Return how much of the square lies inside the edges of every triangle that touches it."""
    squares = painter.squares
    count = len(squares.primitive)
    pieces = whole_pixels(np.arange(count))
    areas = np.ones(count)
    for edge in range(3):
        a, b, value = (part[pieces.number, edge] for part in squares.edge_parts)
        pieces, _ = split_pieces(pieces, a, b, value)
    inside = np.bincount(pieces.number, area_of(pieces), count)
    found: list[float] = np.where(squares.is_whole, areas, inside).tolist()
    return found


def _area_of(pieces: ColoredPieces, primitive: int) -> float:
    """Return how much of the pixel shows a primitive; -1: nothing."""
    return float(pieces.area[pieces.primitive == primitive].sum())


def _mean_color(pieces: ColoredPieces, primitive: int) -> Singles:
    """Return the mean colour (4,) float32 of what a primitive has; NaN where that is nothing."""
    is_own = pieces.primitive == primitive
    with np.errstate(invalid="ignore"):
        mean = (pieces.area[is_own, None] * pieces.color[is_own]).sum(axis=0) / pieces.area[is_own].sum()
    return read_only(mean.astype(np.float32))
