import pytest
from PySide6.QtCore import QRectF

from widgets.space.frame_corner import picture_area

ROOM = QRectF(0, 0, 600, 400)


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((600, 400), (0, 0, 600, 400)),
        ((1200, 400), (0, 100, 600, 200)),
        ((1920, 1080), (0, 31, 600, 337.5)),
        ((512, 200), (44, 100, 512, 200)),
        ((24, 16), (0, 0, 600, 400)),
        ((100, 150), (200, 50, 200, 300)),
    ],
)
def test_a_picture_is_reduced_to_fit_or_magnified_by_a_whole_number(size, expected):
    area = picture_area(ROOM, size, 1.0)
    assert (area.x(), area.y(), area.width(), area.height()) == pytest.approx(expected)


def test_a_magnified_pixel_is_a_whole_number_of_the_screens_pixels():
    area = picture_area(QRectF(10, 20, 600, 400), (512, 512), 1.5)
    assert area.width() * 1.5 == pytest.approx(512)
    assert (area.x() - 10) * 1.5 == pytest.approx(194)
    assert (area.y() - 20) * 1.5 == pytest.approx(44)


def test_no_room_is_no_error():
    assert picture_area(QRectF(0, 0, 0, 0), (100, 50), 1.0).width() <= 1
