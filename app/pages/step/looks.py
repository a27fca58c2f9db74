"""How the Step page shows the run, as a state file keeps it."""

from app.files.state_models import Look, OrbitRecord, TextSize
from app.pages.step.page import StepPage
from widgets.space.orbit import Orbit


def look_of(page: StepPage, text_size: TextSize) -> Look:
    """Return how the page shows the run, in text of a size in percent."""
    return Look(
        view=page.current_view(),
        views=dict(page.main_area.views_by_hand),
        grid=page.grids.look(),
        orbits={name: OrbitRecord(**vars(orbit)) for name, orbit in page.views.chosen_orbits().items()},
        other=dict(page.comparing.differences),
        printed=page.comparing.printed,
        other_buffer=page.comparing.buffer,
        panes=page.desk_panes(),
        text_size=text_size,
        event=page.stepping.event_kind,
    )


def show_look(page: StepPage, look: Look) -> None:
    """Show the run as it was shown."""
    page.main_area.views_by_hand = dict(look.views)
    page.comparing.set_buffer(look.other_buffer)
    page.comparing.set_differences(look.other)
    if look.printed:
        page.comparing.show_printed(look.printed, seeks=False)
    page.events.choose(look.event)
    if look.panes is not None:
        page.show_desk_panes(look.panes)
    page.grids.show_look(look.grid)
    page.views.look_from({name: Orbit(**dict(orbit)) for name, orbit in look.orbits.items()})
    page.show_view(look.view)
