"""The shaders of the scene in their pane: each text is tried first, and each that runs is one edit to be undone.

What reads and runs shaders is imported when it is first needed: most windows open without any.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from math import isfinite
from typing import Literal

import numpy as np
from PySide6.QtCore import QEvent, QObject, QTimer, Signal, Slot

from app.background import Job
from app.pages.page_bar import Page
from app.session.document import Document
from app.session.moment import Moment
from app.session.session import Session
from app.session.tracing import trace_now
from core import Trace, render
from core.lanes.problem import SHADER
from core.records.arrays import Singles
from core.records.steps import Level
from core.records.words import joined
from core.scene import Scene
from core.shaders.presets import PRESETS, preset_of, preset_program, retyped
from core.shaders.record import DIALECTS, ShaderProblem, ShaderProgram
from widgets.scene.shaders import OWN, ShaderPane, ShownProgram, ShownUniform

# A trial of shaders off the GUI thread: they are read, stepped and drawn before the document takes them
# over.


TRIAL_SECONDS = 3.0
"""Seconds that stepping and drawing may take before what was typed is taken over."""
RECOGNISED = (96, 72)
"""Largest size, in pixels, of a picture that is compared with those of the mistakes."""

Make = Callable[[], ShaderProgram]
"""Reads shaders; raises ValueError where they cannot be read."""


@dataclass(frozen=True, eq=False)
class Tried:
    """Shaders that have run."""

    beside: Document
    """What was open when they were tried."""
    document: Document
    """The same with these shaders."""
    trace: Trace
    said: str
    """What is said of them: a mistake of the shelf that makes their picture, and notes."""


def try_shaders(beside: Document, stage: str, make: Make, is_cancelled: Callable[[], bool]) -> Tried:
    """Read shaders, step them as far as a stage, and draw both pictures of the scene by them.

    Raises ValueError (`core.shaders.record.ShaderProblem` with a place) where they cannot be read, do not end, or are
    too many to step.
    """
    from core.lanes.run import bounded

    assert isinstance(beside.scene, Scene)
    with bounded(TRIAL_SECONDS, is_cancelled):
        program = make()
        document = replace(beside, scene=replace(beside.scene, program=program))
        trace = trace_now(document, stage)
        if document.traced_scene is not document.scene:
            render(document.scene, document.settings)
    said = _accepted(document, program, [*_unset(trace, stage)], is_cancelled)
    return Tried(beside, document, trace, said)


def _unset(trace: Trace, stage: str) -> Iterator[str]:
    """Yield what is said of the first statement of the stage that reads a variable without a value."""
    traced = trace.stage(stage)
    rows = np.flatnonzero(traced.extra.get("unset", ()))
    if not len(rows):
        return
    row = int(rows[0])
    explanation = traced.explain(traced.steps.position_after(row))
    assert explanation is not None
    assert explanation.step is not None
    line, what = explanation.step.line, "vertices" if stage == "transform" else "fragments"
    same = rows[traced.columns["line"][rows] == line]
    count = len(np.unique(traced.columns["lane"][same]))
    names = joined(explanation.step.unset)
    yield f"Line {line} reads {names} before it has a value, for {count:,} {what}. Here it is 0, GLSL leaves it open."


def _accepted(
    document: Document,
    program: ShaderProgram,
    unset: Sequence[str],
    is_cancelled: Callable[[], bool],
) -> str:
    """Return what is said of shaders that run."""
    from core.lanes.problem import Problem
    from core.lanes.run import bounded
    from lessons.mistakes.shaders import recognised

    assert isinstance(document.scene, Scene)
    width, height = document.scene.size
    scale = min(1.0, RECOGNISED[0] / width, RECOGNISED[1] / height)
    small = (max(round(scale * width), 1), max(round(scale * height), 1))
    scene = replace(document.scene, size=small)
    try:
        with bounded(TRIAL_SECONDS, is_cancelled):
            mistake = recognised(program, replace(scene, program=None), document.settings)
            if mistake is not None and mistake.wrong not in getattr(program, mistake.stage):
                # Pictures of one colour are alike whatever made them.
                mistake = None if _is_plain(render(scene, document.settings).color) else mistake
    except Problem:
        mistake = None  # A mistake takes too long to draw: none is named.
    said = f"Both shaders run. {mistake.says}" if mistake is not None else ""
    said = said or ("Both shaders run." if unset else "")
    return " ".join(filter(None, (said, notes_of(program), *unset)))


def _is_plain(picture: Singles) -> bool:
    """Return whether a picture (H, W, 4) has one colour."""
    return bool((picture == picture[0, 0]).all())


def notes_of(program: ShaderProgram) -> str:
    """Return what is worth a sentence although both shaders run."""
    return " ".join(note for shader in program.shaders for note in shader.notes)


# The shaders of the scene in their pane: each text that runs is one edit, which undo takes back.


LATER_MS = 200
"""After this long a trial is reported."""
DRAWING = "Drawing with your shaders … Esc stops it."
STAY = "Your shaders stay: they draw this scene, too. The pane Shaders (L) takes them off."
SLEEP = "Your shaders sleep: a scene in clip space runs none. They come back with the next scene of meshes."
PUT_ASIDE = "This scene has shaders of its own: yours are put aside. Undo leads back to them."
REFUSED = "Your shaders sleep: they do not run on this scene, which is drawn without them: "
STOPPED = "Stopped. The picture is that of the last shaders that ran."


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
        pane.left.connect(self.leave)
        self._job = Job(self, succeeded=self._take, failed=self._refuse)
        self._make: Make | None = None
        self._own: ShaderProgram | None = None
        """The shaders that the user has typed or chosen last."""
        self._refusing: Scene | None = None
        """The scene on which they do not run: there they sleep."""
        self._is_bringing = False
        """Whether the trial is of shaders that another scene had."""
        self._began_with: ShaderProgram | None = None
        """The shaders of the scene when the trial began."""
        self._later = QTimer(self, interval=LATER_MS, singleShot=True)
        self._later.timeout.connect(self._tell_drawing)
        self.refresh(session.moment)

    def begin_anew(self) -> None:
        """Forget what did not run: another scene was opened."""
        self._job.cancel()
        self._pane.forget_typed()

    def refresh(self, moment: Moment) -> None:
        """Show the shaders while the pane is in sight; a trial ends where others came in between, as by undo."""
        if self._program() is not self._began_with:
            self._job.cancel()
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
        if preset:
            self._edit(partial(preset_program, preset, scene))
        else:
            self._job.cancel()
            self._own = None
            self._session.edit(replace(self._session.latest, scene=replace(scene, program=None)))

    @Slot(str, str)
    def _type(self, stage: str, text: str) -> None:
        program = self._program()
        if program is None:
            return
        sources = {each: self._pane.editor(each).toPlainText() for each in ("vertex", "fragment")} | {
            stage: text
        }
        if (sources["vertex"], sources["fragment"]) == (program.vertex, program.fragment):
            self._job.cancel()
            self._pane.show_accepted(notes_of(program))
            return
        self._edit(partial(retyped, program, sources["vertex"], sources["fragment"]))

    @Slot(str)
    def show_divergence(self, said: str) -> None:
        """Say below the sources, where all of it has room, where A and B differ first; not in place of a problem."""
        if self._program() is not None and not self.drafts():
            self._pane.show_accepted(said)

    def drafts(self) -> dict[Literal["vertex", "fragment"], str]:
        """Return the texts in the editors that the document has not taken over."""
        program = self._program()
        if program is None or not self._pane.shows(program.vertex, program.fragment):
            return {}
        texts: dict[Literal["vertex", "fragment"], str] = {
            "vertex": self._pane.editor("vertex").toPlainText(),
            "fragment": self._pane.editor("fragment").toPlainText(),
        }
        return {
            stage: text
            for stage, text in texts.items()
            if text != getattr(program, stage) and len(text) <= SHADER.characters
        }

    def show_drafts(self, drafts: Mapping[Literal["vertex", "fragment"], str]) -> None:
        """Put texts that did not run back into the editors, and say again why they do not."""
        if self._program() is None or not drafts:
            return
        self._show()
        for stage, text in drafts.items():
            self._pane.editor(stage).set_source(text)
        self._type(*next(iter(drafts.items())))

    @Slot(str)
    def _choose_dialect(self, dialect: str) -> None:
        program = self._program()
        if program is None or dialect == program.dialect:
            return
        self._edit(partial(replace, program, dialect=dialect))

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
        from core.shaders.linking import scene_uniforms

        others = {other: numbers for other, numbers in program.values.items() if other != name}
        if not text.strip() and name in scene_uniforms(scene):
            self._edit(partial(replace, program, uniforms=tuple(others.items())))
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
        self._edit(partial(replace, program, uniforms=(*others.items(), (name, values))))

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

    @Slot(object)
    def _refuse(self, problem: Exception) -> None:
        """Say what is wrong, at its place where it has one; the document keeps what it had."""
        self._show()
        if self._is_bringing:
            scene = self._session.latest.scene
            self._refusing = scene if isinstance(scene, Scene) else None
            self._page.tell(f"{REFUSED}{ended(str(problem))}")
        if isinstance(problem, ShaderProblem):
            self._pane.show_problem(problem.stage, problem.line, problem.column, ended(problem.sentence))
        else:
            self._pane.show_problem("", 0, 0, ended(str(problem)))

    @property
    def kept(self) -> ShaderProgram | None:
        """The shaders that the user has typed or chosen, unless the scene that is open has other ones."""
        scene = self._session.document.scene
        if not isinstance(scene, Scene) or scene is self._refusing or scene.program == self._own:
            return self._own
        return None

    def bring(self, program: ShaderProgram | None) -> None:
        """Let shaders of the scene before draw the one that was opened, if they run there, or say why not."""
        scene = self._session.document.scene
        self._own = program
        if program is None:
            return
        if not isinstance(scene, Scene):
            self._page.tell(SLEEP)
        elif scene.program is not None:
            self._own = None
            self._page.tell(PUT_ASIDE)
        else:
            self._edit(lambda: program, is_bringing=True)

    def _edit(self, make: Make, *, is_bringing: bool = False) -> None:
        """Take shaders over once they have run in the background; the newest count."""
        self._is_bringing = is_bringing
        document = self._session.latest
        assert isinstance(document.scene, Scene)
        self._make, self._began_with = make, document.scene.program
        run = partial(try_shaders, document, self._session.cursor.stage, make)
        self._job.start(lambda _progress, is_cancelled: run(is_cancelled))
        self._later.start()

    @Slot(object)
    def _take(self, tried: Tried) -> None:
        """Take over shaders that have run, unless something else is open by now: then they run on that."""
        if tried.beside is not self._session.latest:
            assert self._make is not None
            self._edit(self._make, is_bringing=self._is_bringing)
            return
        self._session.edit_traced(tried.document, tried.trace)
        self._own = self._program()
        self._pane.show_accepted(tried.said)
        if self._is_bringing:
            self._page.tell(STAY)

    @property
    def is_working(self) -> bool:
        """Whether shaders are being tried."""
        return self._job.is_running

    @Slot()
    def leave(self) -> None:
        """Stop a trial, or else give the keyboard back to the page."""
        if self._job.is_running:
            self._job.cancel()
            self._pane.show_problem("", 0, 0, STOPPED)
            self._show()
        else:
            self._page.setFocus()

    @Slot()
    def _tell_drawing(self) -> None:
        if self._job.is_running:
            self._pane.show_problem("", 0, 0, DRAWING)


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


def shown_program(program: ShaderProgram, scene: Scene) -> ShownProgram:
    """Return what the pane shows of a scene's shaders."""
    from core.shaders.linking import scene_uniforms

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
