"""Settings: one method of the table per family, as files, command line and API spell them."""

from dataclasses import dataclass, fields

from core.methods import table

BLOCK_SIZE_LIMIT = 256


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
    block_size: int = 8
    """Pixels on a side of a block (fills by blocks), 1 to 256."""

    def __post_init__(self) -> None:
        for family in families():
            table.get(family, str(getattr(self, family)))
        if type(self.block_size) is not int or not 1 <= self.block_size <= BLOCK_SIZE_LIMIT:
            raise ValueError(
                f"block_size must be a whole number from 1 to {BLOCK_SIZE_LIMIT}, got {self.block_size!r}"
            )


def families() -> tuple[str, ...]:
    """Return the families of methods that settings choose from, in pipeline order."""
    return tuple(field.name for field in fields(Settings) if field.type is str)


def settings_from_texts(pairs: dict[str, str]) -> Settings:
    """Return settings from texts such as ``{"fill": "blocks", "block_size": "4"}``; a wrong name raises ValueError."""
    known = {field.name for field in fields(Settings)}
    for name in pairs:
        if name not in known:
            raise ValueError(f"setting must be one of {', '.join(sorted(known))}, got {name}")
    values: dict[str, str | int] = dict(pairs)
    if "block_size" in pairs:
        try:
            values["block_size"] = int(pairs["block_size"])
        except ValueError:
            raise ValueError(f"block_size must be a whole number, got {pairs['block_size']}") from None
    return Settings(**values)  # type: ignore[arg-type]
