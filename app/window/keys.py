"""The one table of keys: menus, tooltips and the ``?`` page are made from it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox, QSplitterHandle, QTabBar, QWidget

from core.stages.declared import STAGES, stage_of


@dataclass(frozen=True)
class KeyAction:
    """Something a key does."""

    name: str
    """Name of the handler, as ``step_forward``."""
    keys: tuple[str, ...]
    """Qt's portable texts; the first is shown in menus."""
    title: str
    group: str
    """Heading on the ``?`` page."""
    menu: str = ""
    """Menu that it stands in; empty: none."""
    is_checkable: bool = False
    page: str = ""
    """The page on which it does something; empty: all of them."""


def _on(page: str, *actions: KeyAction) -> Iterator[KeyAction]:
    """Yield actions as those of one page."""
    return (replace(action, page=page) for action in actions)


STEPPING, POINTING, STAGE_GROUP, RUNNING, VIEWING, EDITING, FILES, PAGES = (
    "Stepping",
    "Pixels",
    "Stages",
    "Run to",
    "View",
    "Edit",
    "Files",
    "Pages",
)
HELP = "Help"
PRESENTING = "Presenting"
MEASURING = "Measuring"
EXPERIMENTS = "Experiments"
MAPS = "Maps"
CHARTS = "Charts"
PLANNING = "Planning"
ANSWERING = "Answering"

WAYS = (("left", "to the left"), ("right", "to the right"), ("up", "up"), ("down", "down"))

ACTIONS: tuple[KeyAction, ...] = (
    *_on(
        "step",
        KeyAction("step_forward", ("Right",), "Step forward", STEPPING, "Step"),
        KeyAction("step_back", ("Left",), "Step back", STEPPING, "Step"),
        KeyAction("larger_forward", ("Shift+Right", "F10"), "Larger step forward (over)", STEPPING, "Step"),
        KeyAction("larger_back", ("Shift+Left", "Ctrl+F10"), "Larger step back", STEPPING, "Step"),
        KeyAction("level_in", ("Down", "F11"), "Smaller steps (into)", STEPPING, "Step"),
        KeyAction("level_out", ("Up", "Shift+F11"), "Larger steps (out)", STEPPING, "Step"),
        KeyAction("go_first", ("Home",), "Go to the start of the stage", STEPPING, "Step"),
        KeyAction("go_last", ("End",), "Go to the end of the stage", STEPPING, "Step"),
        KeyAction("toggle_play", ("Space",), "Play or pause", STEPPING, "Step"),
        KeyAction("faster", ("+", "="), "Play faster", STEPPING),
        KeyAction("slower", ("-",), "Play slower", STEPPING),
        KeyAction("visited_back", ("Ctrl+[",), "Back to the step before the jump", STEPPING, "Step"),
        KeyAction("visited_forward", ("Ctrl+]",), "Forward again", STEPPING, "Step"),
        KeyAction("next_at_pin", ("J",), "Next step at the pinned pixel", RUNNING, "Step"),
        KeyAction("previous_at_pin", ("K",), "Previous step at the pinned pixel", RUNNING, "Step"),
        KeyAction("next_event", ("N",), "Next event of the chosen kind", RUNNING, "Step"),
        KeyAction("previous_event", ("Shift+N",), "Previous event of the chosen kind", RUNNING, "Step"),
        KeyAction("run_forward", ("F5",), "Run to the next breakpoint", RUNNING, "Step"),
        KeyAction("run_back", ("Ctrl+F5",), "Run back to the last breakpoint", RUNNING, "Step"),
        KeyAction("toggle_breakpoint", ("F9", "B"), "Breakpoint at the pinned pixel", RUNNING, "Step"),
        KeyAction("edit_condition", ("Ctrl+F9",), "Breakpoint on a condition…", RUNNING, "Step"),
        KeyAction("toggle_bookmark", ("Ctrl+B",), "Bookmark this step", RUNNING, "Step"),
        KeyAction("note_bookmark", ("Ctrl+Shift+B",), "Bookmark with a note…", RUNNING, "Step"),
        *(
            KeyAction(f"bookmark_{k}", (f"Ctrl+{(k + 1) % 10}",), f"Go to bookmark {k + 1}", RUNNING)
            for k in range(10)
        ),
        *(
            KeyAction(
                f"stage_{k}",
                (str((k + 1) % 10),) if k < 10 else (),
                stage_of(stage).short_title,
                STAGE_GROUP,
                "Stage",
            )
            for k, stage in enumerate(STAGES)
        ),
        KeyAction("next_stage", ("Ctrl+PgDown",), "Next stage", STAGE_GROUP, "Stage"),
        KeyAction("previous_stage", ("Ctrl+PgUp",), "Previous stage", STAGE_GROUP, "Stage"),
        KeyAction("pin_left", ("Alt+Left",), "Move the pin left", POINTING),
        KeyAction("pin_right", ("Alt+Right",), "Move the pin right", POINTING),
        KeyAction("pin_up", ("Alt+Up",), "Move the pin up", POINTING),
        KeyAction("pin_down", ("Alt+Down",), "Move the pin down", POINTING),
        KeyAction("value_origin_pixel", ("Y",), "Where does the pinned value come from?", POINTING, "Step"),
        KeyAction("go_to_pixel", ("Ctrl+G",), "Go to pixel…", POINTING, "View"),
        KeyAction("zoom_in", ("Alt++", "Alt+="), "Magnify the view, or the timeline in it", VIEWING, "View"),
        KeyAction("zoom_out", ("Alt+-",), "Magnify less", VIEWING, "View"),
        *(
            KeyAction(f"view_{way}", (f"Ctrl+{way.capitalize()}",), f"Look further {where}", VIEWING)
            for way, where in WAYS
        ),
    ),
    KeyAction("unpin", ("Escape",), "Close the top pane, stop work, or remove the pin", VIEWING),
    *_on(
        "step",
        KeyAction("fit_view", ("W",), "Show all stepped pixels", VIEWING, "View"),
        KeyAction("next_view", ("V",), "Next main view", VIEWING, "View"),
        KeyAction("compare", ("Ctrl+D",), "A | B | difference", VIEWING, "View", is_checkable=True),
        KeyAction("pane_scene", ("S",), "Scene pane", VIEWING, "View", is_checkable=True),
        KeyAction("pane_methods", ("M",), "Methods pane", VIEWING, "View", is_checkable=True),
        KeyAction("pane_overlays", ("O",), "Overlays pane", VIEWING, "View", is_checkable=True),
        KeyAction("pane_inspector", ("I",), "Inspector", VIEWING, "View", is_checkable=True),
        KeyAction("pane_thumbnails", ("T",), "Thumbnails of all buffers", VIEWING, "View", is_checkable=True),
        KeyAction("flip", ("X",), "Swap the pictures of A and B while held", VIEWING),
        KeyAction("divergence", ("D",), "First divergence of A and B", VIEWING, "View"),
        KeyAction("pane_navigator", ("G",), "Navigator", VIEWING, "View", is_checkable=True),
        KeyAction("pane_details", ("H",), "Variables and pixel history", VIEWING, "View", is_checkable=True),
        KeyAction("pane_run", ("R",), "Run: stages and timeline", VIEWING, "View", is_checkable=True),
        KeyAction("predict", ("P",), "Predict, then reveal", VIEWING, "View", is_checkable=True),
        KeyAction("ask_step", ("Q",), "Ask this step as a question", VIEWING, "View"),
        KeyAction("ask_value", ("Shift+Q",), "Ask for the value of the pinned pixel", VIEWING, "View"),
    ),
    KeyAction("page_start", ("Alt+0",), "Start page", PAGES, "Help"),
    *_on("start", KeyAction("begin_stepping", ("Right",), "Step what is open", STEPPING)),
    KeyAction("page_step", ("Alt+1",), "Step page", PAGES, "View", is_checkable=True),
    KeyAction("page_compare", ("Alt+2",), "Compare page", PAGES, "View", is_checkable=True),
    KeyAction("page_stability", ("Alt+3",), "Stability page", PAGES, "View", is_checkable=True),
    KeyAction("page_plan", ("Alt+4",), "Plan page", PAGES, "View", is_checkable=True),
    KeyAction("page_exercises", ("Alt+5",), "Exercises page", PAGES, "View", is_checkable=True),
    KeyAction("next_pane", ("F6",), "Next pane", PAGES, "View"),
    KeyAction("previous_pane", ("Shift+F6",), "Previous pane", PAGES, "View"),
    KeyAction("next_page", ("Ctrl+Tab",), "Next page", PAGES),
    KeyAction("previous_page", ("Ctrl+Shift+Tab",), "Previous page", PAGES),
    KeyAction("toggle_theme", ("Ctrl+T",), "Light or dark", VIEWING, "View"),
    KeyAction("text_larger", ("Ctrl++", "Ctrl+="), "Larger text", VIEWING, "View"),
    KeyAction("text_smaller", ("Ctrl+-",), "Smaller text", VIEWING, "View"),
    KeyAction(
        "presenter",
        ("Ctrl+Shift+P",),
        "Presenter: full screen, large type",
        VIEWING,
        "View",
        is_checkable=True,
    ),
    KeyAction("help", ("F1",), "Help on what is pointed at", HELP, "Help"),
    KeyAction("help_guide", (), "Five-minute guide", HELP, "Help"),
    KeyAction("help_exercise", (), "Your own exercise", HELP, "Help"),
    KeyAction("help_glossary", (), "Glossary", HELP, "Help"),
    KeyAction("help_methods", (), "Methods: sources, limits, listings", HELP, "Help"),
    KeyAction("show_keys", ("?",), "All keys", HELP, "Help"),
    KeyAction("change_keys", (), "Change keys…", HELP, "Help"),
    *_on(
        "step",
        KeyAction("next_triangle", ("Alt+J",), "Next triangle", EDITING, "Raster"),
        KeyAction("previous_triangle", ("Alt+K",), "Previous triangle", EDITING, "Raster"),
        KeyAction("go_to_triangle", ("Ctrl+Shift+G",), "Go to triangle…", EDITING, "Raster"),
        KeyAction("next_vertex", ("Alt+N",), "Choose the next vertex to move", EDITING, "Edit"),
        *(
            KeyAction(
                f"vertex_{way}", (f"Ctrl+Shift+{way.capitalize()}",), f"Move the vertex {where}", EDITING
            )
            for way, where in WAYS
        ),
    ),
    KeyAction("undo", ("Ctrl+Z",), "Undo", EDITING, "Edit"),
    KeyAction("redo", ("Ctrl+Shift+Z", "Ctrl+Y"), "Redo", EDITING, "Edit"),
    *_on(
        "step",
        KeyAction("fit_region", ("F",), "Go into the triangle", EDITING, "Raster"),
        KeyAction("whole_picture", ("Shift+F",), "Back to the whole picture", EDITING, "Raster"),
        KeyAction(
            "toggle_shared", ("Ctrl+J",), "Shared vertices move together", EDITING, "Edit", is_checkable=True
        ),
        KeyAction("focus_all", ("A",), "Step all triangles", EDITING, "Raster"),
        KeyAction(
            "toggle_cleared", ("Ctrl+K",), "Start from cleared buffers", EDITING, "Raster", is_checkable=True
        ),
    ),
    *_on(
        "compare",
        KeyAction("measure", ("F5",), "Measure all methods of the family", MEASURING, "Compare"),
        KeyAction(
            "measure_scene", ("Ctrl+M",), "Measure the whole pipeline on the open scene", MEASURING, "Compare"
        ),
        KeyAction("cancel_measuring", ("Shift+F5",), "Cancel measuring", MEASURING, "Compare"),
        KeyAction("next_family", ("Ctrl+PgDown",), "Next family", MEASURING, "Compare"),
        KeyAction("previous_family", ("Ctrl+PgUp",), "Previous family", MEASURING, "Compare"),
        KeyAction("next_error", ("E",), "Next error on the axis", CHARTS, "Compare"),
        KeyAction("next_cost", ("X",), "Next cost on the axis: time or a count of work", CHARTS, "Compare"),
        KeyAction("show_numbers", ("T",), "Charts or numbers", CHARTS, "Compare"),
        KeyAction("fit_charts", ("W",), "Show everything in the charts", CHARTS, "Compare"),
        KeyAction("step_run", ("Ctrl+Return",), "Open the chosen run in the stepper", CHARTS, "Compare"),
        KeyAction(
            "step_divergence",
            ("Ctrl+Shift+Return",),
            "Step two runs to their first divergence",
            CHARTS,
            "Compare",
        ),
        KeyAction("copy_pictures", (), "Copy the pictures", CHARTS, "Compare"),
    ),
    *_on(
        "stability",
        KeyAction("run_experiment", ("F5",), "Run every method of the experiment", EXPERIMENTS, "Stability"),
        KeyAction("cancel_experiment", ("Shift+F5",), "Cancel running", EXPERIMENTS, "Stability"),
        KeyAction("next_experiment", ("Ctrl+PgDown",), "Next experiment", EXPERIMENTS, "Stability"),
        KeyAction("previous_experiment", ("Ctrl+PgUp",), "Previous experiment", EXPERIMENTS, "Stability"),
        KeyAction("step_cell", ("Ctrl+Return",), "Open the chosen cell in the stepper", MAPS, "Stability"),
        KeyAction("shrink_cell", ("S",), "Shrink the chosen cell", MAPS, "Stability"),
        KeyAction("save_case", (), "Save the smallest case…", MAPS, "Stability"),
    ),
    *_on(
        "plan",
        KeyAction("analyse", ("F5",), "Analyse the scene", PLANNING, "Plan"),
        KeyAction("cancel_analysis", ("Shift+F5",), "Cancel the analysis", PLANNING, "Plan"),
        KeyAction("apply_plan", ("Ctrl+Return",), "Apply these settings", PLANNING, "Plan"),
        KeyAction("plan_difference", ("D",), "Difference from the reference settings", PLANNING, "Plan"),
        KeyAction("plan_chart", ("Ctrl+M",), "Show the plan on the scene’s chart", PLANNING, "Plan"),
        KeyAction("plan_findings", ("I",), "Show or hide the findings", PLANNING, "Plan"),
    ),
    *_on(
        "exercises",
        KeyAction("check_answer", ("Ctrl+Return", "F5"), "Check the answer", ANSWERING, "Exercises"),
        KeyAction("next_hint", ("Ctrl+H",), "Show the next hint", ANSWERING, "Exercises"),
        KeyAction("new_variant", ("Ctrl+N",), "New variant of this question", ANSWERING, "Exercises"),
        KeyAction("start_again", ("Ctrl+R",), "Start this question again", ANSWERING, "Exercises"),
        KeyAction(
            "step_mistake", ("Ctrl+D",), "Step the right run beside that mistake", ANSWERING, "Exercises"
        ),
        KeyAction("model_answer", ("Ctrl+M",), "Model answer", ANSWERING, "Exercises"),
        KeyAction("step_question", ("Ctrl+G",), "Step the scene, hidden", ANSWERING, "Exercises"),
        KeyAction(
            "answer_rows", ("Ctrl+L",), "Answer row by row instead of on the picture", ANSWERING, "Exercises"
        ),
        KeyAction("try_next", ("Ctrl+Shift+N",), "Exercise to try next", ANSWERING, "Exercises"),
        KeyAction("show_progress", ("Ctrl+I",), "Progress, and who answers", ANSWERING, "Exercises"),
        KeyAction("add_exercises", (), "Add a folder of exercises…", ANSWERING, "Exercises"),
        KeyAction("diagnose_picture", (), "Which mistake makes a picture?…", ANSWERING, "Exercises"),
        KeyAction("next_exercise", ("Ctrl+PgDown",), "Next exercise", ANSWERING, "Exercises"),
        KeyAction("previous_exercise", ("Ctrl+PgUp",), "Previous exercise", ANSWERING, "Exercises"),
    ),
    KeyAction("open_file", ("Ctrl+O",), "Open mesh or state…", FILES, "File"),
    KeyAction("save_state", ("Ctrl+S",), "Save state…", FILES, "File"),
    KeyAction("export_view", ("Ctrl+E",), "Export view…", FILES, "File"),
    KeyAction("copy_view", ("Ctrl+Shift+C",), "Copy view", FILES, "File"),
    KeyAction("print_view", ("Ctrl+P",), "Print view with sentence and formula…", FILES, "File"),
    KeyAction(
        "export_caption",
        (),
        "Export with sentence and formula",
        FILES,
        "File",
        is_checkable=True,
        page="step",
    ),
    KeyAction("quit", ("Ctrl+Q",), "Quit", FILES, "File"),
)

LOCAL_KEYS = (
    KeyAction("next_control", ("Tab", "Shift+Tab"), "Next, previous control", PAGES),
    KeyAction("next_button", ("Left", "Right"), "In a row of buttons: the neighbouring button", PAGES),
    KeyAction("move_border", ("Left", "Right", "Up", "Down"), "On a border between panes: move it", PAGES),
    KeyAction("clicker_next", ("PgDown", "PgUp"), "Presenting: step forward, back", PRESENTING),
    KeyAction("clicker_start", ("F5",), "Presenting: start of the run", PRESENTING),
    KeyAction("clicker_black", ("B", "."), "Presenting: black screen, and back", PRESENTING),
    *_on(
        "step",
        KeyAction("value_origin", ("Return",), "In Variables: go to the step that made the number", STEPPING),
        KeyAction(
            "go_to_row",
            ("Up", "Down"),
            "In Variables, Pixel history and the listing: go to the neighbouring row",
            STEPPING,
        ),
        KeyAction(
            "go_to_tab",
            ("Left", "Right"),
            "In a row of tabs: go to the neighbouring tab; in Variables: fold",
            STEPPING,
        ),
        KeyAction(
            "choose_chapter",
            ("Left", "Right", "Return"),
            "In the chapters: choose a stage and enter it",
            STEPPING,
        ),
        KeyAction(
            "leap",
            ("PgDown", "PgUp"),
            "In the chapters and the timeline: go on or back by a twentieth of the stage",
            STEPPING,
        ),
        KeyAction(
            "read_texel",
            ("Shift+Left", "Shift+Right", "Shift+Up", "Shift+Down"),
            "In the texture: read the next texel",
            POINTING,
        ),
    ),
    *_on(
        "compare",
        KeyAction(
            "chart_go", ("Left", "Right", "Up", "Down"), "In a chart: go to the neighbouring point", CHARTS
        ),
        KeyAction(
            "chart_choose", ("Return",), "In a chart: open the point’s pictures, as a click does", CHARTS
        ),
        KeyAction(
            "picture_go",
            ("Left", "Right", "Up", "Down"),
            "In a picture: read the next pixel; with Shift the eighth",
            CHARTS,
        ),
        KeyAction(
            "chart_add", ("Shift+Return",), "In a chart: select a second point, as Ctrl+click does", CHARTS
        ),
    ),
    *_on(
        "exercises",
        KeyAction(
            "mark_go",
            ("Left", "Right", "Up", "Down"),
            "On the picture: go to the neighbouring pixel",
            ANSWERING,
        ),
        KeyAction("mark_pixel", ("Space",), "On the picture: mark the pixel, or clear it", ANSWERING),
        KeyAction(
            "mark_paint",
            ("Shift+Left", "Shift+Right", "Shift+Up", "Shift+Down"),
            "On the picture: take the mark of this pixel along",
            ANSWERING,
        ),
        KeyAction("move_item", ("Alt+Up", "Alt+Down"), "In an order: move the chosen item", ANSWERING),
    ),
    *_on(
        "stability",
        KeyAction("map_go", ("Left", "Right", "Up", "Down"), "In a map: go to the neighbouring cell", MAPS),
        KeyAction(
            "map_next",
            ("Tab",),
            "In a map: the same cell of the next map; Shift+Tab: of the previous map",
            MAPS,
        ),
        KeyAction("map_open", ("Return",), "In a map: open the chosen cell in the stepper", MAPS),
    ),
)
"""What a widget does by itself while it has the keyboard: for the page of keys only."""


def key_text(action: KeyAction) -> str:
    """Return the keys of an action as they are shown."""
    names = {"PgDown": "Page Down", "PgUp": "Page Up"}
    texts = []
    for key in action.keys:
        for short, long in names.items():
            key = key.replace(short, long)
        texts.append(key)
    return ", ".join(texts)


_PRESS = frozenset({Qt.Key.Key_Space})
_SIDEWAYS = frozenset({Qt.Key.Key_Left, Qt.Key.Key_Right})
_UP_DOWN = frozenset({Qt.Key.Key_Up, Qt.Key.Key_Down})
KEYS: tuple[tuple[type[QWidget], frozenset[Qt.Key]], ...] = (
    (QAbstractButton, _PRESS),
    (QComboBox, _PRESS),
    (QAbstractSpinBox, _UP_DOWN),
    (QTabBar, _SIDEWAYS),
    (QSplitterHandle, _SIDEWAYS | _UP_DOWN),
)
"""Kinds of controls and the keys, without Ctrl and Alt, that they have a use for."""


def has_use_for(widget: QWidget | None, event: QKeyEvent) -> bool:
    """Return whether a control needs a key that is pressed while it has the focus."""
    if widget is None or event.modifiers() & ~Qt.KeyboardModifier.KeypadModifier:
        return False
    return any(isinstance(widget, kind) and event.key() in keys for kind, keys in KEYS)
