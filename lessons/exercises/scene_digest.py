"""A short text for the shapes of a scene: by it the open scene is known as the one that is asked about."""

from hashlib import sha256

import numpy as np

from core.scene import AnyScene, ClipScene


def scene_digest(scene: AnyScene) -> str:
    """Return a text that two scenes have in common which show the same shapes, whatever their rasters and colours."""
    if isinstance(scene, ClipScene):
        parts = [scene.kind, scene.clip, scene.rings, scene.clip_region]
        if scene.table is not None:
            # A table's fragments have a place; their depths are in the table.
            parts += [scene.table.depths, scene.table.test]
    else:
        parts = [*vars(scene.camera).values(), *(mesh.positions for mesh in scene.meshes)]
    digest = sha256()
    for part in parts:
        digest.update(part.encode() if isinstance(part, str) else np.asarray(part, float).tobytes())
        digest.update(b";")
    return digest.hexdigest()[:16]
