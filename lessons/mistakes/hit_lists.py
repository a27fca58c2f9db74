"""Mistakes of lists of hits: their order, and how they are resolved from front to back."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from core import Settings
from core.scene import ClipScene
from lessons.mistakes.depths import cards, first_is_nearest
from lessons.mistakes.twin import Case, Twin, WrongRule, frame_colors

HALF = Fraction(1, 2)


class Hit(NamedTuple):
    """A hit of one pixel; a smaller depth is nearer."""

    depth: int
    grey: int
    alpha: Fraction


def resolved(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Return the grey of a pixel with these hits, given in drawing order, over a background."""
    return _from_front(sorted(hits, key=lambda hit: hit.depth), background)


def _from_front(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    grey, rest = Fraction(0), Fraction(1)
    for hit in hits:
        grey += rest * hit.alpha * hit.grey
        rest *= 1 - hit.alpha
    return (grey + rest * background,)


def unsorted(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Resolve the list as it was appended."""
    return _from_front(hits, background)


def farthest_first(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Resolve from the back as if it were the front."""
    return _from_front(sorted(hits, key=lambda hit: -hit.depth), background)


def own_alphas(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Add each hit with its own alpha, whatever is in front of it."""
    (behind,) = _from_front([hit._replace(grey=0) for hit in hits], background)
    return (sum((hit.alpha * hit.grey for hit in hits), behind),)


def listed_and_blended(hits: Sequence[Hit]) -> tuple[int, int]:
    """Return how many hits a list holds, and how many are blended until one lets nothing through."""
    return len(hits), _until_opaque(sorted(hits, key=lambda hit: hit.depth))


def _until_opaque(hits: Sequence[Hit]) -> int:
    return next((count for count, hit in enumerate(hits, start=1) if hit.alpha == 1), len(hits))


def nearer_ones(hits: Sequence[Hit]) -> tuple[int, int]:
    """List only what is nearer than all before it, as a z-buffer keeps it."""
    kept = [hit for k, hit in enumerate(hits) if all(hit.depth < other.depth for other in hits[:k])]
    return listed_and_blended(kept)


def far_is_near(scene: ClipScene) -> ClipScene:
    """Turn all depths around, so that the farthest stands in front."""
    clip = scene.clip.copy()
    clip[..., 2] *= -1
    return replace(scene, clip=clip)


LISTS = Settings(visibility="hit-lists", blend="over")
_GLASS = cards([0.75] * 3, [0.25] * 3, alpha=0.5)
_ALONE = cards([0.25] * 3, alpha=0.5)

TWINS = (
    Twin(
        "list-not-sorted",
        "The list was resolved in the order of drawing. Sort it by depth first.",
        Case(_GLASS, LISTS, frame_colors),
        Case(cards([0.25] * 3, [0.75] * 3, alpha=0.5), LISTS, frame_colors),
        change_scene=first_is_nearest,
    ),
    Twin(
        "sorted-farthest-first",
        "The list was sorted from the farthest hit on, and resolved from there. The nearest hit is its front.",
        Case(_GLASS, LISTS, frame_colors),
        Case(_ALONE, LISTS, frame_colors),
        change_scene=far_is_near,
    ),
)

_TWO = (Hit(5, 8, HALF), Hit(2, 0, HALF))
_SORTED = (Hit(2, 0, HALF), Hit(5, 8, HALF))
_CLOSED = (Hit(7, 4, HALF), Hit(5, 8, Fraction(1)), Hit(2, 0, HALF))
RULES = (
    WrongRule("list-not-sorted", TWINS[0].sentence, resolved, unsorted, (_TWO, 0), (_SORTED, 0)),
    WrongRule("sorted-farthest-first", TWINS[1].sentence, resolved, farthest_first, (_TWO, 0), (_TWO[:1], 0)),
    WrongRule(
        "own-alpha-for-share",
        "Each hit was added with its own alpha. What is in front of it lets only a part of it through.",
        resolved,
        own_alphas,
        (_TWO, 0),
        (_TWO[:1], 0),
    ),
    WrongRule(
        "behind-opaque-blended",
        "Hits behind an opaque one were blended. It lets nothing through, so the list ends there.",
        listed_and_blended,
        lambda hits: (len(hits), len(hits)),
        (_CLOSED,),
        (_TWO,),
    ),
    WrongRule(
        "opaque-in-drawing-order",
        "Hits were counted up to the opaque one in the order of drawing. The list is sorted first.",
        listed_and_blended,
        lambda hits: (len(hits), _until_opaque(hits)),
        (_CLOSED[1:],),
        (_TWO,),
    ),
    WrongRule(
        "only-nearer-listed",
        "Only hits nearer than those before were listed, as a z-buffer keeps them. A list takes all.",
        listed_and_blended,
        nearer_ones,
        (_SORTED,),
        (_TWO,),
    ),
)
