"""The order in which the parts of the Step page show a moment."""

from collections import Counter
from collections.abc import Callable

import pytest

from app.pages.step.panes import order_of_parts
from app.session.document import open_document
from app.window.main_window import MainWindow
from lessons.scenes import make_scene
from tests.calls import calls_of

pytestmark = pytest.mark.shared_window


def refreshes(window: MainWindow, do: Callable[[], object]) -> Counter[str]:
    """Return how often each part is brought up to date, by the page or by another part."""
    return calls_of([show for _, show in order_of_parts(window.page)], do)


@pytest.mark.slow
def test_a_change_refreshes_each_part_once(window: MainWindow) -> None:
    session = window.session
    session.set_stage("raster", 400)
    session.set_pin((3, 3))
    assert max(refreshes(window, lambda: session.set_pin((5, 5))).values()) == 1, "where its history is shown"
    ways: list[Callable[[], object]] = [
        lambda: session.open(open_document(make_scene("cube"), "cube")),
        lambda: session.set_setting("fill", "scanline"),
        lambda: session.set_stage("depth", 5),
        lambda: session.step(1),
        lambda: window.page.set_predicting(True),
        session.undo,
    ]
    for way in ways:
        found = refreshes(window, way)
        assert found
        assert max(found.values()) == 1, found


def test_a_step_of_the_same_listing_asks_nothing_of_it_again(window: MainWindow) -> None:
    session, page = window.session, window.page
    session.set_stage("raster", 400)
    listing = page.inspector.shown_listing
    found = calls_of([page.editing._show_head], lambda: session.step(1))
    assert page.inspector.shown_listing is listing is not None
    assert not found
    assert calls_of([page.editing._show_head], lambda: session.set_stage("depth", 5))
