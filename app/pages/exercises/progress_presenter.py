"""Shows what a learner has reached, lets another one answer, and exchanges answers as files."""

from collections.abc import Sequence
from itertools import groupby
from operator import attrgetter
from pathlib import Path

from pydantic import TypeAdapter, ValidationError
from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QFileDialog

from app.files.attempts import SIZE_LIMIT, attempt_file
from app.files.file_writing import write_file
from app.files.input_files import read_input
from app.files.save_dialog import SaveDialog
from core import STAGES
from core.records.words import counted
from core.stages.declared import stage_of
from lessons.attempts.practice import progress
from lessons.attempts.record import Attempt, Name, exported_attempts, read_attempts_json
from lessons.mistakes.shelf import MISTAKES
from widgets.exercises.progress_view import MistakeRecord, ProgressView, StageProgress

KINDS = "Answers (*.json);;All files (*)"
EXPORTED = "Answers, to be imported (*.json);;Table for a spreadsheet (*.csv)"
_NAMES: TypeAdapter[str] = TypeAdapter(Name)


class ProgressPresenter(QObject):
    """Fills the view of progress."""

    user_changed = Signal(str)
    """Somebody else answers from now on."""
    attempts_added = Signal()
    """Answers were imported."""
    message_sent = Signal(str)
    refused = Signal(str)

    def __init__(self, view: ProgressView, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._view = view
        self._user = ""
        view.user_chosen.connect(self._choose_user)
        view.export_requested.connect(self._export)
        view.import_requested.connect(self._import)

    def show(self, attempts: Sequence[Attempt], user: str) -> None:
        """Show what a user has reached."""
        self._user = user
        try:
            self._view.show_users(attempt_file().users(), user)
        except OSError as problem:
            self.refused.emit(f"{problem}.")
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
        self._view.show_progress(f"{reached.points:.3g} points", stages)

    @Slot(str)
    def _choose_user(self, name: str) -> None:
        try:
            user = _NAMES.validate_python(name)
        except ValidationError:
            self.refused.emit(f"Expected a name of 1 to 200 printable characters, got {name[:40]!r}.")
            return
        if user != self._user:
            self.user_changed.emit(user)

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
            self.refused.emit(f"The answers were not exported: {problem}.")
        else:
            self.message_sent.emit(f"Exported {counted(len(attempts), 'answer')} to {Path(path).name}.")

    @Slot()
    def _import(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self._view.window(), "Import answers", "", KINDS)
        if path:
            self.import_from(path)

    def import_from(self, path: str) -> None:
        """Add the answers of an exported file, all or none."""
        try:
            added = attempt_file().add_all(read_attempts_json(read_input(path, SIZE_LIMIT), Path(path).name))
        except (OSError, ValueError) as problem:
            self.refused.emit(f"The answers were not imported: {problem}.")
        else:
            self.message_sent.emit(f"Imported {counted(added, 'answer')} from {Path(path).name}.")
            self.attempts_added.emit()


def _place(count: object) -> int:
    stage = str(attrgetter("stage")(count))
    return STAGES.index(stage) if stage in STAGES else len(STAGES)


def _title(mistake: str) -> str:
    return mistake.replace("-", " ")


def _sentence(mistake: str) -> str:
    return MISTAKES[mistake].sentence if mistake in MISTAKES else ""
