"""Clipping after the division by w: right in front of the eye, mirrored behind it; new corners A-B against B-A."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, draw_triangles, render, trace
from core.clipping.planes import PolygonClipping, clip_divided
from core.clipping.sutherland_hodgman import ALL_PLANES, clip_polygons
from core.clipping.traced import DIVIDE_OPERATIONS
from core.culling.culling import plane_distances
from core.methods import table
from core.records.primitives import Primitives
from core.records.steps import Level
from tests.core.strategies import ANY_TRIANGLES, perspective_triangles

SIZE = (24, 18)
DIVIDING = ["after-divide", "project-first"]
THROUGH_THE_EYE = [[[-0.5, -0.5, 0.1, 1.0], [1.0, 1.5, 0.2, 2.0], [0.3, 0.2, 0.4, -0.5]]]
"""The last corner is behind the eye."""


def picture(clip, clipping: str, size=SIZE, **choices) -> np.ndarray:
    values = np.tile(np.eye(3), (len(clip), 1, 1))
    return draw_triangles(
        clip, *size, attributes=values, settings=Settings(clipping=clipping, **choices)
    ).color


def clipped(clip, values=None, planes=ALL_PLANES):
    clip = np.asarray(clip, float)
    varyings = np.zeros((len(clip), 3, 0)) if values is None else np.asarray(values, float)
    primitives = Primitives(clip, varyings, np.arange(len(clip)), np.zeros(len(clip), np.int64), {})
    return clip_divided(primitives, plane_distances(clip), planes)


@given(perspective_triangles(2), st.sampled_from(DIVIDING))
def test_in_front_of_the_eye_it_draws_what_the_others_draw(case, clipping) -> None:
    clip, size = case
    ours, right = (picture(clip, name, size) for name in (clipping, "sutherland-hodgman"))
    # New corners are snapped again: at sides and borders a few pixels may differ.
    differing = (np.abs(ours - right) > 2e-3).any(axis=2)
    assert np.count_nonzero(differing) <= 12


def test_in_front_of_the_eye_values_are_in_perspective() -> None:
    clip = [[[-2.0, -1.0, 0.2, 1.0], [6.0, -3.0, 1.0, 4.0], [0.0, 1.5, 0.5, 2.0]]]
    values = [[[0.0], [1.0], [5.0]]]
    pieces = clipped(clip, values).primitives
    weights = pieces.clip.reshape(-1, 4) @ np.linalg.pinv(np.array(clip[0]))
    assert len(pieces) > 1
    assert np.allclose(weights @ np.array(values[0]), pieces.varyings.reshape(-1, 1), atol=1e-12)
    assert np.allclose(weights.sum(axis=1), 1)


@pytest.mark.parametrize("clipping", DIVIDING)
def test_behind_the_eye_it_draws_the_wrong_triangle(clipping: str) -> None:
    right = picture(THROUGH_THE_EYE, "homogeneous")
    assert np.count_nonzero((picture(THROUGH_THE_EYE, "sutherland-hodgman") != right).any(axis=2)) <= 4
    wrong = picture(THROUGH_THE_EYE, clipping)
    assert np.count_nonzero((wrong != right).any(axis=2)) > 40


def test_a_corner_behind_the_eye_is_mirrored_through_it() -> None:
    found = clipped(THROUGH_THE_EYE, planes=()).primitives
    assert np.allclose(found.clip[0, 2], -np.array(THROUGH_THE_EYE[0][2]))
    assert np.allclose(found.clip[0, :2], THROUGH_THE_EYE[0][:2])
    assert (clipped(THROUGH_THE_EYE).primitives.clip[..., 3] > 0).all()


@pytest.mark.parametrize("clipping", DIVIDING)
def test_several_corners_that_cannot_be_divided_make_no_noise(clipping: str) -> None:
    clip = [
        [[0.0, 0.125, 0.0, 0.0], [0.0, 0.0, 0.0, 0.25], [0.125, 0.0, 0.0, -3.0]],
        [[1.0, 1.0, 0.0, 0.0]] * 3,
    ]
    assert (picture(clip, clipping)[..., :3] == 0).all()
    assert not clipped(clip).primitives.clip.size


@pytest.mark.parametrize(
    ("clipping", "w"), [("after-divide", 0.0), ("project-first", -0.0), ("after-divide", 1e-320)]
)
def test_a_w_that_cannot_be_divided_by_leaves_the_triangle_out(clipping: str, w: float) -> None:
    clip = [[[-1.0, -1.0, 0.0, 1.0], [1.0, -1.0, 0.0, 1.0], [0.0, 1.0, 0.0, w]]]
    scene = ClipScene(np.array(clip), size=SIZE)
    frame = render(scene, Settings(clipping=clipping))
    assert (frame.primitive == -1).all()
    found = trace(scene, Settings(clipping=clipping)).stage("clip")
    assert [found.kind_of(row) for row in range(found.steps.row_count)] == ["undefined"] * 3


@given(ANY_TRIANGLES, st.sampled_from(DIVIDING), st.sampled_from(["fill", "wireframe"]))
def test_any_signs_of_w_never_crash(case, clipping, mode) -> None:
    clip, size = case
    settings = Settings(clipping=clipping, polygon_mode=mode)
    scene = ClipScene(clip, size=size)
    frame = render(scene, settings)
    assert np.array_equal(frame.color, render(scene, settings).color)
    found = trace(scene, settings).stage("clip")
    for level in Level:
        boundaries = found.steps.boundaries(level).tolist()
        assert [found.steps.forward(b, level) for b in boundaries[:-1]] == boundaries[1:]
        assert [found.steps.back(b, level) for b in boundaries[1:]] == boundaries[:-1]


def test_the_trace_divides_every_corner_before_the_first_plane() -> None:
    found = trace(ClipScene(np.array(THROUGH_THE_EYE), size=SIZE), Settings(clipping="after-divide")).stage(
        "clip"
    )
    kinds = [found.kind_of(row) for row in range(found.steps.row_count)]
    assert kinds[:3] == ["divided", "divided", "mirrored"]
    assert not set(kinds[3:]) & set(DIVIDE_OPERATIONS)
    assert found.columns["number"][:3].tolist() == [0, 1, 2]
    assert np.allclose(found.columns["ndc"][2], np.array([0.3, 0.2, 0.4]) / -0.5)
    assert (found.columns["start"][3:, 3] == 1).all()


# The direction in which new corners are computed


def new_corners(ends: np.ndarray, is_canonical: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return the new corners on edges (Q, 2, 4) gone along from A to B, and from B to A."""
    third = np.broadcast_to([0.0, 0.0, 0.0, 1.0], (len(ends), 1, 4))
    found = []
    for polygon in (np.concatenate([ends, third], axis=1), np.concatenate([ends[:, ::-1], third], axis=1)):
        _, _, rows = clip_polygons(polygon, np.full(len(ends), 3), 3, is_canonical)
        found.append(rows.corner[rows.edge == 0])
    return found[0], found[1]


def test_only_canonical_corners_are_the_same_from_both_sides() -> None:
    generator = np.random.default_rng(6)
    ends = generator.uniform(-1, 1, (2000, 2, 4))
    ends[..., 3] += 2
    ends[:, 1, 0] += 6
    there, back = new_corners(ends, is_canonical=True)
    assert np.isfinite(there).all()
    assert np.array_equal(there, back)
    there, back = new_corners(ends, is_canonical=False)
    assert 0.1 < (there != back).any(axis=1).mean() < 1
    assert np.allclose(there, back, rtol=0, atol=1e-14)


def test_the_table_says_which_methods_are_canonical() -> None:
    ways: dict[str, PolygonClipping] = {
        name: table.get("clipping", name).function() for name in table.names("clipping")
    }
    assert [name for name, way in ways.items() if not way.is_canonical] == ["sutherland-hodgman-lecture"]
    assert [name for name, way in ways.items() if way.divides] == DIVIDING
