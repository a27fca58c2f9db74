"""What the actions of the window do, on whatever page: by key, by menu, by a button of a page."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from app.views.view_space import LARGEST_WITH_CAMERA

if TYPE_CHECKING:
    from app.window.main_window import MainWindow


HELP_PAGES = ("guide", "exercise", "glossary", "methods")
"""Pages of Help that the menu opens."""


def window_handlers(window: "MainWindow") -> dict[str, Callable[[], object]]:
    """Return what the actions of ``app.window.keys.ACTIONS`` do that a page cannot do alone."""
    pages, overlays, edits, exports = window.pages, window.overlays, window.edits, window.exports
    return {
        "next_page": partial(pages.show_next, 1),
        "previous_page": partial(pages.show_next, -1),
        "edit_condition": overlays.ask_condition,
        "note_bookmark": overlays.ask_note,
        "go_to_pixel": overlays.ask_pixel,
        "go_to_triangle": overlays.ask_triangle,
        "next_triangle": partial(edits.step_triangle, 1),
        "previous_triangle": partial(edits.step_triangle, -1),
        "unpin": partial(_dismiss, window),
        "predict": lambda: window.page.set_predicting(not window.session.is_predicting),
        "toggle_theme": window.appearance.toggle_theme,
        "text_larger": partial(window.appearance.change_text_size, 1),
        "text_smaller": partial(window.appearance.change_text_size, -1),
        "presenter": window.presenter.toggle,
        "help": window.help.toggle,
        **{f"help_{page}": partial(window.help.show_page, page) for page in HELP_PAGES},
        "show_keys": overlays.toggle_keys,
        "change_keys": overlays.change_keys,
        "next_pane": partial(window.focus_walk.go_pane, 1),
        "previous_pane": partial(window.focus_walk.go_pane, -1),
        "undo": edits.undo,
        "redo": edits.redo,
        "fit_region": partial(_fit_to_triangle, window),
        "whole_picture": partial(_show_whole_picture, window),
        "toggle_shared": edits.toggle_shared,
        "focus_all": edits.focus_all,
        "toggle_cleared": edits.toggle_cleared,
        "open_file": window.files.ask_file,
        "save_state": window.files.ask_save,
        "export_view": exports.ask_export,
        "copy_view": exports.copy,
        "print_view": lambda: exports.print_view(window.session.document.title),
        "export_caption": partial(_toggle_caption, window),
        "quit": window.close,
    }


def _dismiss(window: "MainWindow") -> None:
    """Close what is open on top, stop what runs, or else take the pin away."""
    if window.presenter.end_black() or window.overlays.close_top() or window.help.dismiss():
        return
    page, walk = window.pages.current, window.focus_walk
    if window.files.progress.is_busy:
        window.files.progress.cancel()
    elif window.messages.isVisible():
        window.messages.dismiss()
    elif (page.is_busy() or walk.is_by_mouse or not walk.go_home()) and not page.dismiss():
        window.presenter.leave()


def _fit_to_triangle(window: "MainWindow") -> None:
    """Fit the raster to the triangle in focus; where the 3D view is shown, magnify it there or leave it."""
    window.edits.fit_region()
    if window.page.current_view() == "scene":
        window.page.show_own_view()
        window.page.views.look_at_focus()


def _show_whole_picture(window: "MainWindow") -> None:
    """Show the whole model in the 3D view: its grid would hold a sliver. A small scene is shown on the grid."""
    window.page.grid.fit()
    window.page.views.look_home()
    if window.session.document.triangle_count > LARGEST_WITH_CAMERA:
        window.page.show_view("scene")
    else:
        window.edits.show_whole()


def _toggle_caption(window: "MainWindow") -> None:
    """Export the view with sentence and formula from now on, or without."""
    window.exports.has_caption = not window.exports.has_caption
    window.menus.show_checked("export_caption", window.exports.has_caption)
