import numpy as np
import pytest
from PySide6.QtCore import QRect
from PySide6.QtGui import QColor, QImage, QPainter

from widgets.basics.theme import DARK, LIGHT, Theme
from widgets.grid.layers import (
    BlockOverlay,
    BlockState,
    CellMark,
    CountOverlay,
    MaskOverlay,
    Overlay,
    SegmentOverlay,
    SpanOverlay,
    bounds,
    changed_cells,
    union,
)
from widgets.grid.overlay_paint import paint_above, paint_below
from widgets.grid.view import FIT, place

COLUMNS, ROWS = 6, 4


def painted(overlays: list[Overlay], theme: Theme = LIGHT, side: int = 24) -> QImage:
    image = QImage(COLUMNS * side + 2, ROWS * side + 2, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(QColor("#808080"))
    painter = QPainter(image)
    placement = place(COLUMNS, ROWS, QRect(0, 0, image.width(), image.height()), FIT)
    paint_below(painter, placement, overlays, theme)
    paint_above(painter, placement, overlays, theme)
    painter.end()
    return image


def cell(image: QImage, column: int, row: int, side: int = 24) -> QImage:
    return image.copy(1 + column * side, 1 + (ROWS - 1 - row) * side, side, side)


def one(mark: CellMark, column: int = 2, row: int = 1) -> MaskOverlay:
    mask = np.zeros((ROWS, COLUMNS), np.bool_)
    mask[row, column] = True
    return MaskOverlay(mark.name, mark, mask)


@pytest.mark.parametrize("mark", list(CellMark))
@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_a_mark_is_in_its_cell_only(qapp, mark: CellMark, theme: Theme) -> None:
    plain, marked = painted([], theme), painted([one(mark)], theme)
    for row in range(ROWS):
        for column in range(COLUMNS):
            same = cell(plain, column, row) == cell(marked, column, row)
            assert same == ((column, row) != (2, 1)), (column, row)


def test_marks_differ_without_colour(qapp) -> None:
    forms = set()
    for mark in CellMark:
        picture = cell(painted([one(mark)]), 2, 1).convertToFormat(QImage.Format.Format_Grayscale8)
        grey = np.array([[picture.pixelColor(x, y).value() for x in range(24)] for y in range(24)])
        forms.add((np.sign(grey - 128) * (np.abs(grey - 128) > 10)).tobytes())
    assert len(forms) == len(CellMark)


@pytest.mark.parametrize("mark", list(CellMark))
@pytest.mark.parametrize("side", [2, 5])
def test_marks_are_seen_in_tiny_cells(qapp, mark: CellMark, side: int) -> None:
    mask = np.ones((ROWS, COLUMNS), np.bool_)
    mask[0, 0] = False
    assert painted([MaskOverlay("m", mark, mask)], side=side) != painted([], side=side)


def test_row_0_is_marked_at_the_bottom(qapp) -> None:
    image = painted([one(CellMark.COVERED, 0, 0)])
    assert image.pixelColor(12, image.height() - 12) != QColor("#808080")
    assert image.pixelColor(12, 12) == QColor("#808080")


def test_counts_differ(qapp) -> None:
    counts = np.zeros((ROWS, COLUMNS), np.int32)
    counts[1, 1], counts[1, 2] = 1, 2
    for side in (8, 24):
        image = painted([CountOverlay("o", counts)], side=side)
        cells = [cell(image, column, 1, side) for column in (0, 1, 2)]
        assert cells[0] != cells[1]
        assert cells[1] != cells[2]


def test_block_states_differ(qapp) -> None:
    blocks = np.array([[0, 0, 2, 2]])
    pictures = [painted([BlockOverlay("b", blocks, (state,), ("0,0",))]) for state in BlockState]
    for index, picture in enumerate(pictures):
        assert all(picture != other for other in pictures[index + 1 :])
        assert cell(picture, 4, 3) == cell(painted([]), 4, 3)


def test_spans_and_lines_are_drawn(qapp) -> None:
    span = painted([SpanOverlay("s", np.array([[1, 1, 4], [2, 3, 3]]))])
    assert [cell(span, column, 1) != cell(painted([]), column, 1) for column in range(6)] == [
        0,
        1,
        1,
        1,
        0,
        0,
    ]
    line = np.array([[[0.5, 0.5], [2.5, 0.5]], [[np.nan, 0.0], [1.0, 1.0]], [[1e300, 0.0], [-1e300, 1.0]]])
    part = painted([SegmentOverlay("l", line[:1], (0,))])
    assert cell(part, 4, 0) == cell(painted([]), 4, 0)
    whole = painted([SegmentOverlay("l", line[:1], (0,), extended=True)])
    assert cell(whole, 4, 0) != cell(painted([]), 4, 0)
    assert painted([SegmentOverlay("l", line)]) != painted([])
    assert painted([SegmentOverlay("l", line[:1], tag="window")]) != painted([SegmentOverlay("l", line[:1])])


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: MaskOverlay("m", CellMark.TIE, np.zeros(3, np.bool_)), "mask must be"),
        (lambda: MaskOverlay("m", CellMark.TIE, np.zeros((3, 3), np.int32)), "int32"),
        (lambda: CountOverlay("c", np.zeros((2, 2))), "float64"),
        (lambda: BlockOverlay("b", np.zeros((2, 4), int), (BlockState.LEAF,)), "one entry per block"),
        (lambda: SpanOverlay("s", np.zeros((2, 2), int)), "spans must be"),
        (lambda: SegmentOverlay("l", np.zeros((1, 2, 2)), (0, 1)), "one entry per segment"),
    ],
)
def test_bad_overlays_are_named(make, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_what_changed_between_steps() -> None:
    before, after = one(CellMark.COVERED, 2, 1), one(CellMark.COVERED, 4, 3)
    assert changed_cells((before,), (after,)) == (2, 1, 5, 4)
    assert changed_cells((before,), (before,)) == (0, 0, 0, 0)
    assert changed_cells((before,), ()) is None
    assert changed_cells((before,), (one(CellMark.TIE),)) is None


@pytest.mark.parametrize("wider", [0, 1])
def test_lines_and_blocks_that_are_made_again_change_nothing(wider: int) -> None:
    def overlays(width: int) -> tuple[Overlay, ...]:
        ends = np.array([[[0.0, np.nan], [width, 1.0]]])
        blocks = np.array([[0, 0, width, 2]])
        return (
            SegmentOverlay("l", ends, (0,), extended=True),
            BlockOverlay("b", blocks, (BlockState.LEAF,), labels=("1",)),
            SpanOverlay("s", blocks[:, 1:]),
            CountOverlay("c", blocks),
        )

    for before, after in zip(overlays(3), overlays(3 + wider), strict=True):
        assert changed_cells((before,), (after,)) == (None if wider else (0, 0, 0, 0))


def test_bounds_and_union() -> None:
    assert bounds(np.zeros((3, 3), np.bool_)) == (0, 0, 0, 0)
    assert union((0, 0, 0, 0), (1, 1, 2, 2)) == (1, 1, 2, 2)
    assert union((1, 1, 2, 2), (4, 0, 5, 1)) == (1, 0, 5, 2)
