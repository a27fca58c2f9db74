"""Trace of mirrors: the mirrored direction of a fragment, where it looks or what its ray meets, and what is added."""

import numpy as np

from core.families import mirrors_of
from core.records.arrays import Flags, Floats, Integers
from core.records.listing import Listing, Operation, listing
from core.resolved import resolve
from core.scene import Scene
from core.shading.environment import MapLooks
from core.shading.mirror_rays import MirrorRays
from core.shading.shading import shaded_color
from core.stages.environment import mirror_looks
from core.trace.source import TraceSource

OWN = Operation("own-color", "color", {"own_color": "red green blue"})
"""The light of a fragment, before what it mirrors is added."""


def is_mirror(source: TraceSource, mesh: Integers) -> Flags:
    """Return which fragments of meshes (F,) mirror what is around them."""
    is_lit = "normal" in source.geometry.primitives.layout
    looks = is_lit and resolve(source.settings).environment is not None
    return np.isin(mesh, mirrors_of(source.scene) if looks else ())


def mirror_columns(
    source: TraceSource, mesh: Integers, position: Floats, normal: Floats
) -> list[tuple[Integers, dict[str, np.ndarray]]]:
    """Return which fragments of meshes (F,) are of a mirror, and every number of what they show: name to (C, ...)."""
    assert isinstance(source.scene, Scene)
    found = []
    for chosen, looks in mirror_looks(source.scene, source.settings, mesh, position, normal):
        share = source.scene.meshes[mesh[chosen[0]]].material.mirror
        columns: dict[str, np.ndarray] = {
            "n_dot_i": looks.n_dot_i,
            "reflected": looks.direction,
            "seen": looks.color,
            "mirror_share": np.full(len(chosen), share),
            "mirror": mesh[chosen],
        }
        if isinstance(looks, MapLooks):
            columns |= {
                "face": looks.face,
                "face_place": looks.place,
                "face_texels": looks.texels,
                "face_shares": looks.shares,
            }
        elif isinstance(looks, MirrorRays):
            columns |= {"met": looks.met, "met_distance": looks.distance}
        found.append((chosen, columns))
    return found


def mirror_operations(source: TraceSource) -> tuple[Operation, ...]:
    """Return what a row of a mirror does once it is lit; empty: there is none."""
    method = resolve(source.settings).environment
    return () if method is None else (OWN, *method.operations["mirror"])


def mirror_listings(source: TraceSource) -> dict[str, Listing]:
    """Return the listing of these operations, by operation."""
    method = resolve(source.settings).environment
    if method is None or method.listing is None:
        return {}
    of_mirror = dict.fromkeys((each.name for each in method.operations["mirror"]), listing(method.listing))
    return {OWN.name: listing(shaded_color), **of_mirror}
