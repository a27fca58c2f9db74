"""Trace of scan-line visible surfaces: row by row spans enter, their ends are sorted, segments compared and drawn."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.coverage.pixel_runs import expand
from core.depth.depth import depth_in_range
from core.records.arrays import Flags, Integers
from core.records.listing import RETURN, Columns, Listing, Operation, listing
from core.records.steps import RowOrder, Steps, ends_of
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace, empty_like
from core.visibility.ray_casting import BY_FLOATS, EXACTLY, FIRST, hit_is_nearer, hit_value, ray_constants
from core.visibility.scan_line import ALONE, HALVED, PAIR, SAME, ScanLines, draw_rows

SEGMENT_BY_SEGMENT = RowOrder(
    ("Row", "Span", "Compare"), sums=(("rows", "step", ""), ("covered", "place", "drawn"), ("tie", "tie", ""))
)
"""One row of pixels after another, in it one segment after another, in it one comparison after another."""

_HIT = (Operation("hit", "value", {"nearness": "value"}), Operation("bound", "bound", {"error": "bound"}))
_OTHER = ("nearest", "nearest_nearness", "nearest_error")
_LIVE = Operation("live", "live", {"live_count": "live"})
_ENDS = (Operation("first", "first", {"first": "first"}), Operation("last", "last", {"last": "last"}))


def _drawn_by(columns: Columns, rows: Any) -> NDArray[np.str_]:
    """Return the line of the listing that draws the pixel's segment."""
    labels = np.array(("alone", "same", "pair"))
    found: NDArray[np.str_] = labels[columns["verdict"][rows]]
    return found


_DRAW = Operation("draw", _drawn_by, {"passes": "drawn"}, ("depth", "stored", "before", "after"))
SCAN_OPERATIONS: dict[str, tuple[Operation, ...]] = {
    "scan-enter": (Operation("enter", "enter", (), ("row_first", "row_last")),),
    "scan-span": (Operation("span", "span", {"left": "here", "right": "here"}, ("slope",)),),
    "scan-sort": (Operation("sort", "sort", {"end_count": "ends"}),),
    "scan-alone": (_LIVE, Operation("alone", "alone", {"seen": "drawn"})),
    "scan-live": (_LIVE,),
    "end-first": (*_HIT, Operation("keep", "first", {"passes": RETURN})),
    "end": (*_HIT, Operation("compare", "floats", {"passes": RETURN}, (*_OTHER, "sign"))),
    "end-exact": (
        *_HIT,
        Operation("doubt", "margin", (), _OTHER),
        Operation("exact", "exact", {"passes": RETURN}, ("sign",)),
    ),
    "layer-first": (*_HIT, Operation("keep", "first", {"passes": RETURN})),
    "layer": (*_HIT, Operation("compare", "floats", {"passes": RETURN}, (*_OTHER, "sign"))),
    "layer-exact": (
        *_HIT,
        Operation("doubt", "margin", (), _OTHER),
        Operation("exact", "exact", {"passes": RETURN}, ("sign",)),
    ),
    "scan-same": (*_ENDS, Operation("same", "same", {"seen": "drawn"})),
    "scan-pair": (*_ENDS, Operation("pair", "pair", {"seen": "drawn"})),
    "scan-halve": (*_ENDS, Operation("halve", "halve", {"middle": "middle"})),
    "layers-same": (*_ENDS, Operation("same", "same", {"seen": "drawn"})),
    "layers-pair": (*_ENDS, Operation("pair", "pair", {"seen": "drawn"})),
    "layers-halve": (*_ENDS, Operation("halve", "halve", {"middle": "middle"})),
    "scan-pixel": (_DRAW,),
    "layer-pixel": (_DRAW,),
    "scan-leave": (Operation("leave", "leave", (), ("row_last",)),),
    "out-of-range": (Operation("range", "range", {"passes": RETURN}, ("depth",)),),
    "discarded": (Operation("discard", "", (), ("passes",)),),
}
"""Kind of row to what it does: ``end`` kinds compare one live triangle at one centre of a segment with the nearest so
far, ``layer`` kinds with the one behind it."""
KINDS = tuple(SCAN_OPERATIONS)
_HOW = {FIRST: "-first", BY_FLOATS: "", EXACTLY: "-exact"}
_VERDICTS = {SAME: "same", PAIR: "pair", HALVED: "halve"}
_COMPARED = tuple(f"{kind}{how}" for kind in ("end", "layer") for how in _HOW.values())
_PIXEL_KINDS = [KINDS.index("scan-pixel"), KINDS.index("layer-pixel")]
_RANGE, _ENTER, _SPAN, _SORT, _SEGMENT, _LEAVE = range(6)
"""What comes after what in a row."""
_HEAD, _FIRST_END, _LAST_END, _VERDICT, _PIXELS = range(5)
"""And in a segment."""


@dataclass(frozen=True, eq=False)
class _Rows:
    """Some rows of the trace, all (n,)."""

    kind: Integers
    row: Integers
    column: Integers
    triangle: Integers
    place: tuple[int, Integers | int, Integers | int, Integers | int]
    """What they are sorted by within a row of pixels: a part of it, then what orders the rows of that part."""
    columns: dict[str, NDArray[Any]]


def trace_scan_lines(source: TraceSource, lines: ScanLines) -> StageTrace:
    """Return the rows of the method; ``lines`` has decided the fragments (F,) that are in depth range."""
    parts = [_lost(source), *_surfaces(lines), *_segments(source, lines), _pixels(source, lines)]
    count = [len(part.kind) for part in parts]
    row = np.concatenate([part.row for part in parts])
    keys = [
        np.concatenate([np.broadcast_to(part.place[k], n) for part, n in zip(parts, count, strict=True)])
        for k in range(4)
    ]
    order = np.lexsort((*keys[::-1], row))
    names = {name: values for part in parts for name, values in part.columns.items()}
    columns = {
        name: np.concatenate(
            [
                part.columns[name] if name in part.columns else empty_like(values, n)
                for part, n in zip(parts, count, strict=True)
            ]
        )[order]
        for name, values in names.items()
    }
    kind = np.concatenate([part.kind for part in parts])[order]
    column = np.concatenate([part.column for part in parts])[order]
    row, triangle = row[order], np.concatenate([part.triangle for part in parts])[order]
    columns |= {"column": column, "row": row}
    is_segment, segment = keys[0][order] == _SEGMENT, keys[1][order]
    at_head = np.where(keys[0][order] < _SEGMENT, 0, keys[0][order])
    return StageTrace(
        stage="depth",
        method=f"visibility={source.settings.visibility}",
        steps=Steps(
            KINDS,
            kind,
            SCAN_OPERATIONS,
            ends_of(row),
            ends_of(row, at_head, _tops(lines)[np.where(is_segment, segment, -1)]),
        ),
        columns=columns,
        triangle=triangle,
        pixel=np.stack([column, row], axis=1),
        listings=_listings(),
        constants={**ray_constants(lines.planes), "quantity": source.depth_format.quantity.name},
        marks=_marks(kind, columns),
        buffers=_buffers(source, kind, columns, triangle),
        extra={"scan_lines": lines},
        order=SEGMENT_BY_SEGMENT,
    )


def _numbers(kind: str, count: int) -> Integers:
    return np.full(count, KINDS.index(kind))


def _tops(lines: ScanLines) -> Integers:
    """Return (G + 1,) int64: which segment each part is a half of; an element more for rows of none."""
    return np.append(np.cumsum(lines.segments.depth == 0), -1)


def _lost(source: TraceSource) -> _Rows:
    """Return the fragments that are out of depth range or discarded: they are part of no span."""
    fragments, (depth, keeps, _) = source.fragments, source.depths
    lost = np.flatnonzero(~keeps)
    kind = np.where(source.goes_on[lost], KINDS.index("out-of-range"), KINDS.index("discarded"))
    return _Rows(
        kind,
        fragments.row[lost],
        fragments.column[lost],
        source.triangle_of_fragment[lost],
        (_RANGE, np.arange(len(lost)), 0, 0),
        {"depth": depth[lost], "passes": np.zeros(len(lost), bool), "primitive": fragments.primitive[lost]},
    )


def _surfaces(lines: ScanLines) -> list[_Rows]:
    """Return the rows in which surfaces enter and leave, those of their spans, and those that sort the ends."""
    spans, planes = lines.spans, lines.planes
    number = np.arange(len(spans.row))
    # Spans stand by row. Those of the picture before are of no surface that enters.
    drawn = np.flatnonzero(spans.primitive >= 0)
    surface = spans.primitive[drawn]
    first = drawn[np.unique(surface, return_index=True)[1]]
    last = drawn[::-1][np.unique(surface[::-1], return_index=True)[1]]
    row_first, row_last = (np.full(int(surface.max(initial=-1)) + 2, -1) for _ in range(2))
    row_first[spans.primitive[first]], row_last[spans.primitive[last]] = spans.row[first], spans.row[last]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        slope = 2 * planes.a[spans.triangle] / planes.d[spans.triangle] / planes.size[0]

    def rows(kind: str, place: int, chosen: Integers, **columns: NDArray[Any]) -> _Rows:
        of = {
            "primitive": spans.primitive[chosen],
            "row_first": row_first[spans.primitive[chosen]],
            "row_last": row_last[spans.primitive[chosen]],
        }
        return _Rows(
            _numbers(kind, len(chosen)),
            spans.row[chosen],
            spans.left[chosen],
            spans.triangle[chosen],
            (place, chosen, 0, 0),
            of | columns,
        )

    # The ends of a row are sorted once.
    of_row = np.flatnonzero(np.diff(spans.row, prepend=-1))
    width = int(spans.right.max(initial=0)) + 1
    ends = np.unique(np.concatenate([spans.row * width + spans.left, spans.row * width + spans.right]))
    of_end = ends // width
    end_count = np.searchsorted(of_end, spans.row[of_row], "right") - np.searchsorted(
        of_end, spans.row[of_row]
    )
    sort = _Rows(
        _numbers("scan-sort", len(of_row)),
        spans.row[of_row],
        ends[np.searchsorted(of_end, spans.row[of_row])] % width,
        np.full(len(of_row), -1),
        (_SORT, 0, 0, 0),
        {"end_count": end_count, "span_count": np.diff(of_row, append=len(spans.row))},
    )
    return [
        rows("scan-enter", _ENTER, first),
        rows(
            "scan-span",
            _SPAN,
            number,
            left=spans.left,
            right=spans.right,
            slope=slope,
            a=planes.a[spans.triangle],
            d=planes.d[spans.triangle],
        ),
        sort,
        rows("scan-leave", _LEAVE, last),
    ]


def _segments(source: TraceSource, lines: ScanLines) -> list[_Rows]:
    """Return the rows of segments and their halves: what is live, each comparison at both ends, and the verdict."""
    segments, spans = lines.segments, lines.spans
    number, count = np.arange(len(segments)), segments.live_count
    first, last = (spans.triangle[segments.nearest[:, end]] for end in (0, 1))
    of = {
        "part": number,
        "left": segments.left,
        "right": segments.right,
        "live_count": count,
        "halvings": segments.depth,
        "verdict": segments.verdict,
    }
    nothing = np.full(len(number), -1)
    is_alone = segments.verdict == ALONE

    def rows(kind: Integers, chosen: Integers, place: int, triangle: Integers, **columns: Any) -> _Rows:
        taken = {name: values[chosen] for name, values in of.items()}
        column = columns.pop("column", segments.left[chosen])
        where = (_SEGMENT, chosen, place, columns.pop("turn", 0))
        return _Rows(kind, segments.row[chosen], column, triangle, where, taken | columns)

    kinds = np.where(is_alone, KINDS.index("scan-alone"), KINDS.index("scan-live"))
    head = rows(kinds, number, _HEAD, np.where(is_alone, first, nothing), seen=np.where(is_alone, first, -1))
    verdicts = np.flatnonzero(~is_alone)
    prefix = "layers" if segments.is_layered else "scan"
    of_verdict = np.full(max(_VERDICTS) + 1, -1)
    of_verdict[list(_VERDICTS)] = [KINDS.index(f"{prefix}-{name}") for name in _VERDICTS.values()]
    is_halved = segments.verdict == HALVED
    if segments.is_layered:
        first, last, from_front = _told_places(lines)
        of["from_front"] = from_front
        of["over_picture"] = np.logical_or.reduceat(
            spans.primitive[segments.live] < 0, segments.live_start[:-1]
        )
    decided = rows(
        of_verdict[segments.verdict[verdicts]],
        verdicts,
        _VERDICT,
        first[verdicts],
        first=first[verdicts],
        last=last[verdicts],
        seen=np.where(is_halved, -1, first)[verdicts],
        passes=~is_halved[verdicts],
        middle=np.where(is_halved, (segments.left + segments.right) // 2, -1)[verdicts],
    )
    found = [head, decided]
    which, turn = expand(count)
    prefix = "layer" if segments.is_layered else "end"
    kinds = np.array([KINDS.index(f"{prefix}{_HOW[how]}") for how in sorted(_HOW)])
    for end in (0, 1):
        chosen = np.flatnonzero(segments.compared_ends[which] > end)
        part, live = which[chosen], segments.compared[chosen, end]
        tests = segments.tests[end]
        column = segments.left[part] if end == 0 else segments.right[part] - 1
        kind = kinds[tests.how[chosen]]
        of_end = _comparisons(source, lines, live, tests.before[chosen], column, segments.row[part])
        of_end |= {
            "sign": tests.sign[chosen],
            "passes": tests.passes[chosen],
            "end": np.full(len(part), end),
            "primitive": spans.primitive[live],
        }
        place = _FIRST_END if end == 0 else _LAST_END
        triangle = spans.triangle[live]
        found.append(rows(kind, part, place, triangle, column=column, turn=turn[chosen], **of_end))
    return found


def _told_places(lines: ScanLines) -> tuple[Integers, Integers, Integers]:
    """Return of sorted segments (G,) the triangles at both centres in one place of the order, and its number.

    Places are counted from the front, from 1 on: the first in which the centres differ, or else the first of all.
    """
    segments = lines.segments
    differs = segments.compared[:, 0] != segments.compared[:, 1]
    # The last slot of each segment is the front.
    slot = np.where(differs, np.arange(len(differs)), -1)
    found = np.maximum.reduceat(slot, segments.live_start[:-1]) if len(segments) else slot
    front = segments.live_start[1:] - 1
    told = np.where(found < 0, front, found)
    first, last = lines.spans.triangle[segments.compared[told]].T
    return first, last, front - told + 1


def _comparisons(
    source: TraceSource, lines: ScanLines, live: Integers, before: Integers, column: Integers, row: Integers
) -> dict[str, NDArray[Any]]:
    """Return how near live spans (N,) and the nearest before them are at centres (N,), with bounds of the error."""
    planes, triangle = lines.planes, lines.spans.triangle[live]
    m, n = planes.rays(column, row, source.raster.center)
    nearness, error = planes.values(triangle, m, n)
    there, there_error = planes.values(np.maximum(before, 0), m, n)
    columns: dict[str, NDArray[Any]] = {
        "m": m,
        "n": n,
        "nearness": nearness,
        "error": error,
        "nearest": before,
    }
    columns["nearest_nearness"] = np.where(before < 0, np.nan, there)
    columns["nearest_error"] = np.where(before < 0, np.nan, there_error)
    return columns | {name: getattr(planes, name)[triangle] for name in ("a", "b", "c", "d", "sizes")}


def _pixels(source: TraceSource, lines: ScanLines) -> _Rows:
    """Return the pixels that are drawn; their depth is kept for views of the picture, and compared with nothing."""
    segments = lines.segments
    depth, keeps, stored = source.depths
    fragment = np.flatnonzero(keeps)[lines.drawn]
    row, column = source.fragments.row[fragment], source.fragments.column[fragment]
    done = np.flatnonzero(segments.verdict != HALVED)
    key = segments.row[done] * (int(segments.right.max(initial=0)) + 1)
    at = (
        np.searchsorted(
            key + segments.left[done], row * (int(segments.right.max(initial=0)) + 1) + column, "right"
        )
        - 1
    )
    part = done[at]
    # How many layers of the pixel are drawn before, and have stored their depths.
    order = np.argsort(source.place[fragment], kind="stable")
    layer = np.empty(len(order), np.int64)
    layer[order] = np.arange(len(order)) - np.searchsorted(
        source.place[fragment][order], source.place[fragment][order]
    )
    kind = "layer-pixel" if segments.is_layered else "scan-pixel"
    return _Rows(
        _numbers(kind, len(fragment)),
        row,
        column,
        source.triangle_of_fragment[fragment],
        (_SEGMENT, part, _PIXELS, np.arange(len(fragment))),
        {
            "left": segments.left[part],
            "right": segments.right[part],
            "verdict": segments.verdict[part],
            "depth": depth[fragment],
            "stored": stored[fragment],
            "before": source.depth_tests.before[fragment],
            "after": stored[fragment],
            "passes": np.ones(len(fragment), bool),
            "primitive": source.fragments.primitive[fragment],
            "layer": layer,
        },
    )


def _marks(kind: Integers, columns: dict[str, NDArray[Any]]) -> dict[str, Flags]:
    is_compared = np.isin(kind, [KINDS.index(name) for name in _COMPARED])
    is_lost = np.isin(kind, [KINDS.index("out-of-range"), KINDS.index("discarded")])
    return {
        "covered": np.isin(kind, _PIXEL_KINDS),
        "depth-failed": is_lost,
        "tie": is_compared & (columns["sign"] == 0),
        "nan": is_lost & np.isnan(columns["depth"]),
    }


def _buffers(
    source: TraceSource, kind: Integers, columns: dict[str, NDArray[Any]], triangle: Integers
) -> tuple[BufferTrack, ...]:
    start = source.start
    drawn = np.flatnonzero(np.isin(kind, _PIXEL_KINDS))
    place = source.raster.index(columns["column"], columns["row"])
    is_lost = np.isin(kind, [KINDS.index("out-of-range"), KINDS.index("discarded")])
    decided = np.flatnonzero(is_lost | np.isin(kind, _PIXEL_KINDS))
    unknown = np.full(source.raster.shape, np.nan)
    passes = columns["passes"][decided].astype(float)
    return (
        BufferTrack("primitive", start.primitive, drawn, place[drawn], triangle[drawn], "ids", True),
        BufferTrack("depth", start.depth, drawn, place[drawn], columns["stored"][drawn], starts_known=True),
        BufferTrack("passes", unknown, decided, place[decided], passes, "flags"),
    )


def _listings() -> dict[str, Listing]:
    of_rows, compared, hit = listing(draw_rows), listing(hit_is_nearer), listing(hit_value)
    return (
        {kind: of_rows for kind in KINDS if kind.startswith(("scan-", "layers-"))}
        | {"layer-pixel": of_rows}
        | dict.fromkeys(_COMPARED, compared)
        | {f"{kind}.{name}": hit for kind in _COMPARED for name in ("hit", "bound")}
        | {"out-of-range": listing(depth_in_range)}
    )
