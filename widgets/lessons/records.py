"""What the pane of a lesson shows: a step, what came of its task, and the end of the lesson."""

from dataclasses import dataclass
from enum import Enum

MOST_WRONG = 2
"""Wrong answers after which the step that refutes the last one is offered."""


class Standing(Enum):
    """How far somebody is with a step; the value is the word for it."""

    OPEN = "open"
    SEEN = "seen"
    DONE = "done"


@dataclass(frozen=True)
class LessonStepRecord:
    """One step of a lesson, or its end."""

    title: str
    """Of the lesson."""
    text: str
    number: int
    """Of the step, from 0; below: what comes before the first; the number of steps: the end."""
    standings: tuple[Standing, ...]
    """Of all steps."""
    lead: str = ""
    """What the lesson is about, where it begins; empty: nothing."""
    task: str = ""
    """What is to be done, as ``Predict`` or in a sentence; empty: nothing."""
    links: tuple[tuple[str, str], ...] = ()
    """Address and title of what can be opened from here: exercises, pages."""
    next_title: str = ""
    """What Next opens, where it is not the next step."""
    was_done: bool = False
    """Whether the task had been done before the step was opened."""
    has_previous: bool = True
    has_next: bool = True
    """Whether anything comes before, and whether anything follows."""

    @property
    def is_done(self) -> bool:
        """Whether the task has been done since the step was opened."""
        is_step = 0 <= self.number < len(self.standings)
        return is_step and self.standings[self.number] is Standing.DONE and not self.was_done

    @property
    def place(self) -> str:
        """Where the step is in the lesson."""
        if not 0 <= self.number < len(self.standings):
            return "end" if self.number > 0 else "before"
        before = ", done before" if self.was_done else ""
        return f"{self.number + 1} of {len(self.standings)}{before}"


@dataclass(frozen=True)
class LessonFeedback:
    """What came of a task."""

    sentences: tuple[str, ...]
    is_right: bool | None = None
    """Whether it is done; ``None``: neither right nor wrong."""
