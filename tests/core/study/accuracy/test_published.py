"""Published results: sign maps of Kettner et al., depth precision of Upchurch and Desbrun, counts."""

from collections import Counter

import numpy as np
import pytest

from core.coverage.edges import edge_coefficients
from core.methods import table
from core.study.counted_listings import CountedNumber
from tests.core.study.accuracy.untimed_runs import run


def test_orientation() -> None:
    # Kettner et al. 2008, figure 2: p = (0.5 + x u, 0.5 + y u), q = (12, 12), r = (24, 24), u = 2^-53. With p as pivot
    # the signs of points beside the line are lost and some turned round; with q, the middle one, they are only lost.
    wrong = {work: run("orientation", work)["float64"].errors for work in ("pivot-p", "pivot-q", "pivot-r")}
    assert [each["wrong-signs"] for each in wrong.values()] == [11972, 5752, 11492]
    assert [each["turned-signs"] for each in wrong.values()] == [672, 0, 0]


def test_orientation_with_the_middle_pivot_by_hand() -> None:
    # p - q = -(11.5 - x u): float64 has steps of 16 u there, so x counts as k = round(x / 16), half to even. Times 12
    # it is 138 - 0.75 k steps of 2^-45, rounded again. The sign is lost where x and y end at the same number.
    k = np.rint(0.75 * np.rint(np.arange(256) / 16))
    lost = np.count_nonzero(k[:, None] == k) - 256
    assert run("orientation", "pivot-q")["float64"].errors["wrong-signs"] == lost


def test_orientation_of_other_formats() -> None:
    found = run("orientation", "pivot-p", side=64)
    assert found["exact"].errors == {"wrong-signs": 0, "turned-signs": 0}
    assert all(found[name].errors["wrong-signs"] > 0 for name in ("float16", "float32", "float64"))


@pytest.fixture(scope="module")
def shares() -> dict[str, dict[str, tuple[float, float]]]:
    """Per cent of neighbouring depths that are equal and that are swapped, by work and format, as Reed's defaults."""
    return {
        work: {
            name: (float(found.errors["indistinguishable"]), float(found.errors["swapped"]))
            for name, found in run("depth-steps", work).items()
        }
        for work in ("separate", "precomposed")
    }


def test_depth_steps(shares) -> None:
    # Reed 2015: reversed z in a float buffer has no errors, composed or not.
    for work in shares.values():
        for name in ("reversed-z", "inverse-w", "logarithmic"):
            assert work[name] == (0, 0)
        # "Float32 is no better than 24 bits": what is lost is lost before it is stored.
        assert work["z-float32"] == pytest.approx(work["z-24"], abs=0.1)
    # The simulator that he published gives 77.34 % and 0 % for z with separate matrices, as OpenGL has them,
    # and 52.12 % and 13.86 % with one matrix. Other random points move these by up to 1 %.
    assert shares["separate"]["z-24"] == pytest.approx((77.34, 0), abs=0.05)
    assert shares["precomposed"]["z-24"] == pytest.approx((52.12, 13.86), abs=1.2)


def test_depth_steps_by_hand(shares) -> None:
    # Depth is near / z but for constants. Steps of 1 differ by 2^-24 up to z = sqrt(0.1 2^24) = 1295, then 0.1 2^24
    # (1/1295 - 1/10000) = 1128 numbers are left for 8705 steps: 75.8 % find none of their own.
    for name, bits in (("z-24", 24), ("z-16", 16)):
        numbers = 0.1 * 2**bits
        last = np.sqrt(numbers)
        lost = (10000 - last) - (numbers / last - numbers / 10000)
        assert shares["separate"][name][0] == pytest.approx(lost / 100, abs=2)


def test_a_line_of_bresenham_adds_and_compares_only() -> None:
    # Bresenham 1965: no multiplication and no division; for a movement the sign of D, one addition to D if it goes
    # along the axis, and 2 db - 2 da (here two additions) if it goes along the diagonal.
    tally: Counter[str] = Counter()
    listing = table.get("line", "bresenham").listing
    listing(*(CountedNumber(end, tally) for end in (0, 0, 8, 3)), False)
    steps, diagonals = 8, 3
    assert tally["integer comparisons"] == 3 + steps
    # Before the line: two differences for the octant, two for the lengths, one for D, one for the number of pixels.
    # Then D and x in every step, y and D once more in a diagonal one.
    assert tally["integer additions"] == 2 + 2 + 1 + 1 + 2 * steps + 2 * diagonals
    assert not {"integer multiplications", "integer divisions"} & set(tally)


def test_the_setup_of_olano_and_greer_multiplies_eighteen_times() -> None:
    # Olano and Greer 1997 invert the matrix of (x, y, w) by its adjoint: nine cofactors of two products and a
    # difference. Here the sign of the determinant turns each too. (What could be read of the paper has no table of
    # counts, only a third less time on Pixel-Planes 5.)
    tally: Counter[str] = Counter()
    corners = [[CountedNumber(value, tally) for value in corner] for corner in np.eye(3).tolist()]
    for k in range(3):
        edge_coefficients(*corners[k - 2], *corners[k - 1], 1.0)
    assert tally == {"float multiplications": 18 + 9, "float additions": 9}
