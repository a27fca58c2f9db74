"""Predict hides all that it asks: two scenes that differ only in the answer look the same, in every pixel."""

from collections.abc import Callable

import numpy as np
import pytest
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtWidgets import QApplication

from app.session.document import open_document
from app.window.main_window import MainWindow
from core import ClipScene, Settings
from core.explain.steps import question
from core.records.steps import Level
from core.trace.stage_trace import StageTrace
from lessons.scenes import make_scene
from tests.covering import every_nth
from widgets.grid.layers import CellMark, MaskOverlay

pytestmark = pytest.mark.shared_window

SETTINGS = Settings(fill="bounding-box", coverage="float64")
HAIR = 1e-9
"""How far a corner is moved: less than any text or line shows, enough to decide another way."""


def tied(nearer: float) -> ClipScene:
    """Return two triangles: the first one's left edge runs through pixel centres, but for a hair to the left."""
    corners = np.array([[-0.75 - nearer, -0.75, 0, 1], [0.8, -0.75, 0, 1], [-0.75 - nearer, 0.8, 0, 1]])
    # Turned over, the edge is a right one: a centre on it is not covered.
    front = corners * [-1, 1, 1, 1]
    back = np.array([[-0.5, -0.9, 0.5, 1], [0.9, -0.9, 0.5, 1], [0.9, 0.9, 0.5, 1]])
    return ClipScene(np.array([front[[1, 0, 2]], back]), np.zeros((2, 3, 4)), (12, 12))


def colored(green: float) -> ClipScene:
    """Return a triangle whose corners carry a value, which no text of the scene shows."""
    corners = np.array([[[-0.75, -0.75, 0, 1], [0.8, -0.75, 0, 1], [-0.75, 0.8, 0, 1]]])
    return ClipScene(corners, np.full((1, 3, 4), green), (12, 12))


def seen(window: MainWindow) -> tuple[QImage, QImage, list[str]]:
    """Return the whole window, what copying the view gives, and what every pixel tells."""
    window.page.settle()
    QApplication.processEvents()
    window.run_action("copy_view")
    copied = QGuiApplication.clipboard().image()
    window.statusBar().clearMessage()
    window.messages.clear()
    grid = window.page.grid
    texts = [grid.value_text((column, row)) for row in range(12) for column in range(12)]
    assert not copied.isNull()
    return window.grab().toImage(), copied, texts


def first_difference(first: StageTrace, second: StageTrace) -> int:
    """Return the first row that has another answer in each of two traces that list the same rows."""
    asked = ((question(first, row), question(second, row)) for row in range(first.steps.row_count))
    return next(
        row for row, (one, other) in enumerate(asked) if (one and one.reveal) != (other and other.reveal)
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fill", "stage", "make", "change", "is_row_asked"),
    [
        ("bounding-box", "raster", tied, HAIR, True),
        ("hierarchy", "raster", tied, HAIR, False),
        ("spans", "raster", tied, HAIR, False),
        ("bounding-box", "shade", colored, 0.5, False),
    ],
)
def test_two_answers_look_alike(
    window: MainWindow,
    fill: str,
    stage: str,
    make: Callable[[float], ClipScene],
    change: float,
    is_row_asked: bool,
) -> None:
    settings = Settings(fill=fill, coverage="float64")
    documents = [open_document(make(value), "Tie", settings=settings) for value in (0.0, change)]
    traces = [document.make_trace().stage(stage) for document in documents]
    window.run_action("predict")
    row = first_difference(*traces) if is_row_asked else 0
    for position in {0, int(traces[0].steps.starts[row])}:
        shown = []
        for document in documents:
            # From the same place: the room of the formula is that of the tallest one seen in the stage.
            window.session.set_stage("transform", 0)
            window.session.open(document)
            window.session.set_level(Level.PIXEL)
            window.session.set_stage(stage, position)
            shown.append(seen(window))
        for first, second in zip(*shown, strict=True):
            assert first == second


def test_no_view_tells_anything_of_a_pixel(window: MainWindow) -> None:
    """Weights, rays, texels: views look the same whatever pixel is pinned, in every stage from the raster on."""
    page, session = window.page, window.session
    session.open(open_document(make_scene("shared-edge"), "Shared edge"))
    page.set_predicting(True)
    views = [name for name in page.view_names() if name != "pixels"]
    for stage in every_nth(("raster", "interpolate", "depth"), 3):
        session.set_stage(stage, 0)
        for view in views:
            page.show_view(view)
            page.settle()
            looks = []
            for pixel in ((20, 20), (40, 30)):
                session.set_pin(pixel)
                page.settle()
                shown = page.main_view()
                # Below the time that drawing has taken.
                looks.append(shown.grab(shown.rect().adjusted(0, 30, 0, 0)).toImage())
            assert looks[0] == looks[1], (stage, view)


def test_right_extra_and_missing_pixels_have_their_own_shapes(window: MainWindow) -> None:
    window.session.open(open_document(tied(0.0), "Tie", settings=SETTINGS))
    window.session.set_stage("raster", 0)
    window.run_action("predict")
    page = window.page
    covered = window.session.trace.source.picture.primitive >= 0
    right = tuple(np.argwhere(covered)[0][::-1].tolist())
    wrong = tuple(np.argwhere(~covered)[0][::-1].tolist())
    for pixel in (right, wrong):
        page.grid.pixel_clicked.emit(*pixel)
    marked = {o.mark: o.mask for o in page.grid.overlays() if isinstance(o, MaskOverlay)}
    assert np.argwhere(marked[CellMark.RIGHT]).tolist() == [[*right[::-1]]]
    assert np.argwhere(marked[CellMark.EXTRA]).tolist() == [[*wrong[::-1]]]
    assert not marked[CellMark.MISSING].any()
    page.prediction.reveal_button.click()
    marked = {o.mark: o.mask for o in page.grid.overlays() if isinstance(o, MaskOverlay)}
    assert int(marked[CellMark.MISSING].sum()) == int(covered.sum()) - 1
    assert page.grid.hidden() is None


def test_the_grid_keeps_its_place(window: MainWindow) -> None:
    page = window.page
    window.session.set_stage("raster", 0)
    QApplication.processEvents()
    before = page.grid.mapTo(window, page.grid.rect().topLeft()), page.grid.size()
    window.run_action("predict")
    places = set()
    for _ in range(3):
        page.grid.pixel_clicked.emit(20, 20)
        QApplication.processEvents()
        places.add(
            (page.grid.mapTo(window, page.grid.rect().topLeft()).toTuple(), page.grid.size().toTuple())
        )
        window.session.step(1)
    assert places == {(before[0].toTuple(), before[1].toTuple())}


def test_no_search_ahead_tells_what_comes(window: MainWindow) -> None:
    session, stepping = window.session, window.page.stepping
    session.set_stage("raster", 0)
    session.set_pin((27, 20))
    window.page.set_predicting(True)
    before = session.cursor
    for search in (stepping.run_to_pin, stepping.run_to_event, stepping.run_to_breakpoint):
        search(1)
        assert session.cursor == before
        assert "P ends predicting" in window.statusBar().currentMessage()
