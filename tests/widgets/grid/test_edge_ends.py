"""Edges that end behind the eye."""

import numpy as np
import pytest

from app.pages.step.grid_records import geometry_of
from app.session.document import open_document
from app.session.moment import Cursor, Step
from lessons.scenes import make_scene
from widgets.grid.geometry import FAR, edge_segments
from widgets.grid.view import clip_segments


@pytest.mark.parametrize(
    ("end", "direction"),
    [((3.0, 1.0, 0.0), (3.0, 1.0)), ((-6.0, 2.0, -2.0), (-4.0, 4.0)), ((np.nan,) * 3, None)],
)
def test_an_edge_goes_on_to_a_vertex_behind_the_eye(
    end: tuple[float, float, float], direction: tuple[float, float] | None
) -> None:
    vertices = np.array([[1.0, 1.0], [np.nan, np.nan]])
    behind = np.array([[np.nan] * 3, end])
    segments = edge_segments(vertices, behind, np.array([[0, 1], [1, 0]]))
    np.testing.assert_array_equal(segments[0], segments[1, ::-1])
    if direction is None:
        assert np.isnan(segments[0, 1]).all()
    else:
        np.testing.assert_allclose(
            segments[0, 1], 1 + np.array(direction) / np.linalg.norm(direction) * FAR, rtol=1e-12
        )


def test_drawn_edges_bound_the_pixels_of_a_triangle_that_crosses_the_near_plane() -> None:
    document = open_document(make_scene("near-plane"), "near-plane")
    trace = document.make_trace(document.settings)
    geometry = geometry_of(Step(trace, Cursor("raster")))
    stage = trace.stage("raster")
    covered = np.unique(stage.pixel[stage.columns["covered"] == 1], axis=0)
    a, b, c = geometry.triangles[0].tolist()
    pieces, _ = clip_segments(geometry.edges(np.array([[a, b], [b, c]])), (0.0, 0.0, 64.0, 48.0))
    for row in (0, 5, 10):
        in_row = covered[covered[:, 1] == row, 0]
        ends = [
            start[0] + (stop[0] - start[0]) * (row + 0.5 - start[1]) / (stop[1] - start[1])
            for start, stop in pieces
            if min(start[1], stop[1]) <= row + 0.5
        ]
        inside = [
            x
            for x in np.arange(64)
            if min(ends) <= x + 0.5 <= max([*ends[1:], 64.0 if len(ends) < 2 else 0.0])
        ]
        np.testing.assert_array_equal(in_row, inside)
