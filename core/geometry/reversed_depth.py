"""The projection of reversed z: depth that is 1 at the near plane and 0 at the far plane, without 1 - z.

For a perspective camera at distance w the clip coordinates of the usual projection are z = ((f + n) w - 2 f n)/(f - n)
and w. Those of the reversed one are n (f - w)/(f - n) and w: what is small for far surfaces is computed as a small
number, while (1 - z/w)/2 would be left over from the difference of two large ones. Their quotient is linear over the
window, so that it is interpolated like z.

Where there is only clip space (``ClipScene``), and for an orthographic camera, it is (w - z)/2 over w in float64:
no more exact than the z that was given.

References
----------
E. Lapidous, G. Jiao, *Optimal depth buffer for low-cost graphics hardware*, 1999.
N. Reed, *Depth precision visualized*, 2015.
"""

from core.records.arrays import Floats


def reversed_clip_depth(z: Floats, w: Floats, view_range: tuple[float, float] | None) -> Floats:
    """Return the clip coordinate that takes the place of (z + w)/2; divided by w it is the reversed depth.

    Parameters
    ----------
    z, w : (...) float64, any shape
        Clip coordinates.
    view_range : (near, far), optional
        Distances of the planes of a perspective camera, whose w is the distance; ``None``: z decides.
    """
    if view_range is None:
        return (w - z) / 2
    near, far = view_range
    return near * ((far - w) / (far - near))
