"""Parameters along a line grow by the same difference from pixel to pixel."""

import numpy as np
import pytest

from core import Settings, trace
from lessons.scenes import make_scene


def test_parameters_along_a_line_grow_by_one_difference() -> None:
    scene = make_scene("segment")
    found = trace(scene, Settings(interpolation="affine")).stage("interpolate")
    t, before = found.columns["t"], found.columns["t_before"]
    assert np.isnan(before[0])
    assert (t[1:] - before[1:]).tolist() == [1 / 8] * 8
    first, second = found.columns["end_values"][0]
    added = found.columns["values_before"][1:, 0] + (second - first) / 8
    assert found.columns["values"][1:] == pytest.approx(added, abs=1e-7)
