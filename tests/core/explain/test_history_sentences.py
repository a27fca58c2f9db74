"""The history of a pixel in words: every key has its sentence, and the sentence has the right numbers."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings
from core.explain.history.sentences import (
    COUNTED,
    SENTENCES,
    count_sentences,
    event_reason,
    event_title,
    link_sentence,
    verdict_sentence,
)
from core.methods import table
from core.pixel_history import Link, PixelHistory, why
from core.settings import families
from core.trace.source import TraceSource
from lessons.scenes import make_scene, window_triangle
from tests.core.strategies import ANY_TRIANGLES, clip_of_window

SIZE = (16, 12)
LOWER_LEFT = [(2, 2), (10, 2), (2, 10)]


def window_scene(*triangles, z=0.0, colors=None) -> ClipScene:
    return ClipScene(clip_of_window(triangles, SIZE, 1.0, z), colors, SIZE)


def ask(scene: ClipScene, column: int, row: int, triangle: int | None = None, **choice) -> PixelHistory:
    return why(TraceSource(scene, Settings(**choice)), column, row, triangle)


def all_texts(history: PixelHistory) -> list[str]:
    """Return every sentence of a history."""
    texts = [verdict_sentence(history), *count_sentences(history)]
    for event in history.events:
        texts += [event_reason(event), *map(link_sentence, event.chain)]
    return texts


@pytest.mark.parametrize(
    ("pixel", "triangle", "choice", "wanted"),
    [
        ((3, 3), None, {}, "Triangle 0 is visible here."),
        (
            (7, 6),
            None,
            {"fill": "bounding-box"},
            "No triangle covers this pixel. The nearest is triangle 0: the pixel centre is 1.414 px beyond edge 0.",
        ),
        (
            (5, 6),
            0,
            {"fill": "bounding-box"},
            "Triangle 0 has no fragment here:"
            " the pixel centre is exactly on edge 0, which the triangle does not own because it is a right edge.",
        ),
        (
            (9, 9),
            0,
            {"fill": "blocks", "block_size": 4},
            "Triangle 0 has no fragment here: block (2, 2) of 4 × 4 pixels is rejected by edge 0;"
            " the pixel centre is 4.95 px beyond edge 0.",
        ),
        (
            (14, 10),
            0,
            {},
            "Triangle 0 has no fragment here: outside its bounding box, columns 2 to 9, rows 2 to 9;"
            " the pixel centre is 9.192 px beyond edge 0.",
        ),
        (
            (14, 10),
            None,
            {},
            "No triangle covers this pixel: it lies outside the bounding box of the only triangle.",
        ),
        (
            (3, 3),
            None,
            {"cull": "front"},
            "Nothing is drawn here: triangle 0 was dropped; culled: its front faces the eye;"
            " otherwise it would have a fragment here.",
        ),
    ],
)
def test_verdicts(pixel, triangle, choice, wanted):
    assert verdict_sentence(ask(window_scene(LOWER_LEFT), *pixel, triangle, **choice)) == wanted


def test_a_near_miss_is_told_in_256ths_too():
    reason = ask(window_scene([(2, 2), (10, 2), (2, 9.875)]), 5, 6, 0, fill="bounding-box").verdict.values[
        "reason"
    ]
    text = link_sentence(reason)
    found = re.fullmatch(r"The pixel centre is (0\.0\d+) px \(([\d.]+)/256\) beyond edge 0\.", text)
    assert found, text
    assert float(found[2]) == pytest.approx(256 * float(found[1]), rel=1e-3)


def test_depth_tests_name_whom_they_met():
    z = np.array([[0.0] * 3, [0.5] * 3, [0.0] * 3, [-0.5] * 3])
    scene = window_scene(LOWER_LEFT, LOWER_LEFT, LOWER_LEFT, LOWER_LEFT, z=z)
    history = ask(scene, 3, 3)
    covered = "Covered: in the span of this row, columns 2 to 7. Weights 0.625, 0.1875 and 0.1875."
    passed = f"{covered} Passed the depth test:"
    failed = f"{covered} Failed the depth test:"
    assert [(event_title(event), event_reason(event)) for event in history.events] == [
        ("Initial value", "Nothing is written here yet."),
        ("Clear", "The background colour and the farthest depth."),
        (
            "Triangle 0",
            f"{passed} 0.5 against the cleared depth (1). Written, later overwritten by triangle 3.",
        ),
        ("Triangle 1", f"{failed} 0.75 is not nearer than triangle 0 (0.5)."),
        ("Triangle 2", f"{failed} equal to triangle 0 (0.5), and a tie keeps the stored depth."),
        ("Triangle 3", f"{passed} 0.25 against triangle 0 (0.5). Written and visible."),
    ]
    depth = history.fragments[0].link("depth")
    assert depth is not None
    assert link_sentence(depth) == "Passed the depth test: 0.5 against the cleared depth (1)."
    assert (
        verdict_sentence(history)
        == "Triangle 3 is visible here; 2 fragments rejected, 1 fragment overwritten."
    )
    assert verdict_sentence(ask(scene, 3, 3, 0)) == (
        "Triangle 0 was drawn here and then overwritten by triangle 3."
    )


def test_clipping_comes_first_in_the_reason():
    clip = [[[-0.9, -0.9, 0, 1], [0.9, -0.9, 0, 1], [0, 0.5, -2, 1]]]
    history = ask(ClipScene(clip, size=SIZE), 8, 8, 0, clipping="sutherland-hodgman", fill="bounding-box")
    text = event_reason(history.events[2])
    assert text.startswith("Vertex 2 is behind the near plane; clipped to a quad; outside its bounding box, ")
    assert re.fullmatch("Triangle 0, piece [12] of 2", event_title(history.events[2]))


def test_counts():
    scene = window_scene(LOWER_LEFT, LOWER_LEFT[::-1], LOWER_LEFT)
    assert count_sentences(ask(scene, 15, 11, cull="back")) == (
        "1 more triangle: culled, back-facing.",
        "2 more triangles: the pixel is outside their bounding box.",
    )


def check_texts(texts: list[str]) -> None:
    for text in texts:
        assert re.fullmatch(r"[A-Z0-9].*\.", text), text
        assert not re.search(r"nan|inf\b|\bNone\b(?! of )|\.\.|  |\bTrue|\bFalse|array", text), text


ANY_SETTINGS = st.builds(Settings, **{family: st.sampled_from(table.names(family)) for family in families()})


@given(ANY_TRIANGLES, ANY_SETTINGS, st.data())
def test_every_history_can_be_told(case, settings, data):
    clip, size = case
    pixel = data.draw(st.integers(0, size[0] - 1)), data.draw(st.integers(0, size[1] - 1))
    triangle = data.draw(st.none() | st.integers(0, len(clip) - 1))
    check_texts(all_texts(why(TraceSource(ClipScene(clip, size=size), settings), *pixel, triangle)))


def test_no_key_is_without_a_sentence_and_no_sentence_without_a_key():
    values = {"values": np.zeros(3), "inside": np.ones(3, bool)}
    with pytest.raises(KeyError):
        link_sentence(Link("raster", "lost", values))
    stages = {stage for stage, _ in SENTENCES}
    assert stages == {
        *("verdict", "transform", "cull", "clip", "bin", "raster"),
        *("interpolate", "shade", "depth", "blend"),
    }
    assert set(COUNTED) == {
        *("back-facing", "front-facing", "degenerate", "behind-eye"),
        *("outside-plane", "clipped-away", "outside-box", "missed", "no-fragment"),
    }


@pytest.mark.parametrize("fill", ["spans", "scanline", "hierarchy", "brute-force"])
@pytest.mark.parametrize(
    ("rule", "why"), [("shared-edge", "it is a left edge"), ("inclusive", "the inclusive rule")]
)
def test_a_pixel_on_an_edge_says_who_owns_it_and_why_with_every_fill(fill: str, rule: str, why: str) -> None:
    # Centre (3.5, 1.5) lies on the left edge of this triangle.
    history = ask(window_scene([(3.5, 0.5), (7.5, 0.5), (3.5, 6.5)]), 3, 1, fill=fill, fill_rule=rule)
    said = " ".join(map(event_reason, history.events))
    assert f"exactly on edge 1, which the triangle owns because {why}" in said


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("bresenham", "D = 4 chose the diagonal step to it"),
        ("bresenham-float", "e + m = 0.75 chose the diagonal step to it"),
        ("midpoint", ""),
    ],
)
def test_a_pixel_of_a_line_says_what_chose_it(line: str, said: str) -> None:
    history = why(TraceSource(make_scene("segment"), Settings(line=line)), 3, 2)
    text = " ".join(map(event_reason, history.events))
    assert said in text
    assert bool(said) == ("step to it" in text)


def test_weights_divided_by_w_stand_beside_those_of_the_window():
    """Corners (0, 0), (8, 0), (0, 8): in the window the centre of pixel (1, 3) has weights 3/8, 3/16 and 7/16."""
    clip = window_triangle([0, 8, 0], [0, 0, 8], [0.5] * 3, [1, 1, 2], (8, 8))
    scene = ClipScene(np.array([clip]), np.zeros((1, 3, 4)), (8, 8))
    reason = event_reason(ask(scene, 1, 3).fragments[0])
    assert "Weights 0.48, 0.24 and 0.28 (divided by w; in the window 0.375, 0.1875 and 0.4375)." in reason
