"""The program measures itself: speed against accuracy, stability, and what a scene needs."""

from core.study.record import ErrorMeasure, Point, Study, WorkKind, pareto_front

__all__ = ["ErrorMeasure", "Point", "Study", "WorkKind", "pareto_front"]
