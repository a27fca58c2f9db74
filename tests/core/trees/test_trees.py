"""Laws of trees of boxes, and their listings: random boxes, flat ones, equal ones, none."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.methods import table
from core.numeric.watched import AbandonedError, watched, work
from core.records.box_tree import BoxTree, Objects, checked_objects
from core.trees.bounding_volumes import area_tree, median_tree, mesh_list
from core.trees.expected import expected_build
from core.trees.octree import MOST_REFERENCES, octree_listing

TREES = {"none": mesh_list, "bvh": median_tree, "bvh-area": area_tree, "octree": octree_listing}
NUMBER = st.integers(-4, 4).map(lambda n: n / 2)
CORNER = st.tuples(NUMBER, NUMBER, NUMBER)
BOXES = st.lists(st.tuples(CORNER, CORNER, st.integers(0, 2)), max_size=14)


def objects_of(boxes) -> Objects:
    boxes = sorted(boxes, key=lambda box: box[2])
    corners = np.array([box[:2] for box in boxes], float).reshape(-1, 2, 3)
    return checked_objects(
        corners.min(axis=1), corners.max(axis=1), np.array([box[2] for box in boxes], np.int64)
    )


def grown(name: str, objects: Objects, leaf_size: int = 2, octree_depth: int = 3) -> BoxTree:
    return table.get("hierarchy", name).function(objects, leaf_size, octree_depth)


@given(BOXES, st.integers(1, 4))
def test_laws_of_every_tree(boxes, leaf_size: int) -> None:
    objects = objects_of(boxes)
    for name in TREES:
        tree = grown(name, objects, leaf_size)
        leaves = [tree.items_of(node) for node in np.flatnonzero(tree.is_leaf)]
        listed = Counter(int(item) for items in leaves for item in items)
        assert set(listed) == set(range(len(objects))), "every object in a leaf"
        assert name == "octree" or set(listed.values()) <= {1}, "in exactly one"
        for node in range(len(tree)):
            parts = tree.children(node)
            assert all(tree.depth[child] == tree.depth[node] + 1 for child in parts)
            assert sorted(tree.items_of(node)) == sorted(
                i for part in parts or [node] for i in tree.items_of(part)
            )
            inside = [*parts] if name == "octree" else list(range(node, tree.subtree_end[node]))
            assert (tree.lower[inside] >= tree.lower[node]).all(), "a box holds those of its subtree"
            assert (tree.upper[inside] <= tree.upper[node]).all()
            if name != "octree":
                held = tree.items_of(node)
                assert (tree.lower[node] == objects.lower[held].min(axis=0)).all(), "and no more"
                assert (tree.upper[node] == objects.upper[held].max(axis=0)).all()


@given(BOXES, st.integers(1, 4))
def test_the_listing_gives_the_nodes(boxes, leaf_size: int) -> None:
    objects = objects_of(boxes)
    lower, upper = objects.lower.tolist(), objects.upper.tolist()
    for name, listed in TREES.items():
        last = {"none": (objects.mesh.tolist(),), "octree": (leaf_size, 3)}.get(name, (leaf_size,))
        tree = grown(name, objects, leaf_size)
        own = [tree.items_of(k).tolist() if tree.is_leaf[k] else [] for k in range(len(tree))]
        nodes = zip(tree.lower.tolist(), tree.upper.tolist(), tree.depth.tolist(), own, strict=True)
        assert listed(lower, upper, *last) == list(nodes), name


@given(BOXES)
def test_cells_of_an_octree_fill_the_cube_and_list_what_touches_them(boxes) -> None:
    objects = objects_of(boxes)
    tree = grown("octree", objects)
    leaves = np.flatnonzero(tree.is_leaf)
    volume = (tree.upper - tree.lower).prod(axis=1)
    assert not len(tree) or volume[leaves].sum() == volume[0]
    for leaf in leaves:
        touches = (objects.lower <= tree.upper[leaf]) & (objects.upper >= tree.lower[leaf])
        assert sorted(tree.items_of(leaf)) == np.flatnonzero(touches.all(axis=1)).tolist()


@pytest.mark.parametrize("name", ["bvh", "bvh-area", "octree"])
def test_building_ends_where_no_cut_parts_the_objects(name: str) -> None:
    spot = np.zeros((100, 3))
    tree = grown(name, checked_objects(spot, spot), 1, 4)
    assert len(tree) == (199 if name != "octree" else 1 + 8 * (1 + 8 + 64 + 512))
    assert tree.items_of(0).tolist()[:2] == [0, 1]
    assert len(grown(name, checked_objects(spot[:0], spot[:0]))) == 0
    assert len(grown(name, checked_objects(spot[:1], spot[:1]), 1)) == 1


def test_wrong_boxes_and_too_many_references_are_named() -> None:
    with pytest.raises(ValueError, match=r"lower must be finite, got nan at \(0, 1\)"):
        checked_objects(np.array([[0, np.nan, 0]]), np.zeros((1, 3)))
    with pytest.raises(ValueError, match=r"must not lie above upper, .* for box 1"):
        checked_objects(np.array([[0.0] * 3, [1, 0, 0]]), np.zeros((2, 3)))
    low = np.zeros((20_000, 3))
    with pytest.raises(ValueError, match=f"may list {MOST_REFERENCES:,} objects, .*: lower octree_depth"):
        grown("octree", checked_objects(low, low + 1), 1, 8)


@pytest.mark.parametrize("name", ["bvh", "bvh-area", "octree"])
def test_building_reports_how_far_it_is_and_ends_where_it_is_cancelled(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("core.numeric.watched.PAUSE", 0.0)
    low = np.random.default_rng(0).random((200, 3))
    objects, told = checked_objects(low, low + 0.01), list[float]()
    with watched(lambda fraction, _: told.append(fraction or 0.0)), work("building"):
        tree = grown(name, objects)
    assert len(told) > 5
    assert told == sorted(told)
    assert 0.5 < told[-1] <= 1
    asked = iter(range(4))
    with watched(None, lambda: next(asked) == 3), pytest.raises(AbandonedError):
        grown(name, checked_objects(low, low + 0.01))
    again = grown(name, objects)
    assert np.array_equal(again.items, tree.items)


def test_what_a_tree_takes_is_known_before() -> None:
    few, many = (expected_build("bvh-area", count, 8, 5) for count in (1_000, 100_000))
    assert few.text == ""
    assert many.text == "building a tree of 100,000 triangles, about 1 s and 36 MB"
    assert expected_build("octree", 100_000, 8, 5).byte_count > 4_193_792
    assert expected_build("none", 100_000, 8, 5).text == ""
