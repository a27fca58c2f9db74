"""Fills the catalogue: the exercises of every stage, how far the learner is, and what to try next."""

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job
from app.files.attempts import attempt_file
from app.files.exercise_folders import FOLDERS, all_templates
from app.files.unfinished_answers import UnfinishedFile
from app.pages.page_bar import Page
from core import STAGES
from core.records.words import counted
from core.stages.declared import stage_of
from lessons.attempts.practice import Choice, next_question
from lessons.attempts.record import DEFAULT_USER, Attempt
from lessons.exercises.catalogue import SUBJECTS, TEMPLATES
from lessons.exercises.exercise_file import read_exercise
from lessons.exercises.question import Question, Template
from lessons.exercises.screen import PREFIX, screen_template
from lessons.os_errors import problem_text
from widgets.exercises.catalogue import Catalogue
from widgets.exercises.records import ExerciseEntry, ExerciseGroup, Standing

Attempts = tuple[Attempt, ...]
FIRST_COURSE = (
    "triangle-coverage",
    "bresenham-pixels",
    "vertex-pixels",
    "front-pixels",
    "pixels-beyond-near",
    "inner-side",
    "box-pixels",
    "below-half",
    "texel-pixels",
    "nearer-pixels",
    "blended-twice",
    "grey-pixels",
    "wrong-picture",
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
        self._reading, self._choosing = (Job(self, expected=(OSError, ValueError)) for _ in range(2))
        self._reading.succeeded.connect(self._take_found)
        self._reading.failed.connect(self._refuse)
        self._choosing.succeeded.connect(self._take_choice)
        self._choosing.failed.connect(self._refuse)
        view.exercise_chosen.connect(self._open)
        view.line_entered.connect(self.open_line)
        self.question_chosen.connect(self._forget_next)

    @property
    def is_working(self) -> bool:
        """Whether attempts are being read, or the next question is being chosen."""
        return self._reading.is_running or self._choosing.is_running

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

    def stop(self) -> None:
        """End all work."""
        self._reading.shut_down()
        self._choosing.shut_down()

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
        if self._reading.is_running:
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
            FOLDERS.add(folder)
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

        def standing(name: str) -> Standing:
            if name in solved:
                return Standing.SOLVED
            if name in tried:
                return Standing.MISSED
            return Standing.BEGUN if name in begun and begun[name].given else Standing.NEW

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
