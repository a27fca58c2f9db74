"""Experiments on coverage, clipping and lines: which pixels are drawn, against exact arithmetic."""

from core.study.stability.coverage import (
    clipping,
    drift,
    facing,
    inverse_slopes,
    line_clippers,
    meshes,
    number_formats,
    precision_dial,
)
from core.study.stability.experiment import Experiment

COVERAGE_EXPERIMENTS: tuple[Experiment, ...] = (
    *precision_dial.EXPERIMENTS,
    *number_formats.EXPERIMENTS,
    *meshes.EXPERIMENTS,
    *drift.EXPERIMENTS,
    *inverse_slopes.EXPERIMENTS,
    *facing.EXPERIMENTS,
    *clipping.EXPERIMENTS,
    *line_clippers.EXPERIMENTS,
)
"""In the order in which they are listed."""
