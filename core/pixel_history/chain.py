"""The links of a triangle's chain up to the raster: transformed, culled, clipped, binned, covered or not."""

from typing import Any

import numpy as np

from core.clipping.sutherland_hodgman import Clipped
from core.coverage.active_edges import edge_table, find_crossings
from core.coverage.edges import EdgeFunctions
from core.coverage.pixel_runs import INSIDE, MIXED, OUTSIDE, Boxes
from core.coverage.snapping import SUBPIXELS, place_corners
from core.culling.culling import PLANES, REASONS, plane_distances
from core.pixel_history.candidates import EdgeTests, PixelCandidates, examine_edges
from core.pixel_history.fragments import Link
from core.pixel_history.pieces import piece_number
from core.records.arrays import Floats, Integers
from core.records.primitives import Rings
from core.resolved import resolve


def vertex_link(candidates: PixelCandidates, triangle: int) -> Link:
    """Return where the corners of a triangle are: in front of the eye, behind it, or on both sides."""
    clip = candidates.geometry.assembled.clip[triangle : triangle + 1]
    corners = place_corners(clip, candidates.scene.size, candidates.settings.coverage)
    w = clip[0, :, 3]
    behind = tuple(int(k) for k in np.flatnonzero(w <= 0))
    key = "in-front" if not behind else "behind-eye" if len(behind) == 3 else "crosses-eye"
    return Link("transform", key, {"w": w, "window": corners.window[0], "behind": behind})


def cull_link(candidates: PixelCandidates, triangle: int, tests: dict[str, Any] | None = None) -> Link:
    """Return the verdict of culling; ``tests``: what the inside test says of a culled triangle."""
    culled = candidates.geometry.culled
    plane = int(culled.plane[triangle])
    values: dict[str, Any] = {
        "facing": float(culled.side[triangle]),
        "plane": PLANES[plane] if plane >= 0 else "none",
        "plane_distances": culled.distances[triangle, :, plane] if plane >= 0 else None,
    }
    if culled.objects is not None:
        values["node"] = int(culled.objects.dropped_in[culled.assembled.triangle[triangle]])
    return Link("cull", REASONS[int(culled.verdict[triangle])], values | (tests or {}))


def clip_link(candidates: PixelCandidates, triangle: int, primitive: int = -1) -> Link:
    """Return what clipping did: which corners lie outside which planes, and how many corners are left."""
    geometry = candidates.geometry
    clipped = geometry.clipped
    cut = {"tree_piece": piece_number(geometry, primitive) if primitive >= 0 else 0}
    is_spared = geometry.clipping_inserted and (geometry.assembled.clip[triangle, :, 3] > 0).all()
    if clipped is None or is_spared:
        return Link("clip", "no-clipping", cut)
    place, piece = int(np.flatnonzero(geometry.kept.triangle == triangle)[0]), -1
    if primitive >= 0:
        place = int(geometry.kept_of_primitive[primitive])
        piece = primitive - int(np.searchsorted(geometry.kept_of_primitive, place))
    distances = plane_distances(geometry.kept.clip_of(np.array([place])))[0]
    outside = tuple(
        (PLANES[plane], tuple(int(k) for k in np.flatnonzero(distances[:, plane] < 0)))
        for plane in clipped.planes
        if (distances[:, plane] < 0).any()
    )
    which = np.flatnonzero(clipped.clipped == place)
    count = int(clipped.counts[-1][which[0]]) if len(which) else 3
    values = {
        "outside": outside,
        "corner_count": count,
        "piece": piece,
        "piece_count": max(count - 2, 0),
        "inserted_for": geometry.clipping_inserted,
        "division": _division(clipped, which, geometry.assembled.clip[triangle, :, 3]),
        **cut,
    }
    key = "inside" if not len(which) else "clipped-away" if count < 3 else "clipped"
    return Link("clip", key, values)


def _division(clipped: Clipped, which: Integers, w: Floats) -> str:
    """Return what dividing corners with ``w`` (3,) before clipping did: ``mirrored``, ``undefined``, or nothing.

    ``which`` (0 or 1,) is the triangle's place among those that were clipped.
    """
    if not clipped.is_divided or not len(which):
        return ""
    if not clipped.counts[0][which[0]]:
        return "undefined"
    return "mirrored" if (w < 0).any() else ""


def undrawn_values(candidates: PixelCandidates, triangle: int) -> dict[str, Any]:
    """Return what the inside test says of a triangle that was culled or clipped away.

    ``would_cover``: whether it would have had a fragment here.
    """
    vertices = candidates.geometry.vertices
    if vertices.rings is not None:
        link = polygon_link(candidates, vertices.rings_of(np.array([triangle])), 0)
        return dict(link.values) | {"would_cover": link.key == "in-polygon"}
    edges = candidates.unclipped(np.array([triangle]))
    tests = examine_edges(edges, *candidates.center)
    values = edge_values(edges, tests, 0)
    is_in_front = bool((edges.corners.homogeneous[..., 2] > 0).any())
    return values | {
        "fill_rule": candidates.settings.fill_rule,
        "would_cover": is_in_front and values["doubled_area"] != 0 and bool(values["inside"].all()),
    }


def edge_values(edges: EdgeFunctions, tests: EdgeTests, k: int) -> dict[str, Any]:
    """Return the numbers of the inside test of primitive ``k``, and those of its worst edge apart.

    Notes
    -----
    ``distance`` is signed, positive inside, in pixels; ``subpixels`` the same in 1/256 pixel; ``ulps`` the
    value in units in the last place of its largest term. The value of an edge with a snapped end is exact.
    ``is_edited``: an edited inside test decides, whatever the sides of the edges are.
    """
    distance, inside = tests.distance[k], tests.inside[k]
    failing = ~inside if not inside.all() else np.ones(3, bool)
    edge = int(np.argmin(np.where(failing, np.nan_to_num(distance, nan=-np.inf), np.inf)))
    is_anchored = edges.corners.is_projected[k, [(edge + 1) % 3, (edge + 2) % 3]].any()
    return {
        "values": tests.values[k],
        "distances": distance,
        "inside": inside,
        "ties": tests.values[k] == 0,
        "owns_tie": edges.owns_tie[k],
        "a": edges.shown_a[k],
        "b": edges.shown_b[k],
        "edge": edge,
        "value": float(tests.values[k, edge]),
        "distance": float(distance[edge]),
        "subpixels": float(distance[edge] * SUBPIXELS),
        "ulps": float(tests.ulps[k, edge]),
        "is_exact": bool(is_anchored) or edges.numbers.is_whole,
        "doubled_area": float(edges.doubled_area[k]),
        "is_edited": edges.rule is not None,
    }


def raster_links(candidates: PixelCandidates, k: int) -> list[Link]:
    """Return how candidate ``k`` fared in binning and at the pixel: covered, or where it was left out.

    A wireframe has no bins; its fragments have `outline_link`.
    """
    values = edge_values(candidates.edges, candidates.edge_tests, k)
    box = tuple(int(getattr(candidates.boxes, name)[k]) for name in Boxes._fields[1:])
    values |= {"box": box, "fill_rule": candidates.settings.fill_rule}
    if candidates.geometry.polygons is not None:
        return [polygon_link(candidates, candidates.geometry.polygons, k)]
    if candidates.geometry.outlines is not None:
        return [missed_outline(candidates, k, values)]
    if values["doubled_area"] == 0:
        return [Link("bin", "no-area", values)]
    whole = candidates.boxes.case[k] == MIXED
    bin_key = "whole-image" if whole else "in-box"
    block = _block_of(candidates, k)
    if not whole and not _contains(box, candidates.column, candidates.row):
        bin_key = "outside-box"
    if block:
        values |= block
        if block["block_verdict"] == OUTSIDE:
            bin_key = "outside-block"
        elif block["block_verdict"] == INSIDE:
            bin_key = "inside-block"
    binned = Link("bin", bin_key, values)
    covers = bool((candidates.covering == k).any())
    if covers:
        accepted = bool(candidates.pixel_tests.accepted[candidates.pixel_tests.primitive == k].any())
        tie = bool(values["ties"].any() and values["inside"].all())
        key = "accepted" if accepted else "covered-on-edge" if tie else "covered"
        return [binned, Link("raster", key, values | _span_of(candidates, k))]
    if bin_key == "outside-block" or (bin_key == "outside-box" and not candidates.rounds_corners):
        return [binned]
    return [binned, Link("raster", *_missed(candidates, k, values))]


def _missed(candidates: PixelCandidates, k: int, values: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """Return the key and the numbers of a pixel that the raster looked at and left out."""
    if candidates.rounds_corners:
        span = _span_of(candidates, k)
        return ("outside-span" if span else "row-not-drawn"), values | span
    failing = values["values"][~values["inside"]]
    if np.isnan(failing).any():
        return "undefined", values
    values = values | _span_of(candidates, k)
    return ("missed-edge" if (failing < 0).any() else "tie-not-owned"), values


def _contains(box: tuple[int, ...], column: int, row: int) -> bool:
    return box[0] <= column < box[2] and box[1] <= row < box[3]


def _block_of(candidates: PixelCandidates, k: int) -> dict[str, Any]:
    """Return the smallest block around the pixel that was looked at for candidate ``k``; empty: none."""
    blocks = candidates.runs.blocks
    if blocks is None:
        return {}
    nodes: Integers = np.flatnonzero(blocks.triangle == k)
    if not len(nodes):
        return {}
    node = int(nodes[-1])
    size = int(blocks.size[node])
    return {
        "block": (int(blocks.column[node]) // size, int(blocks.row[node]) // size),
        "block_size": size,
        "block_verdict": int(blocks.verdict[node]),
        "rejected_by": int(blocks.rejected_by[node]),
        "low": blocks.low[node],
        "high": blocks.high[node],
    }


def _span_of(candidates: PixelCandidates, k: int) -> dict[str, Any]:
    """Return the span of candidate ``k`` in the pixel's row (scanline fills); empty: none."""
    if candidates.runs.crossings is None:
        return {}
    runs = candidates.row_runs
    spans = np.flatnonzero((runs.triangle == k) & (runs.stop > runs.start))
    if not len(spans):
        return {}
    # Of several spans (pieces of a printed fill) the one nearest to the pixel.
    away = np.maximum(runs.start[spans] - candidates.column, candidates.column - runs.stop[spans] + 1)
    span = int(spans[np.argmin(away)])
    return {"start": int(runs.start[span]), "stop": int(runs.stop[span])}


def polygon_link(candidates: PixelCandidates, rings: Rings, k: int) -> Link:
    """Return what a row crosses of polygon ``k`` of ``rings`` up to the pixel's centre, and which edge is nearest."""
    table = edge_table(rings, candidates.raster)
    found = find_crossings(table, resolve(candidates.settings).polygon_fill)
    to_left = np.flatnonzero((table.polygon[found.edge] == k) & (found.column <= candidates.column))
    crossed, winding, is_inside = 0, 0, False
    if len(to_left):
        last = to_left[-1]
        crossed = int(found.crossed[last])
        winding = int(found.winding[last])
        is_inside = bool(found.is_inside[last])
    own = np.flatnonzero(rings.polygon_of_corner == k)
    if not len(own):
        return Link("raster", "clipped-polygon", {"distance": float("nan")})
    sides = np.stack([rings.corners[own], rings.corners[rings.following[own]]], axis=1)
    away = distance_to_segments(sides, *candidates.center)
    edge = int(np.argmin(away))
    values = {"crossed": crossed, "winding": winding, "edge": edge, "rule": candidates.settings.polygon_fill}
    distance = float(away[edge]) if is_inside else -float(away[edge])
    return Link("raster", "in-polygon" if is_inside else "outside-polygon", values | {"distance": distance})


def outline_link(candidates: PixelCandidates, place: int) -> Link:
    """Return which edge the fragment ``place`` lies on, and how far its centre is from the exact line."""
    (fragments, steps), outlines = candidates.lines, candidates.geometry.outlines
    assert outlines is not None
    segment = int(fragments.segment[place])
    away = float(distance_to_segments(outlines.window[segment : segment + 1], *candidates.center)[0])
    values = {
        "edge": int(outlines.edge[segment]),
        "distance": away,
        "segment": segment,
        "line": candidates.settings.line,
        "is_point": candidates.scene.corner_count == 1,
        "decision": float(steps.decision[place]),
        "has_stepped": bool(steps.has_stepped[place]),
    }
    return Link("raster", "on-outline", values)


def missed_outline(candidates: PixelCandidates, k: int, values: dict[str, Any]) -> Link:
    """Return the nearest edge of candidate ``k``, which is not drawn at this pixel."""
    outlines = candidates.geometry.outlines
    assert outlines is not None
    segments = np.flatnonzero(outlines.primitive == candidates.primitive[k])
    if not len(segments):
        return Link("raster", "no-outline", values)
    away = distance_to_segments(outlines.window[segments], *candidates.center)
    nearest = int(np.argmin(away))
    edge = int(outlines.edge[segments[nearest]])
    return Link("raster", "off-outline", values | {"edge": edge, "distance": -float(away[nearest])})


def distance_to_segments(window: Floats, x: float, y: float) -> Floats:
    """Return the distance (L,) of a point from segments (L, 2, 2), in pixels."""
    start, along = window[:, 0], window[:, 1] - window[:, 0]
    offset = np.array([x, y]) - start
    squared = along[:, 0] * along[:, 0] + along[:, 1] * along[:, 1]
    product = offset[:, 0] * along[:, 0] + offset[:, 1] * along[:, 1]
    t = np.clip(product / np.where(squared > 0, squared, 1.0), 0.0, 1.0)
    rest = offset - t[:, None] * along
    return np.asarray(np.hypot(rest[:, 0], rest[:, 1]))
