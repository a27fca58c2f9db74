"""An action and how the table of actions writes one, and what actions do that is more than one call."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar, cast

from app.help.pane import HelpPane
from app.pages.lessons.presenter import WAY_BACK
from app.pages.step.page import StepPage
from app.pages.step.panes import PANES, Pane, SidePane
from app.pages.step.stepping_presenter import SteppingPresenter
from app.views.view_space import LARGEST_WITH_CAMERA
from app.window.focus_walk import FocusWalk
from app.window.keys import KeyAction
from app.window.menus import next_entry, printed_group, scene_groups, scenes_about
from app.window.parts import WindowParts
from app.window.presenter import Presenter
from app.window.remembering import Remembering
from core.scene import ClipScene
from core.stages.declared import STAGES, stage_of

if TYPE_CHECKING:
    # A page is imported when it is first shown, see app.pages.page_table.
    from app.pages.compare.page import ComparePage
    from app.pages.exercises.page import ExercisesPage
    from app.pages.plan.page import PlanPage
    from app.pages.stability.page import StabilityPage
    from app.pages.start_page import StartPage


class ActionWindow(WindowParts):
    """What actions reach of a window."""

    help: HelpPane
    presenter: Presenter
    focus_walk: FocusWalk
    memory: Remembering

    @property
    def stepping(self) -> SteppingPresenter:
        """What moves the cursor of the Step page."""
        return self.page.stepping

    @property
    def start(self) -> "StartPage":
        """The Start page."""
        return cast("StartPage", self.pages.page("start"))

    @property
    def compare(self) -> "ComparePage":
        """The Compare page."""
        return cast("ComparePage", self.pages.page("compare"))

    @property
    def stability(self) -> "StabilityPage":
        """The Stability page."""
        return cast("StabilityPage", self.pages.page("stability"))

    @property
    def plan(self) -> "PlanPage":
        """The Plan page."""
        return cast("PlanPage", self.pages.page("plan"))

    @property
    def exercises(self) -> "ExercisesPage":
        """The Exercises page."""
        return cast("ExercisesPage", self.pages.page("exercises"))


@dataclass(frozen=True)
class Action(KeyAction):
    """A key's or a menu's action, and what it does."""

    do: Callable[[ActionWindow], object] = field(kw_only=True)
    is_on: Callable[[ActionWindow], bool] | None = field(default=None, kw_only=True)
    """Whether what it switches is on; ``None``: it switches nothing."""

    @property
    def is_checkable(self) -> bool:
        """Whether it switches something on and off."""
        return self.is_on is not None


Part = TypeVar("Part")


@dataclass(frozen=True)
class Row(Generic[Part]):
    """An action as the table writes it: among others of its page, its group of keys, and its menu."""

    name: str
    keys: str
    """Qt's portable texts, between spaces."""
    title: str
    do: Callable[[Part], object]
    is_on: Callable[[ActionWindow], bool] | None = None
    ends_group: bool = False


class _Rows(Protocol[Part]):
    """Makes actions of rows."""

    def __call__(self, *rows: Row[Part]) -> Iterator[Action]: ...


def rows_of(page: str, group: str, menu: str, part: Callable[[ActionWindow], Part]) -> "_Rows[Part]":
    """Return what makes actions of rows that do something with the same part of a window."""

    def action(row: Row[Part]) -> Action:
        return Action(
            row.name,
            tuple(row.keys.split()),
            row.title,
            group,
            menu,
            page,
            do=lambda window: row.do(part(window)),
            is_on=row.is_on,
            ends_group=row.ends_group,
        )

    return lambda *rows: map(action, rows)


def whole_window(window: ActionWindow) -> ActionWindow:
    """Return the window: what actions of no page work on."""
    return window


def pane_row(pane: Pane) -> Row[ActionWindow]:
    """Return what shows a pane of the Step page or folds it away."""
    name, title = pane.name, f"{pane.title} pane" if isinstance(pane, SidePane) else pane.title
    return Row(
        f"pane_{name}",
        pane.key,
        title,
        lambda w: w.page.toggle_pane(name),
        lambda w: name in w.page.shown_panes(),
        ends_group=pane is PANES[-1],
    )


def page_row(name: str, keys: str, title: str) -> Row[ActionWindow]:
    """Return what shows a page."""
    return Row(
        f"page_{name}", keys, title, lambda w: w.pages.show_page(name), lambda w: w.pages.current_name == name
    )


def bookmark_row(k: int) -> Row[ActionWindow]:
    """Return what goes to a bookmark."""
    title = f"Go to bookmark {k + 1}"
    return Row(f"bookmark_{k}", f"Ctrl+{(k + 1) % 10}", title, lambda w: w.stepping.bookmarks.go_to(k))


def stage_row(k: int) -> Row[ActionWindow]:
    """Return what goes to the start of a stage; the first ten have a digit."""
    key = str((k + 1) % 10) if k < 10 else ""
    return Row(f"stage_{k}", key, stage_of(STAGES[k]).short_title, lambda w: w.stepping.choose_stage(k))


def way_row(
    name: str,
    modifiers: str,
    title: str,
    act: Callable[[StepPage, int, int], None],
    way: str,
    where: str,
    by: tuple[int, int],
) -> Row[ActionWindow]:
    """Return what does something in one of the four ways."""
    keys = f"{modifiers}+{way.capitalize()}"
    return Row(f"{name}_{way}", keys, f"{title} {where}", lambda w: act(w.page, *by))


def undo(w: ActionWindow) -> None:
    """Take back the last edit of the page that has edits of its own, or else of the scene."""
    if not w.pages.current.undo():
        w.edits.undo()


def redo(w: ActionWindow) -> None:
    """Do it again."""
    if not w.pages.current.redo():
        w.edits.redo()


def export_view(w: ActionWindow) -> None:
    """Export what a page draws itself, or else its view."""
    if not w.pages.current.export_view():
        w.exports.ask_export()


def copy_what_is_shown(w: ActionWindow) -> None:
    """Copy what a page draws itself, or else its view."""
    if not w.pages.current.copy_view():
        w.exports.copy()


def dismiss(w: ActionWindow) -> None:
    """End the first of these: a black screen, a run, an editor, a message, orbiting by key, a pin, presenting.

    A hint beside the names of the pages goes in any case.
    """
    has_hint = w.presenter.hint.isVisible()
    w.statusBar().clearMessage()
    if not (
        w.presenter.end_black()
        or _stop_run(w)
        or w.overlays.close_top()
        or w.help.dismiss()
        or _end_message(w)
        or has_hint
        or w.focus_walk.go_home()
        or w.pages.current.dismiss()
    ):
        w.presenter.leave()


def _stop_run(w: ActionWindow) -> bool:
    """Stop opening a file, or else what runs on the page; return whether anything ran."""
    if w.files.progress.is_busy:
        w.files.progress.cancel()
        return True
    return w.pages.current.is_busy() and w.pages.current.dismiss()


def _end_message(w: ActionWindow) -> bool:
    """Take the message away that stays until then; return whether there was one."""
    was_shown = w.messages.isVisible()
    if was_shown:
        w.messages.dismiss()
    return was_shown


def choose_scene(w: ActionWindow) -> None:
    """Offer the way back to a lesson, lessons, states, files, scenes and printed listings; the next one is at hand."""
    lessons = w.page.lessons
    groups = scene_groups(w.files.states(), w.memory.preferences.recent_files, lessons.listed())
    groups |= printed_group(w.session.document)
    begins_at_lesson = lessons.last is not None and not lessons.is_open
    first = WAY_BACK if begins_at_lesson else next_entry(groups, lessons.path or w.files.shown)
    w.overlays.choose_scene(groups, first, {**scenes_about(), **lessons.about()})


def fit_to_triangle(w: ActionWindow) -> None:
    """Fit the raster to the triangle in focus; where the 3D view is shown, magnify it there or leave it."""
    w.edits.fit_region()
    if w.page.current_view() == "scene":
        w.page.show_own_view()
        w.page.views.look_at_focus()


def show_whole_picture(w: ActionWindow) -> None:
    """Show the whole model in the 3D view: its grid would hold a sliver. A small scene is shown on the grid."""
    w.page.grid.fit()
    w.page.views.look_home()
    if w.session.document.triangle_count > LARGEST_WITH_CAMERA:
        w.page.show_view("scene")
    else:
        w.edits.show_whole()


def toggle_caption(w: ActionWindow) -> None:
    """Export the view with sentence and formula from now on, or without."""
    w.exports.has_caption = not w.exports.has_caption


def has_shared_vertices(w: ActionWindow) -> bool:
    """Return whether triangles of the scene share vertices."""
    scene = w.session.document.scene
    return not isinstance(scene, ClipScene) or scene.shared is not None
