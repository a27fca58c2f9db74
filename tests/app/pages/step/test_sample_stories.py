"""The history of a pixel with several samples: what each of them shows, and why."""

import numpy as np
import pytest

from app.pages.step.pixel_story import story_of
from core import Settings, render
from core.pixel_history.told_coverage import (
    of_sample,
    piece_reason,
    pieces_verdict,
    samples_name,
    samples_verdict,
)
from core.trace.source import TraceSource
from lessons.scenes import make_scene


def edge_pixel(settings: Settings) -> tuple[TraceSource, int, int]:
    """Return a pixel of which a triangle has two samples of four, and nothing the others."""
    scene = make_scene("single-triangle")
    samples = render(scene, settings).samples
    assert samples is not None
    row, column = np.argwhere((samples.primitive >= 0).sum(axis=0) == 2)[0]
    return TraceSource(scene, settings), int(column), int(row)


def test_the_samples_of_a_pixel_have_histories_of_their_own() -> None:
    source, column, row = edge_pixel(Settings(antialiasing="msaa-4"))
    story, triangles = story_of(source, column, row)
    assert story.verdict == "2 of 4 samples show triangle 0, 2 show none."
    titles = [entry.title for entry in story.entries]
    assert titles[0].startswith("Clear, samples ")
    assert titles[1].startswith("Triangle 0, samples ")
    assert titles[1] != titles[3]
    assert triangles == [None, 0, None, 0]
    reasons = [entry.reason for entry in story.entries if entry.title.startswith("Triangle 0, ")]
    assert not story.entries[1].is_rejected
    assert story.entries[3].is_rejected
    assert " beyond edge " in reasons[1].lower()
    assert not any("pixel centre" in reason for reason in reasons)


def test_one_triangle_is_asked_about_in_every_group() -> None:
    source, column, row = edge_pixel(Settings(antialiasing="msaa-4"))
    story, _ = story_of(source, column, row, 0)
    assert "Triangle 0 is visible here." in story.verdict
    assert "Triangle 0 has no fragment here: the sample is " in story.verdict


def test_a_pixel_inside_tells_one_history() -> None:
    settings = Settings(antialiasing="ssaa-n", samples_across=3)
    scene = make_scene("single-triangle")
    samples = render(scene, settings).samples
    assert samples is not None
    row, column = np.argwhere((samples.primitive >= 0).all(axis=0))[0]
    source = TraceSource(scene, settings)
    story, triangles = story_of(source, int(column), int(row))
    assert story.verdict.startswith("All 9 samples show triangle 0. Triangle 0 is visible here")
    assert triangles == [None, 0]


def test_exact_areas_tell_who_covers_how_much() -> None:
    settings = Settings(antialiasing="area")
    scene = make_scene("single-triangle")
    alpha = render(scene, settings).color[..., 3]
    row, column = np.argwhere((alpha > 0.1) & (alpha < 0.9))[0]
    source = TraceSource(scene, settings)
    story, triangles = story_of(source, int(column), int(row))
    area = float(alpha[row, column])
    assert (
        story.verdict == f"Triangle 0 is visible in {area:.4g} of the pixel, no triangle in {1 - area:.4g}."
    )
    assert [entry.title for entry in story.entries] == ["Clear", "Triangle 0"]
    assert story.entries[1].reason == f"Covers {area:.4g} of the pixel."
    assert triangles == [None, 0]
    told, _ = story_of(source, int(column), int(row), 0)
    assert told.verdict == f"{story.verdict} Triangle 0 covers {area:.4g} of the pixel."


def test_a_pixel_that_no_triangle_touches_says_so_and_why() -> None:
    source = TraceSource(make_scene("single-triangle"), Settings(antialiasing="area"))
    story, triangles = story_of(source, 0, 0)
    assert story.verdict == "No triangle is visible in any part of the pixel."
    assert [entry.title for entry in story.entries] == ["Clear", "1 triangle does not touch the pixel"]
    assert triangles == [None, None]
    told, _ = story_of(source, 0, 0, 0)
    assert told.verdict.startswith(f"{story.verdict} Triangle 0 has no fragment here")


def test_outlines_of_exact_areas_are_told_at_the_centre() -> None:
    settings = Settings(antialiasing="area", polygon_mode="wireframe")
    story, _ = story_of(TraceSource(make_scene("single-triangle"), settings), 0, 0)
    assert "of the pixel" not in story.verdict


@pytest.mark.parametrize(
    ("area", "passed", "seen", "text"),
    [
        (1.0, 1.0, 1.0, "covers all of the pixel"),
        (0.5, 0.5, 0.25, "covers 0.5 of the pixel; 0.25 is visible in the end"),
        (0.5, 0.25, 0.25, "covers 0.5 of the pixel, 0.25 of it passes the depth test"),
        (
            0.5,
            0.25,
            0.0,
            "covers 0.5 of the pixel, 0.25 of it passes the depth test; none of it is visible in the end",
        ),
        (0.5, 0.0, 0.0, "covers 0.5 of the pixel, none of it passes the depth test"),
        (1 - 1e-8, 1 - 1e-8, 1 - 1e-8, "covers almost all of the pixel"),
    ],
)
def test_what_became_of_a_piece(area: float, passed: float, seen: float, text: str) -> None:
    assert piece_reason(area, passed, seen) == text


def test_of_many_triangles_the_largest_pieces_are_named() -> None:
    shown = [(number, 0.1 + 0.01 * number) for number in range(6)]
    verdict = pieces_verdict(shown, 1 - sum(area for _, area in shown), False)
    assert verdict == (
        "Triangle 5 is visible in 0.15 of the pixel, triangle 4 in 0.14, triangle 3 in 0.13, triangle 2 in 0.12, "
        "2 more in 0.21, no triangle in 0.25."
    )
    assert pieces_verdict([(3, 1.0)], 0.0, True) == "Triangle 3 lies on top in all of the pixel."


def test_names_of_samples() -> None:
    assert samples_name([3]) == "Sample 3"
    assert samples_name([0, 1, 2, 3, 4]) == "Samples 0, 1, 2, 3 and 4"
    assert samples_name(range(16)) == "Samples 0, 1, 2 and 13 more"
    assert samples_verdict([(-1, [0, 1, 2, 3])], 4) == "All 4 samples show none."
    assert of_sample("The pixel centre missed edge 1.") == "The sample missed edge 1."
