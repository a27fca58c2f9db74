"""Which mistake, or which other method, makes a picture that somebody drew with a program; and what to say of it."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cache, partial

import numpy as np

from core import Settings, render
from core.framebuffer.display import Bytes, picture_bytes, to_display
from core.methods import table
from core.records.arrays import Flags, Integers
from core.records.frame import Frame
from core.resolved import resolve
from core.scene import AnyScene, ClipScene
from core.setting_texts import settings_from_texts
from core.settings import FAMILIES, no_effect
from core.transform.vertex_stage import transform_vertices
from lessons.mistakes.shelf import SHELF
from lessons.mistakes.twin import Twin, same_scene

# Which mistake, or which other method, makes a picture that somebody drew with a program of their own.


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
UNEXPLAINED = 0.25
"""What part of the pixels that differ from the right picture, and from an empty one, a named nearest may leave."""
LOSSY_STEPS = 24
"""How far apart equal colours may be in a lossy picture, in bytes: coders round, and spread colours, differently."""
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
    background: tuple[tuple[int, ...], tuple[int, ...]] | None = None
    """The scene's background, and what stands for it in the picture; ``None``: the picture has the same."""
    loses: Callable[[Bytes], Bytes] | None = None
    """What is left of colours (H, W, 3) in a file as lossy as that of the picture; ``None``: all of them."""

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
    change_scene: Callable[[ClipScene], ClipScene] | None = same_scene
    """What it draws instead of the scene; ``None``: it changes the picture, and no run makes that."""


@dataclass(frozen=True, eq=False)
class Diagnosis:
    """What a picture may be."""

    is_right: bool
    found: tuple[Candidate, ...]
    """All that make exactly this picture, mistakes before methods; empty where it is right or unknown."""
    nearest: Candidate
    """That with the fewest other pixels where it explains most of what differs, else the right run."""
    differing: Flags
    """(H, W), where the nearest differs."""
    from_right: Flags
    """(H, W), where the right picture differs."""
    drawn: Drawn
    """The picture as it was compared: its colours, its triangles, or only what it covers."""


def compared_text(drawn: Drawn) -> str:
    """Return what of a picture was compared, and what was not, in sentences."""
    if drawn.primitive is not None:
        return "Compared: which triangle is seen at each pixel. Not compared: colours and depths."
    if drawn.covered is not None:
        return "Compared: which pixels are covered. Not compared: colours, depths and numbers of triangles."
    kind = f"grey values ({GREYS[drawn.grey]})" if drawn.grey else "colours"
    said = [f"Compared: the {kind} of all pixels. Not compared: depths and numbers of triangles."]
    if drawn.background is not None:
        said.append(f"The colour {drawn.background[1]} counts as the background.")
    if drawn.loses is not None:
        said.append(
            "The format of the file is lossy. What the picture is compared with was saved in the same way, "
            f"and colours up to {LOSSY_STEPS} of 255 apart are equal: only a PNG shows small differences."
        )
    return " ".join(said)


def candidates(scene: AnyScene, settings: Settings) -> Iterator[Candidate]:
    """Yield the right run, the mistakes, and every other method of the families that matter, one change at a time."""
    right = cache(partial(render, scene, settings))
    yield Candidate(RIGHT, "", right, settings, False)
    for twin in SHELF.values():
        yield from _faulty(twin, scene, settings, right)
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


def _faulty(
    twin: Twin, scene: AnyScene, settings: Settings, right: Callable[[], Frame]
) -> Iterator[Candidate]:
    """Yield the runs and pictures of a mistake; a mesh has no corners in the window that could be changed."""
    changed = twin.change_settings(settings)
    make = partial(Candidate, twin.name, twin.sentence, settings=changed, is_mistake=True)
    if isinstance(scene, ClipScene):
        for change in (twin.change_scene, *twin.other_scenes):
            one = replace(twin, change_scene=change)
            yield make(partial(one.draw, scene, settings), change_scene=change if twin.is_run else None)
    elif twin.takes_any_scene:
        yield make(partial(render, scene, changed))
    if twin.change_picture is not None and not (isinstance(scene, ClipScene) and not twin.is_run):
        change_picture = twin.change_picture
        yield make(lambda: change_picture(right(), scene), change_scene=None)


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
    What a lossy picture is compared with loses the same; then colours up to ``LOSSY_STEPS`` apart are equal.
    """
    check_size(drawn.size, scene.size)
    seen = _compared(_with_corners(scene, settings, drawn), settings, drawn, report)
    is_seen = not _is_blank(drawn) or bool((render(scene, settings).primitive >= 0).all())
    if (seen.is_right and is_seen) or seen.found:
        return seen
    others = [diagnose(scene, settings, each, report) for each in _as_coverage(drawn)]
    if others:
        nearest = min(others, key=lambda one: (int(one.differing.sum()), not one.is_right))
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
    other = Candidate("another-colour", sentence, lambda: frame, settings, True, change_scene=None)
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
    grey = Candidate("grey", sentence, compared.nearest.draw, settings, True, change_scene=None)
    is_known = compared.is_right or compared.found
    name = f"{compared.nearest.name} in grey"
    return Diagnosis(
        False,
        (grey, *compared.found) if is_known else (),
        grey if is_known else replace(grey, name=name),
        compared.differing,
        seen.from_right,
        compared.drawn,
    )


def _with_corners(scene: AnyScene, settings: Settings, drawn: Drawn) -> AnyScene:
    """Return a scene with corners in clip space, which mistakes may change, where that draws the same picture."""
    if isinstance(scene, ClipScene):
        if scene.attributes is not None:
            return scene
        return replace(scene, attributes=np.tile([0.0, 0.0, 0.0, 1.0], (*scene.clip.shape[:2], 1)))
    is_lit = settings.shading != "unlit" or any(mesh.texture is not None for mesh in scene.meshes)
    # A vertex shader places vertices, or what comes before the matrices makes them, and not the matrices alone.
    is_placed_before = scene.program is not None or scene.makes_positions
    if is_placed_before or (drawn.colors is not None and is_lit):
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
    right, *others = candidates(scene, settings)
    frame = right.draw()
    drawn = _with_background(drawn, frame, settings)
    from_right = _differing(frame, settings, drawn)
    # A run that draws almost nothing is near to any small picture, but not nearer than nothing.
    nothing = replace(
        frame,
        color=np.full_like(frame.color, scene.background),
        primitive=np.full_like(frame.primitive, -1),
    )
    unexplained = min(from_right.sum(), _differing(nothing, settings, drawn).sum())
    fits: dict[str, Candidate] = {}
    nearest, fewest = right, from_right
    for number, candidate in enumerate(others if from_right.any() else ()):
        if report is not None:
            report(number / len(others), "comparing")
        try:
            with np.errstate(all="ignore"):
                frame = candidate.draw()
        except ValueError:
            continue  # The scene lacks what this method needs.
        differing = _differing(frame, candidate.settings, drawn)
        if (
            differing.sum() < fewest.sum() and (frame.primitive >= 0).any()
        ):  # Nothing is near to any small picture.
            nearest, fewest = candidate, differing
        if not differing.any():
            fits.setdefault(candidate.name, candidate)
    if fewest.sum() > UNEXPLAINED * unexplained:
        nearest, fewest = right, from_right
    found = sorted(fits.values(), key=lambda each: not each.is_mistake)
    return Diagnosis(not from_right.any(), tuple(found), nearest, fewest, from_right, drawn)


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
    shown = _shown(frame, settings, drawn)
    pictures = [shown]
    if drawn.background is not None:
        ours, theirs = np.array(drawn.background, np.uint8)
        pictures.append(np.where((shown == ours).all(axis=2, keepdims=True), theirs, shown))
    if drawn.loses is not None:
        pictures = [drawn.loses(each) for each in pictures]
    return np.asarray(np.all([~_is_equal(drawn, each) for each in pictures], axis=0))


def _is_equal(drawn: Drawn, colors: Bytes) -> Flags:
    """Return where a picture has such colours, (H, W, 3 or 4) or one for all of it."""
    assert drawn.colors is not None
    return _is_close(drawn, drawn.colors, colors)


def _is_close(drawn: Drawn, some: Bytes, others: Bytes) -> Flags:
    """Return where colours (..., 3 or 4) are equal in a picture of this kind."""
    steps = 1 if drawn.loses is None else LOSSY_STEPS
    return np.asarray((np.abs(some.astype(int) - others) <= steps).all(axis=-1))


def _shown(frame: Frame, settings: Settings, drawn: Drawn) -> Bytes:
    """Return the bytes (H, W, 3 or 4) of a frame as a picture has them: over black, or with its alpha; or in grey."""
    assert drawn.colors is not None
    if drawn.colors.shape[2] == 4:
        shown = picture_bytes(frame.color, resolve(settings).blend_name)
    else:
        shown = to_display(frame.color).pixels[..., :3]
    if drawn.grey:
        grey = np.rint(sum(weight * shown[..., k] for k, weight in enumerate(drawn.grey)))
        shown = np.dstack([grey, grey, grey, shown[..., 3:]]).astype(np.uint8)
    return shown


def _with_background(drawn: Drawn, right: Frame, settings: Settings) -> Drawn:
    """Let another colour stand for the scene's background: the most frequent one where nothing should be drawn."""
    empty = right.primitive < 0
    if drawn.colors is None or not empty.any():
        return drawn
    ours = _shown(right, settings, drawn)[empty][0]
    colors, counts = np.unique(drawn.colors[empty], axis=0, return_counts=True)
    theirs = colors[np.argmax(counts)]
    if (_is_equal(drawn, theirs) | _is_equal(drawn, ours)).all() or _is_close(drawn, ours, theirs).all():
        return drawn  # Ink in the colour of the scene's background would vanish.
    return replace(drawn, background=(tuple(ours.tolist()), tuple(theirs.tolist())))


def _is_blank(drawn: Drawn) -> bool:
    """Return whether a picture is in a single colour."""
    return drawn.colors is not None and bool(_is_equal(drawn, drawn.colors[0, 0]).all())


def _as_coverage(drawn: Drawn) -> list[Drawn]:
    """Return what a picture in two colours may cover: the pixels of the one, or those of the other; in one, nothing."""
    if drawn.colors is None:
        return []
    if _is_blank(drawn):
        return [Drawn(covered=np.zeros(drawn.colors.shape[:2], bool))]
    first = _is_equal(drawn, drawn.colors[0, 0])
    if drawn.loses is not None:  # No pixel keeps its colour: each has about the one brightness or the other.
        brightness = drawn.colors[..., :3] @ np.array(next(iter(GREYS)))
        low, high = brightness.min(), brightness.max()
        if (np.minimum(brightness - low, high - brightness) > (high - low) / 4).any():
            return []
        first = (brightness > (low + high) / 2) == (brightness[0, 0] > (low + high) / 2)
    elif (drawn.colors[~first] != drawn.colors[~first][0]).any():
        return []
    return [Drawn(covered=~first), Drawn(covered=first)]


# What a comparison of pictures found, in the words of command line and window.


PIXELS_SHOWN = 20


def scene_text(title: str, scene: AnyScene) -> str:
    """Return which scene a picture is compared with."""
    return f"{title or 'the open scene'}, {scene.size[0]} x {scene.size[1]} pixels"


def right_text(drawn: Drawn) -> str:
    """Return what is right of a picture in which nothing differs: no more than was compared."""
    if drawn.covered is not None:
        return "exactly the pixels that this scene and its settings cover"
    if drawn.primitive is not None:
        return "every pixel shows the triangle that this scene and its settings draw there"
    return "every pixel has the colour that this scene and its settings draw there"


def pixels_text(differing: Flags, name: str) -> str:
    """Return how many pixels differ from the picture of a ``name``, and the first of them as (column, row)."""
    places = [f"({column}, {row})" for row, column in np.argwhere(differing)[:PIXELS_SHOWN].tolist()]
    count = int(differing.sum())
    more = f" and {count - PIXELS_SHOWN} more" if count > PIXELS_SHOWN else ""
    verb = "pixel differs" if count == 1 else "pixels differ"
    return f"{count} of {differing.size} {verb} from {name}: {' '.join(places)}{more}"
