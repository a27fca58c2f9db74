"""What a picture holds says whether it is worth more than one process."""

from dataclasses import replace

import pytest

from core import Settings, draw_picture
from core.fast_path.workers.sharing import COLOR, FRAGMENT, Load, load_of
from tests.core.fast_path.band_scenes import SCENES, SPANS, ball

# Bands of a supersampled picture have the bytes of the whole, but look at other parts exactly: no scene of `SCENES`.
SUPERSAMPLED = {"supersampled": (ball(), replace(SPANS, antialiasing="ssaa-4"))}


@pytest.mark.parametrize("name", [*SCENES, *SUPERSAMPLED])
def test_every_way_of_drawing_has_its_estimate(name: str) -> None:
    scene, settings = (SCENES | SUPERSAMPLED)[name]
    picture = draw_picture(scene, settings)
    load = load_of(picture)
    assert load.visibility in FRAGMENT
    assert load.color in COLOR
    assert load.seconds >= load.pixels * 1e-9
    assert load.visible == picture.route.visible


def test_more_work_is_worth_more() -> None:
    small, large = Load(100, 64 * 64, 2000, 1500), Load(80_000, 1 << 20, 600_000, 600_000)
    assert not small.is_worth(2)
    assert large.is_worth(2)
    assert large.gain(3) > large.gain(2)


def test_a_scene_without_a_triangle_is_not_worth_it() -> None:
    scene, _ = SCENES["nothing"]
    assert not load_of(draw_picture(scene, Settings())).is_worth(2)
