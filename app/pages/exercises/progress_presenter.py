"""Shows what a learner has reached, lets another one answer, and exchanges answers as files."""

from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from itertools import groupby
from operator import attrgetter
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job, Progress
from app.files.attempts import SIZE_LIMIT, attempt_file
from app.files.exercise_folders import all_templates
from app.files.file_dialogs import SaveDialog, ask_file
from app.files.file_writing import write_file
from app.files.input_files import read_input
from app.pages.page_bar import Page
from core import STAGES
from core.records.words import counted
from core.stages.declared import stage_of
from lessons.attempts.imports import judged_again
from lessons.attempts.practice import progress
from lessons.attempts.record import Attempt, exported_attempts, is_name, read_attempts_json
from lessons.mistakes.shelf import MISTAKES
from lessons.os_errors import problem_text
from widgets.exercises.progress_view import MistakeRecord, ProgressView, StageProgress

KINDS = "Answers (*.json);;All files (*)"
EXPORTED = "Answers, to be imported (*.json);;Table for a spreadsheet (*.csv)"


class ProgressPresenter(QObject):
    """Fills the view of progress."""

    user_changed = Signal(str)
    """Somebody else answers from now on."""
    attempts_added = Signal()
    """Answers were imported."""

    def __init__(self, view: ProgressView, page: Page) -> None:
        super().__init__(page)
        self._view, self._page = view, page
        self._user = ""
        self.job = Job(self, expected=(OSError, ValueError, MemoryError))
        self.job.succeeded.connect(self._take_imported)
        self.job.failed.connect(self._refuse_import)
        view.user_chosen.connect(self._choose_user)
        view.export_requested.connect(self._export)
        view.import_requested.connect(self._import)

    def show(self, attempts: Sequence[Attempt], user: str) -> None:
        """Show what a user has reached."""
        self._user = user
        try:
            self._view.show_users(attempt_file().users(), user)
        except OSError as problem:
            self._page.refuse(f"{problem}.")
            self._view.show_users((), user)
        reached = progress(attempts)
        stage_by_template = {attempt.template: attempt.stage for attempt in attempts}
        most = {attempt.template: attempt.most for attempt in attempts}
        by_stage = {
            stage: [*found]
            for stage, found in groupby(sorted(reached.mistakes, key=_place), attrgetter("stage"))
        }
        stages = []
        for stage in STAGES:
            names = [name for name, its in stage_by_template.items() if its == stage]
            if names:
                best = sum(reached.best.get(name, 0) for name in names)
                points = f"{best:.3g} of {counted(sum(most[name] for name in names), 'point')}"
                mistakes = tuple(
                    MistakeRecord(
                        _title(each.mistake), _sentence(each.mistake), f"{each.made} of {each.asked}"
                    )
                    for each in by_stage.get(stage, ())
                )
                stages.append(StageProgress(stage_of(stage).short_title, points, mistakes))
        self._view.show_progress(reached.points_text, stages)

    @Slot(str)
    def _choose_user(self, name: str) -> None:
        if not is_name(name):
            self._page.refuse(f"Expected a name of 1 to 200 printable characters, got {name[:40]!r}.")
        elif name != self._user:
            self.user_changed.emit(name)

    @Slot()
    def _export(self) -> None:
        path = SaveDialog(self._view.window(), "Export answers", f"answers-{self._user}", EXPORTED).ask()
        if path:
            self.export_to(path)

    def export_to(self, path: str) -> None:
        """Write all answers of the learner."""
        try:
            attempts = attempt_file().attempts(self._user)
            write_file(path, exported_attempts(attempts, path))
        except OSError as problem:
            self._page.refuse(f"The answers were not exported: {problem}.")
        else:
            self._page.tell_done(f"Exported {counted(len(attempts), 'answer')} to {Path(path).name}.")

    @Slot()
    def _import(self) -> None:
        path = ask_file(self._view.window(), "Import answers", KINDS)
        if path:
            self.import_from(path)

    def import_from(self, path: str) -> None:
        """Judge the answers of an exported file again, and add them, all or none."""

        def work(report: Progress, is_cancelled: Callable[[], bool]) -> str:
            name = Path(path).name
            given = read_attempts_json(read_input(path, SIZE_LIMIT), name)
            templates, _ = all_templates()
            imported = judged_again(given, templates, datetime.now(UTC), report)
            added = attempt_file().add_all(imported.attempts)
            return " ".join([f"Imported {counted(added, 'answer')} from {name}.", *imported.sentences])

        self.job.start(work)

    @Slot(object)
    def _take_imported(self, said: str) -> None:
        self._page.tell_done(said)
        self.attempts_added.emit()

    @Slot(object)
    def _refuse_import(self, problem: Exception) -> None:
        self._page.refuse(f"The answers were not imported: {problem_text(problem)}.")

    @property
    def is_working(self) -> bool:
        """Whether answers are being imported."""
        return self.job.is_running

    def stop(self) -> None:
        """End all work."""
        self.job.shut_down()


def _place(count: object) -> int:
    stage = str(attrgetter("stage")(count))
    return STAGES.index(stage) if stage in STAGES else len(STAGES)


def _title(mistake: str) -> str:
    return mistake.replace("-", " ")


def _sentence(mistake: str) -> str:
    return MISTAKES[mistake].sentence if mistake in MISTAKES else ""
