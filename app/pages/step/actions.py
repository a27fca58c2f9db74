"""Keys of the Step page that move the cursor, the pin and the playback."""

from functools import partial

from app.pages.page_bar import Handlers
from app.pages.step.bookmarks import BOOKMARKS
from app.pages.step.stepping_presenter import SteppingPresenter
from app.session.session import Session
from core.stages.declared import STAGES
from widgets.timeline.transport import Timeline


def step_handlers(session: Session, stepping: SteppingPresenter, timeline: Timeline) -> Handlers:
    """Return the handlers by the names of ``app.window.keys.ACTIONS``."""
    attempt = stepping.attempt
    return {
        **{f"stage_{k}": partial(stepping.choose_stage, k) for k in range(len(STAGES))},
        **{f"bookmark_{k}": partial(stepping.bookmarks.go_to, k) for k in range(BOOKMARKS)},
        "step_forward": lambda: stepping.step(1),
        "step_back": lambda: stepping.step(-1),
        "larger_forward": lambda: stepping.step_larger(1),
        "larger_back": lambda: stepping.step_larger(-1),
        "level_in": lambda: stepping.change_level(1),
        "level_out": lambda: stepping.change_level(-1),
        "go_first": lambda: stepping.go_to_end(-1),
        "go_last": lambda: stepping.go_to_end(1),
        "toggle_play": stepping.toggle_play,
        "faster": lambda: timeline.change_speed(1),
        "slower": lambda: timeline.change_speed(-1),
        "visited_back": partial(attempt, session.go_back, "No jump to go back from."),
        "visited_forward": partial(attempt, session.go_forward, "No jump was gone back from."),
        "next_at_pin": lambda: stepping.run_to_pin(1),
        "previous_at_pin": lambda: stepping.run_to_pin(-1),
        "next_event": lambda: stepping.run_to_event(1),
        "previous_event": lambda: stepping.run_to_event(-1),
        "run_forward": lambda: stepping.run_to_breakpoint(1),
        "run_back": lambda: stepping.run_to_breakpoint(-1),
        "toggle_breakpoint": stepping.toggle_pixel_breakpoint,
        "toggle_bookmark": stepping.bookmarks.toggle,
        "next_stage": partial(attempt, partial(session.next_stage, 1), "This is the last stage."),
        "previous_stage": partial(attempt, partial(session.next_stage, -1), "This is the first stage."),
        **{
            f"pin_{way}": partial(attempt, partial(session.nudge_pin, *by), "The stepped pixels end here.")
            for way, by in (("left", (-1, 0)), ("right", (1, 0)), ("up", (0, 1)), ("down", (0, -1)))
        },
    }
