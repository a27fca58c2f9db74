"""The 3D view draws the positions that the document's settings have made, whatever its own settings are."""

import numpy as np
import pytest

from app.views.view_space import make_space
from core import Settings, render
from core.trace.source import TraceSource
from lessons.scenes import make_scene


@pytest.mark.parametrize(
    ("name", "chosen"),
    [
        ("twisted-tube", {"skinning": "dual-quaternion"}),
        ("hill", {"segments": 3}),
        ("curve", {"segments": 2}),
    ],
)
def test_positions_are_not_made_anew(name: str, chosen: dict) -> None:
    source = TraceSource(make_scene(name), Settings(**chosen))
    drawn = make_space(source.scene, source.geometry.vertices).drawn
    assert not drawn.makes_positions
    assert np.array_equal(render(drawn).primitive, render(make_scene(name), Settings(**chosen)).primitive)
    assert not np.array_equal(render(drawn).primitive, render(make_scene(name)).primitive)
