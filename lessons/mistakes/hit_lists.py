"""Mistakes of lists of hits: their order, and how they are resolved from front to back."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from core import Settings
from core.scene import ClipScene
from lessons.mistakes.depths import cards, first_is_nearest
from lessons.mistakes.twin import Case, Twin, frame_colors, wrong_rule

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


def listed_and_blended(hits: Sequence[Hit]) -> tuple[int, int]:
    """Return how many hits a list holds, and how many are blended until one lets nothing through."""
    return len(hits), _until_opaque(sorted(hits, key=lambda hit: hit.depth))


def _until_opaque(hits: Sequence[Hit]) -> int:
    return next((count for count, hit in enumerate(hits, start=1) if hit.alpha == 1), len(hits))


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


@wrong_rule(resolved, shows=(_TWO, 0), hides=(_SORTED, 0), twin=TWINS[0])
def list_not_sorted(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Resolve the list as it was appended."""
    return _from_front(hits, background)


@wrong_rule(resolved, shows=(_TWO, 0), hides=(_TWO[:1], 0), twin=TWINS[1])
def sorted_farthest_first(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Resolve from the back as if it were the front."""
    return _from_front(sorted(hits, key=lambda hit: -hit.depth), background)


@wrong_rule(resolved, shows=(_TWO, 0), hides=(_TWO[:1], 0))
def own_alpha_for_share(hits: Sequence[Hit], background: int) -> tuple[Fraction]:
    """Each hit was added with its own alpha. What is in front of it lets only a part of it through."""
    (behind,) = _from_front([hit._replace(grey=0) for hit in hits], background)
    return (sum((hit.alpha * hit.grey for hit in hits), behind),)


@wrong_rule(listed_and_blended, shows=(_CLOSED,), hides=(_TWO,))
def behind_opaque_blended(hits: Sequence[Hit]) -> tuple[int, int]:
    """Hits behind an opaque one were blended. It lets nothing through, so the list ends there."""
    return (len(hits), len(hits))


@wrong_rule(listed_and_blended, shows=(_CLOSED[1:],), hides=(_TWO,))
def opaque_in_drawing_order(hits: Sequence[Hit]) -> tuple[int, int]:
    """Hits were counted up to the opaque one in the order of drawing. The list is sorted first."""
    return (len(hits), _until_opaque(hits))


@wrong_rule(listed_and_blended, shows=(_SORTED,), hides=(_TWO,))
def only_nearer_listed(hits: Sequence[Hit]) -> tuple[int, int]:
    """Only hits nearer than those before were listed, as a z-buffer keeps them. A list takes all."""
    kept = [hit for k, hit in enumerate(hits) if all(hit.depth < other.depth for other in hits[:k])]
    return listed_and_blended(kept)
