"""Names over a picture lie on nothing that is to be read, as far as there is room."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from PySide6.QtCore import QRect

from widgets.basics.theme import LIGHT
from widgets.grid.geometry import GridGeometry
from widgets.grid.names import name_boxes
from widgets.grid.view import GridView, place

pytestmark = pytest.mark.usefixtures("qapp")


@example([(24, 24), (24, 24), (24, 24)])
@example([(0, 0), (0, 0), (4, 0)])
@given(st.lists(st.tuples(st.integers(0, 24), st.integers(0, 24)), min_size=3, max_size=3))
def test_names_of_vertices_and_edges_never_lie_on_each_other(corners: list[tuple[int, int]]) -> None:
    geometry = GridGeometry(np.array(corners) / 2, np.array([[0, 1, 2]]))
    placement = place(12, 12, QRect(0, 0, 600, 600), GridView())
    boxes = [box for box, _, _ in name_boxes(placement, geometry, LIGHT)]
    assert not any(one.intersects(other) for one, other in combinations(boxes, 2))
