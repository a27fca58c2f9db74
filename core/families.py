"""What `core.settings.Settings` declares of its fields, for menus, command line and tests; and where they matter."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from core.methods import ReplacedName, table
from core.records.deformations import Skin
from core.records.words import nouns
from core.scene import AnyScene, ClipScene


@dataclass(frozen=True, eq=False, kw_only=True)
class SettingField:
    """What is known of any setting."""

    title: str
    """What a person reads in a panel."""
    taken_by: str = ""
    """The families, apart by spaces, whose chosen methods decide by their ``takes`` whether this setting matters.

    Empty: it always does.
    """
    otherwise: str = ""
    """Why it does not matter, where no chosen method takes it."""

    @property
    def takers(self) -> tuple[str, ...]:
        """The families of ``taken_by``."""
        return tuple(self.taken_by.split())


@dataclass(frozen=True, eq=False, kw_only=True)
class Family(SettingField):
    """A family of methods, one of which a setting chooses."""

    stage: str
    """The stage that runs the method."""
    is_look: bool = False
    """Whether it chooses what is to be seen, not how well: references take it from the settings given."""
    classical: tuple[str, ...] = ()
    """Its methods that a first course teaches; empty: a first course does without the family."""
    asks: tuple[str, ...] = ()
    """Fields of `core.methods.Method` that every method of the family fills in, ``listing`` and ``operations``."""
    files: tuple[str, ...]
    """The modules of its first methods, in the order of the menus; others are found in the first one's folder."""


@dataclass(frozen=True, eq=False, kw_only=True)
class WholeNumber(SettingField):
    """A whole number that some methods of a family take."""

    limit: int
    """Largest that it may be."""
    least: int = 1
    """Smallest that it may be."""
    offered: tuple[int, ...]
    """Those in menus."""
    label: str
    """How a menu shows one, a format of the number."""

    @property
    def limits(self) -> str:
        """Both limits in words."""
        return f"from {self.least} to {self.limit}"


def choice(default: str, title: str, stage: str, *files: str, **applies: Any) -> Any:
    """Declare a field of settings that chooses a method; ``applies`` are further fields of `Family`."""
    return field(
        default=default, metadata={"field": Family(title=title, stage=stage, files=files, **applies)}
    )


def number_field(
    default: int, title: str, limit: int, offered: tuple[int, ...], label: str, **applies: Any
) -> Any:
    """Declare a field of settings that is a number; ``applies`` are further fields of `WholeNumber`."""
    number = WholeNumber(title=title, limit=limit, offered=offered, label=label, **applies)
    return field(default=default, metadata={"field": number})


OF_TRIANGLES = {
    "clipping": "The planes of the view volume cut no polygon: all its corners lie in front of the eye.",
    "coverage": "A polygon's corners are snapped to 1/256 pixel, and its crossings are exact.",
    "fill_rule": "A polygon owns the pixel centres on its left and lower edges.",
    "fill": "Polygons are filled row by row, from an edge table.",
    "polygon_mode": "Polygons are filled.",
    "interpolation": "A polygon has one colour.",
    "provoking": "A polygon has the colour of its corner 0.",
    "block_size": "Polygons are filled row by row, from an edge table.",
}
"""Settings that do not matter to polygons, and why."""
_OF_AREAS = ("cull", "polygon_mode", "fill", "fill_rule")
_OF_LINES = {"line": "", "line_clipping": ""}
NOT_FOR: Mapping[str, Mapping[str, str]] = {
    "polygons": OF_TRIANGLES,
    "segments": {**dict.fromkeys(_OF_AREAS, "Segments have no area."), **_OF_LINES},
    "points": {
        **dict.fromkeys(_OF_AREAS, "Points have no area."),
        **_OF_LINES,
        "line": "A point is one pixel.",
    },
    "patches": {
        "visibility": "",
        "blend": "",
        "": "A table of depths begins at the depth test, and has its own.",
    },
    "no polygons": dict.fromkeys(("polygon_clipping", "polygon_fill"), "This scene has no polygons."),
    "no texture": dict.fromkeys(("texture_filter", "wrap"), "This scene has no texture."),
    "own shaders": {
        "shading": "The scene's own shaders do it. The pane Shaders (L) takes them off.",
        "shadow": "The scene's own shaders light it, and look into no shadow map.",
        "environment": "The scene's own shaders light it, and look into no environment map.",
        "object_culling": "The scene's vertex shader moves the corners: the boxes of its meshes do not hold them.",
        "depth_test_time": "A shader may discard a fragment, so depth is tested after it has run.",
    },
    "no shadow": {"shadow": "No light of this scene casts shadows: only a directional light can."},
    "no mirror": {"environment": "No mesh of this scene has a mirror share and another mesh to show."},
    "no curves": dict.fromkeys(
        ("tessellation", "segments", "curve_tolerance"), "This scene has no curves and no patches of curves."
    ),
    "no bones": {"skinning": "No mesh of this scene hangs on bones."},
    "no lights": {
        "shading": "Typed triangles have no lights: they are unlit.",
        "object_culling": "This scene has no meshes: only those have boxes in world space.",
    },
    "outlined": {"correction_interval": "Lines are interpolated with perspective at every pixel."},
}
"""By a fact, the settings that do not matter then, and why. No reason: they do; no name: all others do not."""


def facts(scene: AnyScene | None) -> list[str]:
    """Return which keys of `NOT_FOR` hold of a scene; those that decide first come first."""
    if scene is None:
        return []
    textures = [scene.texture] if isinstance(scene, ClipScene) else [mesh.texture for mesh in scene.meshes]
    holds = {
        nouns(scene.corner_count).many: scene.corner_count != 3,
        "no polygons": scene.corner_count <= 3,
        "no texture": all(texture is None for texture in textures),
        "own shaders": scene.program is not None,
        "no shadow": isinstance(scene, ClipScene) or scene.casting_light < 0,
        "no mirror": not mirrors_of(scene),
        "no curves": not has_curves(scene),
        "no bones": not has_bones(scene),
        "no lights": isinstance(scene, ClipScene),
    }
    return [fact for fact, is_so in holds.items() if is_so]


def mirrors_of(scene: AnyScene) -> tuple[int, ...]:
    """Return the meshes that mirror others: one alone has nothing to show."""
    if isinstance(scene, ClipScene) or len(scene.meshes) == 1:
        return ()
    return tuple(number for number, mesh in enumerate(scene.meshes) if mesh.material.mirror > 0)


def has_curves(scene: AnyScene) -> bool:
    """Return whether a scene is made of curves or patches, which are cut into segments or triangles."""
    if isinstance(scene, ClipScene):
        return scene.curves is not None
    return any(mesh.patches is not None for mesh in scene.meshes)


def has_bones(scene: AnyScene) -> bool:
    """Return whether some mesh of a scene hangs on bones."""
    return not isinstance(scene, ClipScene) and any(
        isinstance(mesh.deformation, Skin) for mesh in scene.meshes
    )


def _visibility_trait(visibility: str) -> Any:
    return None if isinstance(visibility, ReplacedName) else table.get("visibility", visibility).traits


def casts_rays(visibility: str) -> bool:
    """Return whether a setting is a method, with its own function, that compares triangles exactly: by its trait."""
    return bool(_visibility_trait(visibility) == "exact")


def decides_itself(visibility: str) -> bool:
    """Return whether a method, with its own function, decides what is kept without the depth test: by its trait."""
    return _visibility_trait(visibility) is not None


def suited(settings: Any, scene: AnyScene) -> Any:
    """Return the settings that the primitives of a scene are drawn with.

    Segments and points have no area: they are drawn as lines, and face nowhere. Polygons are filled by methods of
    their own, with the colour of corner 0. A table of depths brings its own depth test.
    """
    corner_count = scene.corner_count
    if corner_count == 3:
        return settings
    if isinstance(scene, ClipScene) and scene.table is not None:
        from core.depth.whole_depths import TABLE_DEPTHS  # Only such scenes wait for it.

        seen = "z-buffer" if casts_rays(settings.visibility) else settings.visibility
        plain = type(settings)(polygon_mode="wireframe", visibility=seen, blend=settings.blend)
        return plain.replaced(depth=TABLE_DEPTHS[scene.table.test])
    if corner_count > 3:
        defaults = {name: getattr(type(settings), name) for name in OF_TRIANGLES}
        filled = {"fill": "scanline", "interpolation": "flat", "provoking": "first"}
        return replace(settings, **{**defaults, **filled})
    divides = table.get("clipping", settings.clipping).function().divides
    return replace(
        settings,
        polygon_mode="wireframe",
        cull="none",
        clipping="homogeneous" if divides else settings.clipping,
        line="bresenham" if corner_count == 1 else settings.line,
    )
