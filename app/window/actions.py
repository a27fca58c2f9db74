"""The one table of actions: keys, menus, buttons, the page of keys and the links of Help are made from it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Generic, Protocol, TypeVar, cast

from app.help.pane import HelpPane
from app.pages.step.bookmarks import BOOKMARKS
from app.pages.step.copy_state import copy_state
from app.pages.step.lesson_presenter import WAY_BACK
from app.pages.step.page import PANES, Pane, SidePane, StepPage
from app.pages.step.stepping_presenter import SteppingPresenter
from app.pages.step.view_keys import ZOOM, choose_vertex, move_view, nudge_vertex, zoom
from app.views.view_space import LARGEST_WITH_CAMERA
from app.window.focus_walk import FocusWalk
from app.window.keys import (
    ANSWERING,
    CHARTS,
    EDITING,
    EXPERIMENTS,
    FILES,
    HELP,
    LESSONS,
    MAPS,
    MEASURING,
    PAGES,
    PLANNING,
    POINTING,
    RUNNING,
    STAGE_GROUP,
    STEPPING,
    VIEWING,
    KeyAction,
)
from app.window.parts import WindowParts
from app.window.presenter import Presenter
from app.window.remembering import Remembering
from app.window.scene_groups import next_entry, printed_group, scene_groups, scenes_about
from core.scene import ClipScene
from core.stages.declared import STAGES, stage_of

if TYPE_CHECKING:
    # A page is imported when it is first shown, see app.pages.page_table.
    from app.pages.compare.page import ComparePage
    from app.pages.exercises.page import ExercisesPage
    from app.pages.plan.page import PlanPage
    from app.pages.stability.page import StabilityPage
    from app.pages.start.page import StartPage


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


def _rows(page: str, group: str, menu: str, part: Callable[[ActionWindow], Part]) -> "_Rows[Part]":
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


def _window(window: ActionWindow) -> ActionWindow:
    return window


def _pane(pane: Pane) -> Row[ActionWindow]:
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


def _page(name: str, keys: str, title: str) -> Row[ActionWindow]:
    """Return what shows a page."""
    return Row(
        f"page_{name}",
        keys,
        title,
        lambda w: w.pages.show_page(name),
        lambda w: w.pages.current_name == name,
    )


def _bookmark(k: int) -> Row[ActionWindow]:
    """Return what goes to a bookmark."""
    title = f"Go to bookmark {k + 1}"
    return Row(f"bookmark_{k}", f"Ctrl+{(k + 1) % 10}", title, lambda w: w.stepping.bookmarks.go_to(k))


def _stage(k: int) -> Row[ActionWindow]:
    """Return what goes to the start of a stage; the first ten have a digit."""
    key = str((k + 1) % 10) if k < 10 else ""
    return Row(f"stage_{k}", key, stage_of(STAGES[k]).short_title, lambda w: w.stepping.choose_stage(k))


def _way(
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


def _undo(w: ActionWindow) -> None:
    """Take back the last edit of the page that has edits of its own, or else of the scene."""
    if not w.pages.current.undo():
        w.edits.undo()


def _redo(w: ActionWindow) -> None:
    """Do it again."""
    if not w.pages.current.redo():
        w.edits.redo()


def _export(w: ActionWindow) -> None:
    """Export what a page draws itself, or else its view."""
    if not w.pages.current.export_view():
        w.exports.ask_export()


def _copy(w: ActionWindow) -> None:
    """Copy what a page draws itself, or else its view."""
    if not w.pages.current.copy_view():
        w.exports.copy()


def _dismiss(w: ActionWindow) -> None:
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


def _choose_scene(w: ActionWindow) -> None:
    """Offer the way back to a lesson, lessons, states, files, scenes and printed listings; the next one is at hand."""
    lessons = w.page.lessons
    groups = scene_groups(w.files.states(), w.memory.preferences.recent_files, lessons.listed())
    groups |= printed_group(w.session.document)
    begins_at_lesson = lessons.last is not None and not lessons.is_open
    first = WAY_BACK if begins_at_lesson else next_entry(groups, lessons.path or w.files.shown)
    w.overlays.choose_scene(groups, first, {**scenes_about(), **lessons.about()})


def _fit_to_triangle(w: ActionWindow) -> None:
    """Fit the raster to the triangle in focus; where the 3D view is shown, magnify it there or leave it."""
    w.edits.fit_region()
    if w.page.current_view() == "scene":
        w.page.show_own_view()
        w.page.views.look_at_focus()


def _show_whole_picture(w: ActionWindow) -> None:
    """Show the whole model in the 3D view: its grid would hold a sliver. A small scene is shown on the grid."""
    w.page.grid.fit()
    w.page.views.look_home()
    if w.session.document.triangle_count > LARGEST_WITH_CAMERA:
        w.page.show_view("scene")
    else:
        w.edits.show_whole()


def _toggle_caption(w: ActionWindow) -> None:
    """Export the view with sentence and formula from now on, or without."""
    w.exports.has_caption = not w.exports.has_caption


def _has_shared_vertices(w: ActionWindow) -> bool:
    scene = w.session.document.scene
    return not isinstance(scene, ClipScene) or scene.shared is not None


WAYS = (
    ("left", "to the left", (-1, 0)),
    ("right", "to the right", (1, 0)),
    ("up", "up", (0, 1)),
    ("down", "down", (0, -1)),
)
"""Four ways, in words, and in columns and rows (y up)."""
ACTIONS: tuple[Action, ...] = (
    *_rows("step", STEPPING, "Step", _window)(
        Row("step_forward", "Right", "Step forward", lambda w: w.stepping.step(1)),
        Row("step_back", "Left", "Step back", lambda w: w.stepping.step(-1)),
        Row(
            "larger_forward",
            "Shift+Right F10",
            "Larger step forward (over)",
            lambda w: w.stepping.step_larger(1),
        ),
        Row("larger_back", "Shift+Left Ctrl+F10", "Larger step back", lambda w: w.stepping.step_larger(-1)),
        Row("level_in", "Down F11", "Smaller steps (into)", lambda w: w.stepping.change_level(1)),
        Row("level_out", "Up Shift+F11", "Larger steps (out)", lambda w: w.stepping.change_level(-1)),
        Row("go_first", "Home", "Go to the start of the stage", lambda w: w.stepping.go_to_end(-1)),
        Row("go_last", "End", "Go to the end of the stage", lambda w: w.stepping.go_to_end(1)),
        Row("toggle_play", "Space", "Play or pause", lambda w: w.stepping.toggle_play()),
    ),
    *_rows("step", STEPPING, "", lambda w: w.page.timeline)(
        Row("faster", "+ =", "Play faster", lambda p: p.change_speed(1)),
        Row("slower", "-", "Play slower", lambda p: p.change_speed(-1)),
    ),
    *_rows("step", STEPPING, "Step", lambda w: w.stepping)(
        Row("visited_back", "Ctrl+[", "Back to the step before the jump", lambda p: p.go_back()),
        Row("visited_forward", "Ctrl+]", "Forward again", lambda p: p.go_forward(), ends_group=True),
    ),
    *_rows("step", RUNNING, "Step", _window)(
        Row("next_at_pin", "J", "Next step at the pinned pixel", lambda w: w.stepping.run_to_pin(1)),
        Row("previous_at_pin", "K", "Previous step at the pinned pixel", lambda w: w.stepping.run_to_pin(-1)),
        Row("next_event", "N", "Next event of the chosen kind", lambda w: w.stepping.run_to_event(1)),
        Row(
            "previous_event",
            "Shift+N",
            "Previous event of the chosen kind",
            lambda w: w.stepping.run_to_event(-1),
        ),
        Row("run_forward", "F5", "Run to the next breakpoint", lambda w: w.stepping.run_to_breakpoint(1)),
        Row(
            "run_back",
            "Ctrl+F5",
            "Run back to the last breakpoint",
            lambda w: w.stepping.run_to_breakpoint(-1),
        ),
        Row(
            "toggle_breakpoint",
            "F9 B",
            "Breakpoint at the pinned pixel",
            lambda w: w.stepping.toggle_pixel_breakpoint(),
        ),
        Row("edit_condition", "Ctrl+F9", "Breakpoint on a condition…", lambda w: w.overlays.ask_condition()),
        Row("toggle_bookmark", "Ctrl+B", "Bookmark this step", lambda w: w.stepping.bookmarks.toggle()),
        Row("note_bookmark", "Ctrl+Shift+B", "Bookmark with a note…", lambda w: w.overlays.ask_note()),
    ),
    *_rows("step", RUNNING, "", _window)(*(_bookmark(k) for k in range(BOOKMARKS))),
    *_rows("step", STAGE_GROUP, "Stage", _window)(
        *(_stage(k) for k in range(len(STAGES))),
        Row("next_stage", "Ctrl+PgDown", "Next stage", lambda w: w.stepping.go_to_stage(1)),
        Row("previous_stage", "Ctrl+PgUp", "Previous stage", lambda w: w.stepping.go_to_stage(-1)),
    ),
    *_rows("step", LESSONS, "Lesson", lambda w: w.page.lessons)(
        Row("lesson_next", "PgDown", "Next step of the lesson", lambda p: p.next()),
        Row("lesson_back", "PgUp", "Previous step of the lesson", lambda p: p.back()),
        Row("lesson_return", "Ctrl+Home", "Return to the lesson’s step", lambda p: p.return_here()),
        Row("lesson_check", "Ctrl+Return", "Check the answer", lambda p: p.check()),
        Row("lesson_reveal", "Ctrl+M", "Show what is right", lambda p: p.reveal(), ends_group=True),
        Row("lesson_anew", "", "Begin the lesson anew", lambda p: p.begin_anew()),
        Row("lesson_close", "", "Close the lesson", lambda p: p.close()),
    ),
    *_rows("step", LESSONS, "Lesson", lambda w: w.page)(
        Row("lesson_copy", "", "Copy this state for a lesson", copy_state),
    ),
    *_rows("step", POINTING, "", lambda w: w.stepping)(
        Row("pin_left", "Alt+Left", "Move the pin left", lambda p: p.move_pin(-1, 0)),
        Row("pin_right", "Alt+Right", "Move the pin right", lambda p: p.move_pin(1, 0)),
        Row("pin_up", "Alt+Up", "Move the pin up", lambda p: p.move_pin(0, 1)),
        Row("pin_down", "Alt+Down", "Move the pin down", lambda p: p.move_pin(0, -1)),
    ),
    *_rows("step", POINTING, "Step", _window)(
        Row(
            "value_origin_pixel",
            "Y",
            "Where does the pinned value come from?",
            lambda w: w.page.go_to_writer(),
        )
    ),
    *_rows("step", POINTING, "View", _window)(
        Row("go_to_pixel", "Ctrl+G", "Go to pixel…", lambda w: w.overlays.ask_pixel())
    ),
    *_rows("step", VIEWING, "View", _window)(
        Row(
            "zoom_in", "Alt++ Alt+=", "Magnify the view, or the timeline in it", lambda w: zoom(w.page, ZOOM)
        ),
        Row("zoom_out", "Alt+-", "Magnify less", lambda w: zoom(w.page, 1 / ZOOM)),
    ),
    *_rows("step", VIEWING, "", _window)(
        *(_way("view", "Ctrl", "Look further", move_view, *way) for way in WAYS)
    ),
    *_rows("", VIEWING, "", _window)(
        Row("unpin", "Escape", "Stop work, close the top pane or message, or remove the pin", _dismiss)
    ),
    *_rows("step", VIEWING, "View", _window)(
        Row("fit_view", "W", "Show all stepped pixels", lambda w: w.page.fit()),
        Row("next_view", "V", "Next main view", lambda w: w.page.main_area.next_view()),
        Row(
            "compare",
            "Ctrl+D",
            "A | B | difference",
            lambda w: w.page.toggle_compare(),
            is_on=lambda w: w.page.current_view() == "compare",
            ends_group=True,
        ),
    ),
    *_rows("step", VIEWING, "", _window)(
        Row("flip", "X", "Swap the pictures of A and B while held", lambda w: w.page.flip())
    ),
    *_rows("step", VIEWING, "View", _window)(
        Row("edit_line", "F2", "Edit the line of the listing", lambda w: w.page.editing.edit_chosen_line()),
        Row("divergence", "D", "First divergence of A and B", lambda w: w.page.comparing.go_to_divergence()),
    ),
    *_rows("step", VIEWING, "View/Panes", _window)(*map(_pane, PANES)),
    *_rows("step", VIEWING, "View", _window)(
        Row(
            "predict",
            "P",
            "Predict, then reveal",
            lambda w: w.page.toggle_predicting(),
            is_on=lambda w: w.session.is_predicting,
        ),
        Row("ask_step", "Q", "Ask this step as a question", lambda w: w.page.asking.ask_step()),
        Row(
            "ask_value",
            "Shift+Q",
            "Ask for the value of the pinned pixel",
            lambda w: w.page.ask_value(),
            ends_group=True,
        ),
    ),
    *_rows("", PAGES, "Help", _window)(
        Row("page_start", "Alt+0", "Start page", lambda w: w.pages.show_page("start"))
    ),
    *_rows("start", STEPPING, "", _window)(
        Row("begin_stepping", "Right", "Step what is open", lambda w: w.start.step_on())
    ),
    *_rows("", PAGES, "View/Pages", _window)(
        _page("step", "Alt+1", "Step page"),
        _page("compare", "Alt+2", "Compare page"),
        _page("stability", "Alt+3", "Stability page"),
        _page("plan", "Alt+4", "Plan page"),
        _page("exercises", "Alt+5", "Exercises page"),
    ),
    *_rows("", PAGES, "View/Panes", _window)(
        Row("next_pane", "F6", "Next pane", lambda w: w.focus_walk.go_pane(1)),
        Row("previous_pane", "Shift+F6", "Previous pane", lambda w: w.focus_walk.go_pane(-1)),
    ),
    *_rows("", PAGES, "", lambda w: w.pages)(
        Row("next_page", "Ctrl+Tab", "Next page", lambda p: p.show_next(1)),
        Row("previous_page", "Ctrl+Shift+Tab", "Previous page", lambda p: p.show_next(-1)),
    ),
    *_rows("", VIEWING, "View", _window)(
        Row("toggle_theme", "Ctrl+T", "Light or dark", lambda w: w.appearance.toggle_theme()),
        Row("text_larger", "Ctrl++ Ctrl+=", "Larger text", lambda w: w.appearance.change_text_size(1)),
        Row("text_smaller", "Ctrl+-", "Smaller text", lambda w: w.appearance.change_text_size(-1)),
        Row(
            "presenter",
            "Ctrl+Shift+P",
            "Presenter: full screen, large type",
            lambda w: w.presenter.toggle(),
            is_on=lambda w: w.presenter.is_presenting,
        ),
    ),
    *_rows("", HELP, "Help", _window)(
        Row("help", "F1", "Help on what is pointed at", lambda w: w.help.toggle()),
        Row("help_guide", "", "Five-minute guide", lambda w: w.help.show_page("guide")),
        Row("help_editing", "", "Change a line", lambda w: w.help.show_page("editing")),
        Row("help_exercise", "", "Your own exercise", lambda w: w.help.show_page("exercise")),
        Row("help_glossary", "", "Glossary", lambda w: w.help.show_page("glossary")),
        Row("help_methods", "", "Methods: sources, limits, listings", lambda w: w.help.show_page("methods")),
        Row("show_keys", "?", "All keys", lambda w: w.overlays.toggle_keys()),
        Row("change_keys", "", "Change keys…", lambda w: w.overlays.change_keys()),
    ),
    *_rows("step", EDITING, "Raster", _window)(
        Row("next_triangle", "Alt+J", "Next triangle", lambda w: w.edits.step_triangle(1)),
        Row("previous_triangle", "Alt+K", "Previous triangle", lambda w: w.edits.step_triangle(-1)),
        Row("go_to_triangle", "Ctrl+Shift+G", "Go to triangle…", lambda w: w.overlays.ask_triangle()),
    ),
    *_rows("step", EDITING, "Edit", _window)(
        Row("next_vertex", "Alt+N", "Choose the next vertex to move", lambda w: choose_vertex(w.page))
    ),
    *_rows("step", EDITING, "", _window)(
        *(_way("vertex", "Ctrl+Shift", "Move the vertex", nudge_vertex, *way) for way in WAYS)
    ),
    *_rows("", EDITING, "Edit", _window)(
        Row("undo", "Ctrl+Z", "Undo", _undo),
        Row("redo", "Ctrl+Shift+Z Ctrl+Y", "Redo", _redo, ends_group=True),
    ),
    *_rows("step", EDITING, "Raster", _window)(
        Row("fit_region", "F", "Go into the triangle", _fit_to_triangle),
        Row("whole_picture", "Shift+F", "Back to the whole picture", _show_whole_picture),
    ),
    *_rows("step", EDITING, "Edit", _window)(
        Row(
            "toggle_shared",
            "Ctrl+J",
            "Shared vertices move together",
            lambda w: w.edits.toggle_shared(),
            is_on=_has_shared_vertices,
        )
    ),
    *_rows("step", EDITING, "Raster", lambda w: w.edits)(
        Row("focus_all", "A", "Step all triangles", lambda p: p.focus_all()),
        Row(
            "toggle_cleared",
            "Ctrl+K",
            "Start from cleared buffers",
            lambda p: p.toggle_cleared(),
            is_on=lambda w: w.session.document.before == "cleared",
        ),
    ),
    *_rows("compare", MEASURING, "Compare", lambda w: w.compare.results)(
        Row("measure", "F5", "Measure all methods of the family", lambda p: p.start()),
        Row(
            "measure_scene",
            "Ctrl+M",
            "Measure the whole pipeline on the open scene",
            lambda p: p.measure_scene(),
        ),
        Row("cancel_measuring", "Shift+F5", "Cancel measuring", lambda p: p.cancel()),
        Row("next_family", "Ctrl+PgDown", "Next family", lambda p: p.show_neighbour(1)),
        Row(
            "previous_family", "Ctrl+PgUp", "Previous family", lambda p: p.show_neighbour(-1), ends_group=True
        ),
    ),
    *_rows("compare", CHARTS, "Compare", _window)(
        Row("next_error", "E", "Next error on the axis", lambda w: w.compare.results.show_next_measure()),
        Row(
            "next_cost",
            "X",
            "Next cost on the axis: time or a count of work",
            lambda w: w.compare.results.show_next_cost(),
        ),
        Row("show_numbers", "T", "Charts or numbers", lambda w: w.compare.toggle_numbers()),
        Row(
            "fit_charts",
            "W",
            "Show everything in the charts",
            lambda w: w.compare.fit_charts(),
            ends_group=True,
        ),
        Row(
            "step_run", "Ctrl+Return", "Open the chosen run in the stepper", lambda w: w.compare.opened.step()
        ),
        Row(
            "step_divergence",
            "Ctrl+Shift+Return",
            "Step two runs to their first divergence",
            lambda w: w.compare.opened.step_to_divergence(),
        ),
        Row("copy_pictures", "", "Copy the pictures", lambda w: w.compare.opened.copy()),
    ),
    *_rows("stability", EXPERIMENTS, "Stability", lambda w: w.stability.results)(
        Row("run_experiment", "F5", "Run every method of the experiment", lambda p: p.start()),
        Row("cancel_experiment", "Shift+F5", "Cancel running", lambda p: p.cancel()),
        Row("next_experiment", "Ctrl+PgDown", "Next experiment", lambda p: p.show_neighbour(1)),
        Row(
            "previous_experiment",
            "Ctrl+PgUp",
            "Previous experiment",
            lambda p: p.show_neighbour(-1),
            ends_group=True,
        ),
    ),
    *_rows("stability", MAPS, "Stability", lambda w: w.stability)(
        Row("step_cell", "Ctrl+Return", "Open the chosen cell in the stepper", lambda p: p.opened.step()),
        Row("shrink_cell", "S", "Shrink the chosen cell", lambda p: p.opened.shrink()),
        Row("save_case", "", "Save the smallest case…", lambda p: p.ask_save_case()),
    ),
    *_rows("plan", PLANNING, "Plan", _window)(
        Row("analyse", "F5", "Analyse the scene", lambda w: w.plan.plans.analyse()),
        Row("cancel_analysis", "Shift+F5", "Cancel the analysis", lambda w: w.plan.plans.cancel()),
        Row("apply_plan", "Ctrl+Return", "Apply these settings", lambda w: w.plan.plans.apply()),
        Row(
            "plan_difference",
            "D",
            "Difference from the reference settings",
            lambda w: w.plan.opened.open_all(),
        ),
        Row("plan_chart", "Ctrl+M", "Show the plan on the scene’s chart", lambda w: w.plan.show_on_chart()),
        Row("plan_findings", "I", "Show or hide the findings", lambda w: w.plan.findings.toggle_findings()),
    ),
    *_rows("exercises", ANSWERING, "Exercises", lambda w: w.exercises)(
        Row("check_answer", "Ctrl+Return F5", "Check the answer", lambda p: p.questions.check()),
        Row("next_hint", "Ctrl+H", "Show the next hint", lambda p: p.questions.show_hint()),
        Row("new_variant", "Ctrl+N", "New variant of this question", lambda p: p.questions.ask_variant()),
        Row("start_again", "Ctrl+R", "Start this question again", lambda p: p.questions.ask_again()),
        Row(
            "step_mistake",
            "Ctrl+D",
            "Step the right run beside that mistake",
            lambda p: p.questions.evidence.show_mistake(),
        ),
        Row("model_answer", "Ctrl+M", "Model answer", lambda p: p.questions.show_model()),
        Row(
            "step_question", "Ctrl+G", "Step the scene, hidden", lambda p: p.questions.evidence.step_hidden()
        ),
        Row(
            "answer_rows", "Ctrl+L", "Answer row by row instead of on the picture", lambda p: p.toggle_rows()
        ),
        Row("try_next", "Ctrl+Shift+N", "Exercise to try next", lambda p: p.open_next()),
        Row("show_progress", "Ctrl+I", "Progress, and who answers", lambda p: p.toggle_progress()),
        Row("add_exercises", "", "Add a folder of exercises…", lambda p: p.ask_folder()),
        Row("diagnose_picture", "", "Which mistake makes a picture?…", lambda p: p.diagnosis.ask_picture()),
        Row("next_exercise", "Ctrl+PgDown", "Next exercise", lambda p: p.exercises.open_neighbour(1)),
        Row("previous_exercise", "Ctrl+PgUp", "Previous exercise", lambda p: p.exercises.open_neighbour(-1)),
    ),
    *_rows("", FILES, "File", _window)(
        Row("open_file", "Ctrl+O", "Open mesh or state…", lambda w: w.files.ask_file()),
        Row("choose_scene", "Ctrl+Shift+O", "Open a scene or state from a list…", _choose_scene),
        Row(
            "next_state", "Ctrl+Shift+PgDown", "Next state of the folder", lambda w: w.files.open_neighbour(1)
        ),
        Row(
            "previous_state",
            "Ctrl+Shift+PgUp",
            "Previous state of the folder",
            lambda w: w.files.open_neighbour(-1),
        ),
        Row("save_state", "Ctrl+S", "Save state…", lambda w: w.files.ask_save(), ends_group=True),
        Row("export_view", "Ctrl+E", "Export view…", _export),
        Row("copy_view", "Ctrl+Shift+C", "Copy view", _copy),
        Row(
            "print_view",
            "Ctrl+P",
            "Print view with sentence and formula…",
            lambda w: w.exports.print_view(w.session.document.title),
        ),
    ),
    *_rows("step", FILES, "File", _window)(
        Row(
            "export_caption",
            "",
            "Export with sentence and formula",
            _toggle_caption,
            is_on=lambda w: w.exports.has_caption,
            ends_group=True,
        )
    ),
    *_rows("", FILES, "File", _window)(Row("quit", "Ctrl+Q", "Quit", lambda w: w.close())),
)
ACTIONS_BY_NAME = {action.name: action for action in ACTIONS}
