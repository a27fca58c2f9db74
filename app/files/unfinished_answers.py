"""Answers in progress: kept in a file soon after every change, so that leaving or the end of the program loses none."""

from collections.abc import Set
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.background.workers import Job
from app.files.file_writing import make_folder, write_file
from app.files.input_files import read_input
from app.files.user_folders import ANSWERS, data_folder
from lessons.attempts.record import DEFAULT_USER
from lessons.exercises.draws import SEED_LIMIT
from lessons.os_errors import os_error_reason

if TYPE_CHECKING:
    from lessons.exercises.question import Template  # All mistakes come along: not at every start.

PAUSE = 200
"""Milliseconds after the last change."""
VERSION: Literal[3] = 3
"""Of the file; earlier ones are read, later ones left alone."""
SIZE_LIMIT = 1 << 24
"""Most bytes of the file."""


class Unfinished(BaseModel):
    """How far the learner is with one exercise."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    version: int
    """Of the template: of another one the answer is to another question."""
    seed: Annotated[int, Field(ge=0, le=SEED_LIMIT)]
    given: Any = None
    """What is in the form; ``None``: nothing yet."""
    hints: Annotated[int, Field(ge=0, le=20)] = 0
    """How many are shown."""
    is_shown: bool = False
    """The model answer has been shown, so the question is asked no more."""
    is_checked: bool = False
    """The answer, or an earlier one, has been checked: nothing is hidden for the question any more."""


class UnfinishedAnswers(BaseModel):
    """The file."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    program: Literal["rasterscope answers"] = "rasterscope answers"
    version: Literal[1, 2, 3] = VERSION
    user: str = DEFAULT_USER
    """Who answers."""
    current: str = ""
    """Name of the exercise that was open last."""
    path: str = ""
    """Its file; empty: it has none."""
    asked_scene: str = ""
    """Digest of the scene that it asks about, as long as that is hidden; empty: nothing is."""
    hidden: tuple[str, str] | None = None
    """Title and file of what was open and hidden for it, perhaps edited; ``None``: nothing was."""
    answers: dict[str, Unfinished] = {}
    """By the name of the exercise."""
    others: dict[str, dict[str, Unfinished]] = {}
    """Those of other learners, by their names."""

    @property
    def by_learner(self) -> dict[str, dict[str, Unfinished]]:
        """Answers of all learners, by learner and exercise."""
        return {**self.others, self.user: self.answers}


class UnfinishedFile(QObject):
    """Holds the answers in progress, each learner's apart, and writes them off the GUI thread."""

    failed = Signal(str)
    """Why they cannot be kept, as a sentence."""

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.answers = UnfinishedAnswers()
        self._changed: frozenset[tuple[str, str]] = frozenset()
        """Learners and exercises whose answers this window has changed; the rest is left to other windows."""
        self._has_failed = self._is_dirty = self._is_foreign = False
        """The last: the file is of a later version, and is left alone."""
        self._job = Job(self, expected=(OSError,))
        self._job.succeeded.connect(self._succeed)
        self._job.failed.connect(self._fail)
        self._timer = QTimer(self)
        self._timer.setSingleShot(True)
        self._timer.setInterval(PAUSE)
        self._timer.timeout.connect(self._save)

    def read(self) -> str:
        """Read what was kept; return what to tell the user, empty if all is well."""
        try:
            content = read_input(_path(), SIZE_LIMIT)
        except FileNotFoundError:
            return ""
        except OSError as problem:
            return f"Answers in progress cannot be read: {os_error_reason(problem)}."
        try:
            self.answers = _answers(content)
        except ValidationError:
            if _is_later(content):
                self._is_foreign = True
                return "Answers in progress were kept by a later version of the program. They are left alone."
            broken = _path().with_suffix(".broken")
            try:
                _path().replace(broken)
            except OSError as problem:
                return f"Answers in progress were broken and cannot be set aside: {os_error_reason(problem)}."
            return f"Answers in progress were broken. They are kept as {broken.name}, and none is open."
        return ""

    def keep(self, template: "Template", unfinished: Unfinished, asked_scene: str = "") -> None:
        """Keep the answer to an exercise, that it is the one that is open, and the scene that is hidden for it."""
        name = template.name
        self._changed |= {(self.answers.user, name)}
        answers = {**self.answers.answers, name: unfinished}
        changed = {"current": name, "path": template.path, "asked_scene": asked_scene, "answers": answers}
        self._change(self.answers.model_copy(update=changed))

    def keep_hidden(self, hidden: tuple[str, str] | None) -> None:
        """Keep what is open and hidden."""
        self._change(self.answers.model_copy(update={"hidden": hidden}))

    def keep_user(self, user: str) -> None:
        """Keep who answers, and go on with what this learner has begun; what others have stays theirs."""
        kept = _merged(self.answers, self._changed)
        others = kept.by_learner
        own = others.pop(user, {})
        self._change(
            UnfinishedAnswers(user=user, current=kept.current, path=kept.path, answers=own, others=others)
        )

    def _change(self, changed: UnfinishedAnswers) -> None:
        if changed != self.answers:
            self.answers = changed
            if not self._is_foreign:
                self._is_dirty = True
                self._timer.start()

    @Slot()
    def _save(self) -> None:
        if self._job.is_running:
            self._timer.start()
            return
        answers, changed, self._is_dirty = self.answers, self._changed, False
        self._job.call(partial(_write, answers, changed))

    @Slot()
    def _succeed(self) -> None:
        self._has_failed = False

    @Slot(object)
    def _fail(self, error: Exception) -> None:
        self._is_dirty = True
        if not self._has_failed:
            self._has_failed = True
            self.failed.emit(f"The answer is not kept for the next start: {error}.")

    def finish(self) -> None:
        """Write the latest changes; a failure has been told before, or is told by this sentence."""
        self._timer.stop()
        self._job.shut_down()
        if self._is_dirty:
            try:
                _write(self.answers, self._changed)
            except OSError as error:
                self._fail(error)


class _Head(BaseModel):
    program: Literal["rasterscope answers"]
    version: int


def read_answers() -> UnfinishedAnswers:
    """Return what was kept; OSError where it cannot be read, ValidationError where it is broken or of a later one."""
    return _answers(read_input(_path(), SIZE_LIMIT))


def learner() -> str:
    """Return who answers, as it is kept; the usual name where that cannot be read."""
    try:
        return read_answers().user
    except (OSError, ValidationError):
        return DEFAULT_USER


def _answers(content: bytes) -> UnfinishedAnswers:
    return UnfinishedAnswers.model_validate_json(content).model_copy(update={"version": VERSION})


def _is_later(content: bytes) -> bool:
    """Return whether a file was written by a later version."""
    try:
        return _Head.model_validate_json(content).version > VERSION
    except ValidationError:
        return False


def _path() -> Path:
    return data_folder() / ANSWERS


def _merged(answers: UnfinishedAnswers, changed: Set[tuple[str, str]]) -> UnfinishedAnswers:
    """Return answers with what other windows have kept since, but for the ``changed`` ones."""
    try:
        learners = read_answers().by_learner
    except (OSError, ValidationError):
        return answers
    for user, its in answers.by_learner.items():
        own = {name: answer for name, answer in its.items() if (user, name) in changed}
        learners[user] = {**its, **learners.get(user, {}), **own}
    return answers.model_copy(update={"answers": learners.pop(answers.user), "others": learners})


def _write(answers: UnfinishedAnswers, changed: Set[tuple[str, str]]) -> None:
    """Write answers, beside those that other windows have kept."""
    make_folder(data_folder())
    write_file(_path(), _merged(answers, changed).model_dump_json().encode() + b"\n")
