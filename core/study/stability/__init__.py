"""Where methods fail: experiments over one or two parameters, each cell the outcome of a real run."""

from core.study.accuracy.record import Axis, Outcome, Verdict
from core.study.stability.coverage import COVERAGE_EXPERIMENTS
from core.study.stability.experiment import Experiment, experiments
from core.study.stability.fragments import FRAGMENT_EXPERIMENTS
from core.study.stability.record import Atlas, ExperimentInfo, StabilityMap, StressCancelledError
from core.study.stability.stress import count_outcomes, stress, study_experiment

__all__ = [
    "Atlas",
    "Axis",
    "Experiment",
    "ExperimentInfo",
    "Outcome",
    "StabilityMap",
    "StressCancelledError",
    "Verdict",
    "count_outcomes",
    "experiments",
    "stress",
    "study_experiment",
]

for each in (*COVERAGE_EXPERIMENTS, *FRAGMENT_EXPERIMENTS):
    experiments.add(each)
