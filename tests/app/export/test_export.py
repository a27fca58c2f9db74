"""Exporting a view: what stands in the files is what is seen."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PySide6.QtCore import QByteArray, QRectF
from PySide6.QtGui import QGuiApplication, QImage, QPainter
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QHBoxLayout, QLabel, QScrollArea, QWidget

from app.export.views import copy_widget, export_widget, widget_image
from app.files.file_access import FileWriteError
from core import Settings, render
from core.explain.records import Formula
from lessons.scenes import make_scene
from widgets.grid.layers import GridBuffer
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import GridView
from widgets.inspector.formula_view import FormulaView

SVG = "{http://www.w3.org/2000/svg}"


def pixels(image):
    image = image.convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


def drawn(path, size):
    """Draw an SVG file."""
    renderer = QSvgRenderer(QByteArray(path.read_bytes()))
    assert renderer.isValid()
    image = QImage(size, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(0xFFFFFFFF)
    with QPainter(image) as painter:
        renderer.render(painter, QRectF(image.rect()))
    return image


@pytest.fixture
def grid(qtbot):
    widget = PixelGrid()
    qtbot.addWidget(widget)
    widget.resize(400, 300)
    frame = render(make_scene("shared-edge"), Settings())
    widget.show_buffer(GridBuffer("colour", frame.color, "color"))
    widget.show()
    qtbot.waitExposed(widget)
    return widget


@pytest.fixture
def pane(qtbot):
    """Return a widget with a label and a scroll area that cuts a label off."""
    widget = QWidget()
    qtbot.addWidget(widget)
    layout = QHBoxLayout(widget)
    layout.addWidget(QLabel("left <&> right"))
    area, wide = QScrollArea(), QLabel()
    wide.setFixedSize(3000, 40)
    wide.setStyleSheet("background: #ff0000")
    area.setWidget(wide)
    layout.addWidget(area)
    layout.addWidget(QLabel("end"))
    widget.resize(400, 100)
    widget.show()
    qtbot.waitExposed(widget)
    return widget


def test_a_png_is_what_is_seen(grid, tmp_path):
    export_widget(grid, tmp_path / "a.png")
    saved = QImage(str(tmp_path / "a.png"))
    assert np.array_equal(pixels(saved), pixels(grid.grab().toImage()))
    export_widget(grid, str(tmp_path / "b.PNG"), scale=2)
    assert QImage(str(tmp_path / "b.PNG")).size() == grid.size() * 2


@pytest.mark.slow
@pytest.mark.parametrize("view", [GridView(), GridView(0.3, 0.4, 3.3)], ids=["whole", "zoomed"])
def test_an_svg_of_a_grid_shows_the_same_cells(grid, tmp_path, view):
    grid.set_view(view)
    export_widget(grid, tmp_path / "a.svg")
    seen, saved = pixels(grid.grab().toImage()), pixels(drawn(tmp_path / "a.svg", grid.size()))
    # Qt draws no clipping of SVG: only what lies inside is compared.
    inside = grid.placement().viewport.adjusted(2, 2, -2, -2)
    rows, columns = slice(inside.top(), inside.bottom()), slice(inside.left(), inside.right())
    differs = np.abs(seen[rows, columns] - saved[rows, columns]).max(axis=2) > 40
    assert differs.mean() < 0.002
    assert len(np.unique(seen[rows, columns].reshape(-1, 3), axis=0)) > 2


def test_an_svg_is_in_logical_pixels_and_its_text_is_text(pane, tmp_path):
    pane.setWindowTitle("a < b & c")
    export_widget(pane, tmp_path / "a.svg")
    root = ElementTree.parse(tmp_path / "a.svg").getroot()
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("400", "100", "0 0 400 100")
    assert root.findtext(f"{SVG}title") == "a < b & c"
    texts = [text.text for text in root.iter(f"{SVG}text")]
    assert "left <&> right" in texts
    assert "end" in texts


def test_an_svg_cuts_off_what_the_window_cuts_off(pane, tmp_path):
    export_widget(pane, tmp_path / "a.svg")
    parts = list(ElementTree.parse(tmp_path / "a.svg").getroot().iter(f"{SVG}svg"))
    wide = next(part for part in parts if part.get("width") == "3000")
    around = next(part for part in parts if wide in list(part))
    assert int(around.get("width")) < 300
    assert all(part.get("overflow") == "hidden" for part in parts[1:])


def test_names_in_an_svg_are_its_own(grid, tmp_path):
    export_widget(grid, tmp_path / "a.svg")
    names = [element.get("id") for element in ElementTree.parse(tmp_path / "a.svg").getroot().iter()]
    names = [name for name in names if name]
    assert len(names) == len(set(names))


def test_a_pdf_is_one_page_of_the_size_of_the_widget(grid, tmp_path):
    export_widget(grid, tmp_path / "a.pdf")
    content = (tmp_path / "a.pdf").read_bytes()
    assert content.startswith(b"%PDF-")
    assert content.rstrip().endswith(b"%%EOF")
    assert content.count(b"/MediaBox") == 1
    assert b"/MediaBox [0 0 300.000000 225.000000]" in content
    assert b"/DCTDecode" not in content, "pixels must not be blurred by JPEG"


@pytest.mark.parametrize("ending", [".png", ".svg", ".pdf"])
def test_every_widget_exports_in_every_format(pane, tmp_path, ending):
    path = tmp_path / f"a{ending}"
    export_widget(pane, path)
    assert path.stat().st_size > 500
    assert [found.name for found in tmp_path.iterdir()] == [path.name]


def test_a_formula_exports_by_itself(qtbot, tmp_path):
    view = FormulaView()
    qtbot.addWidget(view)
    view.resize(300, 80)
    view.show_formula(Formula("a + b", "1 + 2"))
    qtbot.waitUntil(view.is_complete)
    export_widget(view, tmp_path / "a.png")
    saved = QImage(str(tmp_path / "a.png"))
    assert saved == view.to_image().convertToFormat(saved.format())
    assert saved.pixelColor(0, 0).alpha() == 0
    export_widget(view, tmp_path / "a.svg")
    assert "<image" in (tmp_path / "a.svg").read_text()


def test_copying_puts_the_picture_on_the_clipboard(grid):
    copy_widget(grid)
    copied = QGuiApplication.clipboard().image()
    assert np.array_equal(pixels(copied), pixels(widget_image(grid)))


def test_another_ending_is_refused(grid, tmp_path):
    with pytest.raises(ValueError, match=r"must end with \.png, \.svg, \.pdf, got view\.gif"):
        export_widget(grid, tmp_path / "view.gif")
    with pytest.raises(ValueError, match="got view"):
        export_widget(grid, tmp_path / "view")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", [".png", ".svg", ".pdf"])
def test_a_file_that_cannot_be_written_is_one_sentence(grid, tmp_path, ending):
    with pytest.raises(FileWriteError, match=r"cannot be written: there is no folder"):
        export_widget(grid, tmp_path / "gone" / f"a{ending}")
