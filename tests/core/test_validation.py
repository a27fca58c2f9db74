"""Bad input is refused with a sentence that says what was wanted and what came."""

from math import inf, nan, pi

import numpy as np
import pytest

from core import (
    Camera,
    ClipScene,
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    Settings,
    Texture,
    draw_triangles,
)
from core.coverage.fill_rule import owns
from core.methods import Method, MethodTable, table
from core.records.arrays import checked, checked_size, read_only
from core.records.listing import listing
from core.setting_texts import settings_from_texts
from core.settings import families

TRIANGLE = np.array([[[0.0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1]]])
POSITIONS = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


def camera(**changes) -> Camera:
    return Camera(**{"eye": [0, 0, 5], "target": [0, 0, 0], **changes})


def mesh(**changes) -> Mesh:
    return Mesh(**{"positions": POSITIONS, "triangles": [[0, 1, 2]], **changes})


@pytest.mark.parametrize(
    ("values", "shape", "dtype", "message"),
    [
        ([1.0, 2.0], (3, 2), float, r"^corners must be \(3, 2\), got \(2,\)$"),
        (np.zeros((2, 2)), (3, 2), float, r"^corners must be \(3, 2\), got \(2, 2\)$"),
        (np.zeros((2, 3)), ("T", 2), float, r"^corners must be \(T, 2\), got \(2, 3\)$"),
        (5.0, ("T",), float, r"^corners must be \(T,\), got \(\)$"),
        ([["a", "b"]], ("T", 2), float, r"^corners must be numbers, got <U1$"),
        ([[1j, 2]], ("T", 2), float, r"^corners must be numbers, got complex128$"),
        ([[1.0, nan]], ("T", 2), float, r"^corners must be finite, got nan at \(0, 1\)$"),
        ([[1.0, 0.0], [-inf, 0.0]], ("T", 2), float, r"^corners must be finite, got -inf at \(1, 0\)$"),
        ([[1.0, 0.5]], ("T", 2), np.int64, r"^corners must be whole numbers, got float64$"),
    ],
)
def test_arrays_are_checked_for_axes_shape_type_and_value(values, shape, dtype, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        checked("corners", values, shape, dtype)


def test_checked_arrays_are_read_only_copies() -> None:
    given = np.zeros((2, 2))
    kept = checked("corners", given, ("T", 2))
    given[0, 0] = 7
    assert kept[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        kept[0, 0] = 1
    view = read_only(given)
    with pytest.raises(ValueError, match="read-only"):
        view[0, 0] = 1
    assert given.flags.writeable
    assert checked("faces", [2.0, 3.0], ("T",), np.int64).dtype == np.int64
    assert np.isnan(checked("corners", [nan], ("T",), finite=False)).all()


@pytest.mark.parametrize(
    ("size", "message"),
    [
        ((0, 5), "size must be 1 to 100 pixels each way, got 0x5"),
        ((5, 101), "size must be 1 to 100 pixels each way, got 5x101"),
        ((-3, 5), "size must be 1 to 100 pixels each way, got -3x5"),
        ((5,), r"size must be two whole numbers \(width, height\), got \(5,\)"),
        ((5.5, 4), r"size must be two whole numbers \(width, height\), got \(5.5, 4\)"),
        ((nan, 4), r"size must be two whole numbers \(width, height\), got \(nan, 4\)"),
        (("5", 4), r"size must be two whole numbers \(width, height\), got \('5', 4\)"),
        ((None, 4), r"size must be two whole numbers \(width, height\), got \(None, 4\)"),
        (5, r"size must be two whole numbers \(width, height\), got 5"),
    ],
)
def test_sizes(size, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}$"):
        checked_size("size", size, 100)


def test_sizes_that_are_whole_numbers_of_any_type() -> None:
    assert checked_size("size", (np.int32(8), 6.0), 100) == (8, 6)
    assert checked_size("size", np.array([8, 6], np.int32), 100) == (8, 6)
    assert ClipScene(TRIANGLE, size=(16384, 1)).size == (16384, 1)
    with pytest.raises(ValueError, match="1 to 16384"):
        ClipScene(TRIANGLE, size=(16385, 1))


def test_a_texture_may_be_given_as_its_pixels() -> None:
    pixels = np.arange(12.0).reshape(2, 2, 3)
    coordinates = np.array([[[0.25, 0.25], [0.75, 0.25], [0.25, 0.75]]])
    given = draw_triangles(TRIANGLE, 4, 4, coordinates, pixels)
    wanted = draw_triangles(TRIANGLE, 4, 4, coordinates, Texture(pixels))
    assert given.color.max() > 1
    np.testing.assert_array_equal(given.color, wanted.color)
    with pytest.raises(ValueError, match=r"^texture pixels must be \(h, w, C\), got \(2, 2\)$"):
        draw_triangles(TRIANGLE, 4, 4, coordinates, pixels[..., 0])


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"triangles": np.zeros((0, 3), int)}, "mesh has no triangles"),
        ({"triangles": [[0, 1, 2], [0, 1, 3]]}, r"triangle 1 of mesh names vertex \[0, 1, 3\], there are 3"),
        ({"triangles": [[0, 1, -1]]}, r"triangle 0 of mesh names vertex \[0, 1, -1\], there are 3"),
        ({"triangles": [[0, 1]]}, r"triangles must be \(T, 3\), got \(1, 2\)"),
        (
            {"positions": [[0, 0, 0], [1, nan, 0], [0, 1, 0]]},
            r"positions must be finite, got nan at \(1, 1\)",
        ),
        ({"positions": np.zeros((3, 2))}, r"positions must be \(N, 3\), got \(3, 2\)"),
        ({"normals": np.zeros((2, 3))}, r"normals must be \(3, 3\), got \(2, 3\)"),
        ({"uvs": np.zeros((3, 3))}, r"uvs must be \(N, 2\), got \(3, 3\)"),
        ({"colors": np.zeros((4, 4))}, r"colors must be \(3, 4\), got \(4, 4\)"),
        ({"faces": [0, 1]}, r"faces must be \(1,\), got \(2,\)"),
        ({"transform": np.eye(3)}, r"transform must be \(4, 4\), got \(3, 3\)"),
        ({"name": "bunny", "triangles": [[0, 1, 9]]}, "triangle 0 of bunny names vertex"),
    ],
)
def test_meshes(changes, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        mesh(**changes)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"near": 2.0, "far": 2.0}, "near must be less than far, got near 2, far 2"),
        ({"near": 3.0, "far": 2.0}, "near must be less than far, got near 3, far 2"),
        ({"near": 0.0}, "near must be positive for a perspective camera, got 0"),
        ({"near": -1.0}, "near must be positive for a perspective camera, got -1"),
        ({"far": inf}, "camera far must be finite, got inf"),
        ({"field_of_view": nan}, "camera field_of_view must be finite, got nan"),
        ({"field_of_view": 0.0}, "field of view must be between 0 and 180 degrees, got 0"),
        ({"field_of_view": pi}, "field of view must be between 0 and 180 degrees, got 180"),
        ({"projection": "orthographic", "view_height": 0.0}, "view height must be positive, got 0"),
        ({"projection": "fisheye"}, "projection must be perspective or orthographic, got fisheye"),
        ({"target": [0, 0, 5]}, "camera eye and target must differ"),
        ({"up": [0, 0, 1]}, "camera up must not be parallel to the viewing direction"),
        ({"up": [0, 0, 0]}, "camera up must not be parallel to the viewing direction"),
        ({"eye": [0, 0]}, r"camera eye must be \(3,\), got \(2,\)"),
        ({"eye": [0, nan, 0]}, r"camera eye must be finite, got nan at \(1,\)"),
    ],
)
def test_cameras(changes, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        camera(**changes)


def test_an_orthographic_camera_may_have_its_near_plane_behind_it() -> None:
    assert camera(projection="orthographic", near=-5.0, far=5.0).near == -5


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Scene((), camera()), "a scene needs at least one mesh"),
        (lambda: Scene((mesh(),), camera(), background=[0, 0, 0]), r"background must be \(4,\), got \(3,\)"),
        (lambda: Scene((mesh(),), camera(), size=(0, 4)), "size must be 1 to 16384 pixels each way, got 0x4"),
        (lambda: ClipScene(np.zeros((3, 4))), r"clip must be \(T, 3, 4\), got \(3, 4\)"),
        (lambda: ClipScene(TRIANGLE * nan), r"clip must be finite, got nan at \(0, 0, 0\)"),
        (
            lambda: ClipScene(TRIANGLE, np.zeros((2, 3, 4))),
            r"attributes must be \(1, 3, K\), got \(2, 3, 4\)",
        ),
        (lambda: ClipScene(TRIANGLE, np.zeros((1, 4))), r"attributes must be \(T, 3, K\), got \(1, 4\)"),
        (
            lambda: ClipScene(TRIANGLE, shared=[[0, 1, 2], [2, 1, 0]]),
            r"shared must be \(1, 3\), got \(2, 3\)",
        ),
        (
            lambda: ClipScene(TRIANGLE, np.zeros((1, 3, 1)), texture=Texture(np.ones((1, 1, 3)))),
            r"a texture needs attributes \(T, 3, 2 or more\), got \(1, 3, 1\)",
        ),
        (lambda: Texture(np.ones((2, 2))), r"texture pixels must be \(h, w, C\), got \(2, 2\)"),
        (
            lambda: Texture(np.ones((2, 2, 2))),
            r"texture pixels must be \(h, w, 1, 3 or 4\) and not empty, got \(2, 2, 2\)",
        ),
        (lambda: Texture(np.ones((0, 2, 3))), r"not empty, got \(0, 2, 3\)"),
        (lambda: Texture(np.full((1, 1, 3), nan)), r"texture pixels must be finite, got nan at \(0, 0, 0\)"),
        (lambda: DirectionalLight([0, 0, 0]), r"light direction must not be \(0, 0, 0\)"),
        (lambda: DirectionalLight([0, 0]), r"light direction must be \(3,\), got \(2,\)"),
        (lambda: PointLight([0, 0, inf]), r"light position must be finite, got inf at \(2,\)"),
        (lambda: PointLight([0, 0, 0], [1, 1]), r"light color must be \(3,\), got \(2,\)"),
        (lambda: Material(ambient=1.5), "material ambient must be from 0 to 1, got 1.5"),
        (lambda: Material(specular=nan), "material specular must be from 0 to 1, got nan"),
        (lambda: Material(shininess=0), "material shininess must be above 0 and at most 10000, got 0"),
    ],
)
def test_scenes(make, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_a_scene_cannot_be_changed() -> None:
    clip = TRIANGLE.copy()
    scene = ClipScene(clip)
    clip[0, 0, 0] = 9
    assert scene.clip[0, 0, 0] == 0
    for array in (
        scene.clip,
        scene.attributes,
        scene.background,
        mesh().positions,
        mesh().triangles,
        camera().eye,
    ):
        assert not array.flags.writeable
    with pytest.raises(AttributeError, match="cannot assign to field"):
        scene.size = (4, 4)


@pytest.mark.parametrize("family", families())
def test_settings_list_the_choices_of_every_family(family: str) -> None:
    choices = ", ".join(table.names(family))
    with pytest.raises(ValueError, match=f"^{family} must be one of {choices}, got nonsense$"):
        Settings(**{family: "nonsense"})
    for name in table.names(family):
        assert getattr(Settings(**{family: name}), family) == name


@pytest.mark.parametrize("block_size", [0, -1, 257, 2.5])
def test_block_sizes(block_size: float) -> None:
    with pytest.raises(
        ValueError, match=f"^block_size must be a whole number from 1 to 256, got {block_size}$"
    ):
        Settings(block_size=block_size)


def test_settings_of_texts() -> None:
    assert settings_from_texts({"fill": "blocks", "block_size": "4"}) == Settings(fill="blocks", block_size=4)
    assert settings_from_texts({}) == Settings()
    with pytest.raises(ValueError, match=r"^setting must be one of .*block_size.*fill.*, got fil$"):
        settings_from_texts({"fil": "blocks"})
    with pytest.raises(ValueError, match=r"^fill must be one of .*, got nonsense$"):
        settings_from_texts({"fill": "nonsense"})
    with pytest.raises(ValueError, match=r"^block_size must be a whole number, got four$"):
        settings_from_texts({"block_size": "four"})


def test_settings_are_values() -> None:
    assert Settings() == Settings()
    assert Settings(fill="blocks") != Settings()
    assert len({Settings(), Settings(), Settings(cull="back")}) == 2
    with pytest.raises(AttributeError, match="cannot assign to field"):
        Settings().fill = "blocks"


def test_every_family_of_the_settings_is_in_the_table_and_the_other_way_round() -> None:
    assert families() == table.families


def test_every_method_says_what_it_is() -> None:
    for row in table:
        assert row.title, row
        assert row.source, row
        assert row.exact_for, row
        assert row.name == row.name.lower(), row
        assert " " not in row.name, row
        assert row.function.__doc__, row


def test_a_name_is_registered_once() -> None:
    methods = MethodTable({"fill": (__name__,)})
    row = Method("fill", "blocks", "Blocks", test_a_name_is_registered_once, "source", "everything")
    methods.add(row)
    with pytest.raises(ValueError, match="fill has a method blocks already"):
        methods.add(row)
    assert methods.families == ("fill",)
    assert methods.get("fill", "blocks") is row
    with pytest.raises(ValueError, match="setting must be one of fill, got cull"):
        methods.get("cull", "none")


def test_a_method_must_stand_in_a_file_of_its_family() -> None:
    methods = MethodTable({"fill": ("core.coverage.fills", "core.coverage.scanline")})
    row = Method("fill", "blocks", "Blocks", test_a_name_is_registered_once, "source", "everything")
    with pytest.raises(ValueError, match=r"of fill must stand in core\.coverage, got blocks in"):
        methods.add(row)


def test_a_listing_is_the_source_without_labels_and_half_as_indented() -> None:
    read = listing(owns)
    lines = read.source.splitlines()
    assert lines[read.lines["right"] - 1] == "    return a > 0"
    assert lines[read.lines["up"] - 1] == "  return b > 0"
    assert "#:" not in read.source
    assert read.function is owns
