"""Every scene opens at what its card says: the place is there, under its own settings."""

import dataclasses

import pytest

from app.files.open_any import open_any
from app.session.moment import cursor_at
from core.explain.steps import account
from core.records.steps import Level
from core.stages.declared import stage_of
from lessons.lectures.scenes import ALL_SCENES
from lessons.run_place import FIRST_STEP, RunPlace


@pytest.mark.parametrize("scene", ALL_SCENES.values(), ids=list(ALL_SCENES))
def test_a_scene_opens_at_what_its_card_says(scene):
    opened, place = open_any(scene.name), scene.opens
    run = opened.document.make_trace()
    cursor = cursor_at(opened.place, run, Level.STAGE)
    trace = run.stage(cursor.stage)
    assert cursor.stage == place.stage, "the scene goes through this stage"
    assert cursor.position in trace.steps.boundaries(cursor.level)[1:], "something has just been done there"
    assert scene.card.startswith(scene.description)
    assert f"Opens in {stage_of(cursor.stage).short_title}" in scene.card
    assert scene.card.endswith(", operation by operation.") == (cursor.level == Level.OPERATION)
    if place.pixel is not None:
        assert f"at pixel {place.pixel}" in scene.card
        first_column, first_row, end_column, end_row = run.source.raster.bounds
        assert first_column <= place.pixel[0] < end_column
        assert first_row <= place.pixel[1] < end_row
    if scene is next(iter(ALL_SCENES.values())):
        row, _ = trace.steps.row_at(cursor.position)
        column, row_of_pixel = trace.pixel[row].tolist()
        explanation = trace.explain(cursor.position)
        sentence, _ = account(explanation, int(trace.triangle[row]), (column, row_of_pixel))
        assert sentence.startswith(f"Pixel ({column}, {row_of_pixel}) is covered"), (
            "what a beginner reads first"
        )


def test_a_place_that_is_not_there_is_refused():
    run = open_any("segment").document.make_trace()
    for place, wanted in (
        (RunPlace("raster", "rejected"), "no step of raster meets rejected"),
        (RunPlace("raster", "covered", "shade"), "covered in raster has no operation shade"),
        (RunPlace("raster", operation="test"), "start in raster has no operation test"),
    ):
        with pytest.raises(ValueError, match=wanted):
            place.position(run)


def test_a_file_opens_at_its_start_at_the_level_before():
    run = open_any("points").document.make_trace()
    assert dataclasses.astuple(cursor_at(FIRST_STEP, run, Level.STAGE)) == ("transform", 0, Level.STAGE)
    cells = open_any("depth-table").document.make_trace()
    assert cursor_at(FIRST_STEP, cells, Level.GROUP).stage == "depth", "the first that a table goes through"
