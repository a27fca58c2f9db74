"""Trace of exact areas: how the edges of a triangle cut the square of a pixel, and what of it is seen.

Before the row that sums a pixel up stand, for every triangle that touches it, one row for every edge that may cut the
square (``cut``), and one for what is left (``piece``): its area, how much of it is in front of what was there, and how
much of the pixel is covered by now. The picture cuts what earlier triangles have left of the square; those parts lie
side by side in the polygon that is shown here, which is cut out of the whole square by the same rule.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.antialiasing import pixel_pieces
from core.antialiasing.exact_area import DrawnLayer, PiecePainter
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import RETURN, Columns, Labels, Operation, listing
from core.trace.stage_trace import BufferTrack, InsertedRows, StageTrace, empty_like, insert_rows

MOST_NUMBERS = 1 << 22
"""Rows times the pieces of the pixel that has most: every row has room for them, some 32 bytes each."""
MOST_CORNERS = 7
"""Corners of a square that three edges have cut."""
KINDS = ("cut", "piece")


def _cut_label(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line of `cut_polygon` that returns: the whole polygon, nothing, or what is kept."""
    distance = columns["corner_distance"][rows]
    is_whole, is_nothing = ~(distance < 0).any(axis=1), ~(distance > 0).any(axis=1)
    return np.select([is_whole, is_nothing], ["whole", "nothing"], "cut")


def _area_label(name: str) -> Labels:
    """Return the line of `shown_areas` that adds to an area last; of none the line that begins with 0."""
    of_area = {"seen": "seen_area", "cover": "covered_area"}[name]
    return lambda columns, rows: np.where(columns[of_area][rows] > 0, name, "none")


OPERATIONS = {
    "cut": (
        Operation(
            "distances", "distances", {"corner_distance": "distance"}, ("edge", "a", "b", "value", "before")
        ),
        Operation("cut", _cut_label, {"polygon": RETURN}, ("corner_count",)),
    ),
    "piece": (
        Operation("area", "area", {"piece_area": RETURN}, ("polygon", "corner_count")),
        Operation(
            "seen", _area_label("seen"), {"seen_area": "front"}, ("part_area", "part_primitive", "primitive")
        ),
        Operation("cover", _area_label("cover"), {"covered_area": "covered"}),
    ),
}


@dataclass(frozen=True, eq=False)
class PixelCuts:
    """F pairs of a pixel and a triangle that touches its square: pixel by pixel, and in drawing order in each."""

    place: Integers
    """(F,) int64, place of the pixel in flattened buffers."""
    triangle: Integers
    """(F,) int64, number of the triangle in the scene."""
    is_whole: Flags
    """(F,) bool, no edge cuts the square."""
    edge_parts: tuple[Floats, Floats, Floats]
    """(F, 3) float64 each: change of the edge functions per column and per row, and their values at the centre."""
    seen: Floats
    """(F,) float64, the area of what passed the depth test, in pixels."""
    covered: Floats
    """(F,) float64, how much of the pixel shows any triangle after this one."""
    part_area: Floats
    """(F, M) float64, how much of the pixel each of the primitives shows that are seen in it then; 0: there is none."""
    part_primitive: Integers
    """(F, M) int64, these primitives, rising; -1: the background, or none."""
    primitive: Integers
    """(F,) int64, the primitive that was drawn."""


def cuts_of(
    painter: PiecePainter, layers: list[DrawnLayer], triangle_of: Integers, chosen: int | None
) -> PixelCuts:
    """Return what was cut in the ``layers`` of a painter.

    Parameters
    ----------
    triangle_of : (P,) int64
        Number of every primitive's triangle.
    chosen : int, optional
        The only triangle whose cuts are rows.
    """
    squares, pixel = painter.squares, painter.stacks.pixel
    none = np.empty(0, np.int64)
    fragment, place, rank = [none], [none], [none]
    seen: list[Floats] = [np.empty(0)]
    covered: list[Floats] = [np.empty(0)]
    parts = []
    for number, layer in enumerate(layers):
        count, there = len(layer.fragment), layer.there
        areas, shown = _by_primitive(
            there.pieces.number, pixel_pieces.area_of(there.pieces), there.primitive, count
        )
        new = squares.primitive.take(layer.fragment)
        fragment.append(layer.fragment)
        place.append(pixel[:count])
        rank.append(np.full(count, number))
        seen.append(_added_up(areas, shown == new[:, None]))
        covered.append(_added_up(areas, shown >= 0))
        parts.append((areas, shown))
    joined, at = np.concatenate(fragment), np.concatenate(place)
    triangle = triangle_of.take(squares.primitive.take(joined))
    order = np.lexsort((np.concatenate(rank), at))
    if chosen is not None:
        order = order[triangle[order] == chosen]
    taken = joined[order]
    first, second, third = (part[taken] for part in squares.edge_parts)
    return PixelCuts(
        at[order],
        triangle[order],
        squares.is_whole[taken],
        (first, second, third),
        np.concatenate(seen)[order],
        np.concatenate(covered)[order],
        _joined_parts([areas for areas, _ in parts], 0.0)[order],
        _joined_parts([shown for _, shown in parts], -1)[order],
        squares.primitive.take(taken),
    )


def _by_primitive(number: Integers, area: Floats, primitive: Integers, count: int) -> tuple[Floats, Integers]:
    """Return how much of each of ``count`` pixels its primitives show, and which these are, (count, M) each.

    Given are pieces (P,) by the number of their pixel; one primitive may show hundreds of them in a pixel.
    """
    primitives = np.int64(primitive.max(initial=-1)) + 2
    key, group = np.unique(number * primitives + (primitive + 1), return_inverse=True)
    of_pixel, shown = key // primitives, key % primitives - 1
    place = np.arange(len(key)) - np.searchsorted(of_pixel, of_pixel)
    most = int(place.max(initial=0)) + 1
    areas, primitives_of = np.zeros((count, most)), np.full((count, most), -1)
    areas[of_pixel, place] = np.bincount(group, area, len(key))
    primitives_of[of_pixel, place] = shown
    return areas, primitives_of


def _added_up(areas: Floats, chosen: Flags) -> Floats:
    """Return the sums (F,) of the ``chosen`` (F, M) areas, one after another."""
    total = np.zeros(len(areas))
    for column in range(areas.shape[1]):
        total += areas[:, column] * chosen[:, column]
    return total


def _joined_parts(of_layers: list[NDArray[Any]], missing: float) -> NDArray[Any]:
    """Return the parts (n, M) of all layers, one after another, filled up with ``missing``."""
    most = max((of_layer.shape[1] for of_layer in of_layers), default=1)
    room = [np.pad(of, ((0, 0), (0, most - of.shape[1])), constant_values=missing) for of in of_layers]
    return np.concatenate(room) if room else np.empty((0, most))


def with_cuts(found: StageTrace, cuts: PixelCuts) -> StageTrace:
    """Return the trace of the sums, one row a pixel, with the rows of the cuts before them.

    Where they would take more than `MOST_NUMBERS` they are left out, and a constant says for how many triangles.
    """
    row_count = found.steps.row_count + 4 * len(cuts.place)
    if row_count * found.columns["sample_weights"].shape[1] > MOST_NUMBERS:
        return replace(found, constants={**found.constants, "untold_cuts": len(cuts.place)})
    joined = insert_rows(found, np.arange(found.steps.row_count), _inserted(cuts, found))
    rows = np.flatnonzero(joined.steps.kind == joined.steps.kinds.index("piece"))
    # The buffer fills as triangle after triangle comes.
    covered = joined.columns["covered_area"][rows]
    buffers = [
        _written_too(track, rows, cuts.place, covered) if track.name == "covered part" else track
        for track in joined.buffers
    ]
    return replace(joined, buffers=tuple(buffers))


def _written_too(track: BufferTrack, rows: Integers, places: Integers, values: Floats) -> BufferTrack:
    """Return a buffer that ``rows`` (k,) write to as well."""
    all_rows = np.concatenate([track.rows, rows])
    order = np.argsort(all_rows, kind="stable")
    return replace(
        track,
        rows=all_rows[order],
        places=np.concatenate([track.places, places])[order],
        values=np.concatenate([track.values, values])[order],
    )


ColumnsOfPairs = tuple[Integers, dict[str, NDArray[Any]]]
"""Which pairs (R,) of pixel and triangle some rows are about, and their columns, name to (R, ...)."""


def _cut_squares(cuts: PixelCuts) -> list[ColumnsOfPairs]:
    """Return what the three edges cut off, one after another, and what is left of the squares in the end."""
    count = len(cuts.place)
    pieces = pixel_pieces.whole_pixels(np.arange(count))
    parts: list[ColumnsOfPairs] = []
    for edge in range(3):
        is_cut = ~cuts.is_whole.take(pieces.number)
        whole, cut = pieces.select(~is_cut), pieces.select(is_cut)
        a, b, value = (part[cut.number, edge] for part in cuts.edge_parts)
        left, _ = pixel_pieces.split_pieces(cut, a, b, value)
        before, after = polygons_of(cut, count), polygons_of(left, count)
        parts.append((cut.number, _of_cut(edge, (a, b, value), before[cut.number], after[cut.number])))
        joined = pixel_pieces.join_pieces([whole, left])
        pieces = joined.take(np.argsort(joined.number, kind="stable"))
    area = np.zeros(count)
    area[pieces.number] = pixel_pieces.area_of(pieces)
    of_piece: dict[str, NDArray[Any]] = {
        "polygon": polygons_of(pieces, count),
        "piece_area": area,
        "seen_area": cuts.seen,
        "covered_area": cuts.covered,
        "part_area": cuts.part_area,
        "part_primitive": cuts.part_primitive,
        "primitive": cuts.primitive,
    }
    return [*parts, (np.arange(count), of_piece)]


def _inserted(cuts: PixelCuts, found: StageTrace) -> InsertedRows:
    """Return the rows of all cuts, to stand before those of their pixels in ``found``."""
    parts = _cut_squares(cuts)

    # The rows of a pair of pixel and triangle stand together: its cuts, then what is left.
    pair = np.concatenate([of_pair for of_pair, _ in parts])
    kind = np.repeat([0, 0, 0, 1], [len(of_pair) for of_pair, _ in parts])
    order = np.argsort(pair, kind="stable")
    names = dict.fromkeys(name for _, of_rows in parts for name in of_rows)
    columns = {name: _joined_column(name, parts)[order] for name in names}
    columns["corner_count"] = np.isfinite(columns["polygon"][..., 0]).sum(axis=1)
    pair = pair[order]
    place = cuts.place[pair]
    columns["column"], columns["row"] = found.pixel[place].T
    return InsertedRows(
        before=place,
        group=place,
        triangle=cuts.triangle[pair],
        kinds=KINDS,
        kind=kind[order],
        operations=OPERATIONS,
        columns=columns,
        listings={
            "cut": listing(pixel_pieces.cut_polygon),
            "piece": listing(pixel_pieces.shown_areas),
            "piece.area": listing(pixel_pieces.polygon_area),
        },
        pixel=found.pixel[place],
    )


def _of_cut(
    edge: int, line: tuple[Floats, Floats, Floats], before: Floats, after: Floats
) -> dict[str, NDArray[Any]]:
    """Return the columns of the rows (R,) in which an edge cuts polygons (R, V, 2)."""
    a, b, value = line
    distance = a[:, None] * before[..., 0] + (b[:, None] * before[..., 1] + value[:, None])
    is_on = np.abs(distance) <= pixel_pieces.ON_LINE * (np.abs(a) + np.abs(b))[:, None]
    return {
        "edge": np.full(len(a), edge),
        "a": a,
        "b": b,
        "value": value,
        "before": before,
        "corner_distance": np.where(is_on, 0.0, distance),
        "polygon": after,
    }


def _joined_column(name: str, parts: list[ColumnsOfPairs]) -> NDArray[Any]:
    """Return one column of all rows, empty where the rows have no such number."""
    of_any = next(columns[name] for _, columns in parts if name in columns)
    return np.concatenate([columns.get(name, empty_like(of_any, len(pair))) for pair, columns in parts])


def polygons_of(pieces: pixel_pieces.Pieces, count: int) -> Floats:
    """Return the polygon of every number below ``count``, (count, V, 2) float64; NaN behind its last corner."""
    polygon = np.full((count, MOST_CORNERS, 2), np.nan)
    room = min(pieces.corner.shape[1], MOST_CORNERS)
    corner = pieces.corner[:, :room].transpose(2, 1, 0)
    is_own = np.arange(room) < pieces.corner_count[:, None]
    polygon[pieces.number, :room] = np.where(is_own[..., None], corner, np.nan)
    return polygon
