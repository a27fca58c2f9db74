"""Memory that is used again does not show: not in the next picture, and not in one that was returned before."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core import Settings, draw_picture
from core.numeric.large_arrays import ScratchBuffers
from tests.core.fast_path.numbered import numbered
from tests.core.spans.adversarial import mixed, projected
from tests.core.strategies import clip_of_window

PICTURES = st.tuples(
    st.integers(0, 2**32 - 1),
    st.sampled_from([(1, 1), (7, 5), (61, 97), (300, 200)]),
    st.sampled_from([0, 1, 5, 30]),
    st.sampled_from(["z-float32", "fixed-38", "inverse-w"]),
    st.sampled_from(["opaque", "over"]),
    st.booleans(),
)


@given(st.lists(PICTURES, min_size=2, max_size=4))
def test_pictures_in_turn_are_those_of_fresh_memory(wanted) -> None:
    shared, returned = ScratchBuffers(), []
    for seed, size, count, depth, blend, is_mixed in wanted:
        generator = np.random.default_rng(seed)
        flat = clip_of_window(
            projected(generator, count, size), size, 1.0, generator.uniform(-1, 1, (count, 3))
        )
        scene = numbered(mixed(generator, count, size) if is_mixed else flat, size)
        chosen = Settings(fill="spans", depth=depth, blend=blend)
        for with_depth in (False, True):
            pair = [
                draw_picture(scene, chosen, with_depth=with_depth, scratch=scratch)
                for scratch in (shared, ScratchBuffers())
            ]
            returned.append(pair)
    # Compared only now: a later picture must not have written into an earlier one.
    for picture, fresh in returned:
        assert np.array_equal(picture.pixels, fresh.pixels)
        assert (picture.depth is None) == (fresh.depth is None)
        if picture.depth is not None:
            assert np.array_equal(picture.depth, fresh.depth)
        assert not picture.pixels.flags.writeable


def test_pieces_grow_and_keep_their_place() -> None:
    scratch = ScratchBuffers()
    small = scratch("piece", 3, 4, dtype=np.int32)
    small[:] = 7
    again = scratch("piece", 12, dtype=np.int32)
    assert np.shares_memory(small, again)
    assert (again == 7).all()
    assert not np.shares_memory(small, scratch("another", 12, dtype=np.int32))
    held = scratch.byte_count
    large = scratch("piece", 1000, 1000)
    assert large.shape == (1000, 1000)
    assert large.dtype == np.float64
    assert scratch.byte_count >= held + large.nbytes - 64 * 12
