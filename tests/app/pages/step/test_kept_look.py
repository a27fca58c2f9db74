"""Breakpoints and origins agree with the steps themselves."""

import numpy as np
import pytest

from app.pages.step.kept_look import line_positions
from app.pages.step.pixel_origins import writer_of
from app.session.document import open_document
from app.session.session import Session
from lessons.scenes import make_scene


@pytest.fixture
def session(qapp: object) -> Session:
    session = Session(open_document(make_scene("four-layers"), "Four layers"))
    session.set_stage("depth")
    return session


def test_a_line_stops_at_every_step_that_is_explained_by_it(session: Session) -> None:
    stage = session.stage_trace
    lines: dict[tuple[str, int], list[int]] = {}
    for position in range(1, min(stage.steps.count, 400) + 1):
        explained = stage.explain(position)
        if explained.listing is not None and explained.line:
            lines.setdefault((explained.listing.name, explained.line), []).append(position)
    assert lines
    for (name, line), positions in lines.items():
        found = line_positions(stage, name, line)
        assert found[found <= 400].tolist() == positions


def test_what_a_pixel_holds_was_written_by_the_step_that_is_named(session: Session) -> None:
    stage = session.stage_trace
    for position in (stage.steps.count // 2, stage.steps.count):
        session.set_stage("depth", position)
        held = stage.state(position)
        for column, row in np.unique(stage.pixel, axis=0)[::29].tolist():
            place = session.moment.place_of((column, row))[::-1]
            for track in stage.buffers:
                origin = writer_of(session.moment, track.name, (column, row))
                then = track.initial if origin is None else stage.state(origin.position)[track.name]
                assert origin is None or origin.position <= position
                np.testing.assert_array_equal(then[place], held[track.name][place])
