"""The listings of bins, fills and spans, executed on the rows."""

import numpy as np

from core.coverage.binning import block_verdict
from core.coverage.edges import covers
from core.coverage.fills import increments, step_covers
from core.coverage.scanline import draw_triangle, drawn_columns, round_half_up, span
from core.coverage.traced_edges import bounding_box, outer_box
from core.coverage.traced_rows import PRINTED
from core.spans.fill import order_of_pixels, place_by_size, rows_of_triangle, span_of_row
from core.spans.lanes import tie_owners
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from tests.core.trace.executed_rows import ROW_LIMIT, check_marks, equal, lines_that_run, rows_of_kind
from tests.core.trace.geometry_listings import coefficients_of


def check_bin(traced: Trace) -> None:
    found = traced.stage("bin")
    c, edges, raster = found.columns, traced.source.geometry.edges, traced.source.raster
    for row in rows_of_kind(found, "outer-box"):
        box = outer_box(*c["corners"][row].T, raster.center, raster.bounds)
        kept = tuple(int(c[name][row]) for name in ("column", "row", "column_end", "row_end"))
        if kept[2] > kept[0] and kept[3] > kept[1]:
            assert box == kept
    for row in rows_of_kind(found, "box"):
        box = bounding_box(*c["corners"][row].T, raster.center, raster.bounds)
        kept = tuple(int(c[name][row]) for name in ("column", "row", "column_end", "row_end"))
        is_empty = box[2] <= box[0] or box[3] <= box[1]
        if kept[2] > kept[0] and kept[3] > kept[1]:
            assert box == kept
        else:
            corners = c["corners"][row]
            first, second = corners[1] - corners[0], corners[2] - corners[0]
            assert is_empty or first[0] * second[1] == first[1] * second[0]
    blocks = found.extra["blocks"]
    for row in rows_of_kind(found, "block"):
        node = c["node"][row]
        left, bottom = c["column"][row] + raster.center, c["row"][row] + raster.center
        size = c["size"][row] - 1
        sides = coefficients_of(edges, blocks.triangle[node])
        corners = np.array([left, bottom, left + size, bottom + size])
        with np.errstate(all="ignore"):
            verdict = block_verdict(sides, *edges.numbers.of_pixels(corners))
        assert verdict == str(c["verdict"][row]).replace("leaf", "split")


def check_raster(traced: Trace) -> None:
    found = traced.stage("raster")
    c, edges, raster = found.columns, traced.source.geometry.edges, traced.source.raster
    numbers, p = edges.numbers, c["primitive"]
    for kind in ("test", "accept"):
        for row in rows_of_kind(found, kind):
            x, y = c["column"][row] + raster.center, c["row"][row] + raster.center
            held_x, held_y = (numbers.of_pixels(np.array([place]))[0] for place in (x, y))
            slopes = (edges.a[p[row]], edges.b[p[row]], edges.c[p[row]])
            with np.errstate(all="ignore"):
                values, inside = covers(*slopes, c["owns_tie"][row], held_x, held_y)
            shown = numbers.shown_values(np.array(values, numbers.held_as))
            assert equal(shown, c["values"][row])
            assert (x, y) == (c["x"][row], c["y"][row])
            # A block that is taken as a whole is trusted, whatever the numbers say of its pixels.
            if traced.source.fill != "scanline-lecture" and (kind == "test" or numbers.suits_spans):
                assert inside == c["covered"][row]
    check_steps(found, edges)
    boxes = found.extra["boxes"]
    for row in rows_of_kind(found, "span"):
        primitive = c["primitive"][row]
        y = c["row"][row] + raster.center
        first, end = int(boxes.column[primitive]), int(boxes.column_end[primitive])
        with np.errstate(all="ignore"):
            columns = span(coefficients_of(edges, primitive), y, first, end, raster.center)
        assert columns == list(range(c["start"][row], c["stop"][row]))
    check_printed_lines(found, edges, raster)
    if found.extra.get("span_order") is not None:
        check_spans(traced)


def check_steps(found: StageTrace, edges) -> None:
    """Execute the listing of the fill ``incremental``."""
    c, numbers = found.columns, edges.numbers
    if "before_0" not in c or numbers.name in ("exact", "int64"):
        return
    before = np.stack([c[f"before_{k}"] for k in range(3)], axis=1)
    for kind, slope in (("step", edges.a), ("climb", edges.b)):
        for row in rows_of_kind(found, kind):
            held = np.ldexp(before[row], -numbers.value_exponent).astype(numbers.held_as)
            with np.errstate(all="ignore"):
                added = increments(numbers, slope[c["primitive"][row]])
                values, inside = step_covers(list(held), list(added), c["owns_tie"][row])
            assert equal(numbers.shown_values(np.array(values, numbers.held_as)), c["values"][row])
            assert inside == c["covered"][row]


def check_spans(traced: Trace) -> None:
    """Execute the listings of the fill ``spans``: of lanes, of rows, and of the passes over all pixels."""
    found = traced.stage("raster")
    c, order = found.columns, found.extra["span_order"]
    raster, corners = traced.source.raster, traced.source.geometry.edges.corners.decided
    first_column, first_row, end_column, end_row = raster.bounds
    owners = tie_owners(traced.source.settings.fill_rule)
    for row in rows_of_kind(found, "lane"):
        rows = rows_of_triangle(
            c["corner_y"][row].tolist(), raster.center, (first_row, end_row), owners.bottom, owners.top
        )
        assert rows == (c["first_row"][row], c["row_count"][row])
        assert c["lane"][row] == place_by_size(order.row_count.tolist(), c["primitive"][row])

    # Rows of pixels, in the order in which the engine walks: level by level, lane by lane.
    rows = np.flatnonzero(found.steps.kind == found.steps.kinds.index("lane-row"))
    walked = rows[np.lexsort((c["lane"][rows], c["level"][rows]))]
    lengths = c["length"][walked].tolist()
    for number, row in list(enumerate(walked.tolist()))[:: max(len(walked) // ROW_LIMIT, 1)]:
        ends = corners[c["primitive"][row]]
        sides = []
        for k in range(3):
            start, end = ends[(k + 1) % 3], ends[(k + 2) % 3]
            if traced.source.geometry.edges.doubled_area[c["primitive"][row]] < 0:
                start, end = end, start
            sides.append((*start.tolist(), *end.tolist(), bool(c["owns_tie"][row][k])))
            dx, dy = c["dx"][row][k], c["dy"][row][k]
            assert (dx, dy) == tuple(end - start)
            assert c[f"numerator_{k}"][row] == (start[0] - raster.center) * dy + (c["y"][row] - start[1]) * dx
        with lines_that_run() as ran:
            span = span_of_row(sides, c["y"][row], first_column, end_column, raster.center)
            place = place_by_size(lengths, number)
        check_marks(found, row, ran)
        assert span == (c["start"][row], c["stop"][row])
        assert c["place"][row] == (place if lengths[number] else -1)

    spans = rows[c["length"][rows] > 0]
    spans = spans[np.argsort(c["place"][spans])]
    with lines_that_run() as ran:
        drawn = order_of_pixels([(int(c["row"][r]), int(c["start"][r]), int(c["stop"][r])) for r in spans])
    pixels = np.flatnonzero(found.steps.kind == found.steps.kinds.index("pass"))
    for row in pixels[:3].tolist():
        check_marks(found, row, ran)
    pixels = pixels[np.argsort(c["rank"][pixels])]
    assert drawn == [tuple(pixel) for pixel in found.pixel[pixels].tolist()]


def check_printed_lines(found: StageTrace, edges, raster) -> None:
    lines = np.flatnonzero(np.isin(found.steps.kind, [found.steps.kinds.index(kind) for kind in PRINTED]))
    c, (first_column, _, end_column, _) = found.columns, raster.bounds
    for row in lines[:: max(len(lines) // ROW_LIMIT, 1)].tolist():
        columns = drawn_columns(c["crossing_0"][row], c["crossing_1"][row])
        columns = [column for column in columns if first_column <= column < end_column]
        assert columns == list(range(c["start"][row], c["stop"][row]))
        assert np.isnan(c["crossing_before_0"][row]) == found.kind_of(row).endswith("first")
    for primitive in np.unique(c["primitive"][lines]).tolist():
        corners = round_half_up(edges.corners.window[primitive] - raster.center)
        with lines_that_run() as ran:
            printed = draw_triangle(*(tuple(corner) for corner in corners.tolist()), raster.height)
        _, first_row, _, end_row = raster.bounds
        wanted = [line for line in printed if first_row <= line[0] < end_row]
        own = lines[c["primitive"][lines] == primitive]
        for row in own[:: max(len(own) // 4, 1)].tolist():
            check_marks(found, row, ran)
        assert [(c["row"][row], c["crossing_0"][row], c["crossing_1"][row]) for row in own] == wanted
