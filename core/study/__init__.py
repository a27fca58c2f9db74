"""The program measures itself: speed against accuracy, stability, and what a scene needs."""

from core.study.families import study_families, study_family
from core.study.machine import machine
from core.study.record import ErrorMeasure, Opening, Pictures, Point, Study, WorkKind, pareto_front
from core.study.speed_accuracy import StudyCancelledError, measure, opening, pictures

__all__ = [
    "ErrorMeasure",
    "Opening",
    "Pictures",
    "Point",
    "Study",
    "StudyCancelledError",
    "WorkKind",
    "machine",
    "measure",
    "opening",
    "pareto_front",
    "pictures",
    "study_families",
    "study_family",
]
