"""The history of a pixel with several samples: what each of them shows, and why."""

import numpy as np

from app.pixel_stories import story_of
from core import Settings, render
from core.trace.source import TraceSource
from lessons.scenes import make_scene
from widgets.why_samples import of_sample, samples_name, samples_verdict


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
    assert "the sample missed edge" in reasons[1].lower()
    assert not any("pixel centre" in reason for reason in reasons)


def test_one_triangle_is_asked_about_in_every_group() -> None:
    source, column, row = edge_pixel(Settings(antialiasing="msaa-4"))
    story, _ = story_of(source, column, row, 0)
    assert "Triangle 0 is seen here." in story.verdict
    assert "Triangle 0 has no fragment here: the sample missed edge" in story.verdict


def test_a_pixel_inside_tells_one_history() -> None:
    settings = Settings(antialiasing="ssaa-n", samples_across=3)
    scene = make_scene("single-triangle")
    samples = render(scene, settings).samples
    assert samples is not None
    row, column = np.argwhere((samples.primitive >= 0).all(axis=0))[0]
    source = TraceSource(scene, settings)
    story, triangles = story_of(source, int(column), int(row))
    assert story.verdict.startswith("All 9 samples show triangle 0. Triangle 0 is seen here")
    assert triangles == [None, 0]


def test_exact_areas_tell_of_the_centre() -> None:
    scene = make_scene("single-triangle")
    story, _ = story_of(TraceSource(scene, Settings(antialiasing="area")), 0, 0)
    assert story.verdict.startswith("At the pixel's centre, whatever its pieces are: ")


def test_names_of_samples() -> None:
    assert samples_name([3]) == "Sample 3"
    assert samples_name([0, 1, 2, 3, 4]) == "Samples 0, 1, 2, 3 and 4"
    assert samples_name(range(16)) == "Samples 0, 1, 2 and 13 more"
    assert samples_verdict([(-1, [0, 1, 2, 3])], 4) == "All 4 samples show none."
    assert of_sample("The pixel centre missed edge 1.") == "The sample missed edge 1."
