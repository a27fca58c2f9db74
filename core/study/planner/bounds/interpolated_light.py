"""How far light is off where what it is made of is interpolated in a cheaper way.

Light of vertices is a value like any other. Light of interpolated normals is off by less than its slope times what the
normals and the ways to the lights and the eye turn by, see ``light_changes``.
"""

import numpy as np

from core.records.arrays import Floats
from core.scene import Scene
from core.study.planner.bounds.bytes import times
from core.study.planner.bounds.light_changes import LightError, moved_light_error
from core.study.planner.bounds.lit_patches import lit_primitives, lit_triangles
from core.study.planner.bounds.shading_bounds import spread_of
from core.study.planner.scene_analysis.conservative_coverage import Touched


def interpolated_light_error(touched: Touched, scene: Scene, share: Floats, shading: str) -> LightError:
    """Return how far diffuse and specular light are off.

    Parameters
    ----------
    touched : Touched
    scene : Scene
    share : (P,) float64
        By what part of their range attributes are off; infinite: by anything.
    shading : str
    """
    if shading == "flat":
        return LightError(*np.zeros((2, len(share), 3)))
    part = share[:, None]
    if shading == "gouraud":
        return LightError(*(times(part, each) for each in spread_of(lit_triangles(touched, scene), scene)))
    patches = lit_primitives(touched, scene)
    moved, (diffuse, specular) = moved_light_error(patches, scene, share), spread_of(patches, scene)
    # Places that are off by nothing are lit alike; where they are off by anything, it need not be in the triangle.
    inner = LightError(np.minimum(moved.diffuse, diffuse), np.minimum(moved.specular, specular))
    return LightError(*(_limited(part, each) for each in (inner.diffuse, inner.specular)))


def _limited(part: Floats, error: Floats) -> Floats:
    return np.where(part == 0, 0.0, np.where(np.isinf(part), np.inf, error))
