"""What every chart shows, derived by hand for one case of each family: errors and work counts, never times."""

import numpy as np
import pytest

from core.methods import table
from core.settings import no_effect
from core.study.bands import amdahl_limit
from core.study.families import study_families
from core.study.whole_picture import PICTURE
from core.study.workloads import window_mesh
from tests.core.study.accuracy.untimed_runs import run

PUBLISHED = {"orientation", "depth-steps"}
"""Families that are published tests: ``test_published`` derives them."""
CHOICES = {"polygon_mode", "pixel_center", "provoking", "wrap", "blend"}
"""Families that choose what is to be seen, and share one derivation."""


def test_every_family_has_its_derivation() -> None:
    tested = {name.removeprefix("test_") for name in globals() if name.startswith("test_")}
    assert {family.name for family in study_families()} <= tested | CHOICES | PUBLISHED


def test_a_setting_is_varied_where_it_shows() -> None:
    drawn = [family for family in study_families() if family.works == (PICTURE,)]
    assert not [family.name for family in drawn for name in family.varies if no_effect(family.base, name)]


def test_line() -> None:
    # 100 lines of 16 columns, the last pixel left to the next line: 1,600 pixels, each within half a pixel.
    # Bresenham looks at the sign of D once a column, and three times before; he doubles, but never multiplies (1965).
    # DDA divides once a line, for the slope, and rounds every column (and the two ends of the loop).
    lines = run("line", "pixel-ends", length=16)
    bresenham, dda = lines["bresenham"], lines["dda"]
    assert bresenham.counts["pixels drawn"] == dda.counts["pixels drawn"] == 1600
    assert bresenham.counts["integer comparisons"] == 100 * (16 + 3)
    assert not {"integer multiplications", "integer divisions", "roundings"} & set(bresenham.counts)
    assert not [name for name in bresenham.counts if name.startswith("float")]
    assert dda.counts["float divisions"] == 100
    assert bresenham.errors["largest-distance"] == pytest.approx(0.5)
    assert bresenham.errors["not-nearest"] == 0


def test_dicing() -> None:
    # Eight patches, every quarter of 31.4 pixels split and diced to at most 4 pixels. The outline is right from 2
    # pixels on; what is shaded depends on the side, not on what hides it: twice as much for two balls, one unseen.
    coarse, fine, two = (
        run("dicing", side=side, layers=layers)["reyes"] for side, layers in ((64, 1), (32, 1), (64, 2))
    )
    assert (coarse.errors["outline"], fine.errors["outline"], two.errors["outline"]) == (16, 0, 16)
    assert (coarse.counts["points shaded"], fine.counts["points shaded"]) == (1352, 5000)
    assert two.counts["points shaded"] == 2 * 1352
    assert (coarse.counts["longest list"], two.counts["longest list"]) == (2, 4)


def test_lists() -> None:
    # A z-buffer holds one depth and colour for each of 48 x 48 pixels, 20 bytes, and drops what comes behind: wrong but
    # for a single pane. Lists hold 20 bytes for each fragment, and are right in any order.
    for count in (1, 8):
        buffers, lists = (run("lists", count=count)[name] for name in ("z-buffer", "hit-lists"))
        assert buffers.counts["bytes held"] == 20 * 48 * 48
        assert lists.counts["bytes held"] == 20 * lists.counts["fragments"]
        assert lists.errors["wrong-color"] == 0
        assert (buffers.errors["wrong-color"] > 0) == (count > 1)


def test_tessellation() -> None:
    # The largest second difference of the arch is (-30, -42): six times its length is 309.7, an eighth of it 38.7, so
    # ceil(sqrt(38.7 / 0.5)) = 9 segments keep half a pixel. Halving makes 16, as it can only double; where a curve
    # bends at one place, it makes fewer.
    arch, hook = (run("tessellation", name, segments=6) for name in ("arch", "hook"))
    assert {name: found.counts["segments"] for name, found in arch.items()} == {
        "uniform": 6,
        "bound": 9,
        "adaptive": 16,
        "reyes": 256,
    }
    assert hook["adaptive"].counts["segments"] < hook["bound"].counts["segments"]
    for found in (arch, hook):
        assert all(found[name].errors["deviation"] <= 0.5 for name in ("bound", "adaptive"))
    assert arch["uniform"].errors["deviation"] > 0.5
    # Every point of a cubic takes 3 + 2 + 1 mixtures.
    assert arch["bound"].counts["mixtures"] == 10 * 6


def test_fill() -> None:
    # 48 boxes of 4 x 4 pixels hold 16 centres each, wherever they lie; brute force tests all 256 x 256.
    fills = run("fill", "triangles", size=4)
    assert fills["brute-force"].counts["pixels tested"] == 48 * 256 * 256
    assert fills["bounding-box"].counts["pixels tested"] == 48 * 16
    assert fills["blocks"].counts["pixels tested"] <= 48 * 16
    # Spans test no pixel: they solve the at most four rows of a box for where the edges cross them.
    for name in ("spans", "scanline"):
        assert fills[name].counts["pixels tested"] == 0 < fills[name].counts["rows solved"] <= 48 * 4
    assert fills["bounding-box"].counts["rows solved"] == 0
    for name in table.names("fill"):
        assert (fills[name].errors["misclassified"] == 0) == (name != "scanline-lecture")


def test_polygon_fill() -> None:
    # Both rules decide in whole numbers, as the referee does. Of a ring and a hole that runs the other way, both fill
    # the same.
    fills = run("polygon_fill", "holes", corners=16)
    assert [fills[name].errors["misclassified"] for name in table.names("polygon_fill")] == [0, 0]
    assert fills["even-odd"].counts == fills["non-zero"].counts
    crossing = run("polygon_fill", "crossing", corners=8)
    assert {point.errors["misclassified"] for point in crossing.values()} == {0}


def test_polygon_clipping() -> None:
    # Both leave the same area; only Sutherland-Hodgman joins its parts by edges along the window. Unclipped, pixels
    # outside of the window are drawn. New corners are snapped again, so a pixel beside an edge may differ.
    clippers = run("polygon_clipping", "holes", corners=32)
    errors = {name: clippers[name].errors for name in table.names("polygon_clipping")}
    assert errors["none"]["misclassified"] > 50_000
    assert errors["sutherland-hodgman"]["misclassified"] == errors["weiler-atherton"]["misclassified"] < 1000
    assert errors["sutherland-hodgman"]["connecting"] > 1
    assert errors["weiler-atherton"]["connecting"] == 0


def test_coverage() -> None:
    # A centre on an edge is drawn more than once with >= 0, never with > 0, once with the rule of shared edges: both
    # wrong rules are wrong on the very same pixels. Where six triangles meet the first is off by 5 and the second by 1.
    ties = run("coverage", "ties")
    inclusive, exclusive = ties["fill_rule=inclusive"].errors, ties["fill_rule=exclusive"].errors
    assert inclusive["cracks"] == exclusive["cracks"] > 0
    assert inclusive["misclassified"] > exclusive["misclassified"]
    assert ties["snapped"].errors["cracks"] == ties["exact"].errors["cracks"] == 0


def test_line_clipping() -> None:
    # Cyrus-Beck looks at all four edges; Liang-Barsky stops where nothing is left; both divide once for every edge
    # that is not parallel. Cohen-Sutherland finds two outcodes of four comparisons in every pass, and divides only
    # where an end moves: at most twice for each end.
    clippers = {name: found.counts for name, found in run("line_clipping", "around", count=100).items()}
    assert clippers["none"]["edges tested"] == clippers["none"]["crossings found"] == 0
    assert clippers["cyrus-beck"]["edges tested"] == clippers["cyrus-beck"]["crossings found"] == 400
    assert 300 < clippers["liang-barsky"]["edges tested"] < 400
    cohen = clippers["cohen-sutherland"]
    assert cohen["edges tested"] == 8 * (100 + cohen["crossings found"])
    assert cohen["crossings found"] < clippers["liang-barsky"]["crossings found"] / 2


def test_clipping() -> None:
    # Homogeneous edges need no new corners. Projected first, corners with w > 0 land on the same places; one behind
    # the eye lands mirrored through the centre. Pieces have new corners, and each is snapped: half a step of 1/256.
    near, eye = run("clipping", "near"), run("clipping", "eye")
    assert near["homogeneous"].errors == near["project-first"].errors == eye["homogeneous"].errors
    assert set(near["homogeneous"].errors.values()) == {0}
    assert eye["project-first"].errors["wrong-visible"] > 500_000
    for pieces in (near["sutherland-hodgman"], eye["sutherland-hodgman"]):
        assert pieces.counts["triangles drawn"] > 16
        assert pieces.errors["misclassified"] < 50


def test_interpolation() -> None:
    # Along the bottom row 1/w runs evenly from 1 to 1/4, so u = t / (4 - 3 t) at the share t of the row. Between two
    # anchors a straight line strays by (sqrt r - 1)/(sqrt r + 1) of their difference, r being the ratio of their w: by
    # a third of 256 texels with 64 pixels between them, by most in the last interval, where w changes fastest.
    side, ratio = 64, 4.0
    square = run("interpolation", "aside", side=side, **{"w-ratio": ratio})

    def strays(interval: int) -> float:
        t = np.minimum(np.arange(0.0, side + 1, interval) + 0.5, side) / side
        w, u = 1 / (1 - (1 - 1 / ratio) * t), t / (ratio - (ratio - 1) * t)
        root = np.sqrt(w[1:] / w[:-1])
        return 256 * float(((u[1:] - u[:-1]) * (root - 1) / (root + 1)).max())

    errors = {name: found.errors["largest-texel"] for name, found in square.items()}
    assert errors["perspective"] < 1e-9
    for interval in (4, 16):
        name = "affine-n" if interval == 16 else f"affine-n correction_interval={interval}"
        assert errors[name] == pytest.approx(strays(interval), rel=0.1)
    assert errors["affine-n"] < errors["affine-n correction_interval=64"] <= errors["affine"]
    assert errors["affine"] == pytest.approx(256 / 3, rel=0.01)
    # One division a pixel, none without perspective, and with correction one for every anchor of a row.
    divisions = {name: found.counts["divisions by 1/w"] for name, found in square.items()}
    assert divisions["perspective"] == side * side
    assert divisions["affine"] == divisions["flat"] == 0
    assert divisions["affine-n correction_interval=64"] < divisions["affine-n"] < side * side / 4
    # Leaning back, w is the same along each row: nothing is left to correct, as Wolfenstein's floors knew.
    assert run("interpolation", "square", side=16)["affine-n"].errors["largest-texel"] < 1e-9


def test_texture_filter() -> None:
    # A fragment reads one texel, four, four of one level, four of each of two levels. Facing the camera with 2^k texels
    # for a pixel, level k holds the very mean that a pixel shows; one texel out of 4^k does not.
    facing = run("texture_filter", "facing", density=4, side=32)
    read = {name: found.counts["texels read"] for name, found in facing.items()}
    assert read == {"nearest": 1024, "bilinear": 4096, "mipmap-nearest": 4096, "trilinear": 8192}
    errors = {name: found.errors["mean-color"] for name, found in facing.items()}
    assert (
        max(errors["trilinear"], errors["mipmap-nearest"]) < 1e-3 < min(errors["nearest"], errors["bilinear"])
    )


def test_depth() -> None:
    # With the near plane at 1 two walls a part g of their distance d apart differ by g/d in window depth: by a step of
    # 2^-24 up to d = g 2^24. That is 16,777 for g = 1/1000, beyond the far plane, and 168 for g = 1/100,000. In 16 bits
    # it is 65. 1/w in float32 tells parts of 2^-23 apart at any distance.
    formats = run("depth", gap=1e-3, far=1e4, side=32)
    assert formats["z-24"].errors["wrong-visible"] == 0 < formats["z-16"].errors["wrong-visible"]
    formats = run("depth", gap=1e-5, far=1e4, side=32)
    assert formats["z-24"].errors["wrong-visible"] > 0 == formats["inverse-w"].errors["wrong-visible"]
    bits = {name: found.counts["bits of a depth"] for name, found in formats.items()}
    floats = dict.fromkeys(("z-float32", "inverse-w", "reversed-z", "logarithmic"), 32)
    assert bits == {**floats, "z-16": 16, "z-24": 24, "fixed-38": 38}


def test_antialiasing() -> None:
    # Every pixel's colour is the mean of flat colours by area. Areas in closed form leave nothing but float32; n
    # samples leave an error that falls with n; a sample each is tested for depth.
    methods = run("antialiasing", side=32)
    error = {name: found.errors["mean-color"] for name, found in methods.items()}
    assert error["area"] < 1e-3 < error["ssaa-16"] < error["ssaa-n"] < error["ssaa-4"] < error["none"]
    tests = {name: found.counts["depth tests"] for name, found in methods.items()}
    assert (tests["none"], tests["ssaa-4"], tests["ssaa-16"]) == (1024, 4096, 16384)


def test_shading() -> None:
    # A sphere of 4 rings and 8 columns: 5 x 9 vertices, 8 x (4 + 4 - 2) faces. Flat lights a face, Gouraud a vertex,
    # Phong a fragment; the finer the light is followed, the nearer is the sphere.
    shadings = run("shading", rings=4, side=64)
    lights = {name: found.counts["lights evaluated"] for name, found in shadings.items()}
    assert lights["phong"] == shadings["phong"].counts["pixels shaded"] > lights["flat"]
    assert (lights["gouraud"], lights["flat"], lights["unlit"]) == (45, 48, 0)
    error = {name: found.errors["mean-color"] for name, found in shadings.items()}
    assert error["phong"] < error["gouraud"] < error["flat"] < error["unlit"]


def test_depth_test_time() -> None:
    # Of n full layers the late test shades all; the early one shades as often as the nearest depth falls: once from
    # near to far, n times from far to near. The picture is right either way.
    pixels, layers = 32 * 24, 8
    for work, early in (("near-to-far", pixels), ("far-to-near", layers * pixels)):
        found = run("depth_test_time", work, layers=layers)
        assert found["late"].counts["fragments shaded"] == layers * pixels
        assert found["early"].counts["fragments shaded"] == early
        assert found["prepass"].counts["fragments shaded"] == pixels
        assert {point.errors["wrong-visible"] for point in found.values()} == {0}


def test_shadow() -> None:
    # Without a bias half of the floor shadows itself; at the bound of a plane nearly nothing does; five times as much
    # loses the whole shadow on 16 texels. Rays are the reference.
    found = {bias: run("shadow", bias=bias) for bias in (0, 11, 55)}
    dark, lit = (
        {bias: each["map"].errors[name] for bias, each in found.items()}
        for name in ("wrongly-dark", "wrongly-lit")
    )
    assert dark[0] > 300_000 > 6_000 > dark[11] > dark[55]
    assert lit[55] > lit[11] >= lit[0] > 0
    assert set(found[11]["rays"].errors.values()) == {0}
    assert found[11]["map"].counts["texels of the map"] == 256
    wrong = {bias: each["map"].counts["lit pixels in the dark"] for bias, each in found.items()}
    assert wrong[0] > 1000 > wrong[11] > wrong[55] == 0


def test_environment() -> None:
    # The corners of a flat mirror of side 1 lie 0.68 beside its middle, at the middles of the last pixels: look-ups are
    # off by atan(0.68 / d) of 90 degrees, whatever the map; rays by nothing.
    beside = np.hypot(23, 23) / 48
    for distance, size in ((1, 64), (4, 64), (4, 128), (128, 64)):
        found = run("environment", distance=distance, map=size)
        off = np.arctan(beside / distance) / (np.pi / 2) * size
        assert found["cube"].errors["off-texels"] == pytest.approx(off)
        assert found["rays"].errors["off-texels"] == 0
        assert found["cube"].counts["texels of the map"] == 6 * size**2


@pytest.mark.parametrize("seed", range(3))
def test_visibility(seed: int) -> None:
    # Ray casting compares exactly, on the pixels that every method covers: nothing can be wrong. Its loop over rays and
    # triangles is pixels times triangles; the z-buffer tests each covered pixel; the painter sorts, and tests nothing.
    count, pixels = 16, 128 * 128
    for work in ("crossing", "layers"):
        found = run("visibility", work, seed, count=count)
        assert found["ray-casting"].errors["wrong-visible"] == 0
        counts = {name: each.counts for name, each in found.items()}
        covered = counts["z-buffer"]["pixels covered"]
        assert counts["ray-casting"]["rays times triangles"] == count * pixels
        assert counts["ray-casting"]["hits compared"] == counts["z-buffer"]["depth tests"] == covered
        assert found["scan-line"].errors["wrong-visible"] == 0
        assert 0 < counts["scan-line"]["depths computed"] < counts["z-buffer"]["depths computed"] == covered
        assert counts["scan-line"]["depth tests"] == counts["scan-line"]["hits compared"] == 0
        assert counts["ray-casting"]["depth tests"] == counts["painters"]["depth tests"] == 0
        assert (counts["painters"]["triangles sorted"], counts["last-drawn"]["triangles sorted"]) == (
            count,
            0,
        )
    # Each at one depth: sorted by it, the last drawn is the nearest.
    assert found["painters"].errors["wrong-visible"] == 0 < found["last-drawn"].errors["wrong-visible"]


@pytest.mark.slow
def test_loops() -> None:
    # A loop over rays asks all triangles for every pixel. On 16 x 16 pixels the tree asks more than a z-buffer sets up
    # and tests, until there are triangles enough; with a fourth of the pixels it asks a third at most.
    total, few, many = "asked in all: triangles, fragments, boxes", {}, {}
    for found, rings, side in ((few, 8, 16), (many, 72, 16), ({}, 72, 8)):
        found |= {name: each.counts for name, each in run("loops", rings=rings, side=side).items()}
        drawn = found["z-buffer"]["triangles set up"]
        assert found["ray-casting-by-pixel"][total] == side * side * drawn
        assert found["z-buffer"][total] == drawn + found["z-buffer"]["fragments tested"]
    assert few["z-buffer"][total] < few["ray-casting-tree"][total] < few["ray-casting-by-pixel"][total]
    assert many["ray-casting-tree"][total] < many["z-buffer"][total] < many["ray-casting-by-pixel"][total]
    assert found["ray-casting-tree"][total] < many["ray-casting-tree"][total] / 3


def test_cull() -> None:
    # A ray enters a closed convex surface once and leaves it once: half of what is covered faces away, and is hidden.
    closed = run("cull", "closed", rings=6)
    covered = {name: found.counts["pixels covered"] for name, found in closed.items()}
    assert covered["none"] == 2 * covered["back"] == 2 * covered["front"]
    assert closed["back"].errors["wrong-visible"] == 0
    # Nothing culled, a back may show at the rim: snapping gives the centre to both, and beyond its edge it is nearer.
    assert closed["none"].errors["wrong-visible"] < 500 < closed["front"].errors["wrong-visible"]
    # Without its upper part the surface shows its inside, which is a back.
    assert run("cull", "open", rings=6)["back"].errors["wrong-visible"] > 0


def test_temporal() -> None:
    # At rest a picture is one sample more. Moved a pixel a picture, what is kept where it was is wrong by the ghost;
    # clamped, it is much less wrong.
    at_rest = {count: run("temporal", "at-rest", pictures=count) for count in (1, 4, 16)}
    error = {
        name: [at_rest[count][name].errors["mean-color"] for count in (1, 4, 16)]
        for name in ("kept", "reprojected", "clamped")
    }
    assert error["kept"] == error["reprojected"]
    assert error["kept"][0] > 1.5 * error["kept"][1] > 2 * error["kept"][2]
    moving = run("temporal", "moving", pictures=16)
    assert moving["kept"].errors["mean-color"] > 1.4 * moving["clamped"].errors["mean-color"]


@pytest.mark.slow
def test_hierarchy() -> None:
    # A mesh as one object: every ray asks its box, and all that meet it ask 120 triangles. A BVH of n leaves with one
    # triangle each has 2 n - 1 nodes, and lists each once. An octree lists one in every cell that it touches.
    trees = run("hierarchy", leaf=1, rings=6)
    counts = {name: each.counts for name, each in trees.items()}
    assert counts["none"]["boxes asked"] == 48 * 48
    assert counts["none"]["triangles asked"] % 120 == 0
    for name in ("bvh", "bvh-area"):
        assert (counts[name]["nodes"], counts[name]["references"]) == (2 * 120 - 1, 120)
        assert counts[name]["triangles asked"] < counts["none"]["triangles asked"] / 10
    assert counts["octree"]["references"] > 120
    assert {each.errors["wrong-visible"] for each in trees.values()} == {0}


def test_occluders() -> None:
    # Each wall is a box of 12 triangles that the pass draws. More of them hide more, and no pixel changes.
    few, many = (run("occluders", boxes=25, occluders=count) for count in (1, 8))
    assert [each["occlusion"].counts["triangles of the pass"] for each in (few, many)] == [12, 96]
    assert 0 < few["occlusion"].counts["boxes hidden"] < many["occlusion"].counts["boxes hidden"]
    drawn = [each.counts["triangles drawn"] for each in (many["occlusion"], few["occlusion"], few["none"])]
    assert drawn[0] < drawn[1] < drawn[2]
    assert {each.errors["wrong-visible"] for found in (few, many) for each in found.values()} == {0}


@pytest.mark.parametrize("family", sorted(CHOICES))
def test_choices_of_what_is_seen(family: str) -> None:
    # None of them is wrong: bytes differ from the full buffers by a rounding at most.
    for found in run(family, scale=0.125).values():
        assert found.errors["wrong-visible"] == 0
        assert found.errors["largest-color"] <= 1 + 1e-9


def test_resolve_filter() -> None:
    # A box takes a pixel's own samples, a tent its neighbours' too: it blurs. Fewer than a byte is rounding.
    filters = run("resolve_filter", scale=0.125)
    assert filters["box"].errors["mean-color"] < 1 < filters["tent"].errors["mean-color"]
    assert filters["tent"].counts["pixels covered"] >= filters["box"].counts["pixels covered"]


def test_pipeline() -> None:
    # Two closed spheres: backs are half of what is covered. Four samples of each pixel: four times the depth tests.
    some = ("fill=spans", "cull=back", "cull=front", "antialiasing=ssaa-4")
    points = run("pipeline", only=some, scale=0.25)
    covered = {name: found.counts["pixels covered"] for name, found in points.items()}
    unchanged = covered["fill=spans"]
    assert unchanged == covered["cull=back"] + covered["cull=front"] == 2 * covered["cull=back"]
    assert covered["antialiasing=ssaa-4"] == pytest.approx(4 * unchanged, rel=0.1)
    assert points["cull=back"].errors["wrong-visible"] == 0 < points["cull=front"].errors["wrong-visible"]


@pytest.mark.parametrize("steps", [2, 256, 1024])
def test_no_triangle_of_a_mesh_turns_over(steps: int) -> None:
    # "Every pixel belongs to exactly one triangle" is what cracks are counted by: exact coverage must show none. A
    # triangle that turned over was drawn on top of its neighbours (64 cells on half pixels; seed 475990 of ``ties``).
    for cells in (4, 16, 32, 64):
        for seed in (*range(8), 13844, 475990):
            corners = window_mesh((256, 256), cells, seed, steps)
            (ax, ay), (bx, by) = ((corners[:, k] - corners[:, 0]).T for k in (1, 2))
            assert (ax * by > ay * bx).all()


def test_presentation() -> None:
    # 20 ms a picture, 16 ms a refresh, 63 refreshes: swaps at 20 k tear unless k is a multiple of 4. In a single
    # buffer the screen overtakes the renderer once in 80 ms. Two buffers show a picture every 32 ms, three every 20 ms.
    shown = run("presentation", drawing=20, refresh=16)
    counts = {name: point.counts for name, point in shown.items()}
    rates = {name: found["pictures shown in a second"] for name, found in counts.items()}
    assert rates == {"single": 50, "double-at-once": 50, "double": 31, "triple": 49}
    torn = {name: found["torn refreshes"] for name, found in counts.items()}
    assert torn == {"single": 12, "double-at-once": 38, "double": 0, "triple": 0}
    assert counts["double"]["milliseconds that the renderer waits"] == 31 * 12
    assert shown["double-at-once"].errors["torn"] == pytest.approx(1e6 * 38 / 63)


def test_flush() -> None:
    ways = run("flush", height=24)
    assert {name: point.counts["transfers"] for name, point in ways.items()} == {
        "by-pixel": 24 * 32,
        "by-row": 24,
        "at-once": 1,
    }
    assert {point.errors["wrong-bytes"] for point in ways.values()} == {0}


def test_skinning() -> None:
    # cos(45 degrees) of the width is left where both bones have half of the weight, or of the radius after a twist.
    for work in ("bend", "twist"):
        found = run("skinning", work, rings=16, angle=90)
        assert found["linear"].errors["lost-width"] == pytest.approx(1e6 * (1 - 0.5**0.5))
        assert found["dual-quaternion"].errors["lost-width"] == pytest.approx(0, abs=1e-6)
        assert found["linear"].counts["vertices"] == 17 * 16


@pytest.mark.slow
def test_bands() -> None:
    # Each of three processes transforms all 4 * 8 * 7 triangles; each covered pixel is drawn by one of them.
    three, alone = (run("bands", processes=count, rings=8) for count in (3, 1))
    for name in ("unlit", "gouraud", "phong"):
        assert three[name].counts["triangles transformed by all"] == 3 * 4 * 8 * 7
        assert three[name].counts["pixels covered by all"] == alone[name].counts["pixels covered by all"]
        assert three[name].errors["wrong-pixels"] == 0
    # All work shared: no gain. Nothing shared: as many times as fast. Half shared: never twice as fast.
    assert [amdahl_limit(*parts, 4) for parts in ((8, 0), (0, 8), (4, 4))] == [8, 2, 5]
