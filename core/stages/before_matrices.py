"""What happens to a scene before its matrices: positions are made from what the scene gives, as the settings say.

Everything behind, from culling to the last byte, takes the scene that is returned here. The rows of what was done are
put in front of the first matrix of each corner, see `core.transform.traced`.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

from core.families import has_curves
from core.scene import AnyScene, ClipScene, Mesh, Scene
from core.settings import Settings

if TYPE_CHECKING:
    from core.tessellation.tessellate import Tessellated

_kept: list[tuple[AnyScene, tuple[str, int, int], "Tessellated"]] = []
"""The last scenes that were cut: scenes never change."""
_deformed_scenes: list[tuple[Scene, str, Scene]] = []
"""The last scenes that were deformed, with the method."""
KEPT = 4


def before_matrices(scene: AnyScene, settings: Settings) -> AnyScene:
    """Return the scene that the matrices are applied to: the same, where nothing comes before them.

    Raises
    ------
    ValueError
        Where curves would be cut into too many pieces.
    """
    if not scene.makes_positions:
        return scene
    if isinstance(scene, Scene) and any(mesh.deformation is not None for mesh in scene.meshes):
        scene = _deformed(scene, settings)
    return tessellated(scene, settings).scene if has_curves(scene) else scene


def still(mesh: Mesh) -> Mesh:
    """Return a mesh with the vertices and triangles that it has now: a pass cuts and bends nothing anew."""
    return replace(mesh, patches=None, deformation=None, rest=None) if mesh.makes_positions else mesh


def _deformed(scene: Scene, settings: Settings) -> Scene:
    """Return a scene with its meshes deformed; those of the last few are kept."""
    for of_scene, skinning, made in _deformed_scenes:
        if skinning == settings.skinning and (of_scene is scene or made is scene):
            return made
    from core.deformation.deform import deformed  # Only scenes of bones and shapes wait for it.

    made = deformed(scene, settings)
    _deformed_scenes[:] = [*_deformed_scenes[1 - KEPT :], (scene, settings.skinning, made)]
    return made


def tessellated(scene: AnyScene, settings: Settings) -> "Tessellated":
    """Return a scene of curves or patches with these cut; that of the last few is kept, a cut one is itself."""
    key = settings.tessellation, settings.segments, settings.curve_tolerance
    for of_scene, of_key, made in _kept:
        if of_key == key and (of_scene is scene or made.scene is scene):
            return made
    from core.tessellation.tessellate import cut_curves, cut_patches  # Only scenes of curves wait for it.

    made = cut_curves(scene, settings) if isinstance(scene, ClipScene) else cut_patches(scene, settings)
    _kept[:] = [*_kept[1 - KEPT :], (scene, key, made)]
    return made
