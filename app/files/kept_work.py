"""What is kept in the background: the last results of families and experiments, and answers in progress.

They are the files that an export writes, in a folder of the user's data: one for each name, replaced by the next
result of that name. All of them together stay below a size; the oldest go first.
"""

from collections.abc import Callable, Set
from functools import partial
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError
from PySide6.QtCore import QObject, QTimer, Signal, Slot

from app.background import Job, Progress
from app.files.file_access import FileWriteError, make_folder, read_input, write_file
from app.files.user_folders import ANSWERS, data_folder
from lessons.attempts.record import DEFAULT_USER
from lessons.exercises.numbers import SEED_LIMIT
from lessons.os_errors import os_error_reason

if TYPE_CHECKING:
    from lessons.exercises.question import Template


# The last result of every family or experiment, kept from one start of the window to the next.


LARGEST = 4 << 20
"""Bytes of one file; a result that is larger is not kept."""
LARGEST_TOGETHER = 32 << 20
"""Bytes of all files of the folder."""
ENDING = ".json"
EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
"""A result of each kind, which this program made on another computer: shown where there is none of the user's own."""
_turn = Lock()
"""Two pages write to one folder, and look together at how much there is in it."""


def results_folder() -> Path:
    """Return the folder of kept results; it may not exist yet. Errors as `data_folder`."""
    return data_folder() / "results"


class KeptResults(QObject):
    """Writes results and reads them again, off the GUI thread; does nothing before it has begun."""

    found = Signal(object, bool)
    """A result of an earlier start, or where nothing was kept the example, and whether it is that."""
    failed = Signal(str)
    """Why something cannot be kept or read again, as a sentence."""

    def __init__(self, kind: str, load: Callable[[Path], Any], parent: QObject | None = None) -> None:
        """Keep results of a ``kind``, as ``study``, the first word of its files; ``load`` opens one of them."""
        super().__init__(parent)
        self._kind, self._load = kind, load
        self._has_begun = False
        self._reading = Job(self, (OSError, ValueError), part_done=self._take, succeeded=self._tell_unread)
        self._writing = Job(self, (OSError, ValueError))
        for job in (self._reading, self._writing):
            job.failed.connect(self._tell)

    def begin(self) -> None:
        """Read what was kept, and keep what comes from now on."""
        self._has_begun = True

        def work(
            progress: Progress, is_cancelled: Callable[[], bool], part_done: Callable[[Any], None]
        ) -> tuple[str, ...]:
            unread = []
            paths = sorted(results_folder().glob(f"{self._kind}-*{ENDING}"))
            if not paths:
                part_done((self._load(EXAMPLES / f"{self._kind}{ENDING}"), True))
            for path in paths:
                if is_cancelled():
                    break
                try:
                    part_done((self._load(path), False))
                except ValueError as problem:
                    unread.append(str(problem))
            return tuple(unread)

        self._reading.start_in_parts(work)

    @Slot(object)
    def _take(self, read: tuple[Any, bool]) -> None:
        self.found.emit(*read)

    def keep(self, name: str, content: Callable[[], bytes | None]) -> None:
        """Replace the last result of this ``name``."""
        if not self._has_begun:
            return

        def work() -> None:
            written = content()
            assert written is not None
            with _turn:
                write_result(results_folder(), f"{self._kind}-{name}{ENDING}", written)

        self._writing.call(work)

    @Slot(object)
    def _tell_unread(self, unread: tuple[str, ...]) -> None:
        if unread:
            self.failed.emit(f"Results of the last start: {'; '.join(unread)}.")

    @Slot(object)
    def _tell(self, error: Exception) -> None:
        self.failed.emit(f"The result could not be kept for the next start: {error}.")


def write_result(folder: Path, name: str, content: bytes) -> None:
    """Write one result whole, and remove the oldest of the folder that are too many.

    Raises OSError if it cannot be written or is too large; the previous results are unchanged.
    """
    if len(content) > LARGEST:
        raise FileWriteError(f"{name} is larger than {LARGEST >> 20} MiB")
    make_folder(folder)
    write_file(folder / name, content)
    remove_oldest(folder, LARGEST_TOGETHER)


def remove_oldest(folder: Path, limit: int) -> None:
    """Remove results, the oldest first, until those that are left have at most ``limit`` bytes together."""
    files = [(path, path.stat()) for path in folder.glob(f"*{ENDING}")]
    total = 0
    for path, status in sorted(files, key=lambda found: found[1].st_mtime_ns, reverse=True):
        total += status.st_size
        if total > limit:
            path.unlink(missing_ok=True)


# Answers in progress: kept in a file soon after every change, so that leaving or the end of the program
# loses none.


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
        self._job = Job(self, (OSError,), succeeded=self._succeed, failed=self._fail)
        self._timer = QTimer(self, singleShot=True, interval=PAUSE)
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
