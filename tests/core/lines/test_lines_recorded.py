"""Lines of two real OpenGL rasterizers, where the recorded cases are at hand; a few are drawn here."""

import json

import numpy as np
import pytest

from core.lines.drawing import draw_lines, interpolate_line


def masks(segments, width, height, line) -> np.ndarray:
    """(L, H, W) bool, each segment alone."""
    drawn = np.zeros((len(segments), height, width), bool)
    pixels, _, owner = draw_lines(segments, width, height, line=line)
    drawn[owner, pixels[:, 1], pixels[:, 0]] = True
    return drawn


@pytest.fixture(scope="module")
def cases(shared_folder):
    paths = sorted((shared_folder / "oracle").glob("lines_*.npz"))
    if not paths:
        pytest.skip("no recorded lines")
    cases = []
    for path in paths:
        with np.load(path) as arrays:
            case = {name: arrays[name] for name in arrays.files}
        width, height = map(int, case["size"])
        for name in ("per_line", "per_line_softpipe"):
            case[name] = np.unpackbits(case[name], axis=-1, count=width).astype(bool)
        case["name"], case["raster"] = path.stem, (width, height)
        assert json.loads(str(case["meta"]))["lines"]
        cases.append(case)
    return cases


def test_bresenham_equals_softpipe(cases):
    for case in cases:
        drawn = masks(case["window"], *case["raster"], "bresenham")
        np.testing.assert_array_equal(drawn, case["per_line_softpipe"], err_msg=case["name"])


def test_diamond_exit_equals_llvmpipe_but_for_exact_ties(cases):
    for case in cases:
        window = case["window"]
        drawn = draw_lines(window, *case["raster"], line="diamond-exit")
        differing = masks(window, *case["raster"], "diamond-exit") != case["per_line"]
        # llvmpipe moves some ends before it snaps them: within 1/128 pixel of a tie it may go either way.
        is_close = np.abs(np.abs(drawn.steps.decision) - 0.5) < 1 / 128
        is_tie = np.zeros_like(differing)
        at = drawn.pixels[is_close]
        is_tie[drawn.owner[is_close], at[:, 1], at[:, 0]] = True
        # The other pixel of a tie is the neighbour across the line.
        beside = is_tie.copy()
        beside[:, 1:] |= is_tie[:, :-1]
        beside[:, :-1] |= is_tie[:, 1:]
        beside[:, :, 1:] |= is_tie[:, :, :-1]
        beside[:, :, :-1] |= is_tie[:, :, 1:]
        assert not (differing & ~beside).any(), case["name"]


def test_color_and_depth_equal_llvmpipe(cases):
    for case in cases:
        width, height = case["raster"]
        drawn = draw_lines(case["window"], width, height, line="diamond-exit")
        clip = case["verts"].astype(float)
        depth = interpolate_line(drawn.owner, drawn.steps.t, clip[..., 2:3] / clip[..., 3:] / 2 + 0.5)
        color = interpolate_line(drawn.owner, drawn.steps.t, case["attrs"], clip[..., 3])
        # Drawn in order without a depth test: the last segment at a pixel stays.
        at = drawn.pixels[:, 1], drawn.pixels[:, 0]
        primitive = np.full((height, width), -1)
        primitive[at] = drawn.owner
        stays = (primitive[at] == drawn.owner) & (case["prim"][at] == drawn.owner)
        assert stays.any()
        assert np.abs(color - case["color"][at])[stays].max() <= 2e-5, case["name"]
        assert np.abs(depth[:, 0] - case["depth"][at])[stays].max() <= 2e-6, case["name"]


RECORDED = [
    # Arbitrary ends: starts inside a diamond, leaves the last one.
    ("diamond-exit", [[10.25, 2.5], [11.75, 2.5]], ["..........0.", "............", "............"]),
    ("diamond-exit", [[3.5, 1.5], [3.75, 1.5]], ["............", "............", "............"]),
    # The same ties, upwards: one rasterizer steps right, the other stays left.
    ("bresenham", [[4.5, 0.5], [5.5, 2.5]], ["............", ".....0......", "....0......."]),
    ("diamond-exit", [[4.5, 0.5], [5.5, 2.5]], ["............", "....0.......", "....0......."]),
    # A tie on the way right, then on the way left: one steps in its own direction, the other stays upper.
    ("bresenham", [[2.5, 0.5], [4.5, 1.5]], ["............", "...0........", "..0........."]),
    ("diamond-exit", [[2.5, 0.5], [4.5, 1.5]], ["............", "...0........", "..0........."]),
    ("bresenham", [[4.5, 1.5], [2.5, 0.5]], ["............", "....0.......", "...0........"]),
    ("diamond-exit", [[4.5, 1.5], [2.5, 0.5]], ["............", "...00.......", "............"]),
]


@pytest.mark.parametrize(("line", "segment", "rows"), RECORDED)
def test_small_recorded_lines(line, segment, rows):
    drawn = masks([segment], 12, 3, line)[0]
    assert ["".join(".0"[int(pixel)] for pixel in row) for row in drawn[::-1]] == rows
