"""The last event of a pixel's history: what pictures before, or pixels beside it, have a part in its colour."""

from dataclasses import replace

import numpy as np
import pytest

from core import Scene, Settings, render
from core.pixel_history import why
from core.pixel_history.told import event_reason, event_title
from core.records.motion import Motion
from core.trace.source import TraceSource
from lessons.scenes import make_scene

TURNED = replace(make_scene("textured-floor"), size=(24, 18), motion=Motion(camera=(0.4, 0.0, 0.0)))


@pytest.mark.parametrize("history", ["kept", "reprojected", "clamped"])
@pytest.mark.parametrize("pictures", [1, 3])
def test_the_mixture_is_that_of_the_picture_and_its_weights_add_up(history: str, pictures: int) -> None:
    settings = Settings(antialiasing="temporal", pictures=pictures, blend_share=40, history=history)
    frame, keys = render(TURNED, settings), set()
    for column, row in ((0, 0), (5, 3), (12, 9), (23, 2), (23, 17)):
        found = why(TraceSource(TURNED, settings), column, row)
        event = found.events[-1]
        values = event.reason.values
        assert np.array_equal(event.after.color, frame.color[row, column])
        assert event.before == found.events[-2].after or event.before.triangle == event.after.triangle
        keys.add(event.reason.key)
        if event.reason.key == "mixed":
            assert values["share"] == 0.4
            mixed = values["history"] + 0.4 * (event.before.color - values["history"])
            assert np.allclose(mixed, event.after.color, atol=1e-6)
            assert values["is_moved"] == (history != "kept")
            assert "with weight 0.4" in event_reason(event)
            assert event_title(event) == "Resolved"
    assert keys == ({"begun"} if pictures == 1 else {"mixed"} if history == "kept" else {"mixed", "lost"})


def test_smoothed_edges_name_the_pixel_that_they_take_part_of() -> None:
    cube = make_scene("cube")
    assert isinstance(cube, Scene)
    scene, settings = replace(cube, size=(32, 24)), Settings(antialiasing="fxaa")
    frame, plain, keys = render(scene, settings), render(scene), {}
    for row in range(2, 24, 3):
        for column in range(0, 32, 4):
            event = why(TraceSource(scene, settings), column, row).events[-1]
            assert np.array_equal(event.before.color, plain.color[row, column])
            assert np.array_equal(event.after.color, frame.color[row, column])
            is_changed = not np.array_equal(event.before.color, event.after.color)
            assert not is_changed or event.reason.key == "smoothed"
            keys[event.reason.key] = event_reason(event)
    assert "of the pixel" in keys["smoothed"]
    assert keys["no-edge"].endswith("unchanged.")


def test_other_methods_show_what_is_drawn() -> None:
    history = why(TraceSource(TURNED, Settings()), 3, 3)
    assert all(event.kind != "resolve" for event in history.events)
