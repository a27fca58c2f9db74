"""Which mistake makes a picture: compares what another program drew with the open scene, and steps what was found."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job, Progress
from app.files.drawn_pictures import read_drawn
from app.files.file_access import DRAWN_ENDINGS
from app.files.file_dialogs import ask_file
from app.pages.cover import COVERED
from app.pages.page_bar import Page, StepRequest
from app.session.document import Document
from app.session.moment import Change
from app.session.session import Session
from core import STAGES
from core.records.words import capitalized, counted
from core.scene import AnyScene, ClipScene
from core.settings import FAMILIES
from core.study.record import Opening
from lessons.diagnosis import (
    RIGHT,
    Candidate,
    Diagnosis,
    Drawn,
    compared_text,
    diagnose,
    pixels_text,
    right_text,
    scene_text,
)
from lessons.mistakes.twin import same_scene
from lessons.os_errors import problem_text
from lessons.scene_edits import scene_digest
from widgets.exercises.diagnosis_view import DiagnosisView
from widgets.exercises.records import DiagnosisRecord, FoundRun
from widgets.grid.layers import GridBuffer

KINDS = f"Pictures ({' '.join(f'*{ending}' for ending in DRAWN_ENDINGS)});;All files (*)"
MOST_FOUND = 8
"""Runs that are listed; of more, a number is told."""


@dataclass(frozen=True, eq=False)
class _Diagnosed:
    name: str
    document: Document
    scene: AnyScene
    """The open scene at the size of the picture."""
    drawn: Drawn
    diagnosis: Diagnosis


class _CancelledError(Exception):
    """Nobody waits for the comparison any more."""


class DiagnosisPresenter(QObject):
    """Fills the view of a picture."""

    shown = Signal()
    """A picture is in the view now."""
    hidden = Signal()
    """It must not be seen any more: an exercise asks about its scene."""

    def __init__(self, session: Session, view: DiagnosisView, page: Page) -> None:
        super().__init__(page)
        self._session, self._view, self._page = session, view, page
        self._diagnosed: _Diagnosed | None = None
        self.job = Job(self, (OSError, ValueError, MemoryError), succeeded=self._show, failed=self._refuse)
        view.open_requested.connect(self.ask_picture)
        view.run_requested.connect(self._show_run)
        session.changed.connect(self._hide_asked)

    @Slot()
    def ask_picture(self) -> None:
        """Ask for a picture of the open scene."""
        path = ask_file(self._view.window(), "Which mistake makes this picture?", KINDS)
        if path:
            self.open(path)

    def open(self, path: str) -> None:
        """Compare a picture with what every mistake and method makes of the open scene."""
        if self._session.is_asked_about:
            self._page.refuse(COVERED[self._session.asker])
            return
        document = self._session.document

        def work(progress: Progress, is_cancelled: Callable[[], bool]) -> _Diagnosed:
            def report(fraction: float, doing: str) -> None:
                if is_cancelled():
                    raise _CancelledError
                progress(fraction, doing)

            scene, drawn = _read(Path(path), document)
            found = diagnose(scene, document.settings, drawn, report)
            return _Diagnosed(Path(path).name, document, scene, drawn, found)

        self.job.start(work)

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._page.refuse(f"The picture was not compared: {problem_text(error)}.")

    @Slot(object)
    def _show(self, diagnosed: _Diagnosed) -> None:
        self._diagnosed = diagnosed
        scene, diagnosis = diagnosed.scene, diagnosed.diagnosis
        runs = diagnosis.found or (() if diagnosis.is_right else (diagnosis.nearest,))
        found = [
            FoundRun(_sentence(each), self._request(each) is not None)
            for each in runs[:MOST_FOUND]
            if each.name != RIGHT
        ]
        if len(runs) > MOST_FOUND:
            found.append(FoundRun(f"{len(runs) - MOST_FOUND} more make the same picture.", has_run=False))
        about = f"{diagnosed.name}, compared with {scene_text(diagnosed.document.title, scene)}"
        self._view.show_diagnosis(
            DiagnosisRecord(
                f"{about}. {compared_text(diagnosis.drawn)}",
                _verdict(diagnosis),
                diagnosis.is_right,
                tuple(found),
                _buffer(diagnosed.drawn),
                diagnosis.from_right if diagnosis.found else diagnosis.differing,
            )
        )
        self.shown.emit()

    @Slot(int)
    def _show_run(self, number: int) -> None:
        if self._diagnosed is not None:
            diagnosis = self._diagnosed.diagnosis
            request = self._request((diagnosis.found or (diagnosis.nearest,))[number])
            if request is not None:
                self._page.step_to(request)

    def _request(self, candidate: Candidate) -> StepRequest | None:
        """Return what steps the right run beside that of a candidate; ``None``: it has only a picture."""
        assert self._diagnosed is not None
        document, scene = self._diagnosed.document, self._diagnosed.scene
        change = candidate.change_scene
        if change is None or (change is not same_scene and not isinstance(scene, ClipScene)):
            return None
        changed = document.settings.differences(candidate.settings)
        stages = [STAGES.index(FAMILIES[family].stage) for family in changed if family in FAMILIES]
        # The first pixel, not an edge's rule: no pixel is drawn before the raster.
        stage = STAGES[max(min(stages, default=0), STAGES.index("raster"))]
        differing = self._diagnosed.diagnosis.from_right.nonzero()
        pixel = int(differing[1][0]), int(differing[0][0])
        opening = Opening(scene, document.settings, stage, pixel)
        if not candidate.is_mistake:
            return StepRequest(opening, document.title, candidate.settings)
        other = change(scene) if isinstance(scene, ClipScene) else scene
        title = f"with the mistake: {candidate.name.replace('-', ' ')}"
        return StepRequest(opening, document.title, candidate.settings, other_scene=other, other_title=title)

    @Slot(Change)
    def _hide_asked(self, what: Change) -> None:
        """Forget a picture of the scene that an exercise asks about from now on."""
        if (
            Change.ASKED in what
            and self._diagnosed is not None
            and scene_digest(self._diagnosed.document.scene) in self._session.asked_scenes
        ):
            self._diagnosed = None
            self.hidden.emit()


def _read(path: Path, document: Document) -> tuple[AnyScene, Drawn]:
    """Return the open scene at the size of a picture, as it is stepped or as a whole, and the picture."""
    scene, stepped = document.scene, document.traced_scene.size
    try:
        return replace(scene, size=stepped), read_drawn(path, stepped)
    except ValueError as problem:
        try:
            return scene, read_drawn(path, scene.size)
        except ValueError:
            raise problem from None


def _verdict(diagnosis: Diagnosis) -> str:
    if diagnosis.is_right:
        return f"Right: {right_text(diagnosis.drawn)}."
    if diagnosis.found:
        count = counted(len(diagnosis.found), "run")
        verb = "makes" if len(diagnosis.found) == 1 else "make"
        return f"{count} {verb} this picture. {pixels_text(diagnosis.from_right, RIGHT)}."
    nearest = pixels_text(diagnosis.differing, _name(diagnosis.nearest))
    said = "" if diagnosis.nearest.name == RIGHT else "The nearest: "
    return f"Unknown: no mistake on the shelf and no method makes this picture. {said}{nearest}."


def _name(candidate: Candidate) -> str:
    return candidate.name.replace("-", " ") if candidate.is_mistake else candidate.name


def _sentence(candidate: Candidate) -> str:
    beginning = capitalized(_name(candidate)) if candidate.is_mistake else "Another method"
    return f"{beginning}. {candidate.sentence}"


def _buffer(drawn: Drawn) -> GridBuffer:
    """Return a picture as the grid shows it."""
    if drawn.colors is not None:
        return GridBuffer("picture", drawn.colors, "color", title="the picture")
    if drawn.primitive is not None:
        return GridBuffer("picture", drawn.primitive, "ids", title="the picture")
    assert drawn.covered is not None
    return GridBuffer("picture", drawn.covered, "bool", title="the picture")
