"""Rays pixel by pixel: the picture and the hits of ray casting, and a row for every pair that is no hit."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given

from core import ClipScene, Settings, Trace, draw_picture, render, trace
from core.records.steps import Level
from core.visibility.rays_by_pixel import cast_all_rays
from core.visibility.traced_by_pixel import ASKED_OPERATIONS, MOST_ASKED
from lessons.scenes import make_scene
from tests.core.exact_reference import exact_coverage
from tests.core.strategies import perspective_triangles
from tests.core.trace.trace_cases import SCENES

BY_TRIANGLE = Settings(visibility="ray-casting", cull="none")
BY_PIXEL = replace(BY_TRIANGLE, visibility="ray-casting-by-pixel")
CHOICES = [
    ("intersecting", {}),
    ("clip", {"blend": "over"}),
    ("clip", {"clipping": "sutherland-hodgman", "fill": "scanline"}),
    ("lit", {"antialiasing": "msaa-4"}),
    ("shared-edge", {"antialiasing": "ssaa-4"}),
    ("clip", {"polygon_mode": "wireframe", "line": "wu"}),
    ("pentagram", {}),
]


def both(name: str, chosen: dict[str, str]) -> tuple[Trace, Trace]:
    return trace(SCENES[name], replace(BY_TRIANGLE, **chosen)), trace(
        SCENES[name], replace(BY_PIXEL, **chosen)
    )


def same(one, other) -> bool:
    return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")


@pytest.mark.parametrize(("name", "chosen"), CHOICES, ids=str)
def test_both_loops_draw_one_picture_and_decide_the_same_hits(name, chosen) -> None:
    one, other = both(name, chosen)
    pictures = [render(run.source.scene, run.source.settings) for run in (one, other)]
    for buffer in ("color", "depth", "primitive", "cover_count"):
        assert same(*(getattr(picture, buffer) for picture in pictures))
    of_triangles, of_pixels = one.stage("depth"), other.stage("depth")
    asked = [of_pixels.steps.kinds.index(kind) for kind in ASKED_OPERATIONS]
    hits = np.flatnonzero(~np.isin(of_pixels.steps.kind, asked))
    keys = of_triangles.columns.get("sample", 0 * of_triangles.triangle), *of_triangles.pixel.T
    others = of_pixels.columns.get("sample", 0 * of_pixels.triangle)[hits], *of_pixels.pixel[hits].T
    order, others_order = np.lexsort(keys), np.lexsort(others)
    for column, values in of_triangles.columns.items():
        assert same(values[order], of_pixels.columns[column][hits][others_order]), column
    ends = [stage.state(stage.steps.count) for stage in (of_triangles, of_pixels)]
    assert all(same(ends[0][name], ends[1][name]) for name in ends[0] if name.startswith(("depth", "prim")))


@given(perspective_triangles(3))
def test_every_pair_of_pixel_and_triangle_has_one_row_and_misses_cover_nothing(case) -> None:
    clip, size = case
    scene = ClipScene(clip, size=size)
    traced = trace(scene, BY_PIXEL)
    found, primitives = traced.stage("depth"), traced.source.geometry.primitives
    about = found.pixel[:, 0] >= 0
    pairs = np.column_stack([found.pixel, found.columns["primitive"]])[about]
    assert len(pairs) == len(np.unique(pairs, axis=0)) == size[0] * size[1] * len(primitives)
    assert np.count_nonzero(~about) == 1
    is_miss = found.steps.kind == found.steps.kinds.index("ray-missed")
    covered = np.array([exact_coverage(corners, size) for corners in clip], bool)
    (column, row), triangle = found.pixel[about].T, found.triangle[about]
    assert np.array_equal(covered[triangle, row, column], ~is_miss[about])
    # An edge that is named is one that the pixel lies outside of; of a convex triangle there always is one.
    assert found.columns["is_outside"][is_miss].any(axis=1).all()


def test_the_loops_of_the_listing_find_what_is_seen() -> None:
    traced = trace(SCENES["clip"], BY_PIXEL)
    source, picture = traced.source, traced.source.picture
    planes, fragments = source.geometry.ray_planes, source.fragments
    kept = source.depths[1]
    hits = set(zip(source.place[kept].tolist(), source.triangle_of_fragment[kept].tolist(), strict=True))
    assert len(fragments) >= len(hits)
    width, height = source.scene.size

    def is_nearer(pixel: int, new: int, old: int) -> bool:
        row, column = divmod(pixel, width)
        m, n = planes.rays(np.array([column]), np.array([row]), source.raster.center)
        return planes.compare(new, old, m.tolist(), n.tolist()) == [1]

    triangles = source.geometry.primitives.triangle.tolist()
    seen = cast_all_rays(range(width * height), triangles, lambda *pair: pair in hits, is_nearer)
    shown = [-1 if triangle is None else triangle for triangle in seen.values()]
    assert np.array_equal(np.reshape(shown, (height, width)), picture.primitive)


def test_a_step_is_a_pixel_and_a_large_mesh_has_rows_for_hits_alone() -> None:
    small = trace(make_scene("intersecting"), BY_PIXEL).stage("depth").steps
    assert len(small.boundaries(Level.GROUP)) - 1 == 64 * 48 + 1
    assert small.row_count == 64 * 48 * 2 + 1
    sphere = replace(make_scene("sphere"), size=(40, 30))
    traced = trace(sphere, BY_PIXEL)
    found = traced.stage("depth")
    assert 40 * 30 * len(traced.source.geometry.primitives) > MOST_ASKED
    assert found.steps.row_count == len(traced.source.fragments) + 1
    assert not found.constants["lists_misses"]


def test_the_fast_path_draws_the_same_bytes() -> None:
    scene = SCENES["clip"]
    assert np.array_equal(draw_picture(scene, BY_PIXEL).pixels, draw_picture(scene, BY_TRIANGLE).pixels)
