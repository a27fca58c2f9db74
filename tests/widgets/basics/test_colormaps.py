import numpy as np
import pytest

from widgets.basics.image import COLORMAPS, colormap_table, id_table


@pytest.mark.parametrize("name", COLORMAPS)
def test_tables_are_read_only_bytes(name: str) -> None:
    table = colormap_table(name)
    assert table.dtype == np.uint8
    assert table.shape[1] == 3
    assert not table.flags.writeable


@pytest.mark.parametrize("name", ["viridis", "cividis"])
def test_maps_are_those_of_pyqtgraph(name: str) -> None:
    from pyqtgraph import colormap

    np.testing.assert_array_equal(colormap_table(name), colormap.get(name).getLookupTable(nPts=256))


def test_viridis_runs_from_purple_to_yellow() -> None:
    table = colormap_table("viridis")
    assert table[0].tolist() == [68, 1, 84]
    assert table[-1].tolist() == [253, 231, 37]


@pytest.mark.parametrize("name", ["viridis", "cividis", "grey"])
def test_sequential_maps_grow_lighter(name: str) -> None:
    light = colormap_table(name) @ np.array([0.2126, 0.7152, 0.0722])
    assert (np.diff(light) > -1.0).all()
    assert light[-1] - light[0] > 150


@pytest.mark.parametrize(("name", "middle", "outward"), [("diverging", 255, -1), ("diverging-dark", 18, 1)])
def test_a_difference_of_zero_looks_like_the_page(name: str, middle: int, outward: int) -> None:
    table = colormap_table(name).astype(int)
    assert len(table) == 255
    assert table[127, 0] == middle
    light = outward * table.sum(axis=1)
    assert (np.diff(light[:128]) <= 0).all()
    assert (np.diff(light[127:]) >= 0).all()
    assert abs(int(light[0]) - int(light[-1])) < 150


def test_an_unknown_map_is_named() -> None:
    with pytest.raises(ValueError, match="got 'jet'"):
        colormap_table("jet")


def test_neighbouring_ids_differ() -> None:
    table = id_table().astype(int)
    assert len(table) == 4096
    assert (np.abs(np.diff(table, axis=0)).sum(axis=1) > 40).all()
    assert len({tuple(color) for color in table[:64].tolist()}) == 64
