"""Fills the catalogue: the exercises of every stage, how far the learner is, who answers, and attempts as files."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import groupby
from operator import attrgetter
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot

from app.background import Job, Progress
from app.files.file_access import read_input, write_file
from app.files.file_dialogs import SaveDialog, ask_file
from app.files.kept_work import UnfinishedFile
from app.files.user_folders import EXERCISE_FOLDERS, MOST_ATTEMPT_BYTES, all_templates, attempt_file
from app.pages.page_bar import Page
from core import STAGES
from core.records.words import counted
from core.stages.declared import stage_of
from lessons.attempts.imports import judged_again
from lessons.attempts.practice import Choice, next_question, progress
from lessons.attempts.record import DEFAULT_USER, Attempt, exported_attempts, is_name, read_attempts_json
from lessons.exercises.catalogue import SUBJECTS, TEMPLATES
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Question, Template
from lessons.exercises.screen import PREFIX, screen_template
from lessons.mistakes.shelf import MISTAKES
from lessons.os_errors import problem_text
from widgets.exercises.catalogue import Catalogue, MistakeRecord, ProgressView, StageProgress
from widgets.exercises.records import ExerciseEntry, ExerciseGroup, ExerciseStanding

# Fills the catalogue: the exercises of every stage, how far the learner is, and what to try next.


Attempts = tuple[Attempt, ...]
FIRST_COURSE = (
    *("triangle-coverage", "bresenham-pixels", "vertex-pixels", "front-pixels", "pixels-beyond-near"),
    *("inner-side", "box-pixels", "below-half", "texel-pixels", "nearer-pixels", "blended-twice"),
    *("grey-pixels", "wrong-picture"),
)
"""What somebody new is asked first: on the picture, one or two of each stage."""


@dataclass(frozen=True, eq=False)
class Found:
    """The exercises and attempts that the page begins with."""

    templates: dict[str, Template]
    attempts: Attempts
    trouble: str
    """What to tell of it, in sentences."""


class CataloguePresenter(QObject):
    """Knows all exercises and the attempts of the learner."""

    question_chosen = Signal(object, object)
    """A `Template`, and the seed of its question or ``None``."""
    found = Signal()
    """All exercises are known now, also those of teachers."""

    def __init__(self, view: Catalogue, unfinished: UnfinishedFile, page: Page) -> None:
        super().__init__(page)
        self._view, self._unfinished, self._page = view, unfinished, page
        self.user = DEFAULT_USER
        self.templates: dict[str, Template] = dict(TEMPLATES)
        """By name, stage by stage."""
        self.attempts: Attempts = ()
        """Of the learner, in the order of time."""
        self._choice: Choice | None = None
        self._wants_next = False
        """Whether to open the exercise that suits the learner as soon as one is chosen."""
        self._current = ""
        self._shown: list[str] = []
        """Names of all exercises in the order of the catalogue."""
        self._reading = Job(self, (OSError, ValueError), succeeded=self._take_found, failed=self._refuse)
        self._choosing = Job(self, (OSError, ValueError), succeeded=self._take_choice, failed=self._refuse)
        view.exercise_chosen.connect(self._open)
        view.line_entered.connect(self.open_line)
        self.question_chosen.connect(self._forget_next)

    @property
    def is_reading(self) -> bool:
        """Whether the attempts of the learner are not known yet, or read again."""
        return self._reading.is_running

    @property
    def is_working(self) -> bool:
        """Whether attempts are being read, or the next question is being chosen."""
        return self.is_reading or self._choosing.is_running

    def begin(self) -> None:
        """Read the exercises of teachers' folders, and what the learner has answered so far."""

        def work() -> Found:
            templates, skipped = all_templates()
            trouble = [f"Skipped: {sentence}." for sentence in skipped]
            attempts: Attempts = ()
            try:
                file = attempt_file()
                try:
                    trouble += filter(None, [file.check()])
                finally:  # What was kept before can be read where nothing can be written.
                    attempts = file.attempts(user)
            except OSError as problem:
                trouble.append(f"{problem}. Answers are checked, but not kept.")
            return Found(templates, attempts, " ".join(trouble))

        user = self.user
        self._reading.call(work)
        self.refresh()

    def set_user(self, user: str) -> None:
        """Let somebody else answer."""
        self.user, self.attempts, self._choice = user, (), None
        self.begin()

    @Slot(object)
    def _take_found(self, found: Found) -> None:
        self.templates, self.attempts = {**self.templates, **found.templates}, found.attempts
        if found.trouble:
            self._page.refuse(found.trouble)
        self._choose()
        self.found.emit()

    @Slot(object)
    def take_attempt(self, attempt: Attempt) -> None:
        """Take one more attempt, which is kept already."""
        self.attempts = (*self.attempts, attempt)
        if self.is_reading:
            self.begin()  # What is being read may lack it.
        self._choose()

    def _choose(self) -> None:
        """Choose what to try next."""
        attempts, user = self.attempts, self.user
        templates = {
            name: self.templates[name] for name in dict.fromkeys((*FIRST_COURSE, *self._practised()))
        }
        self._choosing.call(lambda: next_question(attempts, templates, user, datetime.now().astimezone()))
        self.refresh()

    def _practised(self) -> list[str]:
        """Return the names of what practice chooses from: a question from the screen comes only when it is asked."""
        return [name for name in self.templates if not name.startswith(PREFIX)]

    @Slot(object)
    def _take_choice(self, choice: Choice | None) -> None:
        self._choice = choice
        self.refresh()
        if self._wants_next:
            self.open_next()

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._wants_next = False
        self._page.refuse(f"{problem_text(error)}.")

    # What is chosen.

    @Slot(str)
    def _open(self, name: str) -> None:
        self.question_chosen.emit(self.templates[name], None)

    @Slot()
    def _forget_next(self) -> None:
        self._wants_next = False

    def open_next(self) -> None:
        """Open what suits the learner now: what was chosen before the last answer does so no longer."""
        self._wants_next = self.is_working
        if self._choice is not None and not self._wants_next:
            question = self._choice.question
            self.question_chosen.emit(question.template, question.seed)

    def open_neighbour(self, direction: int) -> None:
        """Open the next exercise (1) or the previous one (-1)."""
        names = self._shown
        place = names.index(self._current) + direction if self._current in names else 0
        self._open(names[place % len(names)])

    @Slot(str)
    def open_line(self, line: str) -> None:
        """Open the question of a line such as ``triangle-coverage 2, seed 7``."""
        head, _, seed = line.strip().rpartition(", seed ")
        name, _, version = head.rpartition(" ")
        try:
            template = self.template(name)
        except ValueError as problem:
            self._page.refuse(f"{problem}.")
            return
        if template is None or not seed.isascii() or not seed.isdecimal() or len(seed) > 10:
            self._page.refuse(
                f"Expected a line such as triangle-coverage 2, seed 7; got {line.strip()[:60]!r}."
            )
        elif version != str(template.version):
            self._page.refuse(
                f"The line is of version {version} of {name}, this program has version {template.version}: "
                "the seed gives another question."
            )
        else:
            self.question_chosen.emit(template, int(seed))

    def template(self, name: str) -> Template | None:
        """Return an exercise by its name, also of what is on the screen; ValueError where such a name is wrong."""
        if name.startswith(PREFIX) and name not in self.templates:
            self.templates[name] = screen_template(name)
        return self.templates.get(name)

    def last(self) -> Template | None:
        """Return the exercise that was open last, if there is such."""
        kept = self._unfinished.answers
        try:
            template = self.template(kept.current)
            if template is None and kept.path:
                template = self.templates[kept.current] = read_exercise(Path(kept.path))
        except (OSError, ValueError):
            return None  # About a screen of another version, or in a file that is gone or broken: it is asked no more.
        return template

    def open_file(self, path: str) -> None:
        """Ask the exercise of a file."""
        try:
            template = read_exercise(Path(path))
        except (OSError, ValueError) as problem:
            self._page.refuse(f"{problem_text(problem)}. The page is unchanged.")
        else:
            self.templates[template.name] = template
            self.question_chosen.emit(template, None)

    def add_folder(self, folder: str) -> None:
        """Take a folder of own exercises into the catalogue."""
        try:
            EXERCISE_FOLDERS.add(folder)
        except (OSError, ValueError) as problem:
            self._page.refuse(f"The folder was not added: {problem_text(problem)}.")
        else:
            self.begin()

    @Slot(object)
    def show_question(self, question: Question) -> None:
        """Show which exercise is asked."""
        self._current = question.template.name
        self.refresh()

    # What is shown.

    @Slot()
    def refresh(self) -> None:
        """Show all exercises and how far the learner is."""
        solved = {attempt.template for attempt in self.attempts if attempt.score == 1}
        tried = {attempt.template for attempt in self.attempts}
        begun = self._unfinished.answers.answers

        def standing(name: str) -> ExerciseStanding:
            if name in solved:
                return ExerciseStanding.SOLVED
            if name in tried:
                return ExerciseStanding.MISSED
            return ExerciseStanding.BEGUN if name in begun and begun[name].given else ExerciseStanding.NEW

        def group(name: str, title: str, templates: Iterable[Template]) -> ExerciseGroup:
            return ExerciseGroup(
                name,
                title,
                tuple(
                    ExerciseEntry(
                        each.name,
                        each.title,
                        counted(each.points, "point"),
                        standing(each.name),
                        SUBJECTS.get(each.name, ""),
                    )
                    for each in templates
                ),
            )

        shipped = [self.templates[name] for name in TEMPLATES]
        groups = [
            group(stage, stage_of(stage).short_title, (each for each in shipped if each.stage == stage))
            for stage in STAGES
        ]
        own = [each for each in self.templates.values() if each.name not in TEMPLATES]
        groups = [
            each for each in (*groups, group("own", "Own, and from the Step page", own)) if each.entries
        ]
        self._shown = [entry.name for each in groups for entry in each.entries]
        choice = self._choice
        to_try = "" if choice is None else f"{choice.question.template.title}. {choice.reason}"
        self._view.show_exercises(groups, self._current, to_try)


# Shows what a learner has reached, lets another one answer, and exchanges answers as files.


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
        expected = (OSError, ValueError, MemoryError)
        self.job = Job(self, expected, succeeded=self._take_imported, failed=self._refuse_import)
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
            given = read_attempts_json(read_input(path, MOST_ATTEMPT_BYTES), name)
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


def _place(count: object) -> int:
    stage = str(attrgetter("stage")(count))
    return STAGES.index(stage) if stage in STAGES else len(STAGES)


def _title(mistake: str) -> str:
    return mistake.replace("-", " ")


def _sentence(mistake: str) -> str:
    return MISTAKES[mistake].sentence if mistake in MISTAKES else ""
