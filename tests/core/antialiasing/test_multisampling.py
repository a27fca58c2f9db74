"""Multisampling: laws; the comparison with OpenGL is in tests/oracle."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given

from core import ClipScene, Settings, render
from core.antialiasing.sampling import ROTATED_GRID
from core.methods import table
from tests.core.exact_reference import edge_signs, facing
from tests.core.strategies import ANY_TRIANGLES
from tests.core.trace.trace_cases import CHOICES, MIXES, SCENES, name_of, settings_of
from tests.covering import every_nth, in_turn

EXACT_FILLS = [name for name in table.names("fill") if not table.get("fill", name).breaks_where]


def exact_sample(lines, x: Fraction, y: Fraction) -> bool:
    """Decide whether a point is inside, moved an infinitesimal step right, then up."""
    for a, b, c in lines:
        value = a * x + b * y + c
        if value < 0 or (value == 0 and not (a > 0 or (a == 0 and b > 0))):
            return False
    return True


@given(ANY_TRIANGLES)
def test_coverage_of_every_sample_is_the_rational_one(drawn):
    clip, (width, height) = drawn
    for triangle in clip:
        if (np.asarray(triangle)[:, 3] <= 0).any():
            continue
        scene = ClipScene([triangle], size=(width, height))
        count = render(scene, Settings(antialiasing="msaa-4", visibility="last-drawn")).samples.primitive
        in_range = (np.abs(np.asarray(triangle)[:, 2]) <= np.asarray(triangle)[:, 3]).all()
        if not in_range or facing(triangle, (width, height)) == 0:
            continue
        if (np.abs(np.asarray(triangle)[:, :2] / np.asarray(triangle)[:, 3:]) > 2**10).any():
            continue
        lines = edge_signs(triangle, (width, height))
        for sample, (x, y) in enumerate(ROTATED_GRID):
            for row in range(height):
                for column in range(width):
                    inside = exact_sample(lines, column + Fraction(x), row + Fraction(y))
                    assert (count[sample, row, column] == 0) == inside


@pytest.mark.parametrize("fill", EXACT_FILLS)
@pytest.mark.parametrize("name", ["clip", "lit", "textured-clip"])
def test_every_fill_draws_the_same_samples(name, fill):
    usual = render(SCENES[name], Settings(antialiasing="msaa-4"))
    frame = render(SCENES[name], Settings(antialiasing="msaa-4", fill=fill))
    for buffer in ("color", "depth", "primitive", "cover_count"):
        assert np.array_equal(getattr(frame.samples, buffer), getattr(usual.samples, buffer))


@pytest.mark.parametrize(
    ("name", "choice"),
    every_nth(in_turn(["clip", "lit", "orthographic"], [*CHOICES, *MIXES]), 3),
    ids=name_of,
)
def test_a_pixel_that_one_triangle_fills_looks_as_without(name, choice):
    scene = SCENES[name]
    settings = settings_of(choice | {"antialiasing": "msaa-4", "resolve_filter": "box"}, scene)
    frame = render(scene, settings)
    plain = render(scene, replace(settings, antialiasing="none"))
    samples = frame.samples
    alike = (samples.primitive == plain.primitive).all(axis=0) & (
        samples.cover_count == plain.cover_count
    ).all(axis=0)
    alike &= plain.cover_count <= 1
    # Over several layers the samples may differ in what lies below; over one there is one colour.
    assert np.array_equal(frame.color[alike], plain.color[alike], equal_nan=True)


@pytest.mark.parametrize("blend", ["opaque", "over"])
def test_lines_cover_all_samples_of_their_pixels(blend):
    choice = {"polygon_mode": "wireframe", "blend": blend}
    frame = render(SCENES["lit"], Settings(antialiasing="msaa-4", **choice))
    plain = render(SCENES["lit"], Settings(**choice))
    assert (frame.samples.primitive == plain.primitive).all()
    assert np.array_equal(frame.color, plain.color)
    assert (plain.primitive >= 0).any()


def test_colour_is_shaded_once_for_a_triangle_in_a_pixel():
    scene = SCENES["lit"]
    frame = render(scene, Settings(antialiasing="msaa-4"))
    pairs = {
        (int(identity), row, column)
        for sample in frame.samples.primitive
        for (row, column), identity in np.ndenumerate(sample)
        if identity >= 0
    }
    assert frame.statistics["shade"].outgoing == len(pairs)


def test_attributes_are_those_of_the_centre_even_outside():
    # The left half of a pixel: its centre lies on the edge, and its two left samples take the centre's value.
    clip = [[[-1, -1, 0, 1], [0, -1, 0, 1], [0, 1, 0, 1]], [[-1, -1, 0, 1], [0, 1, 0, 1], [-1, 1, 0, 1]]]
    red = np.zeros((2, 3, 4))
    red[..., 3] = 1
    red[:, :, 0] = [[0, 1, 1], [0, 1, 0]]
    frame = render(ClipScene(clip, red, (1, 1)), Settings(antialiasing="msaa-4"))
    assert frame.samples.primitive[:, 0, 0].tolist().count(-1) == 2
    assert frame.samples.color[0, 0, 0].tolist() == [1, 0, 0, 1]
    assert frame.color[0, 0].tolist() == [0.5, 0, 0, 0.5]


def test_shared_edges_are_drawn_once_at_every_sample():
    grid = np.random.default_rng(4).uniform(-0.03, 0.03, (5, 5, 2)) + np.stack(
        np.meshgrid(np.linspace(-1.2, 1.2, 5), np.linspace(-1.2, 1.2, 5)), axis=2
    )
    corners = np.concatenate([grid, np.zeros((5, 5, 1)), np.ones((5, 5, 1))], axis=2)
    triangles = []
    for row in range(4):
        for column in range(4):
            a, b = corners[row, column], corners[row, column + 1]
            c, d = corners[row + 1, column], corners[row + 1, column + 1]
            triangles += [[a, b, d], [a, d, c]]
    scene = ClipScene(np.array(triangles), size=(16, 13))
    for antialiasing in ("msaa-4", "ssaa-4", "ssaa-16"):
        assert (render(scene, Settings(antialiasing=antialiasing)).samples.cover_count == 1).all()
    assert np.allclose(render(scene, Settings(antialiasing="area")).color[..., 3], 1, atol=1e-7)
