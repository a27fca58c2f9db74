"""Settings: one method of the table per family, as files, command line and API spell them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

from core.families import NOT_FOR, Family, SettingField, WholeNumber, facts, number_field, suited
from core.methods import Method, ReplacedName, table
from core.scene import AnyScene
from core.setting_choices import OF_HISTORY, Choices


@dataclass(frozen=True)
class Settings(Choices):
    """Which method runs at each stage; every value names a row of ``core.methods.table``.

    Raises ValueError if a value is not in the table; the message lists those that are.
    """

    pictures: int = number_field(16, "Pictures", 64, (1, 2, 4, 8, 16, 32, 64), "{0}", **OF_HISTORY)
    """How many pictures are mixed (antialiasing ``temporal``), 1 to 64."""
    blend_share: int = number_field(10, "Blend share", 100, (1, 2, 5, 10, 20, 50, 100), "{0} %", **OF_HISTORY)
    """Least share of a new picture (antialiasing ``temporal``) in hundredths, 1 to 100."""
    segments: int = number_field(
        6,
        "Segments",
        100_000,
        (1, 2, 3, 4, 6, 8, 12, 16, 32),
        "{0} segments",
        taken_by="tessellation",
        otherwise="Only equal steps have a number.",
    )
    """Straight pieces of a curve, and of each side of a patch (tessellation), 1 to 100,000."""
    curve_tolerance: int = number_field(
        8,
        "Tolerance, or side",
        4096,
        (1, 2, 4, 8, 16, 32, 64),
        "{0}/16 px",
        taken_by="tessellation",
        otherwise="Equal steps have a number, and no tolerance.",
    )
    """Sixteenths of a pixel that a curve may be away, or a micropolygon long (tessellation), 1 to 4,096."""
    leaf_size: int = number_field(
        8,
        "Leaf size",
        1024,
        (1, 2, 4, 8, 16, 32, 64),
        "{0} in a leaf",
        taken_by="hierarchy",
        otherwise="Only trees have leaves.",
    )
    """Triangles that a node may have without being cut (hierarchies), 1 to 1,024."""
    octree_depth: int = number_field(
        5,
        "Octree depth",
        8,
        tuple(range(1, 9)),
        "{0} levels",
        taken_by="hierarchy",
        otherwise="Only an octree needs a limit of its depth.",
    )
    """How often a cell of an octree is halved at most, 1 to 8."""
    occluders: int = number_field(
        4,
        "Occluders",
        1024,
        (1, 2, 4, 8, 16, 32),
        "{0} drawn first",
        taken_by="object_culling",
        otherwise="Only occlusion culling draws occluders.",
    )
    """Boxes that are drawn first to hide others, the largest on screen (object culling ``occlusion``), 1 to 1,024."""
    map_size: int = number_field(
        64,
        "Shadow map",
        2048,
        (1, 4, 8, 16, 32, 64, 128, 256, 512, 1024),
        "{0} × {0} texels",
        taken_by="shadow",
        otherwise="Only shadow maps have texels.",
    )
    """Texels on a side of a shadow map, 1 to 2,048."""
    shadow_bias: int = number_field(
        16,
        "Shadow bias",
        1024,
        (0, 4, 6, 8, 11, 16, 23, 32, 64, 128),
        "{0}/16 texel",
        least=0,
        taken_by="shadow",
        otherwise="Only shadow maps need a bias.",
    )
    """How far a point may lie behind what the map stores and still be lit, in 1/16 of a texel's width, 0 to 1,024."""
    environment_size: int = number_field(
        64,
        "Environment map",
        512,
        (1, 4, 8, 16, 32, 64, 128, 256, 512),
        "{0} × {0} texels",
        taken_by="environment",
        otherwise="Only environment maps have texels.",
    )
    """Texels on a side of each of the six faces of an environment map, 1 to 512."""
    block_size: int = number_field(
        8,
        "Block size",
        256,
        (1, 2, 4, 8, 16, 32),
        "{0} × {0} pixels",
        taken_by="fill",
        otherwise="Only fills by blocks have a block size.",
    )
    """Pixels on a side of a block (fills by blocks), 1 to 256."""
    correction_interval: int = number_field(
        16,
        "Perspective correction interval",
        256,
        (1, 2, 4, 8, 16, 32, 64),
        "{0} px",
        taken_by="interpolation",
        otherwise="Only corrected affine interpolation has an interval.",
    )
    """Columns between corrections (interpolation ``affine-n``), 1 to 256."""
    samples_across: int = number_field(
        3,
        "Samples",
        8,
        tuple(range(1, 9)),
        "{0} × {0} samples",
        taken_by="antialiasing",
        otherwise="Only supersampling with n x n samples has a sample count.",
    )
    """Samples on a side of a pixel (antialiasing ``ssaa-n``), 1 to 8."""
    drawing_time: int = number_field(
        20,
        "Time to draw a picture",
        100,
        (5, 8, 10, 16, 20, 24, 33, 50),
        "{0} ms",
        taken_by="presentation",
        otherwise="Only pictures that are presented on a screen take time.",
    )
    """Milliseconds of the model that the renderer needs for a picture (presentation), 1 to 100."""
    refresh_time: int = number_field(
        16,
        "Time of a refresh",
        100,
        (4, 7, 8, 10, 16, 20),
        "{0} ms",
        taken_by="presentation",
        otherwise="Only a screen is refreshed.",
    )
    """Milliseconds of the model between two refreshes of the screen (presentation), 1 to 100."""

    def __post_init__(self) -> None:
        for family in families():
            name = getattr(self, family)
            # Defaults are in the table; looking there would import their files.
            if name != getattr(Settings, family) or isinstance(name, ReplacedName):
                table.get(family, name)
        for name, number in WHOLE_NUMBERS.items():
            value = getattr(self, name)
            if type(value) is not int or not number.least <= value <= number.limit:
                raise ValueError(f"{name} must be a whole number {number.limits}, got {value!r}")

    def __eq__(self, other: object) -> bool:
        return not self.differences(other) if isinstance(other, Settings) else NotImplemented

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
        Render, trace and pixel history run it, under the name of the method that it replaces. `draw_picture` draws all
        buffers then: its closed forms are those of the table. Other runs are not equal to it.

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


FIELDS: Mapping[str, SettingField] = {field.name: field.metadata["field"] for field in fields(Settings)}
"""What is declared of every setting, by name."""
FAMILIES = {name: declared for name, declared in FIELDS.items() if isinstance(declared, Family)}
"""The families of methods, in pipeline order."""
WHOLE_NUMBERS = {name: declared for name, declared in FIELDS.items() if isinstance(declared, WholeNumber)}
"""Settings that are whole numbers."""
for _name, _family in FAMILIES.items():
    table.declare(_name, _family.files)


def families() -> tuple[str, ...]:
    """Return the families of methods that settings choose from, in pipeline order."""
    return tuple(FAMILIES)


def no_effect(settings: Settings, name: str, scene: AnyScene | None = None) -> str:
    """Return why a setting changes nothing with the others and this scene, as a sentence; empty: it may."""
    if scene is not None:
        settings = suited(settings, scene)
    for reasons in (NOT_FOR[fact] for fact in facts(scene)):
        if name in reasons or "" in reasons:
            return reasons.get(name, reasons.get("", ""))
    taking = [by for by in FIELDS[name].takers if name in table.get(by, getattr(settings, by)).takes]
    if FIELDS[name].taken_by and not taking:
        return FIELDS[name].otherwise
    if name in NOT_FOR["outlined"] and table.get("polygon_mode", settings.polygon_mode).function():
        return NOT_FOR["outlined"][name]
    found = [no_effect(settings, by, scene) for by in taking]
    return found[0] if found and all(found) else ""


DEFAULTS = Settings()
"""What runs where nothing is chosen."""


def with_method(settings: Settings, family: str, name: str) -> Settings:
    """Return settings that choose the method ``name`` of one family."""
    return replace(settings, **{family: name})  # type: ignore[arg-type]
