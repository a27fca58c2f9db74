"""Scan-line visible surfaces measured: depths computed at the ends of segments, and what is sorted for it."""

from core.scene import AnyScene
from core.settings import Settings
from core.trace.source import TraceSource
from core.visibility.scan_line import HALVED, ScanLines


def scan_line_work(scene: AnyScene, settings: Settings) -> dict[str, int]:
    """Return what the method does for a scene; nothing where the settings decide otherwise.

    Returns
    -------
    dict of str to int
        ``depths computed``, every live triangle at every centre that is compared at; ``span ends sorted``; ``segments``
        between them, and ``halvings`` of these.
    """
    lines = TraceSource(scene, settings).ray_tests
    if not isinstance(lines, ScanLines):
        return {}
    segments = lines.segments
    return {
        "depths computed": segments.evaluations,
        "span ends sorted": 2 * len(lines.spans.row),
        "segments": int((segments.depth == 0).sum()),
        "halvings": int((segments.verdict == HALVED).sum()),
    }
