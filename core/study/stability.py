"""Where methods fail: experiments over one or two parameters, each cell the outcome of a real run."""

from core.antialiasing.measured import THIN
from core.clipping import measured as clipping
from core.coverage import measured_pixel, measured_sums, measured_triangles
from core.culling import measured as culling
from core.deformation.measured import COLLAPSE, WRAPPER
from core.depth.measured import BY_DISTANCE, BY_RANGE, ORTHOGRAPHIC
from core.depth.measured_order import CIRCLE, LAYERS
from core.framebuffer.measured import BLENDING
from core.interpolation.measured import AFFINE
from core.lines import measured_clipping
from core.shading.measured import HIGHLIGHT, NORMALS
from core.shading.measured_environment import NEAR
from core.study.cases import Atlas, ExperimentInfo, StabilityMap
from core.study.experiment import Experiment, experiments
from core.study.record import Axis, Outcome, StudyCancelledError, Verdict
from core.study.stress import count_outcomes, stress, study_experiment
from core.textures.measured import MINIFICATION, SHADING_ALIASING

# Experiments on coverage, clipping and lines: which pixels are drawn, against exact arithmetic.


COVERAGE_EXPERIMENTS: tuple[Experiment, ...] = (
    *measured_pixel.EXPERIMENTS,
    *measured_triangles.EXPERIMENTS,
    *measured_sums.DRIFT_EXPERIMENTS,
    *measured_sums.SLOPE_EXPERIMENTS,
    *culling.EXPERIMENTS,
    *clipping.EXPERIMENTS,
    *measured_clipping.EXPERIMENTS,
)
"""In the order in which they are listed."""


# Experiments on what covered pixels show: depth, attributes, textures, shading, blending, order, samples.


FRAGMENT_EXPERIMENTS: tuple[Experiment, ...] = (
    COLLAPSE,
    WRAPPER,
    AFFINE,
    MINIFICATION,
    HIGHLIGHT,
    NORMALS,
    NEAR,
    BY_DISTANCE,
    BY_RANGE,
    ORTHOGRAPHIC,
    CIRCLE,
    LAYERS,
    BLENDING,
    THIN,
    SHADING_ALIASING,
)
"""In the order in which they are listed: that of the pipeline."""


__all__ = [
    "Atlas",
    "Axis",
    "Experiment",
    "ExperimentInfo",
    "Outcome",
    "StabilityMap",
    "StudyCancelledError",
    "Verdict",
    "count_outcomes",
    "experiments",
    "stress",
    "study_experiment",
]

for each in (*COVERAGE_EXPERIMENTS, *FRAGMENT_EXPERIMENTS):
    experiments.add(each)
