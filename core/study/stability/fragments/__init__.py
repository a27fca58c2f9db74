"""Experiments on what covered pixels show: depth, attributes, textures, shading, blending, order, samples."""

from core.study.stability.experiment import Experiment
from core.study.stability.fragments.affine import AFFINE
from core.study.stability.fragments.blending_order import BLENDING
from core.study.stability.fragments.depth_gaps import BY_DISTANCE, BY_RANGE, ORTHOGRAPHIC
from core.study.stability.fragments.drawing_order import CIRCLE, LAYERS
from core.study.stability.fragments.highlights import HIGHLIGHT
from core.study.stability.fragments.opposite_normals import NORMALS
from core.study.stability.fragments.texels import MINIFICATION, SHADING_ALIASING
from core.study.stability.fragments.thin_triangles import THIN

FRAGMENT_EXPERIMENTS: tuple[Experiment, ...] = (
    AFFINE,
    MINIFICATION,
    HIGHLIGHT,
    NORMALS,
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
