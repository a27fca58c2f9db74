"""Pixel for pixel against pictures that a real OpenGL implementation drew; needs no OpenGL."""

from dataclasses import replace

import numpy as np
import pytest

import core
from app.cli.opengl_check import describe
from app.opengl_check.compare import PIXELS_ALLOWED, compare, draw_with_core
from app.opengl_check.families import FAMILIES
from core.methods import table
from tests.covering import in_turn
from tests.oracle.record_cases import FOLDER, read_case

FILES = sorted(path.stem for path in FOLDER.glob("*.npz"))
LINES = [name for name in FILES if name.rsplit("_")[0] in ("octants", "line-ends")]
TRIANGLES = [name for name in FILES if name not in LINES]
EXACT_FILLS = [name for name in table.names("fill") if not table.get("fill", name).breaks_where]


def read(name):
    return read_case(FOLDER / f"{name}.npz")


def assert_agrees(result):
    assert result.agrees, describe(result)


def test_every_family_is_recorded_in_small_files():
    assert {name.rsplit("_")[0] for name in FILES} == set(FAMILIES)
    assert sum(path.stat().st_size for path in FOLDER.glob("*.npz")) < 300_000


def test_every_recorded_picture_shows_something_and_leaves_something():
    for name in FILES:
        _, picture = read(name)
        assert (picture.primitive >= 0).any(), name
        assert (picture.primitive < 0).any() or name.startswith(("offscreen", "clipped", "near")), name
        assert (picture.depth[picture.primitive < 0] == 1).all(), name


def test_fills_that_are_not_wrong_by_design():
    assert set(EXACT_FILLS) >= {"hierarchy", "blocks", "bounding-box", "brute-force", "scanline", "spans"}
    assert "scanline-lecture" not in EXACT_FILLS


@pytest.mark.parametrize(("name", "fill"), in_turn(TRIANGLES, EXACT_FILLS))
def test_triangles_are_the_same(name, fill):
    case, picture = read(name)
    assert_agrees(compare(case, picture, fill))


@pytest.mark.parametrize("name", LINES)
def test_lines_are_the_same(name):
    case, picture = read(name)
    assert_agrees(compare(case, picture, line="diamond-exit"))


@pytest.mark.parametrize("line", ["bresenham", "bresenham-float"])
@pytest.mark.parametrize("name", [name for name in LINES if name.startswith("octants")])
def test_lines_between_pixels_are_the_same_with_bresenham(name, line):
    case, picture = read(name)
    assert len(compare(case, picture, line=line).differing) == 0


@pytest.mark.parametrize("name", [name for name in FILES if name.startswith("shared")])
def test_shared_edges_are_drawn_once(name):
    case, picture = read(name)
    frame = core.draw_triangles(case.clip, *case.size, case.attributes, settings=case.settings())
    assert np.array_equal(frame.cover_count, picture.primitive >= 0)


def test_the_lecture_scanline_is_not_the_same():
    differing = [
        len(compare(*read(name), "scanline-lecture").differing) for name in FILES if name.startswith("shared")
    ]
    assert sum(differing) > 10


@pytest.mark.parametrize(
    "name", ["single_0", "mesh_0", "near_0", "ground_0", "bilinear_0", "depth_1", "octants_0"]
)
def test_a_change_is_noticed(name):
    case, picture = read(name)
    row, column = np.argwhere(picture.primitive >= 0)[0]

    depth = picture.depth.copy()
    depth[row, column] += 1e-2
    result = compare(case, replace(picture, depth=depth))
    assert not result.agrees
    assert "depth off by 1.0e-02" in describe(result)

    color = picture.color.copy()
    color[row, column, 0] += 1e-2
    assert "colour off by 1.0e-02" in describe(compare(case, replace(picture, color=color)))

    primitive = picture.primitive.copy()
    primitive[picture.primitive >= 0] = -1
    result = compare(case, replace(picture, primitive=primitive))
    assert not result.agrees
    assert len(result.differing) == (picture.primitive >= 0).sum()
    assert "another primitive" in describe(result)


def test_nearest_texels_may_differ_only_on_their_borders():
    case, picture = read("nearest_0")
    shifted = replace(case, attributes=case.attributes + np.float32(0.02))
    assert compare(case, picture).color_excess == 0
    assert not compare(shifted, picture).agrees
    untested = np.isinf(draw_with_core(case).color_tolerance).sum()
    assert untested <= 0.001 * picture.primitive.size


def test_allowed_pixels_are_few():
    assert set(PIXELS_ALLOWED) < set(FAMILIES)
    assert max(PIXELS_ALLOWED.values()) <= 4
