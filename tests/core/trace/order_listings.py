"""The listings of the drawing order, executed on the rows: the painter's sort, and the BSP tree."""

import numpy as np

from core.trace.stage_trace import StageTrace
from core.visibility.bsp import cut_piece, distance_of, eye_side, plane_of, side_of
from core.visibility.painters import far_to_near
from tests.core.trace.executed_rows import rows_of_kind


def check_sort(found: StageTrace) -> None:
    """Sort again: depths, sums, and the order that swaps and places lead to."""
    c = found.columns
    kinds = np.array([found.kind_of(row) for row in range(found.steps.row_count)])
    rows = np.flatnonzero(np.isin(kinds, ["distance", "swap", "place"])).tolist()
    depths = [c["depths"][row].tolist() for row in rows if kinds[row] == "distance"]
    order: list[int] = []
    for row in rows:
        triangle, place = int(found.triangle[row]), int(c["place"][row])
        first, second, third = depths[triangle]
        assert c["distance"][row] == first + second + third
        if found.kind_of(row) == "distance":
            assert place == len(order)
            order.append(triangle)
        elif found.kind_of(row) == "swap":
            assert order[place] == c["other"][row]
            assert order[place + 1] == triangle
            assert c["distance"][row] > c["other_distance"][row]
            order[place : place + 2] = [triangle, order[place]]
        else:
            assert order[place] == triangle
            assert c["other"][row] == (order[place - 1] if place else -1)
            assert not place or c["distance"][row] <= c["other_distance"][row]
    for kind in ("distance", "swap", "place"):
        for _ in rows_of_kind(found, kind):
            assert order == far_to_near(depths)


def check_tree(found: StageTrace) -> None:
    """Compute planes, distances, sides, cuts and the eye's sides again."""
    c, tree = found.columns, found.extra["tree"]
    for row in rows_of_kind(found, "root"):
        corners = tree.clip[int(found.triangle[row])].tolist()
        assert list(plane_of(*corners)) == c["plane"][row].tolist()
    for side in ("on", "front", "back", "cut"):
        for row in rows_of_kind(found, side):
            corners, plane = c["clip"][row], c["plane"][row].tolist()
            d = [distance_of(corner, plane) for corner in corners.tolist()]
            assert d == c["distances"][row].tolist()
            assert side_of(d) == side == c["side"][row]
            if side == "cut":
                front, back = cut_piece(corners, d)
                assert (len(front) - 2, len(back) - 2) == (c["made_front"][row], c["made_back"][row])
                new = [corner for corner in front if any(corner is other for other in back)]
                new = [corner for corner in new if not any(np.array_equal(corner, old) for old in corners)]
                assert np.array_equal(new[0], c["corner"][row])
    places = [int(c["place"][row]) for kind in ("flat", "walk") for row in rows_of_kind(found, kind)]
    assert places == sorted(places)
    for row in rows_of_kind(found, "walk"):
        assert eye_side(c["plane"][row].tolist()) == c["eye_side"][row]
        assert tree.node[tree.drawn[c["place"][row]]] == c["node"][row]
