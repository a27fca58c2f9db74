import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from core import ClipScene, Settings, render
from core.framebuffer.blending import additive, opaque, over
from core.framebuffer.display import to_display

channel = st.floats(0, 4, width=32)
share = st.floats(0, 1)
fragment = st.tuples(channel, channel, channel, share)
pixel = st.tuples(channel, channel, channel, st.floats(0, 1, width=32))


def blend(rule, source, destination):
    return rule(np.array(source, np.float64), np.array(destination, np.float32))


def test_half_red_over_backgrounds():
    red = [[1.0, 0.0, 0.0, 0.5]] * 3
    background = [[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 1, 1]]
    assert blend(over, red, background).tolist() == [[0.5, 0, 0, 0.5], [0.5, 0, 0, 1], [0.5, 0, 0.5, 1]]


def test_opaque_stores_the_fragment_with_its_alpha():
    result = blend(opaque, [[0.1, 2.0, 0.3, 0.5]], [[9, 9, 9, 9]])
    assert result.dtype == np.float32
    assert result.tolist() == [[float(np.float32(0.1)), 2.0, float(np.float32(0.3)), 0.5]]


def test_order_matters():
    red, blue = [[1.0, 0.0, 0.0, 0.5]], [[0.0, 0.0, 1.0, 0.5]]
    black = np.array([[0, 0, 0, 1]], np.float32)
    assert over(np.array(blue), over(np.array(red), black)).tolist() == [[0.25, 0, 0.5, 1]]
    assert over(np.array(red), over(np.array(blue), black)).tolist() == [[0.5, 0, 0.25, 1]]


@given(source=fragment, destination=pixel)
def test_alpha_zero_and_one(source, destination):
    clear, full = [*source[:3], 0.0], [*source[:3], 1.0]
    assert blend(over, [clear], [destination]).tolist() == [list(destination)]
    assert blend(over, [full], [destination]).tolist() == [full]


@given(source=fragment, destination=pixel)
def test_colour_stays_between_and_alpha_never_falls(source, destination):
    result = blend(over, [source], [destination])[0]
    for value, new, old in zip(result[:3], source, destination, strict=False):
        assert min(new, old) * (1 - 1e-6) <= value <= max(new, old) * (1 + 1e-6) + 1e-44
    assert destination[3] * (1 - 1e-6) <= result[3] <= 1 + 1e-6


def test_additive_keeps_what_is_there_and_cuts_nothing_off():
    light = [[1.0, 0.25, 0.0, 0.5], [3.0, 0.0, 0.0, 1.0]]
    there = [[0.25, 0.5, 0.75, 1.0], [0.5, 0.5, 0.0, 1.0]]
    assert blend(additive, light, there).tolist() == [[0.75, 0.625, 0.75, 1.5], [3.5, 0.5, 0.0, 2.0]]


@given(source=fragment, destination=pixel)
def test_additive_with_alpha_zero_changes_nothing(source, destination):
    assert blend(additive, [[*source[:3], 0.0]], [destination]).tolist() == [list(destination)]


@given(first=fragment, second=fragment, destination=pixel)
def test_the_order_of_additive_fragments_does_not_matter(first, second, destination):
    one, other = (
        blend(additive, [b], blend(additive, [a], [destination])[0][None])
        for a, b in ((first, second), (second, first))
    )
    # Two roundings to float32 on either way.
    assert np.allclose(one, other, rtol=4 * 2.0**-24, atol=1e-44)


def test_only_the_display_cuts_light_off():
    whole = [[[-1, -1, 0, 1], [3, -1, 0, 1], [-1, 3, 0, 1]]] * 3
    color = np.full((3, 3, 4), 0.5)
    scene = ClipScene(whole, color, (2, 2))
    frame = render(scene, Settings(blend="additive", visibility="last-drawn"))
    assert (frame.color == [0.75, 0.75, 0.75, 1.5]).all()
    brighter = ClipScene(whole, 4 * color, (2, 2))
    frame = render(brighter, Settings(blend="additive", visibility="last-drawn"))
    assert (frame.color == [12, 12, 12, 6]).all()
    assert (to_display(frame.color).pixels == 255).all()


@given(alphas=st.lists(share, min_size=1, max_size=6), background=channel)
def test_layers_of_one_colour_are_one_layer(alphas, background):
    """n layers of a colour let the product of (1 - alpha) of the background through."""
    color = np.array([[background, 0, 0, 1]], np.float32)
    for alpha in alphas:
        color = over(np.array([[1.0, 0.0, 0.0, alpha]]), color)
    through = np.prod([1 - alpha for alpha in alphas])
    assert abs(color[0, 0] - (1 + (background - 1) * through)) < 1e-5
    assert abs(color[0, 3] - 1) < 1e-6
