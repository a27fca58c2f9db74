"""Every method of a study run once without a clock: its work counts and its errors."""

from collections.abc import Container, Mapping
from typing import NamedTuple

from core.study.families import study_family
from core.study.family import Assignment, chosen_dials, settings_of


class Found(NamedTuple):
    counts: Mapping[str, int]
    errors: Mapping[str, float | str]


def run(
    family: str, work: str = "", seed: int = 0, only: Container[str] | None = None, **dials: float
) -> dict[str, Found]:
    """Run every method of a family, or ``only`` some, once without a clock; by the method's name."""
    study = study_family(family)
    kind = study.work(work or None)
    task = study.make(Assignment(kind.name, chosen_dials(kind, dials), seed, study.base))
    found = {}
    for candidate in study.candidates(study.base):
        if only is not None and candidate.method not in only:
            continue
        settings = settings_of(study.base, candidate.method)
        made = task.start(settings)()
        name = candidate.method.removeprefix(f"{study.varies[0]}=") if study.varies else candidate.method
        found[name] = Found(task.counts(settings, made), task.judge(settings, made).errors)
    return found
