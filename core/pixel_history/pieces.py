"""The history of a pixel of exact areas: who covers how much of its square, and how much of that is seen.

The painter of the picture cuts this one square, as a raster of its own.
"""

from dataclasses import dataclass

import numpy as np

from core.antialiasing.exact_area import ColoredPieces, PiecePainter, piece_painter, sum_areas
from core.antialiasing.pixel_pieces import area_of, split_pieces, whole_pixels
from core.pixel_history.candidates import check_pixel, whole_geometry
from core.raster.pixel_runs import make_raster
from core.records.arrays import Singles, read_only
from core.records.frame import StageCount
from core.resolved import resolve
from core.stages.declared import STAGES
from core.trace.source import TraceSource


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
