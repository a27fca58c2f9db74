"""What the Step page shows, and how, as a state file keeps it."""

from typing import TYPE_CHECKING

from app.files.state_files import State
from app.files.state_models import Look, OrbitRecord, TextSize
from app.session.cursor import Cursor
from core import Trace
from core.records.steps import Level
from widgets.space.orbit import Orbit

if TYPE_CHECKING:
    from app.pages.step.page import StepPage


def state_of(page: "StepPage", text_size: TextSize) -> State:
    """Return what a state file keeps."""
    moment, stepping = page.session.moment, page.stepping
    return State(
        document=moment.document,
        stage=moment.cursor.stage,
        position=moment.cursor.position,
        level=int(moment.cursor.level),
        pin=moment.pin,
        bookmarks=tuple(stepping.bookmarks.marks),
        breakpoints=stepping.breaks.record(),
        look=look_of(page, text_size),
    )


def show_state(page: "StepPage", state: State, trace: Trace | None = None) -> None:
    """Show what a state file has kept, with its trace if that is there already."""
    session = page.session
    page.timeline.show_playing(False)
    session.open(state.document, trace, Cursor(state.stage, state.position, Level(state.level)))
    page.stepping.set_places(state.bookmarks, state.breakpoints)
    session.set_pin(state.pin)
    show_look(page, state.look)
    page.column.show_step()


def look_of(page: "StepPage", text_size: TextSize) -> Look:
    """Return how the page shows the run, in text of a size in percent."""
    return Look(
        view=page.current_view(),
        views=dict(page.main_area.views_by_hand),
        grid=page.grids.look(),
        orbits={name: OrbitRecord(**vars(orbit)) for name, orbit in page.views.chosen_orbits().items()},
        other=dict(page.comparing.differences),
        printed=page.comparing.printed,
        drafts=page.editing.drafts,
        other_buffer=page.comparing.buffer,
        panes=page.desk_panes(),
        text_size=text_size,
        shader_drafts=page.shading.drafts(),
        event=page.stepping.event_kind,
    )


def show_look(page: "StepPage", look: Look) -> None:
    """Show the run as it was shown."""
    page.main_area.views_by_hand = dict(look.views)
    page.comparing.set_buffer(look.other_buffer)
    if not page.session.document.edits:
        page.comparing.set_differences(look.other)
    if look.printed:
        page.comparing.show_printed(look.printed, seeks=False)
    page.editing.show_drafts(look.drafts)
    page.events.choose(look.event)
    if look.panes is not None:
        page.show_desk_panes(look.panes)
    page.grids.show_look(look.grid)
    page.views.look_from({name: Orbit(**dict(orbit)) for name, orbit in look.orbits.items()})
    page.show_view(look.view)
    page.shading.show_drafts(look.shader_drafts)
    if look.lesson is not None:
        page.lessons.open(*look.lesson)
