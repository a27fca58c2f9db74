import pytest
from PySide6.QtGui import QColor

from widgets.basics.drawing import Mark, blended, mark_pixmap

OUTCOMES = [Mark.COVERED, Mark.REJECTED, Mark.TIE, Mark.NAN, Mark.DEPTH_FAILED]


@pytest.mark.parametrize("mark", list(Mark))
def test_every_mark_draws_something_at_any_scale(qtbot, mark: Mark) -> None:
    for ratio in (1.0, 2.0):
        picture = mark_pixmap(mark, 16, ratio).toImage()
        assert picture.width() == 16 * ratio
        side = range(picture.width())
        alphas = [picture.pixelColor(x, y).alpha() for y in side for x in side]
        assert max(alphas) == 255
        assert min(alphas) == 0


def test_outcomes_differ_in_grey_too(qtbot) -> None:
    greys = []
    for mark in OUTCOMES:
        picture = mark_pixmap(mark, 16).toImage()
        greys.append([picture.pixelColor(x, y).alpha() for y in range(16) for x in range(16)])
    for k, first in enumerate(greys):
        for second in greys[k + 1 :]:
            assert sum(abs(a - b) > 128 for a, b in zip(first, second, strict=True)) > 10


def test_blending_over_a_ground() -> None:
    assert blended("#ffffff", "#000000", 0.5) == QColor(128, 128, 128)
    assert blended("#ff0000", "#000000", 1.0) == QColor("#ff0000")
