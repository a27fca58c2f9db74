"""The core of Rasterscope: the rasterization pipeline in pure NumPy, every stage a function with a record.

Notation and conventions, for the whole core (tested in tests/core/test_conventions.py)
---------------------------------------------------------------------------------------
* N vertices, T triangles, P primitives (triangles and pieces made by clipping), F fragments, H x W raster.
* Vectors are columns, ``p' = D P C^-1 M p``. Right-handed; the camera looks along -z; w > 0 is in front of the eye;
  NDC is [-1, 1]^3, window depth [0, 1]; angles are radians.
* The window is y-up: array row 0 is the bottom row; pixel (column i, row j) has its centre at (i + 1/2, j + 1/2).
* The suffix of a position is its space: object, world, camera, clip, ndc, window; ``homogeneous``: D clip = (x, y, w).
* Coverage is decided per edge on corners snapped to 1/256 pixel; a centre on an edge belongs to the triangle that
  contains the point moved an infinitesimal step right, then up. Attributes and depth come from unsnapped corners.
* Counter-clockwise is the front. The nearer fragment wins; a tie keeps what is there.
* Colours are linear in the core, sRGB only for display and in files; alpha is straight in inputs.
"""

from core.antialiased import centers, exact_area, multisampling, supersampling  # noqa: F401  (they register)
from core.fragments import corrected_affine  # noqa: F401  (it registers)
from core.frame import STAGES, Frame
from core.framebuffer import depth_formats  # noqa: F401  (it registers)
from core.geometry.line_clip_records import ClippedLines
from core.geometry.line_clipping import clip_lines
from core.picture import Picture, draw_picture
from core.pipeline import draw_triangles, render
from core.raster import (  # noqa: F401  (they register)
    fill_rule,
    fills,
    number_formats,
    scanline,
    scanline_lecture,
    wireframe,
)
from core.raster.lines import draw_lines
from core.raster.spans import fill  # noqa: F401
from core.scene import (
    Camera,
    ClipScene,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    Texture,
)
from core.settings import Settings
from core.trace import Trace, trace

__all__ = [
    "STAGES",
    "Camera",
    "ClipScene",
    "ClippedLines",
    "DirectionalLight",
    "Frame",
    "Material",
    "Mesh",
    "Picture",
    "PointLight",
    "Scene",
    "Settings",
    "Texture",
    "Trace",
    "clip_lines",
    "draw_lines",
    "draw_picture",
    "draw_triangles",
    "render",
    "trace",
]
