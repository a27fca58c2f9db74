"""The program measures itself: speed against accuracy, stability, and what a scene needs."""

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
    WorkKind,
    best_values,
    machine,
    pareto_front,
)
from core.study.speed_accuracy import StudyCancelledError, measure, opening, pictures

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
