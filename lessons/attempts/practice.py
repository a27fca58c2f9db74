"""Practice: which question comes next, from what was missed and how long ago."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from hashlib import sha256
from itertools import combinations, count, islice

from lessons.attempts.record import Attempt
from lessons.exercises.draws import SEED_LIMIT
from lessons.exercises.question import Question, Template, ask

VARIANTS_IN_TURN = 3
"""Most variants of a template one after the other, while they are missed."""
TRY_LIMIT = 8
"""Most seeds that are tried until two mistakes give different answers, or until a question can be drawn."""


CORRECTION = timedelta(minutes=10)
"""An answer to the same question within this time after another one corrects it, with the marks in sight."""


@dataclass(frozen=True, eq=False)
class Choice:
    """What comes next."""

    question: Question
    reason: str
    """Why, in a sentence."""


def next_question(
    attempts: Sequence[Attempt], templates: Mapping[str, Template], user: str, now: datetime
) -> Choice | None:
    """Choose the next question of a user; ``None`` where no template can draw one.

    Parameters
    ----------
    attempts : sequence of Attempt
        Those of the user, in the order of time.
    templates : mapping
        By name, in the order in which new ones are asked.
    user : str
        The same user, attempts and time always get the same question.
    now : datetime
        In UTC.

    Notes
    -----
    A new variant of what was just missed comes first; if several mistakes gave the wrong answer, one that tells them
    apart. Then comes what is due by FSRS, the most forgotten first, then what is new, then what is due next.
    """
    known = [attempt for attempt in attempts if attempt.template in templates]
    tries = first_tries(known)
    again = _missed_last(tries, templates)
    if again is not None:
        told = telling_apart(again.mistakes, _tries(known, templates, again, user))
        if told is not None:
            names = " and ".join(again.mistakes)
            return Choice(told, f"The last answer can come from {names}: this question tells them apart.")
    for template, reason in _in_turn(tries, templates, again, now):
        for seed in _fresh_seeds(known, template, user):
            try:
                return Choice(ask(template, seed), reason)
            except ValueError:
                continue  # A teacher's ranges may leave a seed without a question.
    return None


def _missed_last(attempts: Sequence[Attempt], templates: Mapping[str, Template]) -> Attempt | None:
    """Return the last attempt if a new variant of it should follow."""
    if not attempts or attempts[-1].score == 1:
        return None
    last = attempts[-1]
    turn = [
        attempt.template == last.template and attempt.score < 1 for attempt in attempts[-VARIANTS_IN_TURN:]
    ]
    has_enough = len(turn) == VARIANTS_IN_TURN and all(turn)
    return None if has_enough or templates[last.template].is_fixed else last


def _in_turn(
    attempts: Sequence[Attempt], templates: Mapping[str, Template], again: Attempt | None, now: datetime
) -> Iterator[tuple[Template, str]]:
    """Yield all templates, the most urgent first, each with the reason."""
    if again is not None:
        yield templates[again.template], "A new variant of what was just missed."
    known = recall(attempts, now)
    last = {attempt.template: attempt.at for attempt in attempts}
    later = {name: day for name, (_, day) in known.items() if day > now}
    for name, template in templates.items():
        # The same question again at once would be a correction.
        if template.is_fixed and name in known and now < last[name] + CORRECTION:
            later[name] = last[name] + CORRECTION
    for name in sorted((name for name in known if name not in later), key=known.__getitem__):
        yield templates[name], "It was asked some time ago: do you still know it?"
    for name, template in templates.items():
        if name not in known:
            yield template, "This one is new."
    for name in sorted(later, key=later.__getitem__):
        yield templates[name], "Nothing is due yet: this one is due first."


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
    return {name: (scheduler.get_card_retrievability(card, now), card.due) for name, card in cards.items()}


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

    @property
    def points(self) -> float:
        """Sum of the best points."""
        return sum(self.best.values())


def progress(attempts: Sequence[Attempt]) -> Progress:
    """Return what a user has reached, from the attempts of this user; corrections do not count."""
    made: dict[tuple[str, str], int] = defaultdict(int)
    asked: dict[tuple[str, str], int] = defaultdict(int)
    best: dict[str, float] = {}
    correct: dict[str, int] = defaultdict(int)
    tried: dict[str, int] = defaultdict(int)
    for attempt in first_tries(attempts):
        for mistake in attempt.asked:
            asked[attempt.stage, mistake] += 1
            made[attempt.stage, mistake] += mistake in attempt.mistakes
        best[attempt.template] = max(best.get(attempt.template, 0), attempt.points)
        correct[attempt.template] += attempt.score == 1
        tried[attempt.template] += 1
    counts = tuple(MistakeCount(*place, made[place], number) for place, number in asked.items())
    return Progress(counts, best, dict(correct), dict(tried))
