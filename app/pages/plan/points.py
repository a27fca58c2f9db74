"""A plan among the points of its scene's study: its settings as candidates, and which points are its choice."""

from core.settings import Settings
from core.study import Plan, Study
from core.study.accuracy.family import Candidate, settings_of

CHOICE, EVERYTHING = "What the scene needs", "Everything on"


def plan_candidates(plan: Plan, base: Settings, others: tuple[Candidate, ...]) -> tuple[Candidate, ...]:
    """Return what a plan chose, and everything on, as points of a study, unless they are among the ``others`` already.

    The other points change ``base`` in one setting, or not at all: once a plan is applied it is the scene as it is.
    """
    taken = {other.method for other in others}
    found = []
    for settings, title in ((plan.settings, CHOICE), (plan.everything, EVERYTHING)):
        method = _method(settings, base)
        if method not in taken:
            taken.add(method)
            found.append(Candidate(method, title))
    return tuple(found)


def _method(settings: Settings, base: Settings) -> str:
    """Return settings as the method of a point: what differs from ``base``, or one setting as it is."""
    changed = [name for name in vars(settings) if getattr(settings, name) != getattr(base, name)]
    return " ".join(f"{name}={getattr(settings, name)}" for name in changed or ["fill"])


def chosen_points(study: Study, plan: Plan | None) -> tuple[str, ...]:
    """Return the methods of a study that draw with the very settings that a plan chose."""
    if plan is None:
        return ()
    return tuple(
        point.method
        for point in study.points
        if point.is_measured and settings_of(study.settings, point.method) == plan.settings
    )
