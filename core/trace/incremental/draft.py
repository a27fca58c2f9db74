"""A triangle while it is dragged: it alone is traced, and what is around it stays as it was."""

from dataclasses import dataclass, field

from core.records.frame import Frame
from core.scene import AnyScene
from core.trace import Trace
from core.trace.source import TraceSource


@dataclass(frozen=True, eq=False)
class Draft(TraceSource):
    """One triangle of an edited scene, before the buffers and the picture of the scene before the edit.

    Notes
    -----
    The triangle's own rows are those of every trace: the same stages make them. What other triangles have a part in,
    depth tests, blending and the picture, is right again in a trace of the whole scene.
    """

    start: Frame = field(kw_only=True)
    picture: Frame = field(kw_only=True)


def draft(scene: AnyScene, earlier: Trace) -> Trace:
    """Prepare the trace of the same triangle in an edited scene, without drawing the others again.

    Parameters
    ----------
    scene : Scene or ClipScene
        Of the same size, with as many triangles.
    earlier : Trace
        Of one triangle of the scene before, or a draft of it.
    """
    source = earlier.source
    assert source.triangle is not None
    run = source.settings, source.triangle, source.region, source.before, source.lanes
    return Trace(Draft(scene, *run, start=source.start, picture=source.picture))
