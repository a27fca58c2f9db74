from dataclasses import replace

import numpy as np
import pytest

from app.session.document import focus_on, open_document
from app.session.session import Session
from app.views.texture_footprint import (
    PIXEL_SQUARE,
    no_texture_reason,
    pixel_in_texture,
    texture_pictures,
    tile_shift,
)
from core import ClipScene, Settings, Texture
from core.interpolation.interpolation import plane_value, value_plane
from lessons.scenes import make_scene


def floor_session(**settings: str) -> Session:
    return Session(open_document(make_scene("textured-floor"), "floor", settings=Settings(**settings)))


@pytest.mark.parametrize("texture_filter", ["bilinear", "nearest"])
@pytest.mark.parametrize("pixel_center", ["half", "integer"])
def test_corners_are_uv_by_the_planes(qapp, texture_filter, pixel_center):
    source = floor_session(texture_filter=texture_filter, pixel_center=pixel_center).trace.source
    shade = source.fragments
    geometry = source.geometry
    uv = geometry.primitives.varyings[..., geometry.primitives.layout["uv"]]
    for fragment in range(0, len(shade), len(shade) // 40):
        column, row = int(shade.column[fragment]), int(shade.row[fragment])
        primitive = int(shade.primitive[fragment])
        at = pixel_in_texture(source, primitive, column, row)
        places = np.array([column, row]) + source.raster.center + PIXEL_SQUARE
        which = np.full(4, primitive)
        one = plane_value(geometry.inverse_w_plane, which, *places.T)
        if (one > 0).all():
            for axis in range(2):
                plane = value_plane(geometry.planes, uv[..., axis])
                assert np.allclose(at.corners[:, axis], plane_value(plane, which, *places.T) / one, rtol=1e-9)
        assert np.array_equal(at.center, source.interpolated[1][fragment, geometry.primitives.layout["uv"]])


def test_texels_and_shares_are_those_of_the_trace(qapp):
    session = floor_session()
    shade = session.trace.stage("shade")
    row = 400
    session.set_pin(tuple(int(value) for value in shade.pixel[row]))
    (picture,), _ = texture_pictures(session.moment)
    footprint = picture.footprints[0]
    assert np.array_equal(footprint.texels, shade.columns["texels"][row])
    assert np.array_equal(footprint.shares, shade.columns["shares"][row])
    size = np.array(picture.size)
    assert np.array_equal(np.mod(footprint.reads, size), footprint.texels)
    assert np.allclose(np.mod(footprint.center, size), np.mod(shade.columns["texel_position"][row], size))
    assert (footprint.center >= 0).all()
    assert (footprint.center <= size).all()
    assert footprint.is_pinned


def test_of_two_mipmap_levels_both_are_shown_with_their_texels(qapp):
    session = floor_session(texture_filter="trilinear")
    shade = session.trace.stage("shade")
    fractions = shade.columns["level_fraction"]
    row = int(np.flatnonzero((fractions > 0.2) & (fractions < 0.8))[0])
    session.set_pin(tuple(int(value) for value in shade.pixel[row]))
    pictures, _ = texture_pictures(session.moment)
    sizes = shade.columns["level_sizes"][row].tolist()
    assert [*pictures[0].size, *pictures[1].size] == sizes
    for name, picture, share in zip(
        ("near", "far"), pictures, (1 - fractions[row], fractions[row]), strict=True
    ):
        footprint = picture.footprints[0]
        assert np.array_equal(footprint.texels, shade.columns[f"{name}_texels"][row])
        assert np.array_equal(footprint.shares, shade.columns[f"{name}_shares"][row] * share)
        assert np.array_equal(np.mod(footprint.reads, picture.size), footprint.texels)
        assert "% of the colour" in picture.caption
    finer, coarser = (picture.footprints[0] for picture in pictures)
    assert np.allclose(finer.corners / pictures[0].size, coarser.corners / pictures[1].size)
    assert sum(footprint.shares.sum() for footprint in (finer, coarser)) == pytest.approx(1)


def test_a_pixel_that_reads_another_level_has_an_outline_and_no_texels(qapp):
    session = floor_session(texture_filter="mipmap-nearest")
    shade = session.trace.stage("shade")
    levels = shade.columns["levels"][:, 0]
    first, second = (int(np.flatnonzero(levels == level)[0]) for level in np.unique(levels)[:2])
    session.set_pin(tuple(int(value) for value in shade.pixel[first]))
    session.set_hover(tuple(int(value) for value in shade.pixel[second]))
    (picture,), _ = texture_pictures(session.moment)
    pinned, hovered = picture.footprints
    assert len(pinned.texels) == 4
    assert len(hovered.texels) == 0
    assert np.isfinite(hovered.corners).all()


@pytest.mark.parametrize("interpolation", ["affine", "affine-n", "flat"])
def test_footprints_of_every_interpolation(qapp, interpolation):
    session = floor_session(texture_filter="trilinear", interpolation=interpolation)
    shade = session.trace.stage("shade")
    session.set_pin(tuple(int(value) for value in shade.pixel[300]))
    pictures, _ = texture_pictures(session.moment)
    assert np.array_equal(pictures[0].footprints[0].texels, shade.columns["near_texels"][300])


def test_the_pinned_and_the_hovered_pixel_are_shown(qapp):
    session = floor_session()
    fragments = session.trace.source.fragments
    first, second = ((int(fragments.column[k]), int(fragments.row[k])) for k in (200, 600))
    session.set_pin(first)
    session.set_hover(second)
    (picture,), _ = texture_pictures(session.moment)
    assert [footprint.is_pinned for footprint in picture.footprints] == [True, False]
    assert f"pinned pixel {first}" in picture.caption


def test_a_pixel_without_a_fragment_says_so(qapp):
    session = floor_session()
    session.set_pin((0, session.trace.source.raster.shape[0] - 1))
    (picture,), _ = texture_pictures(session.moment)
    assert picture.footprints == ()
    assert "no textured fragment" in picture.caption


@pytest.mark.parametrize(
    ("wrap", "center", "shift"),
    [
        ("repeat", [2.5, -0.25], [2, -1]),
        ("mirror", [2.5, 1.5], [2, 0]),
        ("mirror", [-0.5, 3.5], [-2, 2]),
        ("clamp", [9.0, -4.0], [0, 0]),
        ("repeat", [np.nan, 1.0], [0, 0]),
    ],
)
def test_footprints_are_moved_by_whole_periods(wrap, center, shift):
    assert tile_shift(np.array(center), wrap).tolist() == shift


def test_over_the_horizon_there_is_no_quad(qapp):
    texture = Texture(np.ones((2, 2, 3), np.float32))
    # Reaches behind the eye: 1/w falls to 0 a quarter of the way up.
    clip = np.array([[[-1.0, -1, 0, 1], [1, -1, 0, 1], [0, -0.4, 0, -0.2]]])
    uv = np.array([[[0.0, 0], [1, 0], [0.5, 4]]])
    session = Session(open_document(ClipScene(clip, uv, (16, 12), texture), "typed"))
    source = session.trace.source
    inverse = source.geometry.inverse_w_plane
    quads = [pixel_in_texture(source, 0, column, row) for column in range(16) for row in range(12)]
    finite = np.array([np.isfinite(at.corners).all() for at in quads])
    places = np.array([[column, row] for column in range(16) for row in range(12)]) + 0.5
    lowest = np.min(
        [plane_value(inverse, np.zeros(len(places), int), *(places + corner).T) for corner in PIXEL_SQUARE],
        axis=0,
    )
    assert finite.any()
    assert not finite.all()
    assert np.array_equal(finite, lowest > 0)


def test_scenes_without_a_texture_say_why(qapp):
    typed = Session(open_document(make_scene("single-triangle"), "typed"))
    assert texture_pictures(typed.moment)[0] == ()
    assert "no texture" in texture_pictures(typed.moment)[1]
    cube = Session(open_document(make_scene("cube"), "cube"))
    assert texture_pictures(cube.moment) == ((), "No mesh of this scene has a texture.")
    scene = make_scene("textured-floor")
    plain = replace(scene.meshes[0], texture=None)
    mixed = Session(focus_on(open_document(replace(scene, meshes=(scene.meshes[0], plain)), "mixed"), 2))
    assert no_texture_reason(mixed, 2) == "The mesh of triangle 2 has no texture."
    assert texture_pictures(mixed.moment)[0] == ()
