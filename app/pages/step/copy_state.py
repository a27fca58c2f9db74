"""Copy this state: what is on the Step page as a line of a lesson, on the clipboard."""

from typing import TYPE_CHECKING

from PySide6.QtGui import QGuiApplication

if TYPE_CHECKING:
    from app.pages.step.page import StepPage

ONLY_WHOLE = "only the whole view can stand in a lesson: press Shift+F"


def copy_state(page: "StepPage") -> None:
    """Put the line ``state = {...}`` of what is open on the clipboard, and say so; or say why it cannot be."""
    from lessons.course.copied import state_text  # All exercises come along: not before something is copied.

    moment, comparing = page.session.moment, page.comparing
    document, cursor = moment.document, moment.cursor
    is_compared = page.current_view() == "compare"
    try:
        if document.raster.origin is not None or document.before != "earlier":
            raise ValueError(ONLY_WHOLE)
        line = state_text(
            moment.trace,
            document.settings,
            document.title,
            cursor.stage,
            cursor.position,
            pixel=moment.pin,
            triangle=document.triangle,
            buffer=page.grids.look().buffers.get(cursor.stage, ""),
            view=page.current_view(),
            other=comparing.differences if is_compared and not document.edits else None,
            printed=comparing.printed if is_compared else "",
            edits=document.edits,
        )
    except ValueError as problem:
        page.tell(f"This cannot be copied: {problem}.")
    else:
        QGuiApplication.clipboard().setText(f"{line}\n")
        page.tell("Copied: paste it under [[step]] of a lesson.")
