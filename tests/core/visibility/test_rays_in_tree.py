"""Rays with a tree of boxes draw what rays without one draw, and ask less."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from core import ClipScene, Settings, render, trace
from core.methods import table
from core.pixel_history import why
from core.records.box_tree import BoxTree
from core.visibility.rays_in_tree import _largest_below, meet_box, slabs, walk_tree
from lessons.scenes import make_scene
from tests.core.culling.test_object_culling import PLACE, SIDES, boxes_scene
from tests.core.strategies import clip_of_window, homogeneous_triangles

HIERARCHIES = table.names("hierarchy")
FRAMES = ("color", "depth", "primitive")


def assert_same_picture(scene, hierarchy: str, **chosen) -> None:
    plain = render(scene, Settings(visibility="ray-casting", **chosen))
    found = render(
        scene,
        Settings(visibility="ray-casting-tree", hierarchy=hierarchy, leaf_size=1, octree_depth=2, **chosen),
    )
    for name in FRAMES:
        assert np.array_equal(getattr(plain, name), getattr(found, name), equal_nan=True), (hierarchy, name)


@settings(max_examples=25)
@given(homogeneous_triangles(6), st.sampled_from(HIERARCHIES), st.sampled_from(["none", "msaa-4", "ssaa-4"]))
def test_any_signs_of_w(drawn, hierarchy: str, antialiasing: str) -> None:
    clip, size = drawn
    colors = np.random.default_rng(0).random((len(clip), 3, 4))
    assert_same_picture(ClipScene(clip, colors, size), hierarchy, antialiasing=antialiasing)


@settings(max_examples=15)
@given(
    st.lists(st.tuples(PLACE, SIDES), min_size=1, max_size=5),
    st.sampled_from(["perspective", "orthographic"]),
    st.sampled_from(HIERARCHIES),
)
def test_boxes_around_the_eye_flat_or_points(boxes, projection: str, hierarchy: str) -> None:
    assert_same_picture(boxes_scene(boxes, projection), hierarchy)


def test_a_whole_mesh_with_other_centres_and_clipping() -> None:
    scene = replace(make_scene("sphere"), size=(48, 36))
    for hierarchy in HIERARCHIES[1:]:
        assert_same_picture(scene, hierarchy, pixel_center="integer", clipping="sutherland-hodgman")


def test_of_equally_near_triangles_the_first_one_stays() -> None:
    triangle = [[-0.9, -0.8, 0.25, 1.0], [0.9, -0.7, 0.5, 1.0], [0.1, 0.9, -0.25, 1.0]]
    scene = ClipScene(np.array([triangle] * 5), np.random.default_rng(1).random((5, 3, 4)), (9, 7))
    for hierarchy in HIERARCHIES:
        assert_same_picture(scene, hierarchy)


@pytest.mark.parametrize("hierarchy", HIERARCHIES)
def test_a_ray_meets_the_box_of_a_triangle_that_snapping_moves_over_it(hierarchy: str) -> None:
    # The left edge lies right of the centres at 2.5, by less than snapping moves it: they are covered.
    left = 2.5 + 1 / 1024
    scene = ClipScene(clip_of_window([[(left, 1), (6, 1), (left, 6)]], (8, 8)), size=(8, 8))
    assert (render(scene).primitive[:, 2] == 0).any()
    assert_same_picture(scene, hierarchy)


@given(st.lists(st.sampled_from([0.0, 1.0, 2.0, -1.0]), min_size=12, max_size=12))
def test_a_ray_meets_a_box_where_some_point_of_it_lies_inside(numbers) -> None:
    origin, direction, one, other = np.array(numbers).reshape(4, 3)
    assume(direction.any())
    low, high = np.minimum(one, other), np.maximum(one, other)
    enter, leave = meet_box(origin, direction, low, high, 0.0)
    near, far = slabs(*(values[:, None] for values in (origin, direction, low, high)))
    assert (max(near.max(), 0.0), far.min()) == (enter, leave)
    # All planes lie at multiples of 1/2, if at all: between two of them nothing changes.
    t = np.arange(0, 8.25, 0.25)[:, None]
    inside = ((origin + t * direction >= low) & (origin + t * direction <= high)).all(axis=1)
    assert (enter <= leave) == inside.any()


@pytest.fixture(scope="module")
def traced():
    scene = replace(make_scene("cube"), size=(16, 12))
    return trace(scene, Settings(visibility="ray-casting-tree", leaf_size=2))


def test_the_listings_walk_as_the_rows_do(traced) -> None:
    found, c = traced.stage("depth"), traced.stage("depth").columns
    tree = traced.source.geometry.object_tree.tree
    boxes = [
        (int(tree.subtree_end[k]), tree.items_of(k).tolist() if tree.is_leaf[k] else [])
        for k in range(len(tree))
    ]
    kinds = np.array(found.steps.kinds)[found.steps.kind]
    for column, row in np.unique(found.pixel, axis=0).tolist():
        rows = found.rows_at_pixel(column, row)
        asked = rows[c["is_box"][rows]]
        hits = rows[~c["is_box"][rows] & (kinds[rows] != "tree-hidden")]
        visited = {int(c["node"][each]): each for each in asked}
        nearer = {int(found.triangle[each]): bool(c["passes"][each]) for each in hits}
        walked = []

        def meets_box(node, visited=visited, walked=walked) -> bool:
            walked.append(node)
            each = visited[node]
            ray = c["ray_origin"][each], c["ray_direction"][each]
            way = meet_box(*ray, c["node_lower"][each], c["node_upper"][each], 0.0)
            assert way == (c["enter_z"][each], c["leave_z"][each])
            return way[0] <= way[1]

        seen = walk_tree(
            boxes,
            meets_box,
            lambda node, _, visited=visited: kinds[visited[node]] == "tree-behind",
            nearer.__contains__,
            lambda triangle, _, nearer=nearer: nearer[triangle],
        )
        assert walked == c["node"][asked].tolist()
        last = found.state(found.steps.count)["primitive"][row, column]
        assert seen == last


def test_rows_fold_to_the_picture_and_less_is_asked(traced) -> None:
    found, frame = traced.stage("depth"), render(traced.source.scene, traced.source.settings)
    last = found.state(found.steps.count)
    assert np.array_equal(last["primitive"], frame.primitive)
    assert np.array_equal(last["depth"], frame.depth)
    scene = replace(make_scene("sphere"), size=(16, 12))
    for hierarchy in ("bvh", "bvh-area", "octree"):
        run = trace(scene, Settings(visibility="ray-casting-tree", hierarchy=hierarchy))
        walk = run.source.exact_tests.walk
        assert walk.asked_count.mean() < 120
        assert walk.box_count.mean() < 220


def test_the_history_of_a_pixel_names_the_node_that_hides() -> None:
    scene = replace(make_scene("cube"), size=(32, 24))
    run = trace(scene, Settings(visibility="ray-casting-tree", leaf_size=2))
    hidden = run.source.exact_tests.walk.hidden_in >= 0
    assert hidden.any()
    at = int(np.flatnonzero(run.source.depths[1])[hidden][0])
    fragments = run.source.fragments
    history = why(run.source, int(fragments.column[at]), int(fragments.row[at]))
    links = {event.triangle: event.link("depth") for event in history.fragments}
    link = links[int(run.source.triangle_of_fragment[at])]
    assert link.key == "ray-hidden"
    assert int(link.values["node"]) in range(len(run.source.geometry.object_tree.tree))
    kept = [event for event in history.fragments if not event.is_rejected]
    assert [event.triangle for event in kept] == [
        int(render(scene).primitive[fragments.row[at], fragments.column[at]])
    ]


def test_a_node_has_the_largest_value_of_what_is_in_it() -> None:
    # A root of two leaves, the second one empty, and a leaf beside it; object 1 lies in two leaves.
    tree = BoxTree(
        np.zeros((4, 3)),
        np.ones((4, 3)),
        np.array([3, 2, 3, 4]),
        np.array([0, 0, 2, 2, 4]),
        np.array([0, 1, 1, 2]),
    )
    values = np.array([-3.0, -5.0, 4.0])
    expected = [max((values[item] for item in tree.items_of(node)), default=0.0) for node in range(len(tree))]
    assert _largest_below(tree, values).tolist() == expected == [-3.0, -3.0, 0.0, 4.0]
