"""Settings: one method of the table per family, as files, command line and API spell them."""

from dataclasses import dataclass, fields, replace

from core.methods import table

WHOLE_NUMBERS = {"block_size": 256, "correction_interval": 256, "samples_across": 8}
"""Settings that are whole numbers from 1 on, and the largest that each may be."""


@dataclass(frozen=True)
class Settings:
    """Which method runs at each stage; every value names a row of ``core.methods.table``.

    Raises
    ------
    ValueError
        If a value is not in the table; the message lists those that are.
    """

    cull: str = "none"
    clipping: str = "homogeneous"
    coverage: str = "snapped"
    fill_rule: str = "shared-edge"
    fill: str = "spans"
    polygon_mode: str = "fill"
    line: str = "bresenham"
    line_clipping: str = "none"
    pixel_center: str = "half"
    interpolation: str = "perspective"
    provoking: str = "last"
    texture_filter: str = "bilinear"
    wrap: str = "repeat"
    shading: str = "phong"
    visibility: str = "z-buffer"
    depth: str = "z-float32"
    blend: str = "opaque"
    antialiasing: str = "none"
    resolve_filter: str = "box"
    block_size: int = 8
    """Pixels on a side of a block (fills by blocks), 1 to 256."""
    correction_interval: int = 16
    """Columns between corrections (interpolation ``affine-n``), 1 to 256."""
    samples_across: int = 3
    """Samples on a side of a pixel (antialiasing ``ssaa-n``), 1 to 8."""

    def __post_init__(self) -> None:
        for family in families():
            name = str(getattr(self, family))
            if name != getattr(
                Settings, family
            ):  # Defaults are in the table; looking there would import their files.
                table.get(family, name)
        for name, limit in WHOLE_NUMBERS.items():
            value = getattr(self, name)
            if type(value) is not int or not 1 <= value <= limit:
                raise ValueError(f"{name} must be a whole number from 1 to {limit}, got {value!r}")


def families() -> tuple[str, ...]:
    """Return the families of methods that settings choose from, in pipeline order."""
    return tuple(field.name for field in fields(Settings) if field.type is str)


def import_methods(settings: Settings) -> None:
    """Import all methods that settings choose: before the stages are timed, so that no stage's time contains it."""
    for family in families():
        table.get(family, getattr(settings, family))


def settings_from_texts(pairs: dict[str, str]) -> Settings:
    """Return settings from texts such as ``{"fill": "blocks", "block_size": "4"}``; a wrong name raises ValueError."""
    known = {field.name for field in fields(Settings)}
    for name in pairs:
        if name not in known:
            raise ValueError(f"setting must be one of {', '.join(sorted(known))}, got {name}")
    values: dict[str, str | int] = dict(pairs)
    for name in WHOLE_NUMBERS.keys() & pairs.keys():
        try:
            values[name] = int(pairs[name])
        except ValueError:
            raise ValueError(f"{name} must be a whole number, got {pairs[name]}") from None
    return Settings(**values)  # type: ignore[arg-type]


def with_method(settings: Settings, family: str, name: str) -> Settings:
    """Return settings that choose the method ``name`` of one family."""
    return replace(settings, **{family: name})  # type: ignore[arg-type]
