"""Hypothesis strategies for triangles: on grids, thin, far away, behind the eye; as clip-space arrays."""

import numpy as np
from hypothesis import strategies as st

SIZES = st.sampled_from([(1, 1), (1, 7), (9, 1), (8, 6), (13, 11), (16, 16)])
W_IN_FRONT = st.sampled_from([0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 7.0])
W_ANY = st.sampled_from([-3.0, -1.0, -0.5, 0.0, 0.25, 1.0, 1.5, 2.0])


def clip_of_window(points, size: tuple[int, int], w=1.0, z=0.0) -> np.ndarray:
    """Return (T, 3, 4) clip positions of window points (T, 3, 2); w and z are numbers or (T, 3)."""
    points = np.asarray(points, float)
    w = np.broadcast_to(np.asarray(w, float), points.shape[:-1])
    z = np.broadcast_to(np.asarray(z, float), points.shape[:-1])
    ndc = points / (np.array(size) / 2) - 1
    return np.concatenate([ndc * w[..., None], (z * w)[..., None], w[..., None]], axis=-1)


def window_points(size: tuple[int, int], steps: int, margin: int = 4):
    """Points of the grid of 1/steps pixel, in the window and a little around it."""
    columns = st.integers(-margin * steps, (size[0] + margin) * steps)
    rows = st.integers(-margin * steps, (size[1] + margin) * steps)
    return st.tuples(columns, rows).map(lambda point: (point[0] / steps, point[1] / steps))


@st.composite
def grid_triangles(draw, count: int = 3):
    """Draw (clip (T, 3, 4), size): corners on pixel centres, half pixels, 1/256 or 1/512 pixel."""
    # Half a subpixel must come out exactly half: only where the window is a power of two.
    steps = draw(st.sampled_from([1, 2, 16, 256, 512]))
    size = draw(SIZES if steps < 512 else st.sampled_from([(1, 1), (8, 4), (16, 16)]))
    points = window_points(size, steps, draw(st.sampled_from([0, 4, 3000])))
    triangles = draw(st.lists(st.tuples(points, points, points), min_size=1, max_size=count))
    return clip_of_window(triangles, size), size


@st.composite
def slivers(draw):
    """Draw (clip (1, 3, 4), size): triangles a few 1/256 pixel wide, along any direction."""
    size = draw(SIZES)
    start = draw(window_points(size, 2, 1))
    end = draw(window_points(size, 2, 1))
    offset = draw(st.tuples(st.integers(-3, 3), st.integers(-3, 3)))
    third = (end[0] + offset[0] / 256, end[1] + offset[1] / 256)
    return clip_of_window([[start, end, third]], size), size


@st.composite
def homogeneous_triangles(draw, count: int = 3):
    """Draw (clip (T, 3, 4), size) on dyadic fractions with any signs of w, w = 0 among them.

    The edges through a corner that cannot be projected are then exact in float64 too.
    """
    size = draw(st.sampled_from([(1, 1), (8, 8), (16, 4), (16, 16)]))
    number = st.integers(-24, 24).map(lambda n: n / 8)
    corner = st.tuples(number, number, number, W_ANY)
    triangles = draw(st.lists(st.tuples(corner, corner, corner), min_size=1, max_size=count))
    return np.array(triangles, float), size


@st.composite
def perspective_triangles(draw, count: int = 3):
    """Draw (clip (T, 3, 4), size), all w > 0 and different, corners anywhere in and around the window."""
    size = draw(SIZES)
    points = window_points(size, draw(st.sampled_from([2, 256, 1000])))
    triangles = draw(st.lists(st.tuples(points, points, points), min_size=1, max_size=count))
    ws = draw(
        st.lists(
            st.tuples(W_IN_FRONT, W_IN_FRONT, W_IN_FRONT), min_size=len(triangles), max_size=len(triangles)
        )
    )
    depth = st.sampled_from([-0.9, -0.5, 0.0, 0.25, 0.75, 1.0])
    zs = draw(st.lists(st.tuples(depth, depth, depth), min_size=len(triangles), max_size=len(triangles)))
    return clip_of_window(triangles, size, ws, zs), size


REGIONS = st.tuples(st.integers(0, 8), st.integers(0, 8), st.integers(0, 9), st.integers(0, 9))
BLOCK_SIZES = st.sampled_from([1, 2, 3, 4, 5, 7, 8, 13, 16, 64, 255, 256])
ANY_TRIANGLES = st.one_of(grid_triangles(), slivers(), homogeneous_triangles(), perspective_triangles())
