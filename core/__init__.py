"""The core of Rasterscope: the rasterization pipeline in pure NumPy, every stage a function with a record.

Notation and conventions, for the whole core (tested in tests/core/test_conventions.py)
---------------------------------------------------------------------------------------
* N vertices, T triangles, P primitives (triangles and pieces made by clipping), F fragments, H x W raster.
* Vectors are columns, ``p' = D P C^-1 M p``. Right-handed; the camera looks along -z; w > 0 is in front of the eye;
  NDC is [-1, 1]^3, window depth [0, 1]; angles are radians.
* The window is y-up: array row 0 is the bottom row; pixel (column i, row j) has its centre at (i + 1/2, j + 1/2).
* The suffix of a position is its space: object, world, camera, clip, ndc, window; ``homogeneous``: D clip = (x, y, w).
* Coverage is decided per edge on corners snapped to 1/256 pixel; an edge with one end on this grid runs through it in
  its own direction. A centre on an edge belongs to the triangle that contains the point moved an infinitesimal step
  right, then up. Attributes and depth come from unsnapped corners.
* Counter-clockwise is the front. The nearer fragment wins; a tie keeps what is there.
* Colours are linear in the core, sRGB only for display and in files; alpha is straight in inputs.

Of the functions below, each is imported when it is first asked for: a program that draws does not wait for what steps,
nor the other way round. Methods are imported by their table (`core.methods`).
"""

from typing import TYPE_CHECKING

from core.lazy_import import import_on_demand
from core.records.frame import Frame
from core.scene import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Texture
from core.settings import Settings
from core.stages.declared import STAGES
from core.trace import Trace, trace

if TYPE_CHECKING:
    from core.fast_path.draw import draw_picture
    from core.fast_path.draw_context import Picture
    from core.lines.drawing import draw_lines
    from core.lines.line_clipping import ClippedLines, clip_lines
    from core.pipeline import draw_triangles, render
    from core.transform.assembly import assemble
else:
    __getattr__ = import_on_demand(
        globals(),
        ClippedLines="core.lines.line_clipping",
        Picture="core.fast_path.draw_context",
        assemble="core.transform.assembly",
        clip_lines="core.lines.line_clipping",
        draw_lines="core.lines.drawing",
        draw_picture="core.fast_path.draw",
        draw_triangles="core.pipeline",
        render="core.pipeline",
    )

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
    "assemble",
    "clip_lines",
    "draw_lines",
    "draw_picture",
    "draw_triangles",
    "render",
    "trace",
]


def __dir__() -> list[str]:
    return __all__
