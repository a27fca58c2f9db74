"""How texture coordinates change from pixel to pixel, over areas and along the lines of a wireframe."""

from core.fragments.textures import uses_mipmaps
from core.fragments.uv_slopes import uv_slopes
from core.raster.coverage import Fragments
from core.raster.lines.slopes import line_slopes
from core.raster.lines.wireframe import LineFragments
from core.raster.pixel_runs import Raster
from core.records.arrays import Floats, Integers
from core.records.primitives import interpolation_form
from core.settings import Settings
from core.stages.geometry import Geometry


def texture_slopes(
    geometry: Geometry, settings: Settings, raster: Raster, fragments: Fragments, values: Floats
) -> Floats | None:
    """Return du/dx, dv/dx, du/dy, dv/dy (4, F) of fragments with interpolated ``values`` (F, K).

    ``None`` where no texture is looked up, or the texture filter does not ask for them.
    """
    interpolation = settings.interpolation
    if isinstance(fragments, LineFragments) and interpolation_form(interpolation) != "flat":
        if not _asks_for_slopes(geometry, settings):
            return None
        assert geometry.outlines is not None
        varyings = geometry.primitives.varyings[..., geometry.primitives.layout["uv"]]
        slopes = line_slopes(geometry.outlines, varyings, fragments, raster.center, interpolation)
        return slopes.reshape(4, len(fragments))
    x, y = raster.centers(fragments.column, fragments.row)
    return slopes_at(geometry, settings, fragments.primitive, x, y, values)


def slopes_at(
    geometry: Geometry, settings: Settings, primitive: Integers, x: Floats, y: Floats, values: Floats
) -> Floats | None:
    """Return the same (4, F), or ``None``, for primitives at window positions (F,)."""
    if not _asks_for_slopes(geometry, settings):
        return None
    uv = values[:, geometry.primitives.layout["uv"]]
    how = settings.interpolation
    return uv_slopes(geometry.planes, geometry.primitives.values, primitive, x, y, uv, how)


def _asks_for_slopes(geometry: Geometry, settings: Settings) -> bool:
    return "uv" in geometry.primitives.layout and uses_mipmaps(settings.texture_filter)
