"""No more than a scene needs: the cheapest methods whose bounded errors stay within a tolerance."""

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

__all__ = ["Decision", "Fact", "Findings", "Outcome", "Plan", "PlanReport", "Tessellation", "Tolerance"]
