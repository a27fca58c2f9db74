"""Settings: one method of the table per family, as files, command line and API spell them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from core.methods import Method, ReplacedName, table

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
            name = getattr(self, family)
            # Defaults are in the table; looking there would import their files.
            if name != getattr(Settings, family) or isinstance(name, ReplacedName):
                table.get(family, name)
        for name, limit in WHOLE_NUMBERS.items():
            value = getattr(self, name)
            if type(value) is not int or not 1 <= value <= limit:
                raise ValueError(f"{name} must be a whole number from 1 to {limit}, got {value!r}")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Settings):
            return NotImplemented
        return not self.differences(other)

    def differences(self, other: "Settings") -> dict[str, str | int]:
        """Return the values of ``other`` that are not those of these settings, by name."""
        mine = vars(self)
        return {
            name: value
            for name, value in vars(other).items()
            if value != mine[name] or type(value) is not type(mine[name])
        }

    @property
    def replacements(self) -> dict[str, Method]:
        """By family, the methods that run another function than the table's, see `replaced`."""
        return {family: name.method for family, name in vars(self).items() if isinstance(name, ReplacedName)}

    def replaced(self, **functions: Callable[..., Any] | Method) -> "Settings":
        """Return settings whose methods run other functions: a faulty twin, a student's own. None is registered.

        Parameters
        ----------
        **functions : callable or Method
            By family, what runs instead of the function of the chosen method, with the same arguments; or a whole
            row in its place, which may bring its own listing.

        Notes
        -----
        Render, trace and pixel history run it, under the name of the method that it replaces. `draw_picture` draws
        all buffers then, since its closed forms are those of the table's functions. Other runs are not equal to it.

        Examples
        --------
        >>> twin = Settings().replaced(fill_rule=lambda a, b: a > a)
        >>> twin.fill_rule, twin == Settings(), list(twin.replacements)
        ('shared-edge', False, ['fill_rule'])
        """
        names = {
            name: table.replaced(name, getattr(self, name), function) for name, function in functions.items()
        }
        return replace(self, **names)  # type: ignore[arg-type]


def families() -> tuple[str, ...]:
    """Return the families of methods that settings choose from, in pipeline order."""
    return tuple(field.name for field in fields(Settings) if field.type is str)


def import_methods(settings: Settings) -> None:
    """Import all methods that settings choose: before the stages are timed, so that no stage's time contains it."""
    for family in families():
        table.get(family, getattr(settings, family))


def settings_from_texts(pairs: Mapping[str, str], base: Settings | None = None) -> Settings:
    """Return ``base``, or the defaults, changed by texts such as ``{"fill": "blocks", "block_size": "4"}``.

    A wrong name raises ValueError.
    """
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
    return replace(base or Settings(), **values)  # type: ignore[arg-type]


def settings_record(settings: Settings) -> dict[str, str | int]:
    """Return settings by name, as files keep them; ValueError where a function was replaced, which has no name."""
    for family, method in settings.replacements.items():
        raise ValueError(f"{family} {method.name} runs a replaced function, which cannot be saved")
    return dict(vars(settings))


def with_method(settings: Settings, family: str, name: str) -> Settings:
    """Return settings that choose the method ``name`` of one family."""
    return replace(settings, **{family: name})  # type: ignore[arg-type]
