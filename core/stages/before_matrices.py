"""What happens to a scene before its matrices: positions are made from what the scene gives, as the settings say.

Everything behind, from culling to the last byte, takes the scene that is returned here. The rows of what was done are
put in front of the first matrix of each corner, see `core.transform.traced`.
"""

from typing import TYPE_CHECKING

from core.scene import AnyScene, ClipScene
from core.settings import Settings

if TYPE_CHECKING:
    from core.tessellation.tessellate import Tessellated

_kept: list[tuple[AnyScene, tuple[str, int, int], "Tessellated"]] = []
"""The last scenes that were cut: scenes never change."""
KEPT = 4


def before_matrices(scene: AnyScene, settings: Settings) -> AnyScene:
    """Return the scene that the matrices are applied to: the same, where nothing comes before them.

    Raises
    ------
    ValueError
        Where curves would be cut into too many pieces.
    """
    return tessellated(scene, settings).scene if scene.makes_positions else scene


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
