"""No more than a scene needs: the cheapest methods whose errors stay within a tolerance.

A plan counts what the scene contains (``findings``), tries cheaper methods in parts of the picture (``trials``),
chooses family by family (``planning``), says why (``reasons``), and is measured (``measuring``).
"""

from core.study.planner.measuring import check_plan, measure_plan, plan_and_check
from core.study.planner.planning import look_at, plan
from core.study.planner.records import (
    Decision,
    Fact,
    Findings,
    Outcome,
    Plan,
    PlanReport,
    Tessellation,
    Tolerance,
)
from core.study.planner.reference_settings import reference_settings

__all__ = [
    "Decision",
    "Fact",
    "Findings",
    "Outcome",
    "Plan",
    "PlanReport",
    "Tessellation",
    "Tolerance",
    "check_plan",
    "look_at",
    "measure_plan",
    "plan",
    "plan_and_check",
    "reference_settings",
]
