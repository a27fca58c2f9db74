"""The one table of actions: keys, menus, buttons, the page of keys and the links of Help are made from it."""

from typing import TYPE_CHECKING

from app.pages.step.kept_look import BOOKMARKS, copy_state
from app.pages.step.main_area import ZOOM, choose_vertex, move_view, nudge_vertex, zoom
from app.pages.step.panes import PANES
from app.window import keys
from app.window.action import (
    Action,
    Row,
    bookmark_row,
    choose_scene,
    copy_what_is_shown,
    dismiss,
    export_view,
    fit_to_triangle,
    has_shared_vertices,
    page_row,
    pane_row,
    redo,
    rows_of,
    show_whole_picture,
    stage_row,
    toggle_caption,
    undo,
    way_row,
    whole_window,
)
from core.stages.declared import STAGES

if TYPE_CHECKING:
    # A page is imported when it is first shown, see app.pages.page_table.
    pass


WAYS = (
    ("left", "to the left", (-1, 0)),
    ("right", "to the right", (1, 0)),
    ("up", "up", (0, 1)),
    ("down", "down", (0, -1)),
)
"""Four ways, in words, and in columns and rows (y up)."""
ACTIONS: tuple[Action, ...] = (
    *rows_of("step", keys.STEPPING, "Step", lambda w: w.stepping)(
        Row("step_forward", "Right", "Step forward", lambda p: p.step(1)),
        Row("step_back", "Left", "Step back", lambda p: p.step(-1)),
        Row("larger_forward", "Shift+Right F10", "Larger step forward (over)", lambda p: p.step_larger(1)),
        Row("larger_back", "Shift+Left Ctrl+F10", "Larger step back", lambda p: p.step_larger(-1)),
        Row("level_in", "Down F11", "Smaller steps (into)", lambda p: p.change_level(1)),
        Row("level_out", "Up Shift+F11", "Larger steps (out)", lambda p: p.change_level(-1)),
        Row("go_first", "Home", "Go to the start of the stage", lambda p: p.go_to_end(-1)),
        Row("go_last", "End", "Go to the end of the stage", lambda p: p.go_to_end(1)),
        Row("toggle_play", "Space", "Play or pause", lambda p: p.toggle_play()),
    ),
    *rows_of("step", keys.STEPPING, "", lambda w: w.page.timeline)(
        Row("faster", "+ =", "Play faster", lambda p: p.change_speed(1)),
        Row("slower", "-", "Play slower", lambda p: p.change_speed(-1)),
    ),
    *rows_of("step", keys.STEPPING, "Step", lambda w: w.stepping)(
        Row("visited_back", "Ctrl+[", "Back to the step before the jump", lambda p: p.go_back()),
        Row("visited_forward", "Ctrl+]", "Forward again", lambda p: p.go_forward(), ends_group=True),
    ),
    *rows_of("step", keys.RUNNING, "Step", lambda w: w.stepping)(
        Row("next_at_pin", "J", "Next step at the pinned pixel", lambda p: p.run_to_pin(1)),
        Row("previous_at_pin", "K", "Previous step at the pinned pixel", lambda p: p.run_to_pin(-1)),
        Row("next_event", "N", "Next event of the chosen kind", lambda p: p.run_to_event(1)),
        Row("previous_event", "Shift+N", "Previous event of the chosen kind", lambda p: p.run_to_event(-1)),
        Row("run_forward", "F5", "Run to the next breakpoint", lambda p: p.run_to_breakpoint(1)),
        Row("run_back", "Ctrl+F5", "Run back to the last breakpoint", lambda p: p.run_to_breakpoint(-1)),
        Row(
            "toggle_breakpoint",
            "F9 B",
            "Breakpoint at the pinned pixel",
            lambda p: p.toggle_pixel_breakpoint(),
        ),
    ),
    *rows_of("step", keys.RUNNING, "Step", lambda w: w.overlays)(
        Row("edit_condition", "Ctrl+F9", "Breakpoint on a condition…", lambda p: p.ask_condition()),
    ),
    *rows_of("step", keys.RUNNING, "Step", lambda w: w.stepping)(
        Row("toggle_bookmark", "Ctrl+B", "Bookmark this step", lambda p: p.bookmarks.toggle()),
    ),
    *rows_of("step", keys.RUNNING, "Step", lambda w: w.overlays)(
        Row("note_bookmark", "Ctrl+Shift+B", "Bookmark with a note…", lambda p: p.ask_note()),
    ),
    *rows_of("step", keys.RUNNING, "", whole_window)(*(bookmark_row(k) for k in range(BOOKMARKS))),
    *rows_of("step", keys.STAGE_GROUP, "Stage", whole_window)(
        *(stage_row(k) for k in range(len(STAGES))),
        Row("next_stage", "Ctrl+PgDown", "Next stage", lambda w: w.stepping.go_to_stage(1)),
        Row("previous_stage", "Ctrl+PgUp", "Previous stage", lambda w: w.stepping.go_to_stage(-1)),
    ),
    *rows_of("step", keys.LESSONS, "Lesson", lambda w: w.page.lessons)(
        Row("lesson_next", "PgDown", "Next step of the lesson", lambda p: p.next()),
        Row("lesson_back", "PgUp", "Previous step of the lesson", lambda p: p.back()),
        Row("lesson_return", "Ctrl+Home", "Return to the lesson’s step", lambda p: p.return_here()),
        Row("lesson_check", "Ctrl+Return", "Check the answer", lambda p: p.check()),
        Row("lesson_reveal", "Ctrl+M", "Show what is right", lambda p: p.reveal(), ends_group=True),
        Row("lesson_anew", "", "Begin the lesson anew", lambda p: p.begin_anew()),
        Row("lesson_close", "", "Close the lesson", lambda p: p.close()),
    ),
    *rows_of("step", keys.LESSONS, "Lesson", lambda w: w.page)(
        Row("lesson_copy", "", "Copy this state for a lesson", copy_state),
    ),
    *rows_of("step", keys.POINTING, "", lambda w: w.stepping)(
        Row("pin_left", "Alt+Left", "Move the pin left", lambda p: p.move_pin(-1, 0)),
        Row("pin_right", "Alt+Right", "Move the pin right", lambda p: p.move_pin(1, 0)),
        Row("pin_up", "Alt+Up", "Move the pin up", lambda p: p.move_pin(0, 1)),
        Row("pin_down", "Alt+Down", "Move the pin down", lambda p: p.move_pin(0, -1)),
    ),
    *rows_of("step", keys.POINTING, "Step", lambda w: w.page)(
        Row("value_origin_pixel", "Y", "Where does the pinned value come from?", lambda p: p.go_to_writer())
    ),
    *rows_of("step", keys.POINTING, "View", lambda w: w.overlays)(
        Row("go_to_pixel", "Ctrl+G", "Go to pixel…", lambda p: p.ask_pixel())
    ),
    *rows_of("step", keys.VIEWING, "View", whole_window)(
        Row(
            "zoom_in", "Alt++ Alt+=", "Magnify the view, or the timeline in it", lambda w: zoom(w.page, ZOOM)
        ),
        Row("zoom_out", "Alt+-", "Magnify less", lambda w: zoom(w.page, 1 / ZOOM)),
    ),
    *rows_of("step", keys.VIEWING, "", whole_window)(
        *(way_row("view", "Ctrl", "Look further", move_view, *way) for way in WAYS)
    ),
    *rows_of("", keys.VIEWING, "", whole_window)(
        Row("unpin", "Escape", "Stop work, close the top pane or message, or remove the pin", dismiss)
    ),
    *rows_of("step", keys.VIEWING, "View", lambda w: w.page)(
        Row("fit_view", "W", "Show all stepped pixels", lambda p: p.fit()),
        Row("next_view", "V", "Next main view", lambda p: p.main_area.next_view()),
        Row(
            "compare",
            "Ctrl+D",
            "A | B | difference",
            lambda p: p.toggle_compare(),
            is_on=lambda w: w.page.current_view() == "compare",
            ends_group=True,
        ),
    ),
    *rows_of("step", keys.VIEWING, "", lambda w: w.page)(
        Row("flip", "X", "Swap the pictures of A and B while held", lambda p: p.flip())
    ),
    *rows_of("step", keys.VIEWING, "View", lambda w: w.page)(
        Row("edit_line", "F2", "Edit the line of the listing", lambda p: p.editing.edit_chosen_line()),
        Row(
            "divergence", "D", "First divergence of A and B", lambda p: p.comparing.meeting.go_to_divergence()
        ),
    ),
    *rows_of("step", keys.VIEWING, "View/Panes", whole_window)(*map(pane_row, PANES)),
    *rows_of("step", keys.VIEWING, "View", lambda w: w.page)(
        Row(
            "predict",
            "P",
            "Predict, then reveal",
            lambda p: p.toggle_predicting(),
            is_on=lambda w: w.session.is_predicting,
        ),
        Row("ask_step", "Q", "Ask this step as a question", lambda p: p.asking.ask_step()),
        Row(
            "ask_value",
            "Shift+Q",
            "Ask for the value of the pinned pixel",
            lambda p: p.ask_value(),
            ends_group=True,
        ),
    ),
    *rows_of("", keys.PAGES, "Help", lambda w: w.pages)(
        Row("page_start", "Alt+0", "Start page", lambda p: p.show_page("start"))
    ),
    *rows_of("start", keys.STEPPING, "", lambda w: w.start)(
        Row("begin_stepping", "Right", "Step what is open", lambda p: p.step_on())
    ),
    *rows_of("start", keys.PAGES, "", lambda w: w.start)(
        Row("find", "Ctrl+F /", "Find a lesson or a scene", lambda p: p.begin_search())
    ),
    *rows_of("", keys.PAGES, "View/Pages", whole_window)(
        page_row("step", "Alt+1", "Step page"),
        page_row("compare", "Alt+2", "Compare page"),
        page_row("stability", "Alt+3", "Stability page"),
        page_row("plan", "Alt+4", "Plan page"),
        page_row("exercises", "Alt+5", "Exercises page"),
    ),
    *rows_of("", keys.PAGES, "View/Panes", lambda w: w.focus_walk)(
        Row("next_pane", "F6", "Next pane", lambda p: p.go_pane(1)),
        Row("previous_pane", "Shift+F6", "Previous pane", lambda p: p.go_pane(-1)),
    ),
    *rows_of("", keys.PAGES, "", lambda w: w.pages)(
        Row("next_page", "Ctrl+Tab", "Next page", lambda p: p.show_next(1)),
        Row("previous_page", "Ctrl+Shift+Tab", "Previous page", lambda p: p.show_next(-1)),
    ),
    *rows_of("", keys.VIEWING, "View", whole_window)(
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
    *rows_of("", keys.HELP, "Help", whole_window)(
        Row("help", "F1", "Help on what is pointed at", lambda w: w.help.toggle()),
        Row("help_guide", "", "Five-minute guide", lambda w: w.help.show_page("guide")),
        Row("help_editing", "", "Change a line", lambda w: w.help.show_page("editing")),
        Row("help_exercise", "", "Your own exercise", lambda w: w.help.show_page("exercise")),
        Row("help_glossary", "", "Glossary", lambda w: w.help.show_page("glossary")),
        Row("help_methods", "", "Methods: sources, limits, listings", lambda w: w.help.show_page("methods")),
        Row("show_keys", "?", "All keys", lambda w: w.overlays.toggle_keys()),
        Row("change_keys", "", "Change keys…", lambda w: w.overlays.change_keys()),
    ),
    *rows_of("step", keys.EDITING, "Raster", whole_window)(
        Row("next_triangle", "Alt+J", "Next triangle", lambda w: w.edits.step_triangle(1)),
        Row("previous_triangle", "Alt+K", "Previous triangle", lambda w: w.edits.step_triangle(-1)),
        Row("go_to_triangle", "Ctrl+Shift+G", "Go to triangle…", lambda w: w.overlays.ask_triangle()),
    ),
    *rows_of("step", keys.EDITING, "Raster", lambda w: w.page)(
        Row("open_pass", "Ctrl+L", "Open the pass that is drawn first", lambda p: p.open_pass()),
    ),
    *rows_of("step", keys.EDITING, "Edit", whole_window)(
        Row("next_vertex", "Alt+N", "Choose the next vertex to move", lambda w: choose_vertex(w.page))
    ),
    *rows_of("step", keys.EDITING, "", whole_window)(
        *(way_row("vertex", "Ctrl+Shift", "Move the vertex", nudge_vertex, *way) for way in WAYS)
    ),
    *rows_of("", keys.EDITING, "Edit", whole_window)(
        Row("undo", "Ctrl+Z", "Undo", undo),
        Row("redo", "Ctrl+Shift+Z Ctrl+Y", "Redo", redo, ends_group=True),
    ),
    *rows_of("step", keys.EDITING, "Raster", whole_window)(
        Row("fit_region", "F", "Go into the triangle", fit_to_triangle),
        Row("whole_picture", "Shift+F", "Back to the whole picture", show_whole_picture),
    ),
    *rows_of("step", keys.EDITING, "Edit", lambda w: w.edits)(
        Row(
            "toggle_shared",
            "Ctrl+J",
            "Shared vertices move together",
            lambda p: p.toggle_shared(),
            is_on=has_shared_vertices,
        )
    ),
    *rows_of("step", keys.EDITING, "Raster", lambda w: w.edits)(
        Row("focus_all", "A", "Step all triangles", lambda p: p.focus_all()),
        Row(
            "toggle_cleared",
            "Ctrl+K",
            "Start from cleared buffers",
            lambda p: p.toggle_cleared(),
            is_on=lambda w: w.session.document.before == "cleared",
        ),
    ),
    *rows_of("compare", keys.MEASURING, "Compare", lambda w: w.compare)(
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
    *rows_of("compare", keys.CHARTS, "Compare", lambda w: w.compare)(
        Row("next_error", "E", "Next error on the axis", lambda p: p.show_next_measure()),
        Row("next_cost", "X", "Next cost on the axis: time or a count of work", lambda p: p.show_next_cost()),
        Row("show_numbers", "T", "Charts or numbers", lambda p: p.toggle_numbers()),
        Row("fit_charts", "W", "Show everything in the charts", lambda p: p.fit_charts(), ends_group=True),
        Row("step_run", "Ctrl+Return", "Open the chosen run in the stepper", lambda p: p.opened.step()),
        Row(
            "step_divergence",
            "Ctrl+Shift+Return",
            "Step two runs to their first divergence",
            lambda p: p.opened.step_to_divergence(),
        ),
        Row("copy_pictures", "", "Copy the pictures", lambda p: p.opened.copy()),
    ),
    *rows_of("stability", keys.EXPERIMENTS, "Stability", lambda w: w.stability)(
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
    *rows_of("stability", keys.MAPS, "Stability", lambda w: w.stability)(
        Row("step_cell", "Ctrl+Return", "Open the chosen cell in the stepper", lambda p: p.opened.step()),
        Row("shrink_cell", "S", "Shrink the chosen cell", lambda p: p.opened.shrink()),
        Row("save_case", "", "Save the smallest case…", lambda p: p.ask_save_case()),
    ),
    *rows_of("plan", keys.PLANNING, "Plan", lambda w: w.plan)(
        Row("analyse", "F5", "Analyse the scene", lambda p: p.start()),
        Row("cancel_analysis", "Shift+F5", "Cancel the analysis", lambda p: p.cancel()),
        Row("apply_plan", "Ctrl+Return", "Apply these settings", lambda p: p.apply()),
        Row("plan_difference", "D", "Difference from the reference settings", lambda p: p.open()),
        Row("plan_chart", "Ctrl+M", "Show the plan on the scene’s chart", lambda p: p.show_on_chart()),
        Row("plan_findings", "I", "Show or hide the findings", lambda p: p.findings.toggle_findings()),
    ),
    *rows_of("exercises", keys.ANSWERING, "Exercises", lambda w: w.exercises)(
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
    *rows_of("", keys.FILES, "File", whole_window)(
        Row("open_file", "Ctrl+O", "Open mesh or state…", lambda w: w.files.ask_file()),
        Row("choose_scene", "Ctrl+Shift+O", "Open a scene or state from a list…", choose_scene),
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
        Row("export_view", "Ctrl+E", "Export view…", export_view),
        Row("copy_view", "Ctrl+Shift+C", "Copy view", copy_what_is_shown),
        Row(
            "print_view",
            "Ctrl+P",
            "Print view with sentence and formula…",
            lambda w: w.exports.print_view(w.session.document.title),
        ),
    ),
    *rows_of("step", keys.FILES, "File", whole_window)(
        Row(
            "export_caption",
            "",
            "Export with sentence and formula",
            toggle_caption,
            is_on=lambda w: w.exports.has_caption,
            ends_group=True,
        )
    ),
    *rows_of("", keys.FILES, "File", whole_window)(Row("quit", "Ctrl+Q", "Quit", lambda w: w.close())),
)
ACTIONS_BY_NAME = {action.name: action for action in ACTIONS}
