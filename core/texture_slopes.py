"""How texture coordinates change from pixel to pixel, over areas and along the lines of a wireframe."""

from core.arrays import Floats
from core.fragments.textures import uses_mipmaps
from core.fragments.uv_slopes import uv_slopes
from core.geometry_record import Geometry
from core.raster.coverage import Fragments
from core.raster.line_slopes import line_slopes
from core.raster.schedule import Raster
from core.raster.wireframe import LineFragments
from core.settings import Settings


def texture_slopes(
    geometry: Geometry, settings: Settings, raster: Raster, fragments: Fragments, values: Floats
) -> Floats | None:
    """Return du/dx, dv/dx, du/dy, dv/dy (4, F) of fragments with interpolated ``values`` (F, K).

    ``None`` where no texture is looked up, or the texture filter does not ask for them.
    """
    layout, interpolation = geometry.primitives.layout, settings.interpolation
    if "uv" not in layout or not uses_mipmaps(settings.texture_filter):
        return None
    if isinstance(fragments, LineFragments) and interpolation != "flat":
        assert geometry.outlines is not None
        varyings = geometry.primitives.varyings[..., layout["uv"]]
        slopes = line_slopes(geometry.outlines, varyings, fragments, raster.center, interpolation)
        return slopes.reshape(4, len(fragments))
    x, y = raster.centers(fragments.column, fragments.row)
    uv = values[:, layout["uv"]]
    return uv_slopes(
        geometry.planes, geometry.primitives.values, fragments.primitive, x, y, uv, interpolation
    )
