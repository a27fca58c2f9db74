"""The pane of a scene's shaders: what to begin with, both sources in editors, and what is wrong with them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from PySide6.QtCore import Qt, QTimer, Signal, Slot
from PySide6.QtGui import QColor, QFontDatabase, QKeyEvent, QTextCharFormat, QTextCursor
from PySide6.QtWidgets import (
    QFrame,
    QGridLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QScrollArea,
    QTabWidget,
    QTextEdit,
    QWidget,
)

from widgets.basics.choice_box import ChoiceBox
from widgets.basics.controls import column_layout, row_layout
from widgets.basics.theme import current_theme, theme_notifier
from widgets.inspector.listing_editor import TokenHighlighter

# An editor of a shader's text: it says when typing has paused, and marks the place that is wrong.


PAUSE_MS = 150
"""After this long without a key what was typed is read."""
INDENT = "   "


class SourceEditor(QPlainTextEdit):
    """One shader. Tab indents; Escape gives the keyboard back to the page."""

    text_settled = Signal(str)
    """The user has typed this, and paused."""
    left = Signal()
    """Escape was pressed."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = name
        self._mark: tuple[int, int] | None = None
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setAccessibleName(name)
        self._pause = QTimer(self, interval=PAUSE_MS, singleShot=True)
        self._pause.timeout.connect(self._settle)
        self._highlighter = TokenHighlighter(self.document())
        self.document().contentsChange.connect(self._begin_pause)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._follow_theme()

    def set_source(self, text: str) -> None:
        """Show a text that was not typed here; it is not emitted. Undo leads back to the one before."""
        if text == self.toPlainText():
            return
        is_first = self.document().isEmpty()
        self.blockSignals(True)
        if is_first:
            self.setPlainText(text)
        else:
            cursor = QTextCursor(self.document())
            cursor.select(QTextCursor.SelectionType.Document)
            cursor.insertText(text)
            self.moveCursor(QTextCursor.MoveOperation.Start)
        self.blockSignals(False)
        self._pause.stop()

    def mark(self, line: int, column: int, sentence: str) -> None:
        """Draw a wave under a place, counted from 1, and tell it to screen readers; line 0: nothing is wrong."""
        self._mark = (line, column) if line else None
        self.setAccessibleDescription(f"Line {line}: {sentence}" if line else "")
        self._show_mark()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Indent, or leave."""
        if event.text() == "\t":
            self.insertPlainText(INDENT)
        elif event.text() == "\x1b":
            self.left.emit()
        else:
            super().keyPressEvent(event)

    @Slot(int, int, int)
    def _begin_pause(self, place: int, removed: int, added: int) -> None:
        if not self.signalsBlocked():
            self._pause.start()

    @Slot()
    def _settle(self) -> None:
        self.text_settled.emit(self.toPlainText())

    def _show_mark(self) -> None:
        marks = []
        if self._mark is not None:
            line, column = self._mark
            block = self.document().findBlockByNumber(line - 1)
            cursor = QTextCursor(block)
            begin = min(column - 1, max(block.length() - 2, 0))
            cursor.setPosition(block.position() + begin)
            cursor.movePosition(QTextCursor.MoveOperation.EndOfWord, QTextCursor.MoveMode.KeepAnchor)
            if not cursor.hasSelection():
                cursor.setPosition(block.position())
                cursor.movePosition(QTextCursor.MoveOperation.EndOfBlock, QTextCursor.MoveMode.KeepAnchor)
            mark = QTextEdit.ExtraSelection()
            mark.cursor = cursor
            look = QTextCharFormat()
            look.setUnderlineStyle(QTextCharFormat.UnderlineStyle.WaveUnderline)
            look.setUnderlineColor(QColor(current_theme().accent))
            mark.format = look
            marks.append(mark)
        self.setExtraSelections(marks)

    @Slot()
    def _follow_theme(self) -> None:
        font = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
        font.setPixelSize(current_theme().code_px)
        self.setFont(font)
        self._highlighter.rehighlight()
        self._show_mark()


# The pane of a scene's shaders: what to begin with, both sources, what is wrong with them, and the
# uniforms.


STAGES = {"vertex": "Vertex", "fragment": "Fragment"}
OWN, BUILT_IN = "own", ""
ORDERS = {"one": "One lane at a time", "together": "Lanes together"}
LANES = (
    "A lane is one vertex or one fragment. One lane at a time: each runs the whole shader, one after the other. "
    "Lanes together: all lanes of a triangle run each statement together, as on a graphics card."
)
HINT = "Choose shaders to begin with: then you can change them here. They run without a graphics card."


@dataclass(frozen=True)
class ShownUniform:
    """A uniform that the user sets."""

    name: str
    of: str
    text: str
    """Its numbers as the user has typed them, separated by commas; empty: none were typed."""
    given: str = ""
    """Its numbers where none were typed: those of the scene's light or material, or 0."""


@dataclass(frozen=True)
class ShownProgram:
    """The shaders of a scene."""

    sources: Mapping[str, str]
    """``vertex`` and ``fragment`` to their text."""
    preset: str
    """Name of what they still are, or `OWN`."""
    dialect: str
    uniforms: tuple[ShownUniform, ...]
    notes: str = ""
    lanes: str = "one"
    """In which of `ORDERS` its statements are stepped."""


class ShaderPane(QWidget):
    """Both shaders in tabs. It never compiles: who owns it answers with `show_program` or `show_problem`."""

    source_settled = Signal(str, str)
    """The user has typed this shader: stage and text."""
    preset_chosen = Signal(str)
    """The user begins with another pair; empty: without shaders."""
    dialect_chosen = Signal(str)
    comparison_chosen = Signal(str)
    """The user wants another pair as B; empty: the built-in shading."""
    lanes_chosen = Signal(str)
    """The user steps in another one of `ORDERS`."""
    uniform_typed = Signal(str, str)
    """Name and text; empty: the scene's own numbers."""
    left = Signal()
    """The user gives the keyboard back."""

    def __init__(
        self,
        presets: Sequence[tuple[str, str]],
        dialects: Sequence[tuple[str, str]],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._from_document: dict[str, str] = {}
        """Text of each stage that the document had when it was shown last: what was typed since stays."""
        self._preset, self._dialect = ChoiceBox(self), ChoiceBox(self)
        self._preset.setAccessibleName("Shaders to begin with")
        self._dialect.setAccessibleName("Who declares the names of three.js")
        self._dialect.setToolTip(
            "three.js declares position, modelViewMatrix and more for a ShaderMaterial; with RawShaderMaterial you do."
        )
        for name, title in ((BUILT_IN, "Built-in shading"), *presets, (OWN, "Own shaders")):
            self._preset.addItem(title, name)
        for name, title in dialects:
            self._dialect.addItem(title, name)
        self._beside = ChoiceBox(self)
        self._beside.setAccessibleName("Shaders of B")
        self._beside.setToolTip("Step these shaders beside other ones, or beside the built-in shading.")
        self._beside.addItem("Compare (A | B) …", OWN)
        for name, title in ((BUILT_IN, "Built-in Phong shading"), *presets):
            self._beside.addItem(title, name)
        self._beside.activated.connect(self._choose_beside)
        self._lanes = ChoiceBox(self)
        self._lanes.setAccessibleName("Order of the steps")
        self._lanes.setToolTip(LANES)
        for name, title in ORDERS.items():
            self._lanes.addItem(title, name)
        self._lanes.activated.connect(self._choose_lanes)
        self._preset.activated.connect(self._choose_preset)
        self._dialect.activated.connect(self._choose_dialect)
        self._tabs = QTabWidget(self, documentMode=True)
        self._editors: dict[str, SourceEditor] = {}
        for stage, title in STAGES.items():
            editor = self._editors[stage] = SourceEditor(f"{title} shader", self)
            editor.text_settled.connect(partial(self.source_settled.emit, stage))
            editor.left.connect(self.left)
            self._tabs.addTab(editor, title)
        self._tabs.setCurrentIndex(1)
        self._message = QLabel(HINT, self)
        self._message.setWordWrap(True)
        self._message.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._uniforms = QScrollArea(self, widgetResizable=True)
        self._uniforms.setFrameShape(QFrame.Shape.NoFrame)
        content = QWidget(self._uniforms)
        column = column_layout(content, 0)
        self._rows = QGridLayout()
        self._rows.setContentsMargins(0, 4, 4, 4)
        self._rows.setHorizontalSpacing(8)
        column.addLayout(self._rows)
        column.addStretch(1)
        self._uniforms.setWidget(content)
        self._tabs.addTab(self._uniforms, "Uniforms")
        self._shown_uniforms: tuple[ShownUniform, ...] = ()
        self._fields: dict[str, QLineEdit] = {}
        layout = column_layout(self, 6, margins=(8, 8, 8, 8))
        for above, first, second in ((True, self._preset, self._dialect), (False, self._lanes, self._beside)):
            row = row_layout(spacing=6)
            for box in (first, second):
                box.setMinimumContentsLength(6)
                box.setSizeAdjustPolicy(ChoiceBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
                row.addWidget(box, 1)
            layout.addLayout(row)
            if above:
                layout.addWidget(self._tabs, 1)
                layout.addWidget(self._message)
        self.show_program(None, is_possible=True)

    def show_source(self, stage: str) -> None:
        """Bring a shader's tab to the front; undo leads back to no text before it."""
        self._tabs.setCurrentWidget(self._editors[stage])
        for editor in self._editors.values():
            editor.document().clearUndoRedoStacks()

    @property
    def message(self) -> str:
        """What stands below the sources."""
        return self._message.text()

    def editor(self, stage: str) -> SourceEditor:
        """Return the editor of ``vertex`` or ``fragment``."""
        return self._editors[stage]

    def forget_typed(self) -> None:
        """Show the document's texts next, whatever was typed since."""
        self._from_document = {}

    def shows(self, vertex: str, fragment: str) -> bool:
        """Whether these are the texts that the editors had before the user typed."""
        return self._from_document == {"vertex": vertex, "fragment": fragment}

    def show_program(self, program: ShownProgram | None, is_possible: bool) -> None:
        """Show the shaders of the document; ``None``: it has none, and ``is_possible``: it may have some."""
        self._select(self._preset, BUILT_IN if program is None else program.preset)
        has_program = program is not None
        for widget in (self._dialect, self._tabs, self._beside, self._lanes):
            widget.setVisible(has_program)
        if program is None:
            self._from_document = {}
            self._message.setText(
                HINT
                if is_possible
                else "This scene is given in clip space. Open a scene of meshes, such as the cube, to give it shaders."
            )
            return
        self._select(self._dialect, program.dialect)
        self._select(self._lanes, program.lanes)
        is_new = False
        for stage, editor in self._editors.items():
            if self._from_document.get(stage) != program.sources[stage]:
                editor.set_source(program.sources[stage])
                is_new = True
        self._from_document = dict(program.sources)
        if is_new:
            self._show_message(program.notes)
        if program.uniforms != self._shown_uniforms:
            self._show_uniforms(program.uniforms)

    def show_problem(self, stage: str, line: int, column: int, sentence: str) -> None:
        """Say what is wrong with what was typed; without a stage it is about no place."""
        title = f"{STAGES[stage]} shader, line {line}: " if stage else ""
        self._message.setText(f"{title}{sentence}")
        for name, editor in self._editors.items():
            editor.mark(line if name == stage else 0, column, sentence)
        if stage:
            self._tabs.setCurrentIndex(list(STAGES).index(stage))

    def show_accepted(self, notes: str) -> None:
        """Say that what was typed runs."""
        self._show_message(notes)

    def _show_message(self, notes: str) -> None:
        self._message.setText(notes or "Both shaders run.")
        for editor in self._editors.values():
            editor.mark(0, 0, "")

    def _show_uniforms(self, uniforms: tuple[ShownUniform, ...]) -> None:
        is_other = [(u.name, u.of) for u in uniforms] != [(u.name, u.of) for u in self._shown_uniforms]
        self._shown_uniforms = uniforms
        if is_other:
            self._make_fields(uniforms)
        for uniform in uniforms:
            field = self._fields[uniform.name]
            field.setPlaceholderText(uniform.given)
            field.setText(uniform.text)

    def _make_fields(self, uniforms: tuple[ShownUniform, ...]) -> None:
        place = self._tabs.indexOf(self._uniforms)
        self._tabs.setTabText(place, f"Uniforms ({len(uniforms)})")
        self._tabs.setTabEnabled(place, bool(uniforms))
        while (item := self._rows.takeAt(0)) is not None:
            widget = item.widget()
            if widget is not None:
                widget.hide()
                widget.deleteLater()
        self._fields = {uniform.name: QLineEdit(self) for uniform in uniforms}
        for row, uniform in enumerate(uniforms):
            label, field = QLabel(f"{uniform.name}  {uniform.of}", self), self._fields[uniform.name]
            label.setBuddy(field)
            field.setAccessibleName(f"Uniform {uniform.name}, {uniform.of}")
            field.setToolTip("Empty: the scene's light and material, or 0")
            field.editingFinished.connect(partial(self._type_uniform, row))
            self._rows.addWidget(label, row, 0)
            self._rows.addWidget(field, row, 1)

    def _type_uniform(self, row: int) -> None:
        uniform = self._shown_uniforms[row]
        text = self._fields[uniform.name].text()
        if text != uniform.text:
            self.uniform_typed.emit(uniform.name, text)

    @staticmethod
    def _select(box: ChoiceBox, name: str) -> None:
        box.setCurrentIndex(max(box.findData(name), 0))

    @Slot(int)
    def _choose_preset(self, index: int) -> None:
        name = self._preset.itemData(index)
        if name != OWN:
            self.preset_chosen.emit(name)

    @Slot(int)
    def _choose_beside(self, index: int) -> None:
        name = self._beside.itemData(index)
        self._beside.setCurrentIndex(0)
        if name != OWN:
            self.comparison_chosen.emit(name)

    @Slot(int)
    def _choose_lanes(self, index: int) -> None:
        self.lanes_chosen.emit(self._lanes.itemData(index))

    @Slot(int)
    def _choose_dialect(self, index: int) -> None:
        self.dialect_chosen.emit(self._dialect.itemData(index))
