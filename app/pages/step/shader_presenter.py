"""The shaders of the scene in their pane: each text that runs is one edit, which undo takes back.

What reads and runs shaders is imported when it is first needed: most windows open without any.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite

import numpy as np
from PySide6.QtCore import QEvent, QObject, Signal, Slot

from app.pages.page_bar import Page
from app.session.moment import Moment
from app.session.session import Session
from core.records.steps import Level
from core.scene import Scene
from core.shaders.presets import PRESETS, preset_of, preset_program, retyped
from core.shaders.record import DIALECTS, ShaderProblem, ShaderProgram
from core.shaders.scene_uniforms import scene_uniforms
from widgets.shaders.shader_pane import OWN, ShaderPane, ShownProgram, ShownUniform

TRIAL_SECONDS = 3.0
"""Seconds that drawing may take before what was typed is taken over."""


MOST_RECOGNISED = 96 * 72
"""Pixels of a picture that is compared with those of the mistakes."""


def make_shader_pane(page: Page) -> ShaderPane:
    """Return the pane with all presets."""
    return ShaderPane(
        [(name, preset.title) for name, preset in PRESETS.items()], tuple(DIALECTS.items()), page
    )


class ShaderPresenter(QObject):
    """Shows and edits the shaders of the session's scene."""

    comparison_requested = Signal(object, object, str)
    """The user wants another B: its differences in settings, its scene and its title."""

    def __init__(self, session: Session, pane: ShaderPane, page: Page) -> None:
        super().__init__(page)
        self._session, self._pane, self._page = session, pane, page
        pane.installEventFilter(self)
        pane.source_settled.connect(self._type)
        pane.preset_chosen.connect(self._begin)
        pane.dialect_chosen.connect(self._choose_dialect)
        pane.uniform_typed.connect(self._type_uniform)
        pane.comparison_chosen.connect(self._compare)
        pane.lanes_chosen.connect(self._choose_lanes)
        pane.left.connect(page.setFocus)
        self.refresh(session.moment)

    def refresh(self, moment: Moment) -> None:
        """Show the shaders while the pane is in sight."""
        if self._pane.isVisible():
            self._show()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Bring the pane up to date when it is unfolded."""
        if event.type() == QEvent.Type.Show and watched is self._pane:
            self._show()
        return False

    def _show(self) -> None:
        document = self._session.latest
        scene = document.scene
        program = scene.program if isinstance(scene, Scene) else None
        shown = None
        if isinstance(scene, Scene) and program is not None:
            shown = replace(shown_program(program, scene), lanes=document.lanes)
        self._pane.show_program(shown, is_possible=isinstance(scene, Scene))

    @Slot(str)
    def _begin(self, preset: str) -> None:
        scene = self._session.latest.scene
        if not isinstance(scene, Scene):
            self._show()
            return
        try:
            self._edit(preset_program(preset, scene) if preset else None)
        except ValueError as problem:
            self._refuse(problem)

    @Slot(str, str)
    def _type(self, stage: str, text: str) -> None:
        program = self._program()
        if program is None:
            return
        sources = {each: self._pane.editor(each).toPlainText() for each in ("vertex", "fragment")} | {
            stage: text
        }
        if (sources["vertex"], sources["fragment"]) == (program.vertex, program.fragment):
            self._pane.show_accepted(self._accepted(program))
            return
        self._try(program, sources)

    @Slot(str)
    def _choose_dialect(self, dialect: str) -> None:
        program = self._program()
        if program is None or dialect == program.dialect:
            return
        try:
            self._edit(replace(program, dialect=dialect))
        except ValueError as problem:
            self._refuse(problem)
            self._show()

    @Slot(str)
    def _choose_lanes(self, lanes: str) -> None:
        """Step in another order, from the statement at hand on."""
        session, (row, before) = self._session, (self._session.moment.row, self._session.stage_trace)
        session.edit(replace(session.latest, lanes=lanes))
        session.set_level(Level.GROUP if lanes == "together" else Level.PIXEL)
        now = session.stage_trace
        if "lane" not in now.columns or now is before or row < 0:
            return
        same = [now.columns[name] == before.columns[name][row] for name in ("lane", "lane_step")]
        at = np.flatnonzero(same[0] & same[1])
        if before.columns["lane"][row] >= 0 and len(at):
            session.scrub(now.steps.position_after(int(at[0])))

    @Slot(str, str)
    def _type_uniform(self, name: str, text: str) -> None:
        program = self._program()
        if program is None:
            return
        scene = self._session.latest.scene
        assert isinstance(scene, Scene)
        others = {other: numbers for other, numbers in program.values.items() if other != name}
        if not text.strip() and name in scene_uniforms(scene):
            self._edit(replace(program, uniforms=tuple(others.items())))
            return
        count = component_count(uniforms_of(program)[name])
        try:
            values = tuple(float(number) for number in text.replace(";", ",").split(","))
        except ValueError:
            values = ()
        if len(values) != count or not all(map(isfinite, values)):
            numbers = "1 number" if count == 1 else f"{count} numbers, separated by commas"
            self._pane.show_problem("", 0, 0, f"{name} needs {numbers}, got {text or 'nothing'}.")
            return
        try:
            self._edit(replace(program, uniforms=(*others.items(), (name, values))))
        except ValueError as problem:
            self._refuse(problem)

    @Slot(str)
    def _compare(self, preset: str) -> None:
        """Let B draw with other shaders, or with the built-in Phong shading."""
        scene = self._session.latest.scene
        assert isinstance(scene, Scene)
        if preset:
            other, title, differences = preset_program(preset, scene), PRESETS[preset].title, {}
        else:
            other, title, differences = None, "Built-in Phong shading", {"shading": "phong"}
        self.comparison_requested.emit(differences, replace(scene, program=other), title)

    def _program(self) -> ShaderProgram | None:
        scene = self._session.latest.scene
        return scene.program if isinstance(scene, Scene) else None

    def _try(self, program: ShaderProgram, sources: dict[str, str]) -> None:
        scene = self._session.latest.scene
        assert isinstance(scene, Scene)
        try:
            self._edit(retyped(program, scene, sources["vertex"], sources["fragment"]))
        except ValueError as problem:
            self._refuse(problem)

    def _refuse(self, problem: ValueError) -> None:
        """Say what is wrong, at its place where it has one; the document keeps what it had."""
        if isinstance(problem, ShaderProblem):
            self._pane.show_problem(problem.stage, problem.line, problem.column, ended(problem.sentence))
        else:
            self._pane.show_problem("", 0, 0, ended(str(problem)))

    def _edit(self, program: ShaderProgram | None) -> None:
        """Take the shaders over, once both pictures of the scene were drawn by them: an endless loop ends there."""
        document = self._session.latest
        assert isinstance(document.scene, Scene)
        edited = replace(document, scene=replace(document.scene, program=program))
        if program is not None:
            from core import render
            from core.lanes.run import bounded

            with bounded(TRIAL_SECONDS):
                for scene in {id(scene): scene for scene in (edited.traced_scene, edited.scene)}.values():
                    render(scene, edited.settings)
        self._session.edit(edited)
        if program is not None:
            self._pane.show_accepted(self._accepted(program))

    def _accepted(self, program: ShaderProgram) -> str:
        """Return what is said of shaders that run: a mistake of the shelf that makes their picture, and notes."""
        document = self._session.latest
        scene = document.traced_scene
        assert isinstance(scene, Scene)
        mistake = None
        if scene.size[0] * scene.size[1] <= MOST_RECOGNISED:
            from lessons.shader_mistakes import recognised

            mistake = recognised(program, replace(scene, program=None), document.settings)
        said = f"Both shaders run. {mistake.says}" if mistake is not None else ""
        return f"{said} {notes_of(program)}".strip()


def uniforms_of(program: ShaderProgram) -> dict[str, str]:
    """Return the uniforms that the user sets, with their types."""
    from core.shaders.linking import own_uniforms

    return own_uniforms(program)


def component_count(of: str) -> int:
    """Return how many numbers a value of a type has."""
    from core.shaders import glsl_types

    return glsl_types.component_count(of)


def ended(sentence: str) -> str:
    """Return a sentence with its end."""
    return sentence if sentence.endswith(("?", ".", ";")) else f"{sentence}."


def _text_of(values: Sequence[float]) -> str:
    return ", ".join(f"{value:g}" for value in values)


def notes_of(program: ShaderProgram) -> str:
    """Return what is worth a sentence although both shaders run."""
    return " ".join(note for shader in program.shaders for note in shader.notes)


def shown_program(program: ShaderProgram, scene: Scene) -> ShownProgram:
    """Return what the pane shows of a scene's shaders."""
    values, given = program.values, scene_uniforms(scene)
    uniforms = tuple(
        ShownUniform(
            name,
            of,
            _text_of(values.get(name, ())),
            _text_of(given[name]) if name in given else _text_of((0.0,) * component_count(of)),
        )
        for name, of in uniforms_of(program).items()
    )
    sources = {"vertex": program.vertex, "fragment": program.fragment}
    return ShownProgram(sources, preset_of(program) or OWN, program.dialect, uniforms, notes_of(program))
