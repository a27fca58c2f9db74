"""The listings of transformation, culling, clipping and edge functions, executed on the rows."""

import numpy as np

from core.clipping.planes import divide_corner
from core.clipping.sutherland_hodgman import clip_edge, clip_edge_in_order
from core.coverage.edge_formats import inverse_coefficients, rounded_corner
from core.coverage.edges import edge_coefficients, edge_value
from core.coverage.snapping import anchored_coefficients, edge_left_out, snap_one
from core.culling.culling import cull_verdict
from core.culling.object_culling import box_against_planes
from core.culling.occlusion import box_behind_occluders, coarser_level, largest_boxes
from core.culling.traced import WITH_BOX
from core.methods import table
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from core.transform.matrices import transform_component
from core.transform.traced import divide_and_map
from tests.core.trace.executed_rows import check_marks, equal, lines_that_run, rows_of_kind


def check_transform(traced: Trace) -> None:
    found = traced.stage("transform")
    c = found.columns
    for kind in ("object-to-world", "world-to-camera", "camera-to-clip"):
        for row in rows_of_kind(found, kind):
            after = [transform_component(line, c["before"][row]) for line in c["matrix"][row]]
            assert equal(after, c["after"][row])
    width, height = traced.source.scene.size
    for row in rows_of_kind(found, "viewport"):
        clip = c["before"][row - 1]
        if clip[3] != 0:
            assert equal(clip[:3] / clip[3], c["after"][row - 1][:3])
            assert equal(divide_and_map(clip, width, height), c["after"][row][:3])


def check_cull(traced: Trace) -> None:
    found = traced.stage("cull")
    assembled = traced.source.geometry.assembled
    drops = {"none": lambda f: False, "back": lambda f: f < 0, "front": lambda f: f > 0}
    _check_boxes(found)
    _check_occlusion(found)
    ends = found.steps.triangle_ends
    starts = [0, *ends[:-1].tolist()]
    if found.triangle[0] < 0:
        starts, ends = starts[1:], ends[1:]
    for triangle, start, row in zip(assembled.triangle.tolist(), starts, (ends - 1).tolist(), strict=True):
        facing = found.columns["facing"][row]
        if found.kind_of(row) in WITH_BOX:
            continue
        # Culling by N . V goes by its own side, where there is one.
        seen = -found.columns["product"][row] if "product" in found.columns else facing
        dropped = drops.get(traced.source.settings.cull, drops["back"])(seen)
        clip = assembled.clip[np.flatnonzero(assembled.triangle == triangle)[0]]
        with lines_that_run() as ran:
            verdict = cull_verdict(clip, seen if seen and facing else facing, dropped)
        assert verdict == found.columns["verdict"][row]
        for tested in range(start, row + 1):
            check_marks(found, tested, ran)


def _check_boxes(found: StageTrace) -> None:
    """Run the listing of a box on all planes that each visit has asked."""
    asked = np.flatnonzero(np.isin(found.steps.kind, kinds_named(found, "box-outside", "box-plane")))
    if not len(asked):
        return
    c, objects = found.columns, found.extra["culled"].objects
    equations = objects.planes.coefficients.tolist()
    for visit, node in enumerate(objects.visited.tolist()):
        rows = asked[objects.visit == visit]
        planes = objects.plane[objects.visit == visit].tolist()
        slack = objects.sides.slack[node].tolist()
        box = objects.tree.lower[node].tolist(), objects.tree.upper[node].tolist()
        with lines_that_run() as ran:
            verdict, crossed = box_against_planes(*box, equations, slack, planes)
        assert verdict == c["box_verdict"][rows[-1]]
        assert len(crossed) == (0 if verdict == "outside" else np.count_nonzero(c["is_crossed"][rows]))
        for row in rows:
            check_marks(found, row, ran)


def _check_occlusion(found: StageTrace) -> None:
    """Run the listings of occluders, levels and compared boxes on their rows."""
    culled = found.extra["culled"]
    if (
        culled.objects is None
        or culled.objects.occlusion is None
        or not len(culled.objects.occlusion.occluders)
    ):
        return
    occlusion, c = culled.objects.occlusion, found.columns
    boxes, tests = occlusion.boxes, occlusion.tests
    nearer, farther = (max, min) if occlusion.larger_is_nearer else (min, max)
    pyramid = [level.tolist() for level in tests.pyramid]
    on_screen = np.flatnonzero(~boxes.is_before)
    for row in rows_of_kind(found, "occluder"):
        chosen = largest_boxes(boxes.rectangle[on_screen].tolist(), len(occlusion.occluders))
        assert on_screen[chosen].tolist() == occlusion.occluders.tolist()
        left, low, right, high = c["box_rectangle"][row].tolist()
        assert c["box_pixels"][row] == len(range(left, right + 1)) * len(range(low, high + 1))
    for row in rows_of_kind(found, "pyramid-level"):
        level = int(c["made_level"][row])
        assert coarser_level(pyramid[level - 1], farther) == pyramid[level]
        assert c["keeps_farthest"][row]
    for kind in ("near-box", "seen-box", "hidden-box"):
        for row in rows_of_kind(found, kind):
            box = int(c["compared"][row])
            is_before, slack = bool(boxes.is_before[box]), float(boxes.slack[box])
            given = boxes.corners[box].tolist(), is_before, boxes.reach, slack, pyramid, nearer, farther
            assert box_behind_occluders(*given) == (kind == "hidden-box") == c["is_hidden"][row]


def kinds_named(found: StageTrace, *names: str) -> list[int]:
    return [k for k, kind in enumerate(found.steps.kinds) if kind in names]


def check_clip(traced: Trace) -> None:
    found = traced.stage("clip")
    c = found.columns
    in_order = traced.source.settings.clipping == "sutherland-hodgman-lecture"
    in_order = in_order and not traced.source.geometry.clipping_inserted
    listed = clip_edge_in_order if in_order else clip_edge
    for kind in ("in-in", "in-out", "out-in", "out-out"):
        for row in rows_of_kind(found, kind):
            corners = listed(c["start"][row], c["end"][row], c["start_distance"][row], c["end_distance"][row])
            wanted = {"in-in": [c["end"][row]], "out-out": [], "in-out": [c["corner"][row]]}
            assert equal(corners, wanted.get(kind, [c["corner"][row], c["end"][row]]))
    for kind in {"divided", "mirrored"} & set(found.steps.kinds):
        for row in rows_of_kind(found, kind):
            assert divide_corner(*c["clip"][row].tolist()) == tuple(c["ndc"][row])
            assert (c["clip"][row][3] > 0) == (kind == "divided")


def check_edges(traced: Trace) -> None:
    found = traced.stage("edges")
    c = found.columns
    for row in rows_of_kind(found, "snapped"):
        assert [snap_one(value) for value in c["window"][row]] == c["snapped"][row].tolist()
    edges, primitive = (
        traced.source.geometry.edges,
        np.repeat(np.arange(len(traced.source.geometry.edges)), 7),
    )
    numbers, ends = edges.numbers, edges.numbers.held_corners(edges.corners)
    shown = (edges.shown_a, edges.shown_b, edges.shown_c)
    for row in rows_of_kind(found, "edge"):
        p, k = primitive[row], c["edge"][row]
        if numbers.suits_spans:
            start, finish = c["start"][row], c["finish"][row]
        else:
            start, finish = ([held[corner, p] for held in ends] for corner in ((k + 1) % 3, (k + 2) % 3))
        with np.errstate(all="ignore"):
            sign = np.array(np.sign(c["doubled_area"][row])).astype(numbers.held_as)[()]
            sign = int(sign) if numbers.name == "exact" else sign
            coefficients = edge_coefficients(*start, *finish, sign)
        assert equal(
            np.array(coefficients, float), np.array((edges.a[p, k], edges.b[p, k], edges.c[p, k]), float)
        )
        assert equal([of[p, k] for of in shown], (c["a"][row], c["b"][row], c["c"][row]))
        rule = table.get("fill_rule", traced.source.settings.fill_rule).listing
        assert rule(c["a"][row], c["b"][row]) == c["owns_tie"][row]
    for row in rows_of_kind(found, "rounded"):
        with np.errstate(over="ignore"):
            rounded = rounded_corner(*c["homogeneous"][row], numbers.held_as)
        assert equal(np.array(rounded, float), c["rounded"][row])
    for row in rows_of_kind(found, "inverse-edge"):
        p, k = primitive[row], c["edge"][row]
        with np.errstate(all="ignore"):
            columns, area = inverse_coefficients([list(corner) for corner in edges.corners.homogeneous[p]])
        assert equal([line[k] for line in columns], (c["a"][row], c["b"][row], c["c"][row]))
        assert equal(area, c["doubled_area"][row])
    for row in rows_of_kind(found, "anchored-edge"):
        p, k = primitive[row], c["edge"][row]
        x, y, _ = c["start" if c["anchor"][row] > 0 else "finish"][row]
        ends = edges.corners.clip[p][[(k + 1) % 3, (k + 2) % 3]][:, [0, 1, 3]].tolist()
        coefficients = anchored_coefficients(x, y, *ends, edges.corners.size, np.sign(c["doubled_area"][row]))
        assert equal(coefficients, (c["a"][row], c["b"][row], c["c"][row]))
    for row in rows_of_kind(found, "left-out-edge"):
        p, k = primitive[row], c["edge"][row]
        values = [
            edge_value(*(of[p, corner] for of in shown), *edges.corners.decided[p, corner])
            for corner in ((k + 1) % 3, (k + 2) % 3)
        ]
        left_out = edge_left_out(*values, edges.corners.homogeneous[p, k, 2])
        assert left_out == (c["a"][row], c["b"][row], c["c"][row])


def coefficients_of(edges, primitive: int) -> list[tuple[float, float, float, bool]]:
    return [
        (edges.a[primitive, k], edges.b[primitive, k], edges.c[primitive, k], edges.owns_tie[primitive, k])
        for k in range(3)
    ]
