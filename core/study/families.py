"""The list of studies: those with work and references of their own, and one for every other family of settings.

A method that is added to the table is a point of its family's study. A family that is added to the settings has a study
by itself; a better one is added here.
"""

from core.antialiasing.measured import ANTIALIASING, SHADING, TEXTURE_FILTER
from core.antialiasing.measured_temporal import TEMPORAL
from core.coverage.measured import COVERAGE, FILL, ORIENTATION, POLYGON_CLIPPING, POLYGON_FILL
from core.culling.measured_occlusion import OCCLUDERS
from core.deformation.measured import SKINNING
from core.depth.measured import DEPTH_STEPS
from core.depth.measured_early import DEPTH_TEST_TIME
from core.depth.measured_order import CLIPPING, CULL, DEPTH, VISIBILITY
from core.framebuffer.measured_presentation import FLUSHING, PRESENTATION
from core.interpolation.measured import INTERPOLATION
from core.lines.measured import LINE
from core.lines.measured_clipping import LINE_CLIPPING
from core.methods import table
from core.settings import families
from core.shading.measured_environment import ENVIRONMENT
from core.shading.measured_shadows import SHADOW
from core.study.bands import BANDS
from core.study.family import StudyFamily
from core.study.whole_picture import PIPELINE, standing_in
from core.tessellation.measured import TESSELLATION
from core.tessellation.measured_dice import DICING
from core.trees.measured import HIERARCHY
from core.visibility.measured_lists import LISTS
from core.visibility.measured_loops import LOOPS

OWN = (
    LINE,
    FILL,
    COVERAGE,
    ORIENTATION,
    LINE_CLIPPING,
    POLYGON_FILL,
    POLYGON_CLIPPING,
    CLIPPING,
    INTERPOLATION,
    TEXTURE_FILTER,
    DEPTH,
    DEPTH_STEPS,
    ANTIALIASING,
    TEMPORAL,
    SHADING,
    SHADOW,
    ENVIRONMENT,
    VISIBILITY,
    LOOPS,
    LISTS,
    CULL,
    DEPTH_TEST_TIME,
    HIERARCHY,
    OCCLUDERS,
    SKINNING,
    PRESENTATION,
    FLUSHING,
    BANDS,
    TESSELLATION,
    DICING,
)
"""Studies with work and references of their own; those whose family is not in the table yet are not shown."""


def study_families() -> tuple[StudyFamily, ...]:
    """Return all studies: the whole pipeline last, before it the families that have no study of their own."""
    own = tuple(family for family in OWN if family.varies[0] in table.families)
    covered = {name for family in OWN for name in family.varies}
    others = tuple(
        standing_in(name) for name in families() if name not in covered and len(table.names(name)) > 1
    )
    return (*own, *others, PIPELINE)


def study_family(name: str) -> StudyFamily:
    """Return one study, or raise ValueError with the names that there are."""
    studies = {family.name: family for family in study_families()}
    if name not in studies:
        raise ValueError(f"family must be one of {', '.join(studies)}, got {name}")
    return studies[name]
