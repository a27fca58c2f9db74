"""The listings, executed, give the numbers of the rows bit for bit."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest
from hypothesis import given
from hypothesis import settings as effort
from hypothesis import strategies as st

from core import ClipScene, Scene, Settings, trace
from core.antialiased.exact_area import piece_sum
from core.antialiased.sample_counts import side_of
from core.fragments.corrected_affine import interpolate_corrected_at
from core.fragments.interpolation import interpolate_affine_at, interpolate_at, take_provoking_value
from core.fragments.level_of_detail import level_of_detail
from core.fragments.lighting import blinn_phong
from core.fragments.mipmap_samples import mipmap_color, nearest_mipmap_color
from core.fragments.mipmaps import mipmap_levels
from core.fragments.shading import shaded_color
from core.fragments.textures import bilinear_color, nearest_color, uses_mipmaps
from core.fragments.uv_slopes import slopes_at, slopes_of_one_value
from core.framebuffer.blending import additive_pixel, over_pixel
from core.framebuffer.depth import depth_test
from core.framebuffer.display import srgb_byte
from core.framebuffer.packed_keys import packed_depth_test, rounded_depth_test
from core.framebuffer.pixel_pieces import SQUARE
from core.framebuffer.polygon_cut import cut_polygon, polygon_area, shown_areas
from core.framebuffer.resolve import weighted_mean
from core.geometry.after_divide import divide_corner
from core.geometry.culling import cull_verdict
from core.geometry.matrices import transform_component
from core.geometry.sutherland_hodgman import clip_edge, clip_edge_in_order
from core.methods import table
from core.raster.binning import block_verdict
from core.raster.edge_functions import anchored_coefficients, covers, edge_coefficients
from core.raster.float_formats import rounded_corner
from core.raster.incremental import increments, step_covers
from core.raster.inverse_format import inverse_coefficients
from core.raster.line_slopes import affine_line_slopes_at, line_slopes_at
from core.raster.scanline import span
from core.raster.scanline_lecture import draw_triangle, round_half_up
from core.raster.snapping import snap_one
from core.raster.spans.lanes import tie_owners
from core.raster.spans.scalar import order_of_pixels, place_by_size, rows_of_triangle, span_of_row
from core.surface import viewpoint
from core.trace import TRACERS, StageTrace, Trace, TraceSource
from core.trace.binning import bounding_box, outer_box
from core.trace.sample_sources import CenterSource, finer_source, sources_of_samples
from core.trace.texture_columns import slope_kind
from core.trace.transform import divide_and_map
from core.visibility.ray_casting import hit_is_nearer
from core.visibility.ray_planes import hit_value
from tests.core.strategies import ANY_TRIANGLES
from tests.core.trace.trace_cases import CHOICES, MIXES, SCENES, name_of, settings_of, small_region

ROW_LIMIT = 150
"""Rows of a stage that are executed: all of them, or these many of them spread over the trace."""


def rows_of_kind(found: StageTrace, kind: str) -> list[int]:
    rows = np.flatnonzero(found.steps.kind == found.steps.kinds.index(kind))
    return rows[:: max(len(rows) // ROW_LIMIT, 1)].tolist()


def equal(found: object, wanted: object) -> bool:
    return np.array_equal(np.asarray(found), np.asarray(wanted), equal_nan=True)


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
    ends = found.steps.triangle_ends
    for triangle, row in zip(assembled.triangle.tolist(), (ends - 1).tolist(), strict=True):
        facing = found.columns["facing"][row]
        clip = assembled.clip[np.flatnonzero(assembled.triangle == triangle)[0]]
        verdict = cull_verdict(clip, facing, drops[traced.source.settings.cull](facing))
        assert verdict == found.columns["verdict"][row]


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
        ends = (c["start"][row], c["finish"][row])
        corner, other = ends if c["anchor"][row] > 0 else ends[::-1]
        sign = np.sign(c["doubled_area"][row]) * c["anchor"][row]
        coefficients = anchored_coefficients(*corner[:2], *other, sign)
        assert equal(coefficients, (c["a"][row], c["b"][row], c["c"][row]))


def coefficients_of(edges, primitive: int) -> list[tuple[float, float, float, bool]]:
    return [
        (edges.a[primitive, k], edges.b[primitive, k], edges.c[primitive, k], edges.owns_tie[primitive, k])
        for k in range(3)
    ]


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
        start, stop = int(boxes.column[primitive]), int(boxes.column_end[primitive])
        start, stop = span(coefficients_of(edges, primitive), y, start, stop, raster.center)
        if stop > start or c["stop"][row] > c["start"][row]:
            assert (start, stop) == (c["start"][row], c["stop"][row])
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
        span = span_of_row(sides, c["y"][row], first_column, end_column, raster.center)
        assert span == (c["start"][row], c["stop"][row])
        assert c["place"][row] == (place_by_size(lengths, number) if lengths[number] else -1)

    spans = rows[c["length"][rows] > 0]
    spans = spans[np.argsort(c["place"][spans])]
    drawn = order_of_pixels([(int(c["row"][r]), int(c["start"][r]), int(c["stop"][r])) for r in spans])
    pixels = np.flatnonzero(found.steps.kind == found.steps.kinds.index("pass"))
    pixels = pixels[np.argsort(c["rank"][pixels])]
    assert drawn == [tuple(pixel) for pixel in found.pixel[pixels].tolist()]


def check_printed_lines(found: StageTrace, edges, raster) -> None:
    lines = np.flatnonzero(found.steps.kind == found.steps.kinds.index("line"))
    c = found.columns
    for primitive in np.unique(c["primitive"][lines]).tolist():
        corners = round_half_up(edges.corners.window[primitive] - raster.center)
        printed = draw_triangle(*(tuple(corner) for corner in corners.tolist()))
        _, first_row, _, end_row = raster.bounds
        wanted = [line for line in printed if first_row <= line[0] < end_row]
        own = lines[c["primitive"][lines] == primitive]
        assert [(c["row"][row], c["crossing_0"][row], c["crossing_1"][row]) for row in own] == wanted


def check_interpolate(traced: Trace) -> None:
    found = traced.stage("interpolate")
    c, planes, settings = found.columns, traced.source.geometry.planes, traced.source.settings
    for row in rows_of_kind(found, settings.interpolation):
        p = c["primitive"][row]
        plane = planes.a[p], planes.b[p], planes.c[p]
        for k in range(c["values"].shape[1]):
            corners = c["corner_values"][row][:, k]
            with np.errstate(all="ignore"):
                if settings.interpolation == "flat":
                    provoking = 0 if settings.provoking == "first" else 2
                    weights, value = take_provoking_value(provoking, corners)
                elif settings.interpolation == "affine":
                    w = planes.w[p]
                    weights, total, value = interpolate_affine_at(
                        *plane, w, c["x"][row], c["y"][row], corners
                    )
                    assert equal(total, c["total"][row])
                elif settings.interpolation == "affine-n":
                    center, interval = (c["x"][row], c["y"][row]), settings.correction_interval
                    weights, value = interpolate_corrected_at(
                        *plane, planes.determinant[p], *center, interval, corners
                    )
                else:
                    weights, total, value = interpolate_at(*plane, c["x"][row], c["y"][row], corners)
                    assert equal(total, c["total"][row])
            assert equal(weights, c["weights"][row])
            assert equal(value, c["values"][row, k])


def check_shade(traced: Trace) -> None:
    found = traced.stage("shade")
    source, c = traced.source, found.columns
    filters = {"nearest": nearest_color, "bilinear": bilinear_color}
    textures, mesh = found.extra["textures"], found.extra["mesh"]
    values, layout = source.interpolated[1], source.geometry.primitives.layout
    for kind in ("textured", "textured-lit"):
        for row in rows_of_kind(found, kind):
            pixels = textures[mesh[row]].pixels.astype(np.float64).tolist()
            u, v = values[row, layout["uv"]].tolist()
            if uses_mipmaps(source.settings.texture_filter):
                color = check_mipmaps(traced, found, row)
            else:
                color = filters[source.settings.texture_filter](pixels, u, v, source.settings.wrap)
            assert equal(color, c["texture_color"][row][: len(color)])
            assert c["texture_color"][row][3] == 1 or len(color) == 4
    for kind in ("lit", "textured-lit"):
        for row in rows_of_kind(found, kind):
            color = shaded_color(c["albedo"][row], c["diffuse_light"][row], c["specular_light"][row])
            assert equal(color, c["color"][row])
    for kind in ("plain", "textured"):
        rows = rows_of_kind(found, kind)
        assert equal(c["albedo"][rows], c["color"][rows])
    if "normal" in layout:
        check_light(traced, found)


def slopes_of(traced: Trace, c, row: int):
    """Return what the listing of the slopes gives for a row."""
    kind, uv = slope_kind(traced.source), c["uv"][row].tolist()
    if kind == "flat":
        return slopes_of_one_value()
    if kind == "area":
        rises = (c[name][row] for name in ("slope_a", "slope_b", "slope_n"))
        return slopes_at(*rises, *uv, *c["corner_uv"][row].T)
    ends, length = c["end_uv"][row], c["length"][row]
    if kind == "affine-line":
        slope = affine_line_slopes_at(length, *ends)
    else:
        _, slope = line_slopes_at(c["t"][row], *c["end_w"][row], length, *ends)
    none = [0.0, 0.0]
    return [*none, *slope] if c["is_steep"][row] else [*slope, *none]


def check_mipmaps(traced: Trace, found: StageTrace, row: int) -> tuple[float, ...]:
    """Execute the listings of slopes and level of detail; return what that of the filter gives."""
    settings, c = traced.source.settings, found.columns
    texture = found.extra["textures"][found.extra["mesh"][row]]
    with np.errstate(all="ignore"):
        slopes = slopes_of(traced, c, row)
        assert equal(slopes, c["uv_slopes"][row])
        *lengths, lod = level_of_detail(*map(float, slopes), *c["texture_size"][row].tolist())
    assert equal(lengths, c["lengths"][row])
    assert equal(lod, c["lod"][row])
    levels = [level.pixels.astype(np.float64).tolist() for level in mipmap_levels(texture)]
    mix = {"trilinear": mipmap_color, "mipmap-nearest": nearest_mipmap_color}[settings.texture_filter]
    for name, number in zip(("near", "far"), c["levels"][row].tolist(), strict=True):
        if name == "near" or settings.texture_filter == "trilinear":
            color = bilinear_color(levels[number], *c["uv"][row].tolist(), settings.wrap)
            assert equal(color, c[f"{name}_color"][row][: len(color)])
    return mix(levels, *c["uv"][row].tolist(), lod, settings.wrap)


def check_light(traced: Trace, found: StageTrace) -> None:
    source, scene = traced.source, traced.source.scene
    assert isinstance(scene, Scene)
    values, layout = source.interpolated[1], source.geometry.primitives.layout
    for row in range(0, found.steps.row_count, max(found.steps.row_count // 40, 1)):
        position = values[row : row + 1, layout["position"]]
        eye = np.broadcast_to(viewpoint(scene.camera, position), (1, 3))[0]
        normal = values[row, layout["normal"]]
        material = scene.meshes[found.extra["mesh"][row]].material
        lights = blinn_phong(
            tuple(position[0].tolist()),
            tuple(normal.tolist()),
            tuple(eye.tolist()),
            scene.lights,
            material,
            False,
        )
        assert equal(lights[0], found.columns["diffuse_light"][row])
        assert equal(lights[1], found.columns["specular_light"][row])


def check_rays(traced: Trace) -> None:
    found, planes = traced.stage("depth"), traced.source.geometry.ray_planes
    c, (width, height) = found.columns, traced.source.scene.size
    for kind, has_nearest in (("ray-first", False), ("ray", True), ("ray-exact", True)):
        for row in rows_of_kind(found, kind):
            (triangle, nearest), ray = (
                (found.triangle[row], c["nearest"][row]),
                (int(c["m"][row]), int(c["n"][row])),
            )
            plane = [float(c[name][row]) for name in "abcd"]
            hit = hit_value(plane, c["sizes"][row].tolist(), *ray, width, height)
            assert hit == (c["nearness"][row], c["error"][row])
            corners = planes.clip[nearest].tolist() if has_nearest else None
            before = c["nearest_nearness"][row], c["nearest_error"][row]
            xy = (ray[0], width), (ray[1], height)
            assert (
                hit_is_nearer(*hit, planes.clip[triangle].tolist(), *before, corners, *xy, planes.by_w)
                == (c["passes"][row])
            )


def check_depth(traced: Trace) -> None:
    found = traced.stage("depth")
    c = found.columns
    if traced.source.geometry.casts_rays:
        check_rays(traced)
        return
    # The printed fill draws pixels outside the triangle, where its plane leaves the range of keys.
    if "key" in c and traced.source.settings.fill != "scanline-lecture":
        check_keys(found)
    for kind in ("test", "store"):
        check_stored(found, kind)
    for row in rows_of_kind(found, "test"):
        after, passes = depth_test(c["stored"][row], c["before"][row], bool(c["larger_is_nearer"][row]))
        assert passes == c["passes"][row]
        assert after == c["after"][row]
    for row in rows_of_kind(found, "out-of-range"):
        assert not c["passes"][row]
        assert isnan(c["before"][row])
        assert not 0 <= c["depth"][row] <= 1
    for row in rows_of_kind(found, "store"):
        assert c["after"][row] == c["stored"][row]
        assert c["passes"][row]


def check_stored(found: StageTrace, kind: str) -> None:
    """Execute what makes the value that the depth buffer gets."""
    c, constants = found.columns, found.constants
    making = found.listings.get(f"{kind}.value")
    rounding = found.listings.get(f"{kind}.depth")
    for row in rows_of_kind(found, kind):
        if constants["quantity"] == "logarithm":
            value = making.function(float(c["inverse_w"][row]), constants["near"], constants["far"])
            assert value == c["value"][row]
        elif making is not None:
            names = ("t",) if "t" in c else ("a", "b", "c", "x", "y")
            ends = c["ends"][row].tolist() if "t" in c else []
            assert making.function(*(c[name][row] for name in names), *ends) == c["value"][row]
        if making is not None:
            assert rounding.function(c["value"][row]) == c["stored"][row]
        elif rounding is not None:
            assert rounding.function(float(c["depth"][row]), constants["scale"]) == c["stored"][row]


def check_keys(found: StageTrace) -> None:
    """Execute the depth test on packed keys."""
    c = {name: column.tolist() for name, column in found.columns.items()}
    for row in rows_of_kind(found, "test"):
        plane = [c[name][row] for name in ("origin", "across", "up", "column", "row", "number")]
        assert packed_depth_test(*plane, c["before_key"][row]) == (c["after_key"][row], c["passes"][row])
    for row in rows_of_kind(found, "rounded"):
        after, passes = rounded_depth_test(c["depth"][row], c["number"][row], c["before_key"][row])
        assert (after, passes) == (c["after_key"][row], c["passes"][row])


def check_blend(traced: Trace) -> None:
    found = traced.stage("blend")
    c = found.columns
    for row in rows_of_kind(found, traced.source.settings.blend):
        scalar = {"over": over_pixel, "additive": additive_pixel}.get(traced.source.settings.blend)
        if scalar is not None:
            assert equal(scalar(c["source"][row], c["before"][row]), c["after"][row])
        else:
            assert equal(c["source"][row].astype(np.float32), c["after"][row])


def check_resolve(traced: Trace) -> None:
    found = traced.stage("resolve")
    rules = {"average": weighted_mean, "areas": piece_sum}
    for kind in found.steps.kinds:
        for row in rows_of_kind(found, kind) if kind in rules else []:
            samples, weights = found.columns["samples"][row], found.columns["sample_weights"][row]
            values = [samples[:, k].tolist() for k in range(4)]
            with np.errstate(invalid="ignore", over="ignore"):
                mixed = [rules[kind](*((v, weights) if kind == "average" else (weights, v))) for v in values]
            assert equal(mixed, found.columns["linear"][row])
    if "cut" in found.steps.kinds:
        check_cuts(found)
    for row in rows_of_kind(found, found.steps.kinds[0]):
        linear, shown = found.columns["linear"][row], found.columns["bytes"][row]
        assert [srgb_byte(float(value)) for value in linear[:3]] == shown[:3].tolist()


def check_cuts(found: StageTrace) -> None:
    """Cut the squares of pixels again, edge by edge, and measure what is left."""
    c = found.columns
    for kind in ("cut", "piece"):
        for row in rows_of_kind(found, kind):
            before, after = (
                [(float(x), float(y)) for x, y in c[name][row] if np.isfinite(x)]
                for name in ("before", "polygon")
            )
            if kind == "piece":
                assert polygon_area(after) == c["piece_area"][row]
                parts = c["part_area"][row].tolist(), c["part_primitive"][row].tolist()
                shown = shown_areas(*parts, int(c["primitive"][row]))
                assert shown == (c["seen_area"][row], c["covered_area"][row])
                continue
            if c["edge"][row] == 0:
                assert before == [tuple(corner) for corner in SQUARE.tolist()]
            else:
                previous = c["polygon"][row - 1]
                assert np.array_equal(previous, c["before"][row], equal_nan=True)
            assert cut_polygon(before, *(float(c[name][row]) for name in ("a", "b", "value"))) == after
            assert len(after) == c["corner_count"][row]


CHECKS = (
    check_transform,
    check_cull,
    check_clip,
    check_edges,
    check_bin,
    check_raster,
    check_interpolate,
    check_shade,
    check_depth,
    check_blend,
)
CENTER_CHECKS = (check_interpolate, check_shade)


class OnePart:
    """The stages of one source, as the traces of several samples are joined from."""

    def __init__(self, source: TraceSource) -> None:
        self.source = source

    def stage(self, name: str) -> StageTrace:
        return TRACERS[name](self.source)


def check_all(traced: Trace) -> None:
    """Execute the listings of all stages: of several samples, on what the rows of each were made from."""
    source = traced.source
    side = side_of(source.settings)
    check_resolve(traced)
    if side:
        parts = [(finer_source(source, side), CHECKS)]
    elif source.settings.antialiasing == "msaa-4":
        samples = sources_of_samples(source)
        of_sample = tuple(check for check in CHECKS if check not in CENTER_CHECKS)
        parts = [(sample, of_sample) for sample in samples]
        centers = CenterSource(source.scene, source.settings, source.triangle, source.region, samples=samples)
        parts.append((centers, CENTER_CHECKS))
    else:
        parts = [(replace(source, settings=replace(source.settings, antialiasing="none")), CHECKS)]
    for part, checks in parts:
        for check in checks:
            check(OnePart(part))


@pytest.mark.parametrize("choice", [*CHOICES, *MIXES], ids=name_of)
@pytest.mark.parametrize("name", ["clip", "lit", "orthographic", "textured-clip"])
def test_listings_of_all_stages(name, choice):
    scene = SCENES[name]
    traced = trace(scene, settings_of(choice, scene), region=small_region(scene))
    check_all(traced)


@pytest.mark.parametrize("name", [name for name in SCENES if name not in ("clip", "lit", "orthographic")])
@pytest.mark.parametrize("fill", ["hierarchy", "scanline", "scanline-lecture", "spans"])
def test_listings_on_the_built_in_scenes(name, fill):
    depth = "fixed-38" if fill == "spans" else "z-float32"
    traced = trace(SCENES[name], Settings(fill=fill, depth=depth), region=small_region(SCENES[name]))
    check_all(traced)


FILLS = st.sampled_from(["hierarchy", "blocks", "scanline", "scanline-lecture", "spans", "incremental"])


@effort(max_examples=60)
@given(
    ANY_TRIANGLES,
    FILLS,
    st.sampled_from(["homogeneous", "sutherland-hodgman"]),
    st.sampled_from(table.names("coverage")),
    st.sampled_from(table.names("depth")),
)
def test_listings_on_any_triangles(case, fill, clipping, coverage, depth):
    clip, size = case
    values = np.linspace(0, 1, clip.size).reshape(clip.shape)
    scene = ClipScene(clip, values, size)
    traced = trace(
        scene,
        Settings(fill=fill, clipping=clipping, coverage=coverage, depth=depth, block_size=2, blend="over"),
    )
    check_all(traced)
