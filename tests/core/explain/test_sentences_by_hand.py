"""Sentences of a few steps whose numbers were worked out by hand."""

import re
from functools import cache

import numpy as np
import pytest

from core import ClipScene, Settings, trace
from core.explain import formula, sentence
from core.trace import Explanation, pixel_cuts
from lessons.scenes import make_scene
from lessons.slides.scenes import ALL_SCENES
from tests.core.explain.explained_steps import rare_trace

# The triangle with window corners (1, 1), (7, 1), (1, 7) on 8 x 8 pixels, by hand:
# E0 = -6 x - 6 y + 48 (right edge), E1 = 6 x - 6 (left edge), E2 = 6 y - 6 (level bottom edge).


@cache
def said(stage: str, settings: Settings, name: str = "grid-ties") -> dict[str, list[str]]:
    """Return all sentences of a stage by key."""
    traced = rare_trace(name, settings).stage(stage)
    found: dict[str, list[str]] = {}
    for position in range(1, traced.steps.count + 1):
        explanation = traced.explain(position)
        row, _ = traced.steps.row_at(position)
        column, line = (int(value) for value in traced.pixel[row])
        assert explanation is not None
        text = sentence(explanation, int(traced.triangle[row]), (column, line))
        found.setdefault(explanation.key, []).append(text)
    return found


BRUTE_FORCE = Settings(fill="brute-force")
AREA = Settings(antialiasing="area")
CORNER_CENTRES = Settings(fill="brute-force", pixel_center="integer")


@pytest.mark.parametrize(
    ("stage", "key", "settings", "expected"),
    [
        (
            "raster",
            "raster.test.decide",
            BRUTE_FORCE,
            "Pixel (0, 3) is outside triangle 0: it lies 0.5 px beyond edge 1 (E1 = −3).",
        ),
        (
            "raster",
            "raster.test.decide",
            BRUTE_FORCE,
            "Pixel (0, 0) is outside triangle 0: it lies 0.5 px beyond edge 1 (E1 = −3) and it lies 0.5 px beyond "
            "edge 2 (E2 = −3).",
        ),
        (
            "raster",
            "raster.test.decide",
            BRUTE_FORCE,
            "Pixel (1, 2) is covered by triangle 0: it is inside all three edges, 0.5 px from the "
            "nearest, edge 1 (E1 = 3).",
        ),
        (
            "raster",
            "raster.test.decide",
            BRUTE_FORCE,
            "Pixel (3, 4) is not covered by triangle 0: its centre lies exactly on edge 0, which the triangle does not "
            "own "
            "because it is a right edge.",
        ),
        (
            "raster",
            "raster.test.decide",
            CORNER_CENTRES,
            "Pixel (1, 3) is covered by triangle 0: its centre lies exactly on edge 1, which the triangle owns because "
            "it is "
            "a left edge.",
        ),
        (
            "raster",
            "raster.test.decide",
            CORNER_CENTRES,
            "Pixel (3, 1) is covered by triangle 0: its centre lies exactly on edge 2, which the triangle owns because "
            "it is "
            "a level bottom edge.",
        ),
        (
            "raster",
            "raster.test.decide",
            Settings(fill="brute-force", fill_rule="inclusive"),
            "Pixel (3, 4) is covered by triangle 0: its centre lies exactly on edge 0, which the triangle owns because "
            "the "
            "inclusive rule counts every edge as inside.",
        ),
        (
            "raster",
            "raster.test.decide",
            Settings(fill="brute-force", pixel_center="integer", fill_rule="exclusive"),
            "Pixel (1, 3) is not covered by triangle 0: its centre lies exactly on edge 1, which the triangle does not "
            "own "
            "because the exclusive rule counts no edge as inside.",
        ),
        (
            "raster",
            "raster.test.edge-1",
            BRUTE_FORCE,
            "Pixel (0, 3): E1 of triangle 0 is −3 at its centre (0.5, 3.5), so it is outside edge 1 "
            "(−0.5 px); at corner 1 it is 2A = 36.",
        ),
        (
            "raster",
            "raster.test.edge-0",
            BRUTE_FORCE,
            "Pixel (3, 4): E0 of triangle 0 is 0 at its centre (3.5, 4.5): it lies exactly on edge 0, which the "
            "triangle does "
            "not own because it is a right edge.",
        ),
        (
            "raster",
            "raster.span.edge-0",
            Settings(fill="scanline"),
            "Row 2 of triangle 0 leaves through edge 0 at x = 5.5: the span ends there, or farther inside.",
        ),
        (
            "raster",
            "raster.span.edge-2",
            Settings(fill="scanline"),
            "Row 2 of triangle 0 runs along edge 2, and all of it is inside (E2 = 9).",
        ),
        (
            "raster",
            "raster.span.span",
            Settings(fill="scanline"),
            "Row 2 of triangle 0 is covered in columns 1 to 4: 4 pixels.",
        ),
        (
            "raster",
            "raster.lane.rows",
            Settings(fill="spans"),
            "Triangle 0 reaches from y = 1 to 7, and of the raster the centres of rows 1 to 6 lie between: 6 "
            "rows.",
        ),
        (
            "raster",
            "raster.lane-row.edge-0",
            Settings(fill="spans"),
            "Row 2 (level 1) crosses edge 0 of triangle 0, on the right, at column 5: the fraction 30 / 6, "
            "of which only the "
            "division is rounded.",
        ),
        (
            "raster",
            "raster.lane-row.start",
            Settings(fill="spans"),
            "Row 2 starts at column 1: the left bound is 0.5, and a guard of −2⁻³⁵ includes a centre exactly on "
            "it.",
        ),
        (
            "raster",
            "raster.lane-row.stop",
            Settings(fill="spans"),
            "Row 2 stops before column 5: the right bound is 5, and a guard of −2⁻³⁵ excludes a centre exactly "
            "on it.",
        ),
        (
            "raster",
            "raster.lane-row.place",
            Settings(fill="spans"),
            "Row 2 of triangle 0 is covered in columns 1 to 4: 4 pixels, which makes it span 1 of 5, sorted "
            "longest first.",
        ),
        (
            "raster",
            "raster.lane-row.stop",
            Settings(fill="spans"),
            "Row 6 stops where it starts: no centre lies between the bounds 0.5 and 1.",
        ),
        (
            "raster",
            "raster.pass.pass",
            Settings(fill="spans"),
            "Pixel (2, 2) is 1 pixel from its span's start, so pass 1 draws it, together with one of each "
            "of 3 others.",
        ),
        (
            "raster",
            "raster.pass.draw",
            Settings(fill="spans"),
            "Pixel (2, 2) is covered by triangle 0 without a test of its own, and its rank is 6: "
            "5 pixels of earlier passes "
            "and 1 pixel of this one are drawn before it.",
        ),
        (
            "depth",
            "depth.test.key",
            Settings(depth="fixed-38"),
            "Pixel (1, 2): its key is 0x2000100000 | 0x000001, the depth above the lower 24 bits, which hold "
            "the number of triangle 0 plus one.",
        ),
        (
            "depth",
            "depth.test.minimum",
            Settings(depth="fixed-38"),
            "Pixel (1, 2) passes: its key is less than the buffer's 0x4000100000 | 0x000000, of the empty "
            "buffer.",
        ),
        (
            "edges",
            "edges.edge.c",
            Settings(),
            "Edge 0 of triangle 0 (from corner 1 to corner 2): c is 48, the value of E0 at the window's origin.",
        ),
        (
            "edges",
            "edges.edge.a",
            Settings(),
            "Edge 0 of triangle 0 (from corner 1 to corner 2): a is −6, so E0 falls by 6 with every pixel "
            "to the right.",
        ),
        (
            "edges",
            "edges.orientation.area",
            Settings(),
            "Twice the signed area of triangle 0 is 36, above 0, so its edge functions are positive inside "
            "already.",
        ),
        (
            "bin",
            "bin.box.high",
            Settings(),
            "The box ends with column 6 and row 6, so 6 × 6 = 36 pixels may be covered.",
        ),
        (
            "bin",
            "bin.block.verdict",
            Settings(fill="blocks", block_size=2),
            "The block at column 6, row 6 (2 × 2 pixels) is rejected by edge 0 of triangle 0: even its "
            "greatest E0 there, "
            "−30, is outside.",
        ),
        (
            "bin",
            "bin.block.verdict",
            Settings(fill="blocks", block_size=2),
            "The block at column 2, row 2 (2 × 2 pixels) is accepted as a whole: even the least value of "
            "every "
            "edge function is inside.",
        ),
    ],
)
def test_hand_computed_sentences(stage: str, key: str, settings: Settings, expected: str) -> None:
    assert expected in said(stage, settings)[key]


def test_a_clipped_edge_gives_its_t() -> None:
    # Distances w + z of the corners: 1, 1 and -2.5, so t = 1 / 3.5.
    found = said("clip", Settings(clipping="sutherland-hodgman"), "through-eye")
    assert (
        "The edge leaves through the near plane at t = 0.2857 from its inside end, the start: "
        "that end is 1 inside, and the two ends are 3.5 apart."
    ) in found["clip.in-out.t"]
    assert found["clip.in-in.keep"][0] == "Both ends are inside the near plane, so the end is kept."


@pytest.mark.parametrize(
    ("name", "settings", "expected"),
    [
        (
            "all-behind",
            Settings(),
            "Triangle 0 is behind the eye and dropped: no corner has w above 0 (w = −1, −2 and −1).",
        ),
        (
            "outside-left",
            Settings(),
            "Triangle 0 is dropped: all its corners are outside the left plane (distances −2, −1 and −3).",
        ),
        ("degenerate", Settings(), "Triangle 0 is degenerate and dropped: twice its signed area is 0."),
        (
            "clockwise",
            Settings(cull="back"),
            "Triangle 0 is culled: twice its signed area is −64, below 0, so we see its back, which the "
            "cull setting drops.",
        ),
        ("clockwise", Settings(), "Triangle 0 is kept: none of the tests drops it."),
    ],
)
def test_culling_gives_its_reason(name: str, settings: Settings, expected: str) -> None:
    cull = said("cull", settings, name)
    assert expected == list(cull.values())[-1][-1]


def test_the_snapped_decision_and_the_unsnapped_weight_are_named_apart() -> None:
    # The left edge stands at x = 1.501 and is snapped to 1.5, where the centre of pixel (1, 3) lies.
    x, y = np.array([1.501, 7.0, 1.501]), np.array([1.0, 1.0, 7.0])
    clip = np.stack([x / 4 - 1, y / 4 - 1, np.zeros(3), np.ones(3)], axis=1)[None]
    raster = trace(ClipScene(clip, np.eye(3)[None], (8, 8)), Settings(fill="brute-force")).stage("raster")
    row = int(raster.rows_at_pixel(1, 3)[0])
    explanation = raster.explain(raster.steps.position_after(row))
    assert explanation is not None
    assert sentence(explanation, 0, (1, 3)) == (
        "Pixel (1, 3) is covered by triangle 0: its centre lies exactly on edge 1, which the triangle owns because it "
        "is a left "
        "edge; E1 (snapped) decides, though weight λ1 (unsnapped) is −0.0001819."
    )


def depth_step(operation: str, **values: object) -> str:
    numbers = {
        "depth": 0.25,
        "inverse_w": 0.5,
        "stored": 0.25,
        "before": 1.0,
        "after": 0.25,
        "passes": True,
        "writes": True,
        "larger_is_nearer": False,
        "quantity": "inverse-w" if values.get("larger_is_nearer") else "z",
        **values,
    }
    made = Explanation(f"depth.{operation}", numbers, (), (), None, 0)  # type: ignore[arg-type]
    return sentence(made, 3, (5, 6))


def test_the_depth_test_says_what_was_compared() -> None:
    assert (
        depth_step("test.compare")
        == "Pixel (5, 6) passes: its z, 0.25, is smaller than the buffer's 1, so it is nearer."
    )
    assert depth_step("test.compare", before=0.125, passes=False) == (
        "Pixel (5, 6) fails: its z, 0.25, is larger than the buffer's 0.125, so it is hidden."
    )
    assert depth_step("test.compare", before=0.25, passes=False).endswith("a tie keeps the stored depth.")
    assert depth_step("test.compare", larger_is_nearer=True, stored=0.5, before=0.0) == (
        "Pixel (5, 6) passes: its 1/w, 0.5, is larger than the buffer's 0, so it is nearer."
    )
    assert "0.99991, is smaller than the buffer's 0.99992" in depth_step(
        "test.compare", stored=0.99991, before=0.99992
    )
    assert "cannot be compared" in depth_step("test.compare", stored=float("nan"), passes=False)
    assert (
        depth_step("test.depth", larger_is_nearer=True, stored=0.5)
        == "Pixel (5, 6): its 1/w = 0.5 is stored as 0.5."
    )
    assert depth_step("out-of-range.range", depth=1.5).endswith(
        "its depth z is 1.5, above 1: behind the far plane."
    )
    assert depth_step("out-of-range.range", depth=-0.5).endswith(
        "is −0.5, below 0: in front of the near plane."
    )
    assert depth_step("out-of-range.range", depth=float("nan")).endswith("is NaN, which is not a number.")
    assert (
        depth_step("store.write") == "Pixel (5, 6): without a depth test 0.25 replaces 1 in the depth buffer."
    )
    for kind in ("test", "store"):
        assert depth_step(f"{kind}.write", after=1.0, writes=False) == (
            "Pixel (5, 6): the depth buffer keeps 1, as the line covers less than half of this pixel and must not hide "
            "what is drawn there later."
        )


def test_a_tie_of_keys_names_the_triangle_that_came_first() -> None:
    corners = [[[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]]
    depth = trace(ClipScene(corners * 2, size=(4, 4)), Settings(depth="fixed-38")).stage("depth")
    row = int(np.flatnonzero(depth.triangle == 1)[0])
    explanation = depth.explain(int(depth.steps.starts[row]) + 3)
    assert explanation is not None
    assert sentence(explanation, 1, (1, 0)) == (
        "Pixel (1, 0) fails: the depths tie, and triangle 0 has the lower number, as it came first."
    )


def test_cuts_that_are_left_out_are_said_to_be(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pixel_cuts, "MOST_NUMBERS", 1)
    found = trace(ClipScene([[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], size=(1, 1)), AREA).stage(
        "resolve"
    )
    explained = found.explain(1)
    assert explained is not None
    assert sentence(explained, -1, (0, 0)) == (
        "Pixel (0, 0): edges cut it into 2 pieces, and triangles cover 0.5 of its area; to step through the cuts, "
        "trace one triangle or a smaller part of the picture."
    )


def test_of_the_many_corners_of_a_polygon_the_farthest_decides():
    corners = np.array(
        [[-2, -0.5, 0, 1], [2, -0.5, 0, 1], [3, 0, 0, 1], [2, 0.5, 0, 1], [-2, 0.5, 0, 1], [-3, 0, 0, 1]]
    )
    scene = ClipScene(clip=corners[None], size=(8, 8), kind="polygons", rings=[0])
    traced = trace(scene).stage("cull")
    steps = [traced.explain(position) for position in range(1, traced.steps.count + 1)]
    said = [sentence(step, 0, (0, 0)) for step in steps if step is not None and step.key == "cull.plane.test"]
    assert (
        said[2]
        == "Polygon 0 is not outside the left plane: 3 of its corners are inside (largest distance 4)."
    )
    (behind,) = (step for step in steps if step is not None and step.key == "cull.behind.test")
    assert (
        sentence(behind, 0, (0, 0))
        == "Polygon 0 is not behind the eye: 6 corners have w above 0 (largest w 1)."
    )


def test_a_shared_vertex_has_its_number_in_the_triangle_and_that_in_the_scene() -> None:
    """As its disc is labelled: the second triangle of a quad has corner 1 at the quad's vertex 2."""
    traced = trace(make_scene("textured-floor"), Settings()).stage("transform")
    row = int(np.flatnonzero(traced.columns["corner"] != traced.columns["vertex"])[0])
    corner, vertex = (int(traced.columns[name][row]) for name in ("corner", "vertex"))
    explanation, triangle = traced.explain(int(traced.steps.starts[row]) + 1), int(traced.triangle[row])
    assert explanation is not None
    said = sentence(explanation, triangle, None)
    assert said.startswith(f"Vertex {corner} of triangle {triangle} (vertex {vertex} of the scene): ")


def test_the_matrix_of_corners_times_a_column_of_its_inverse() -> None:
    """One for the corner of the edge function, and zero for the others."""
    settings = Settings(fill="bounding-box", coverage="inverse")
    traced = trace(make_scene("single-triangle"), settings).stage("edges")
    steps = [traced.explain(position) for position in range(1, traced.steps.count + 1)]
    last = [e for e in steps if e is not None and e.key == "edges.inverse-edge.c"]
    for k, explanation in enumerate(last):
        made = formula(explanation)
        assert made is not None
        parts = ([row.split(" & ") for row in rows] for rows in matrices(made.substituted))
        corners, columns, unit = (np.array(part, float) for part in parts)
        wanted = np.eye(3)[:, [k]] if k < 2 else np.eye(3)
        assert np.allclose(corners @ columns, wanted, atol=0.03)
        assert np.array_equal(unit, wanted)
    assert len(last) == 3


def matrices(latex: str) -> list[list[str]]:
    """Return the rows of every matrix in a formula."""
    found = re.findall(r"\\begin\{pmatrix\} (.*?) \\end\{pmatrix\}", latex)
    return [part.split(r" \\ ") for part in found]


def test_texture_coordinates_are_a_quotient_of_planes() -> None:
    traced = trace(make_scene("textured-floor"), Settings()).stage("interpolate")
    steps = (traced.explain(position) for position in range(1, traced.steps.count + 1))
    made = formula(next(e for e in steps if e is not None and e.key.endswith("value-uv")))
    assert made is not None
    assert made.symbolic.endswith(r"u & = & \frac{u/w}{1/w}")


def test_the_albedo_of_corners_without_a_colour_is_that_of_the_texture() -> None:
    shade = trace(ALL_SCENES["zwicker-perspective"].make(), Settings(fill="bounding-box")).stage("shade")
    found = (shade.explain(position) for position in range(1, shade.steps.count + 1))
    explanation = next(each for each in found if each is not None and each.key.endswith(".albedo"))
    assert sentence(explanation, 0, None).endswith("the texture's colour.")
    made = formula(explanation)
    assert made is not None
    assert "colour" not in made.substituted


def test_one_value_alone_is_u_and_no_colour() -> None:
    clip, values = [[[-1, -1, 0, 1], [1, -1, 0, 1], [-1, 1, 0, 1]]], np.array([[[0.0], [1.0], [0.0]]])
    stepped = trace(ClipScene(clip, values, (4, 4)), Settings()).stage("interpolate")
    explained = map(stepped.explain, range(1, stepped.steps.count + 1))
    value = next(each for each in explained if each and each.key == "interpolate.perspective.value-color")
    assert sentence(value, 0, (0, 0)) == (
        "Pixel (0, 0) of triangle 0: its u is 0.125, the weighted sum of the corners' values."
    )
    shown = formula(value)
    assert shown is not None
    assert shown.symbolic.startswith("u")
