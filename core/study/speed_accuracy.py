"""Measure all methods of a family on the same work: time in interleaved rounds, work counts, errors.

Every method first runs once untimed (what it made then is counted and compared), then all take turns: round by round,
each round beginning with another one, with the garbage collector off. A turn is a block of runs, of which the shortest
counts. While methods are not told apart whose times differ, or their order changes, there are more rounds. Of a method
whose runs are slow fewer are timed: it takes part in the first round, and in another one only while all its blocks stay
below `BUDGET` seconds together.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from core.scene import AnyScene
from core.settings import Settings
from core.study.families import study_family
from core.study.family import Assignment, Candidate, StudyFamily, Task, chosen_dials, settings_of, timed_block
from core.study.record import (
    SURE,
    Axis,
    Load,
    Opening,
    Pictures,
    Point,
    Study,
    StudyCancelledError,
    WorkKind,
    is_settled,
    ranks,
)

ROUNDS = 9
GROWTH_ROUNDS = 3
MOST_TIMES = 4
"""So many times the rounds asked for are measured at most, until the order is stable."""
BUDGET = 2.0
"""Seconds of timed blocks of one method."""

Progress = Callable[[float, str], None]


@dataclass(eq=False)
class _Turn:
    """One method while it is measured."""

    candidate: Candidate
    settings: Settings
    point: Point
    last: float = 0.0
    """Seconds of the run, or block, before."""
    spent: float = 0.0
    """Seconds of all blocks."""
    seconds: list[float] = field(default_factory=list)

    def takes_part(self) -> bool:
        """Whether another run fits the method's time."""
        if self.point.refused:
            return False
        return not self.seconds or self.spent + self.last <= BUDGET

    def add(self, spent: float, least: float) -> None:
        """Count a block, and add its shortest run to the point."""
        self.last, self.spent = spent, self.spent + spent
        self.seconds.append(least)
        self.point = replace(self.point, seconds=np.array(self.seconds))


@dataclass(frozen=True, eq=False)
class _Watch:
    """Who is told what is done, and asked whether to go on."""

    progress: Progress | None
    is_cancelled: Callable[[], bool] | None
    point_done: Callable[[Point], None] | None
    run_count: int
    done: list[str] = field(default_factory=list)
    """What has been run."""
    load: Load = field(default_factory=Load)

    def next(self, doing: str, is_extra: bool = False) -> None:
        """Say what is run next, beyond the plan if it is extra; raise StudyCancelledError if nobody wants it."""
        if self.is_cancelled is not None and self.is_cancelled():
            raise StudyCancelledError("The measurement was cancelled.")
        if self.progress is not None:
            self.progress(min(len(self.done) / max(self.run_count, 1), 1.0), doing)
        if not is_extra:
            self.done.append(doing)

    def show(self, point: Point) -> None:
        """Hand on a point."""
        if self.point_done is not None:
            self.point_done(point)


def measure(
    family: str,
    work: str | None = None,
    dials: Mapping[str, float] | None = None,
    *,
    scene: AnyScene | None = None,
    settings: Settings | None = None,
    scene_title: str = "",
    extra: tuple[Candidate, ...] = (),
    rounds: int = ROUNDS,
    grow: bool = True,
    seed: int = 0,
    machine: Mapping[str, str] | None = None,
    progress: Progress | None = None,
    is_cancelled: Callable[[], bool] | None = None,
    point_done: Callable[[Point], None] | None = None,
) -> Study:
    """Measure all methods of a family.

    Parameters
    ----------
    family : str
        A name of ``study_families()``.
    work : str, optional
        A name of the family's works; the first by default.
    dials : mapping of str to float, optional
        Values of the work's dials; those that are left out have their defaults.
    scene, settings, scene_title : optional
        What is measured on, by the family ``pipeline``: the scene, the settings that each point changes one of, and
        what the scene is called.
    extra : tuple of Candidate
        Settings that are measured along with the family's own, as the choice of a plan.
    rounds : int
        Timed blocks of every method, fewer of slow ones; from `core.study.record.SURE` on up to `MOST_TIMES`
        as many, until the order is stable.
    grow : bool
        Measure, with three rounds and without errors, at all values of the cost dial too. A method whose run takes more
        than `BUDGET` seconds, or that is refused, is left out at larger values.
    seed : int
        Of the random numbers that the work is made from.
    machine : mapping of str to str, optional
        Kept in the study, see `core.study.record.machine`; how busy it was is added.
    progress : callable, optional
        Called before every run with the fraction done and what is being done.
    is_cancelled : callable, optional
        Asked before every run.
    point_done : callable, optional
        Called with a point whenever it has been measured anew: once a round, and once for a method that is refused.

    Raises
    ------
    ValueError
        For a family, work, dial or number of rounds that there is not.
    StudyCancelledError
        If ``is_cancelled()``.

    Notes
    -----
    A method that refuses the work (ValueError) or lacks memory is a point with a sentence and without numbers.
    """
    if rounds < 1:
        raise ValueError(f"rounds must be at least 1, got {rounds}")
    found = study_family(family)
    if (scene is not None or settings is not None) and not found.takes_scene:
        raise ValueError(f"{family} makes its own scene: scene and settings must not be given")
    kind = found.work(work)
    base = found.base if settings is None else settings
    assignment = Assignment(kind.name, chosen_dials(kind, dials), seed, base, scene)
    candidates = (*found.candidates(base), *extra)
    dial = cost_dial(kind) if grow else None
    others = [value for value in dial.values if value != assignment.dials[dial.name]] if dial else []
    watch = _Watch(
        progress, is_cancelled, point_done, len(candidates) * (1 + rounds + len(others) * (1 + GROWTH_ROUNDS))
    )
    points = _measure_points(found, assignment, candidates, rounds, watch)
    growth = {} if dial is None else {assignment.dials[dial.name]: points}
    for value in others:
        assert dial is not None
        elsewhere = replace(assignment, dials={**assignment.dials, dial.name: value})
        fit = tuple(each for each in candidates if not _is_too_slow(each, growth, value))
        growth[value] = _measure_points(
            found, elsewhere, fit, GROWTH_ROUNDS, replace(watch, point_done=None), dial
        )
    return Study(
        family=found.name,
        title=found.title,
        work=kind,
        dials=assignment.dials,
        seed=seed,
        measures=found.measures,
        points=points,
        growth=dict(sorted(growth.items())),
        machine=dict(machine or {}) | {"load": watch.load.sentence()},
        settings=base,
        scene=scene_title,
    )


def cost_dial(work: WorkKind) -> Axis | None:
    """Return the dial that cost grows with, if the work has one."""
    return next((dial for dial in work.dials if dial.is_cost), None)


def _is_too_slow(candidate: Candidate, growth: Mapping[float, tuple[Point, ...]], value: float) -> bool:
    """Return whether one run took longer than `BUDGET` on less work, or could not be done: then more is not tried."""
    return any(
        point.method == candidate.method and (bool(point.refused) or float(point.seconds.min()) > BUDGET)
        for less, points in growth.items()
        if less < value
        for point in points
    )


def _measure_points(
    family: StudyFamily,
    assignment: Assignment,
    candidates: tuple[Candidate, ...],
    rounds: int,
    watch: _Watch,
    grown: Axis | None = None,
) -> tuple[Point, ...]:
    """Measure all candidates on one work; with ``grown``, the dial that was turned, leave the errors out."""
    where = "" if grown is None else f", {grown.title.lower()} {assignment.dials[grown.name]:g}"
    watch.next(f"Preparing {family.title.lower()}{where}")
    task = family.make(assignment)
    turns = []
    for candidate in candidates:
        watch.next(f"{candidate.title}{where}")
        turn = _first_run(task, assignment.settings, candidate, with_errors=grown is None)
        if turn.point.refused:
            watch.show(turn.point)
        turns.append(turn)
    order: dict[str, tuple[int, int]] = {}
    for number in range(rounds * MOST_TIMES):
        first = number % max(len(turns), 1)
        for turn in turns[first:] + turns[:first]:
            if turn.takes_part():
                of = f"{rounds}" if number < rounds else f"at most {rounds * MOST_TIMES}"
                watch.next(f"{turn.candidate.title}{where}, round {number + 1} of {of}", number >= rounds)
                turn.add(*timed_block(task, turn.settings, watch.load))
                watch.show(turn.point)
        if number + 2 < rounds:
            continue
        points = [turn.point for turn in turns]
        before, order = order, ranks(points)
        is_stable = order == before and is_settled(points)
        is_spent = rounds < SURE or not any(turn.takes_part() for turn in turns)
        if number + 1 >= rounds and (is_stable or is_spent):
            break
    return tuple(turn.point for turn in turns)


def _first_run(task: Task, base: Settings, candidate: Candidate, with_errors: bool) -> _Turn:
    """Run a method once, untimed, and look at what it made; or say why it cannot be run."""
    point = Point(candidate.method, candidate.title, unit_count=task.unit_count)
    settings = settings_of(base, candidate.method)
    try:
        start = perf_counter()
        made = task.start(settings)()
        last = perf_counter() - start
        counts = task.counts(settings, made)
        found = task.judge(settings, made).errors if with_errors else {}
    except (ValueError, MemoryError) as problem:
        return _Turn(candidate, settings, replace(point, refused=_sentence(problem)))
    reasons = {name: value for name, value in found.items() if isinstance(value, str)}
    errors = {name: np.nan if isinstance(value, str) else value for name, value in found.items()}
    return _Turn(candidate, settings, replace(point, counts=counts, errors=errors, reasons=reasons), last)


def _sentence(problem: Exception) -> str:
    """Return why a method could not be run, as a sentence."""
    text = " ".join(str(problem).split()) or "there is not enough memory for this work"
    text = text[:1].upper() + text[1:]
    return text if text.endswith((".", "!", "?")) else f"{text}."


def pictures(study: Study, point: Point, scene: AnyScene | None = None) -> Pictures:
    """Draw what one method made of the study's work, and the reference, (H, W) or (H, W, 4) pictures.

    Parameters
    ----------
    point : Point
        One of the study's, not refused.
    scene : Scene or ClipScene, optional
        What was measured on, where the family takes a scene.

    Raises
    ------
    ValueError
        For a point that was refused.
    """
    task, settings = _again(study, point, scene)
    return task.pictures(settings, task.start(settings)())


def opening(study: Study, point: Point, scene: AnyScene | None = None) -> Opening | None:
    """Return what opens in the stepper to look at one method's run; arguments as for `pictures`."""
    task, settings = _again(study, point, scene)
    return task.opening(settings, task.start(settings)())


def _again(study: Study, point: Point, scene: AnyScene | None) -> tuple[Task, Settings]:
    """Make the work of a study once more: it is the same, as it is made from its seed."""
    if point.refused:
        raise ValueError(f"{point.title} was refused: {point.refused}")
    family = study_family(study.family)
    assignment = Assignment(study.work.name, study.dials, study.seed, study.settings, scene)
    return family.make(assignment), settings_of(study.settings, point.method)
