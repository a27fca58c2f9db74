"""Practice: which question comes next, from what was missed and how long ago."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from hashlib import sha256
from itertools import combinations, count, islice

from lessons.attempts.record import NOT_CHECKED, Attempt, is_of_lesson
from lessons.exercises.numbers import SEED_LIMIT
from lessons.exercises.question import Question, Template, ask

MISSES_IN_A_ROW = 3
"""After so many misses of a template in a row it is explained, and not asked again on that day."""
QUESTIONS_OF_A_REPEAT = 3
"""At most one in so many questions of a day repeats what was asked on that day already, or was missed last."""
TRY_LIMIT = 8
"""Most seeds that are tried until two mistakes give different answers, or until a question can be drawn."""
KNOWN_STILL = "It was asked some time ago: do you still know it?"
DUE_FIRST = "Nothing is due yet: this one is due first."
CORRECTION = timedelta(minutes=10)
"""An answer to the same question within this time after another one corrects it, with the marks in sight."""


@dataclass(frozen=True, eq=False)
class Choice:
    """What comes next."""

    question: Question
    reason: str
    """Why, in a sentence."""
    explained: Attempt | None = None
    """The last answer, where its exercise was missed so often that it should be explained first."""


def next_question(
    attempts: Sequence[Attempt], templates: Mapping[str, Template], user: str, now: datetime
) -> Choice | None:
    """Choose the next question of a user; ``None`` where no template can draw one.

    Parameters
    ----------
    attempts : sequence of Attempt
        Those of the user, in the order of time; what is dated later than now does not count. Steps of lessons are never
        asked again, but the mistakes that were made in them are.
    templates : mapping
        By name, in the order in which new ones are asked.
    user : str
        The same user, attempts and time always get the same question.
    now : datetime
        With its zone: a day is one of that zone.

    Notes
    -----
    At most one in ``QUESTIONS_OF_A_REPEAT`` questions of a day repeats, while there are others: first a variant of what
    was missed today, then what is due by FSRS. The others are what is due and was right, the most forgotten first,
    then what is new, then what is due next. If several mistakes gave a wrong answer, a question tells them apart.
    """
    known = [attempt for attempt in attempts if attempt.template in templates and attempt.at <= now]
    tries = first_tries(known)
    day = _Day(tries, now)
    explained = (
        tries[-1] if tries and tries[-1].at >= day.begin and day.is_enough(tries[-1].template) else None
    )
    missed = [] if explained is not None else [name for name in day.missed if not templates[name].is_fixed]
    if missed:
        last = day.last[missed[0]]
        allowed = [
            one
            for one in _tries(known, templates, last, user)
            if not day.repeats(one[0].name) or day.may_repeat
        ]
        told = telling_apart(last.mistakes, allowed)
        if told is not None:
            names = " and ".join(last.mistakes)
            return Choice(told, f"An answer of today can come from {names}: this question tells them apart.")
    brought = _brought_back([attempt for attempt in attempts if attempt.at <= now], templates, user)
    if brought is not None and explained is None:
        return brought
    for template, reason in _in_turn(day, templates, now):
        for seed in _fresh_seeds(known, template, user):
            try:
                return Choice(ask(template, seed), reason, explained)
            except ValueError:
                continue  # A teacher's ranges may leave a seed without a question.
    return None


def _brought_back(attempts: Sequence[Attempt], templates: Mapping[str, Template], user: str) -> Choice | None:
    """Return a question that shows a mistake made in a lesson, the latest first, if none has since shown it."""
    shown: set[str] = set()
    for attempt in reversed(attempts):
        if not is_of_lesson(attempt):
            shown.update(attempt.asked)
            continue
        for mistake in attempt.mistakes:
            if mistake in shown:
                continue
            shown.add(mistake)
            question = _showing(mistake, attempt.stage, attempts, templates, user)
            if question is not None:
                said = mistake.replace("-", " ")
                return Choice(question, f"In a lesson an answer came from this mistake: {said}.")
    return None


def _showing(
    mistake: str, stage: str, attempts: Sequence[Attempt], templates: Mapping[str, Template], user: str
) -> Question | None:
    """Return a question of a stage in which a mistake shows; ``None``: none of its templates has one."""
    for template in templates.values():
        if template.stage != stage:
            continue
        for seed in islice(_fresh_seeds(attempts, template, user), 1):
            try:
                question = ask(template, seed)
            except ValueError:
                continue
            if mistake in question.draft.mistakes:
                return question
    return None


class _Day:
    """What was asked today, and before."""

    def __init__(self, tries: Sequence[Attempt], now: datetime) -> None:
        self.begin = now.replace(hour=0, minute=0, second=0, microsecond=0)
        self.last: dict[str, Attempt] = {}
        """By template."""
        self.recall = recall(tries, now)
        count = repeated = 0
        for attempt in tries:
            if attempt.at >= self.begin:
                count += 1
                repeated += self.repeats(attempt.template)
            self.last[attempt.template] = attempt
        self.may_repeat = QUESTIONS_OF_A_REPEAT * (repeated + 1) <= count + 1
        self._misses = misses_in_a_row(tries)
        self.missed = [
            name
            for name, attempt in sorted(self.last.items(), key=lambda item: item[1].at, reverse=True)
            if attempt.at >= self.begin and attempt.score < 1 and not self.is_enough(name)
        ]
        """Templates that were missed last today, the latest first; without those that are to be explained."""

    def repeats(self, name: str) -> bool:
        """Return whether a template was asked today already, or was missed when it was asked last."""
        last = self.last.get(name)
        return last is not None and (last.at >= self.begin or last.score < 1)

    def is_enough(self, name: str) -> bool:
        """Return whether a template was asked today, and missed too often in a row to be asked again."""
        return self._misses[name] >= MISSES_IN_A_ROW and self.last[name].at >= self.begin


def misses_in_a_row(attempts: Sequence[Attempt]) -> Counter[str]:
    """Return by template how often it was missed since it was last right, from first tries."""
    misses: Counter[str] = Counter()
    for attempt in attempts:
        misses[attempt.template] = 0 if attempt.score == 1 else misses[attempt.template] + 1
    return misses


def _in_turn(day: _Day, templates: Mapping[str, Template], now: datetime) -> Iterator[tuple[Template, str]]:
    """Yield all templates, the most urgent first, each with the reason."""
    due_at = {name: due for name, (_, due) in day.recall.items()}
    for name, template in templates.items():
        # The same question again at once would be a correction.
        if template.is_fixed and name in due_at and now < day.last[name].at + CORRECTION:
            due_at[name] = max(due_at[name], day.last[name].at + CORRECTION)
    due = sorted((name for name in due_at if due_at[name] <= now), key=day.recall.__getitem__)
    later = sorted((name for name in due_at if due_at[name] > now), key=due_at.__getitem__)
    if day.may_repeat:
        for name in day.missed:
            if not templates[name].is_fixed:
                yield templates[name], "A new variant of what was missed today."
        for name in due:
            if day.repeats(name) and not day.is_enough(name):
                yield templates[name], KNOWN_STILL
    for name in due:
        if not day.repeats(name):
            yield templates[name], KNOWN_STILL
    for name, template in templates.items():
        if name not in due_at:
            yield template, "This one is new."
    for name in later:
        if not day.repeats(name):
            yield templates[name], DUE_FIRST
    # Nothing but repeats is left.
    for name in sorted((*due, *later), key=lambda name: (day.is_enough(name), due_at[name])):
        yield templates[name], KNOWN_STILL if name in due else DUE_FIRST


def first_tries(attempts: Sequence[Attempt]) -> list[Attempt]:
    """Return attempts (in the order of time) without those that correct an answer just given to the same question."""
    last: dict[tuple[str, int, int], datetime] = {}
    firsts = []
    for attempt in attempts:
        question = (attempt.template, attempt.version, attempt.seed)
        if question not in last or attempt.at - last[question] >= CORRECTION:
            firsts.append(attempt)
        last[question] = attempt.at
    return firsts


def is_correction(attempts: Iterable[Attempt], attempt: Attempt) -> bool:
    """Return whether an attempt corrects one of earlier ``attempts``, so that `first_tries` leaves it out."""
    question = (attempt.template, attempt.version, attempt.seed)
    return any(
        (each.template, each.version, each.seed) == question and attempt.at - each.at < CORRECTION
        for each in attempts
    )


def recall(attempts: Sequence[Attempt], now: datetime) -> dict[str, tuple[float, datetime]]:
    """Return by template how likely it is still known, 0 to 1, and when it is due, from first tries.

    References
    ----------
    Ye, Su, Cao: A Stochastic Shortest Path Algorithm for Optimizing Spaced Repetition Scheduling (KDD 2022); the
    library is py-fsrs.
    """
    from fsrs import Card, Rating, Scheduler  # Not before somebody practises.

    scheduler = Scheduler(enable_fuzzing=False)
    cards: dict[str, Card] = {}
    for attempt in attempts:
        rating = Rating.Good if attempt.score == 1 else Rating.Hard if attempt.is_slip else Rating.Again
        card = cards.get(attempt.template) or Card(card_id=0, due=attempt.at)
        cards[attempt.template], _ = scheduler.review_card(card, rating, attempt.at)
    at = now.astimezone(UTC)  # FSRS takes no other zone.
    return {name: (scheduler.get_card_retrievability(card, at), card.due) for name, card in cards.items()}


def _fresh_seeds(attempts: Sequence[Attempt], template: Template, user: str) -> Iterator[int]:
    """Return seeds of a template that this user has not had, a few."""
    used = {attempt.seed for attempt in attempts if attempt.template == template.name}
    texts = (f"{user} {template.name} {number}" for number in count(len(used)))
    seeds = (int.from_bytes(sha256(text.encode()).digest()[:8], "big") % SEED_LIMIT for text in texts)
    return islice((seed for seed in seeds if seed not in used), TRY_LIMIT)


def _tries(
    attempts: Sequence[Attempt], templates: Mapping[str, Template], missed: Attempt, user: str
) -> list[tuple[Template, int]]:
    """Return what may tell the mistakes of an attempt apart: variants, then others of the stage."""
    own = templates[missed.template]
    others = [each for each in templates.values() if each.stage == own.stage and each is not own]
    tries = [(own, seed) for seed in _fresh_seeds(attempts, own, user)]
    tries += [(other, next(_fresh_seeds(attempts, other, user))) for other in others]
    return tries


def telling_apart(mistakes: Sequence[str], tries: Iterable[tuple[Template, int]]) -> Question | None:
    """Return the first question of templates and seeds in which several mistakes give different answers, if any."""
    if len(mistakes) < 2:
        return None
    for template, seed in tries:
        if any(set(mistakes) <= alike for alike in template.alike):
            continue
        try:
            question = ask(template, seed)
        except ValueError:
            continue
        draft = question.draft
        if set(mistakes) <= set(draft.mistakes) and not any(
            draft.answer.is_same(draft.mistakes[one], draft.mistakes[other])
            for one, other in combinations(mistakes, 2)
        ):
            return question
    return None


@dataclass(frozen=True)
class MistakeCount:
    """How often a mistake was made."""

    stage: str
    mistake: str
    made: int
    asked: int
    """Answers to questions that show it."""


@dataclass(frozen=True)
class Progress:
    """What a user has reached."""

    mistakes: tuple[MistakeCount, ...]
    """In the order in which they were first asked."""
    best: Mapping[str, float]
    """Most points ever earned, by template: they never fall."""
    correct: Mapping[str, int]
    """Answers that were all right, by template."""
    tried: Mapping[str, int]
    """All answers, by template."""
    unchecked: float = 0.0
    """Points among the best that come from another file, and could not be checked."""

    @property
    def points(self) -> float:
        """Sum of the best points."""
        return sum(self.best.values())

    @property
    def points_text(self) -> str:
        """The points in words, with those that are not checked."""
        unsure = f", {self.unchecked:.3g} of them {NOT_CHECKED}" if self.unchecked else ""
        return f"{self.points:.3g} points{unsure}"


def progress(attempts: Sequence[Attempt]) -> Progress:
    """Return what a user has reached, from the attempts of this user; corrections do not count.

    Of lessons only the mistakes count: they earn no points.
    """
    made: dict[tuple[str, str], int] = defaultdict(int)
    asked: dict[tuple[str, str], int] = defaultdict(int)
    best: dict[str, float] = {}
    correct: dict[str, int] = defaultdict(int)
    tried: dict[str, int] = defaultdict(int)
    sure: dict[str, float] = {}
    for attempt in first_tries(attempts):
        for mistake in attempt.asked:
            asked[attempt.stage, mistake] += 1
            made[attempt.stage, mistake] += mistake in attempt.mistakes
        if is_of_lesson(attempt):
            continue
        best[attempt.template] = max(best.get(attempt.template, 0), attempt.points)
        if attempt.is_checked:
            sure[attempt.template] = max(sure.get(attempt.template, 0), attempt.points)
        correct[attempt.template] += attempt.score == 1
        tried[attempt.template] += 1
    counts = tuple(MistakeCount(*place, made[place], number) for place, number in asked.items())
    unchecked = sum(best.values()) - sum(sure.values())
    return Progress(counts, best, dict(correct), dict(tried), unchecked)
