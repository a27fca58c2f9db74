"""Which mistake, or which other method, makes a picture that somebody drew with a program of their own."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from core import Settings, render
from core.framebuffer.display import Bytes, picture_bytes, to_display
from core.geometry.vertex_stage import transform_vertices
from core.methods import table
from core.records.arrays import Flags, Integers
from core.records.frame import Frame
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.settings import FAMILIES, no_effect, settings_from_texts
from lessons.mistakes.coverage import transposed, upside_down
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import Twin

PIXEL_LIMIT = 1 << 18
"""Most pixels of a picture: it is compared with one of each mistake and method."""
RIGHT = "the right picture"
GREYS: dict[tuple[float, ...], str] = {
    (0.299, 0.587, 0.114): "0.299 R + 0.587 G + 0.114 B",
    (0.2126, 0.7152, 0.0722): "0.2126 R + 0.7152 G + 0.0722 B",
    (1 / 3, 1 / 3, 1 / 3): "(R + G + B)/3",
}
"""How programs make bytes of colours grey, by the weights of red, green and blue."""
Report = Callable[[float, str], None]
SLOW = ("fill=brute-force", "antialiasing=area")
"""Methods that take minutes for a mesh of more triangles than ``SLOW_LIMIT``: they are left out there."""
SLOW_LIMIT = 2000


@dataclass(frozen=True, eq=False)
class Drawn:
    """A picture that somebody drew, as colours, as numbers of triangles, or as covered pixels; row 0 at the bottom."""

    colors: Bytes | None = None
    """(H, W, 3 or 4) uint8, sRGB."""
    primitive: Integers | None = None
    """(H, W), -1 for none."""
    covered: Flags | None = None
    """(H, W) bool."""
    grey: tuple[float, ...] = ()
    """Weights by which the colours are taken to be made grey; empty: they are not."""

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        (buffer,) = [each for each in (self.colors, self.primitive, self.covered) if each is not None]
        return buffer.shape[1], buffer.shape[0]


@dataclass(frozen=True, eq=False)
class Candidate:
    """A run that may have made a picture."""

    name: str
    """Of a mistake, or a method as ``fill_rule=inclusive``."""
    sentence: str
    draw: Callable[[], Frame]
    settings: Settings
    is_mistake: bool


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What a picture may be."""

    is_right: bool
    found: tuple[Candidate, ...]
    """All that make exactly this picture, mistakes before methods; empty where it is right or unknown."""
    nearest: Candidate
    """That with the fewest other pixels."""
    differing: Flags
    """(H, W), where the nearest differs."""
    from_right: Flags
    """(H, W), where the right picture differs."""


def candidates(scene: AnyScene, settings: Settings) -> Iterator[Candidate]:
    """Yield the right run, the mistakes, and every other method of the families that matter, one change at a time."""
    yield Candidate(RIGHT, "", lambda: render(scene, settings), settings, False)
    for twin in SHELF.values():
        changed = twin.change_settings(settings)
        for draw in _faulty(twin, scene, settings):
            yield Candidate(twin.name, twin.sentence, draw, changed, True)
    for family in FAMILIES:
        if no_effect(settings, family, scene):
            continue
        for method in table.names(family):
            is_slow = f"{family}={method}" in SLOW and primitive_count(scene) > SLOW_LIMIT
            if method != getattr(settings, family) and not is_slow:
                changed = settings_from_texts({family: method}, settings)
                sentence = f"{FAMILIES[family].title}: {table.get(family, method).title}."
                yield Candidate(
                    f"{family}={method}", sentence, partial(render, scene, changed), changed, False
                )


def primitive_count(scene: AnyScene) -> int:
    """Return how many triangles, segments or points a scene has."""
    return (
        len(scene.clip) if isinstance(scene, ClipScene) else sum(len(mesh.triangles) for mesh in scene.meshes)
    )


def _faulty(twin: Twin, scene: AnyScene, settings: Settings) -> Iterator[Callable[[], Frame]]:
    """Yield what draws a scene with a mistake; of a mesh, which has no corners in the window to be changed, some."""
    if isinstance(scene, ClipScene):
        yield partial(twin.draw, scene, settings)
    elif twin.takes_any_scene:
        yield partial(render, scene, twin.change_settings(settings))
    elif twin.name == "rows-and-columns":
        yield lambda: transposed(render(scene, settings), scene)
    if twin.name == "y-down":  # Drawn the right way up, and saved from the wrong end.
        yield lambda: upside_down(render(scene, settings), scene)
    if twin.name == "weights-permuted" and isinstance(scene, ClipScene):  # The other way round.
        yield lambda: twin.draw(twin.change_scene(scene), settings)


def diagnose(scene: AnyScene, settings: Settings, drawn: Drawn, report: Report | None = None) -> Diagnosis:
    """Compare a picture of a scene with those of all candidates.

    Parameters
    ----------
    scene, settings
        What was to be drawn, and how.
    drawn : Drawn
        What was drawn.
    report : callable, optional
        Is called with the fraction that is done, and with what is being done.

    Raises
    ------
    ValueError
        If the picture has another size than the scene, or too many pixels; the message is one sentence.

    Notes
    -----
    Colours that are a byte apart are equal, and any colour may stand for the background. A picture in two colours that
    fits as no picture in colours is taken for covered pixels. One in a single colour shows nothing, also where ink has
    the colour of the background, unless every pixel is to be covered. Of a grey picture the scene is made grey, too.
    """
    check_size(drawn.size, scene.size)
    seen = _compared(_with_corners(scene, settings, drawn), settings, drawn, report)
    is_seen = not _is_blank(drawn) or bool((render(scene, settings).primitive >= 0).all())
    if (seen.is_right and is_seen) or seen.found:
        return seen
    others = [diagnose(scene, settings, each, report) for each in _as_coverage(drawn)]
    if others:
        nearest = min(others, key=lambda one: int(one.differing.sum()))
        return _of_another_color(nearest, seen, scene, settings, drawn)
    if drawn.colors is None or (drawn.colors[..., :3] != drawn.colors[..., :1]).any():
        return seen
    return _of_grey(seen, scene, settings, drawn, report)


def _of_another_color(
    covering: Diagnosis, seen: Diagnosis, scene: AnyScene, settings: Settings, drawn: Drawn
) -> Diagnosis:
    """Name the colour of a picture in a single one, where every pixel is to have a single other one."""
    frame = render(scene, settings)
    if not _is_blank(drawn) or (frame.primitive < 0).any():
        return covering
    assert drawn.colors is not None
    right = _shown(frame, settings, drawn)
    if (right != right[0, 0]).any():
        return covering
    mine, its = (tuple(colors[0, 0].tolist()) for colors in (drawn.colors, right))
    sentence = f"Every pixel has the colour {mine} instead of {its}."
    other = Candidate("another-colour", sentence, lambda: frame, settings, True)
    return replace(seen, found=(other, *covering.found))


def _of_grey(
    seen: Diagnosis, scene: AnyScene, settings: Settings, drawn: Drawn, report: Report | None
) -> Diagnosis:
    """Compare with the scene in grey, by the weights with which the right picture is nearest."""
    frame = render(scene, settings)
    greys = [_with_background(replace(drawn, grey=weights), frame, settings) for weights in GREYS]
    nearest = min(greys, key=lambda each: int(_differing(frame, settings, each).sum()))
    compared = _compared(_with_corners(scene, settings, drawn), settings, nearest, report)
    if compared.differing.sum() >= seen.differing.sum():
        return seen
    sentence = f"The colours are made grey: {GREYS[nearest.grey]}."
    grey = Candidate("grey", sentence, compared.nearest.draw, settings, True)
    is_known = compared.is_right or compared.found
    name = f"{compared.nearest.name} in grey"
    return Diagnosis(
        False,
        (grey, *compared.found) if is_known else (),
        grey if is_known else replace(grey, name=name),
        compared.differing,
        seen.from_right,
    )


def _with_corners(scene: AnyScene, settings: Settings, drawn: Drawn) -> AnyScene:
    """Return a scene with corners in clip space, which mistakes may change, where that draws the same picture."""
    if isinstance(scene, ClipScene):
        if scene.attributes is not None:
            return scene
        return replace(scene, attributes=np.tile([0.0, 0.0, 0.0, 1.0], (*scene.clip.shape[:2], 1)))
    is_lit = settings.shading != "unlit" or any(mesh.texture is not None for mesh in scene.meshes)
    if drawn.colors is not None and is_lit:
        return scene
    stage = transform_vertices(scene)
    colors = np.concatenate(
        [np.ones((len(mesh.positions), 4)) if mesh.colors is None else mesh.colors for mesh in scene.meshes]
    )
    return ClipScene(
        stage.clip[stage.corners], colors[stage.corners], scene.size, background=scene.background
    )


def _compared(scene: AnyScene, settings: Settings, drawn: Drawn, report: Report | None) -> Diagnosis:
    """Compare a picture in one way."""
    fits: list[Candidate] = []
    nearest: tuple[Candidate, Flags] | None = None
    from_right: Flags | None = None
    runs = list(candidates(scene, settings))
    for number, candidate in enumerate(runs):
        if report is not None:
            report(number / len(runs), "comparing")
        try:
            with np.errstate(all="ignore"):
                frame = candidate.draw()
        except ValueError:
            if from_right is None:
                raise
            continue  # The scene lacks what this method needs.
        if from_right is None:
            drawn = _with_background(drawn, frame, settings)
        differing = _differing(frame, candidate.settings, drawn)
        if from_right is None:
            from_right = differing
        if nearest is None or differing.sum() < nearest[1].sum():
            nearest = candidate, differing
        if not differing.any() and candidate.name not in [each.name for each in fits]:
            fits.append(candidate)
    assert nearest is not None
    assert from_right is not None
    is_right = not from_right.any()
    found = () if is_right else tuple(sorted(fits, key=lambda each: not each.is_mistake))
    return Diagnosis(is_right, found, *nearest, from_right)


def check_size(size: tuple[int, int], wanted: tuple[int, int]) -> None:
    """Raise ValueError for a picture that cannot be compared with a scene of a ``wanted`` size."""
    if size != wanted:
        raise ValueError(f"expected a picture of {wanted[0]} x {wanted[1]} pixels, got {size[0]} x {size[1]}")
    if size[0] * size[1] > PIXEL_LIMIT:
        raise ValueError(f"expected a picture of up to {PIXEL_LIMIT} pixels, got {size[0]} x {size[1]}")


def _differing(frame: Frame, settings: Settings, drawn: Drawn) -> Flags:
    if drawn.primitive is not None:
        return np.asarray(frame.primitive != drawn.primitive)
    if drawn.covered is not None:
        return np.asarray((frame.primitive >= 0) != drawn.covered)
    assert drawn.colors is not None
    shown = _shown(frame, settings, drawn).astype(int)
    return np.asarray((np.abs(shown - drawn.colors) > 1).any(axis=2))


def _shown(frame: Frame, settings: Settings, drawn: Drawn) -> Bytes:
    """Return the bytes (H, W, 3 or 4) of a frame as a picture has them: over black, or with its alpha; or in grey."""
    assert drawn.colors is not None
    if drawn.colors.shape[2] == 4:
        shown = picture_bytes(frame.color, resolve(settings).blend_name)
    else:
        shown = to_display(frame.color).pixels[..., :3]
    if not drawn.grey:
        return shown
    grey = np.rint(sum(weight * shown[..., k] for k, weight in enumerate(drawn.grey)))
    return np.dstack([grey, grey, grey, shown[..., 3:]]).astype(np.uint8)


def _with_background(drawn: Drawn, right: Frame, settings: Settings) -> Drawn:
    """Put the scene's background in place of another one: the most frequent colour where nothing should be drawn."""
    empty = right.primitive < 0
    if drawn.colors is None or not empty.any():
        return drawn
    shown = _shown(right, settings, drawn)
    colors, counts = np.unique(drawn.colors[empty], axis=0, return_counts=True)
    theirs, ours = colors[np.argmax(counts)].astype(int), shown[empty][0]
    is_background = (np.abs(drawn.colors - theirs) <= 1).all(axis=2)
    is_ours = (np.abs(drawn.colors - ours.astype(int)) <= 1).all(axis=2)
    if (is_background | is_ours).all():
        return drawn  # Ink in the colour of the scene's background would vanish.
    return replace(drawn, colors=np.where(is_background[..., None], ours, drawn.colors))


def _is_blank(drawn: Drawn) -> bool:
    """Return whether a picture is in a single colour."""
    return drawn.colors is not None and bool((drawn.colors == drawn.colors[0, 0]).all())


def _as_coverage(drawn: Drawn) -> list[Drawn]:
    """Return what a picture in two colours may cover: the pixels of the one, or those of the other; in one, nothing."""
    if drawn.colors is None:
        return []
    first = (drawn.colors == drawn.colors[0, 0]).all(axis=2)
    others = drawn.colors[~first]
    if not len(others):
        return [Drawn(covered=~first)]
    return [] if (others != others[0]).any() else [Drawn(covered=~first), Drawn(covered=first)]
