"""The listings of ray casting, depth and blending, executed on the rows."""

from fractions import Fraction
from math import isnan

import numpy as np

from core.depth.depth import depth_in_range, depth_test, store_depth
from core.depth.fixed_depth import packed_depth_test, rounded_depth_test
from core.framebuffer.blending import additive_pixel, opaque_pixel, over_pixel, resolve_from_front
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from core.visibility.hit_lists import list_hits
from core.visibility.ray_casting import hit_is_nearer, hit_value
from tests.core.trace.executed_rows import equal, rows_of_kind


def check_rays(traced: Trace) -> None:
    found, planes = traced.stage("depth"), traced.source.geometry.ray_planes
    c, (width, height) = found.columns, traced.source.scene.size
    name = "end" if "end" in found.steps.kinds else "ray"
    for kind, has_nearest in ((f"{name}-first", False), (name, True), (f"{name}-exact", True)):
        for row in rows_of_kind(found, kind):
            triangle, nearest = found.triangle[row], c["nearest"][row]
            ray = Fraction(c["m"][row]), Fraction(c["n"][row])
            plane = [float(c[name][row]) for name in "abcd"]
            hit = hit_value(plane, c["sizes"][row].tolist(), *map(float, ray), width, height)
            assert hit == (c["nearness"][row], c["error"][row])
            corners = planes.clip[nearest].tolist() if has_nearest else None
            before = c["nearest_nearness"][row], c["nearest_error"][row]
            xy = (ray[0], width), (ray[1], height)
            assert (
                hit_is_nearer(*hit, planes.clip[triangle].tolist(), *before, corners, *xy, planes.by_w)
                == (c["passes"][row])
            )


def by_sample(found: StageTrace) -> dict[tuple[int, ...], list[int]]:
    """Return the rows of each pixel, or of each of its samples."""
    sample = found.columns.get("sample", np.zeros(found.steps.row_count, np.int64))
    rows: dict[tuple[int, ...], list[int]] = {}
    for row, key in enumerate(zip(*found.pixel.T.tolist(), sample.tolist(), strict=True)):
        rows.setdefault(key, []).append(row)
    return rows


def check_lists(found: StageTrace) -> None:
    """Append and sort each list by its listing."""
    c, kind_of = found.columns, [found.steps.kinds[kind] for kind in found.steps.kind.tolist()]
    check_stored(found, "hit")
    for rows in by_sample(found).values():
        hits = [(c["stored"][row], c["primitive"][row]) for row in rows if kind_of[row].startswith("hit")]
        known = found.constants["larger_is_nearer"], found.constants["shows_through"]
        kept = list_hits(hits, c["before"][rows[0]], *known)
        listed = list_hits(hits, c["before"][rows[0]], known[0], True)
        ranked = [row for row in rows if kind_of[row].startswith("list")]
        assert [(c["stored"][row], c["primitive"][row]) for row in ranked] == listed
        assert [(c["stored"][row], c["primitive"][row]) for row in ranked if c["passes"][row]] == kept


def check_depth(traced: Trace) -> None:
    found = traced.stage("depth")
    c = found.columns
    if traced.source.geometry.drawing.decides is not None:
        check_lists(found) if "hit" in found.steps.kinds else check_rays(traced)
        return
    if "key" in c:
        check_keys(found)
    for kind in ("test", "store"):
        check_stored(found, kind)
    for row in rows_of_kind(found, "test"):
        after, passes = depth_test(c["stored"][row], c["before"][row], bool(c["larger_is_nearer"][row]))
        assert passes == c["passes"][row]
        assert after == c["after"][row]
    for row in rows_of_kind(found, "out-of-range"):
        assert depth_in_range(c["depth"][row], False) == (c["depth"][row], False)
        assert not c["passes"][row]
        assert isnan(c["before"][row])
        assert not 0 <= c["depth"][row] <= 1
    for row in rows_of_kind(found, "store"):
        assert c["after"][row] == store_depth(c["stored"][row], c["before"][row], c["writes"][row])
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
            scale = [constants[name] for name in ("scale",) if name in constants]
            depth = c["inverse_w" if constants["quantity"] == "inverse-w" else "depth"][row]
            assert equal(rounding.function(float(depth), *scale), c["stored"][row])


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
    if "front-store" in found.steps.kinds:
        for rows in by_sample(found).values():
            store = rows[-1]
            assert equal(resolve_from_front(c["source"][rows[:-1]], c["before"][store]), c["after"][store])
        return
    for row in rows_of_kind(found, traced.source.settings.blend):
        mixing = {"over": over_pixel, "additive": additive_pixel}.get(traced.source.settings.blend)
        source = c["source"][row]
        made = opaque_pixel(source) if mixing is None else mixing(source, c["before"][row])
        assert equal(made, c["after"][row])
