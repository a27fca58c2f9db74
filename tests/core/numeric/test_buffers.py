"""Short buffers end with the block, whatever happens in it."""

import numpy as np
import pytest

from core import ClipScene, Settings, draw_picture
from core.numeric.large_arrays import BUFFERED, short_buffers


def test_buffers_are_short_within_the_block_only():
    before = np.getbufsize()
    with short_buffers():
        assert np.getbufsize() == BUFFERED < before
        with np.errstate(over="ignore"):
            assert np.getbufsize() == BUFFERED
        assert np.getbufsize() == BUFFERED
    assert np.getbufsize() == before


def test_an_error_within_the_block_leaves_numpy_as_it_was():
    before = np.getbufsize()
    with pytest.raises(ZeroDivisionError), short_buffers():
        raise ZeroDivisionError
    assert np.getbufsize() == before


def test_a_picture_leaves_numpy_as_it_was_drawn_or_refused():
    before = np.getbufsize()
    corners = np.array([[[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 1]]])
    scene = ClipScene(corners, np.ones((1, 3, 4)), (40, 30))
    draw_picture(scene)
    assert np.getbufsize() == before
    with pytest.raises(ValueError, match="encoding"):
        draw_picture(scene, Settings(), encoding="rec2020")
    assert np.getbufsize() == before
