"""The program measures itself: speed against accuracy, stability, and what a scene needs."""

from typing import TYPE_CHECKING

from core.lazy_import import import_on_demand

if TYPE_CHECKING:
    from core.study.families import study_families, study_family
    from core.study.planner import (
        Decision,
        Findings,
        Plan,
        PlanReport,
        Tolerance,
        check_plan,
        look_at,
        measure_plan,
        plan,
        plan_and_check,
        reference_settings,
    )
    from core.study.record import (
        BestValue,
        ErrorMeasure,
        Opening,
        Pictures,
        Point,
        Study,
        StudyCancelledError,
        WorkKind,
        best_values,
        machine,
        pareto_front,
    )
    from core.study.speed_accuracy import measure, opening, pictures
else:
    # What measures a topic imports from here, and stands in the list of all studies: neither waits for the other.
    places = {
        "core.study.families": "study_families study_family",
        "core.study.planner": "Decision Findings Plan PlanReport Tolerance check_plan look_at measure_plan plan"
        " plan_and_check reference_settings",
        "core.study.record": "BestValue ErrorMeasure Opening Pictures Point Study StudyCancelledError WorkKind"
        " best_values machine pareto_front",
        "core.study.speed_accuracy": "measure opening pictures",
    }
    __getattr__ = import_on_demand(
        globals(), **{name: place for place, names in places.items() for name in names.split()}
    )

__all__ = [
    "BestValue",
    "Decision",
    "ErrorMeasure",
    "Findings",
    "Opening",
    "Pictures",
    "Plan",
    "PlanReport",
    "Point",
    "Study",
    "StudyCancelledError",
    "Tolerance",
    "WorkKind",
    "best_values",
    "check_plan",
    "look_at",
    "machine",
    "measure",
    "measure_plan",
    "opening",
    "pareto_front",
    "pictures",
    "plan",
    "plan_and_check",
    "reference_settings",
    "study_families",
    "study_family",
]
