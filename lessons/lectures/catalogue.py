"""All listings as printed and all numbers of the slides, in the order of the lectures."""

from core.coverage.scanline import draw_triangle
from core.lines.bresenham import bresenham_lecture_listing
from lessons.lectures import jubair, lmu, pellacini, zwicker
from lessons.lectures.bresenham import CHAIN, FALLING_CASE
from lessons.lectures.clipping_and_projection import CYRUS_BECK, LIANG_BARSKY, PROJECTION
from lessons.lectures.printed import PrintedListing, SlideNumber
from lessons.lectures.scenes import LECTURES

# All listings as printed, in the order of the lectures.


COMPLETE = PrintedListing(
    "lmu-complete",
    "Bresenham, complete version",
    "LMU",
    "Task 1 g) Bresenham (complete version)",
    """\
drawLine(p1, p2, color) {
  if ( Math.abs(p2.y - p1.y) < Math.abs(p2.x - p1.x) ) {
    if (p1.x > p2.x) {
      this.drawLineLow(p2.x, p2.y, p1.x, p1.y, color)
    } else {
      this.drawLineLow(p1.x, p1.y, p2.x, p2.y, color)
    }
  } else {
    if (p1.y > p2.y) {
      this.drawLineHigh(p2.x, p2.y, p1.x, p1.y, color)
    } else {
      this.drawLineHigh(p1.x, p1.y, p2.x, p2.y, color)
    }
  }
}
drawLineLow(x0, y0, x1, y1, color) {
  let dx = x1 - x0
  let dy = y1 - y0
  let yi = 1
  if (dy < 0) {
    yi = -1
    dy = -dy
  }
  let D = 2*dy - dx
  let y = y0
  for (let x = x0; x <= x1; x++) {
    this.drawPoint(x, y, color)
    if (D > 0) {
      y += yi
      D = 2*dx
    }
    D += 2*dy
  }
}""",
    "line",
    "bresenham",
    {"D -= 2*dx": bresenham_lecture_listing},
    "D = 2*dx in drawLineLow and D = 2*dy in drawLineHigh are read as -=, as on the slide before.",
    registered="bresenham-lecture",
)

SCANLINE = PrintedListing(
    "lmu-scanline",
    "Scanline fill of a triangle",
    "LMU",
    "Task 1 g) Scan Line Algorithm for Triangles (cont.)",
    """\
drawTriangle(v1, v2, v3, color) {
  // sort three vertices to guarantee v1.y > v2.y > v3.y
  if (v1.y > v2.y && v2.y > v3.y) {}
  else if (v1.y > v3.y && v3.y > v2.y) [v2, v3] = [v3, v2]
  else if (v3.y > v1.y && v1.y > v2.y) [v1, v2, v3] = [v3, v1, v2]
  else if (v2.y > v1.y && v1.y > v3.y) [v1, v2] = [v2, v1]
  else if (v2.y > v3.y && v3.y > v1.y) [v1, v2, v3] = [v2, v3, v1]
  else if (v3.y > v2.y && v2.y > v1.y) [v1, v3] = [v3, v1]
  if (v2.y == v3.y) {
    this.drawTriangleBottom(v1, v2, v3, color)
    return
  }
  if (v1.y == v2.y) {
    this.drawTriangleTop(v1, v2, v3, color)
    return
  }
  const v4 = new Vector2(v1.x + ((v2.y - v1.y) / (v3.y - v1.y)) * (v3.x - v1.x), v2.y)
  this.drawTriangleTop(v2, v4, v1, color)
  this.drawTriangleBottom(v3, v4, v2, color)
}""",
    "fill",
    "scanline",
    {"as printed": draw_triangle},
    "A single & in the comparisons is read as &&.",
    registered="scanline-lecture",
)

PRINTED = (*pellacini.ALL, CYRUS_BECK, LIANG_BARSKY, PROJECTION, *CHAIN, FALLING_CASE, COMPLETE, SCANLINE)
"""The listings in the order of the lectures."""


def printed_listing(name: str) -> PrintedListing:
    """Return the printed listing ``name``, or raise ValueError with the names that there are."""
    for printed in PRINTED:
        if printed.name == name:
            return printed
    names = ", ".join(printed.name for printed in PRINTED)
    raise ValueError(f"printed listing must be one of {names}, got {name}")


# All numbers of the slides and of the printed listings, by lecture.


_OF_SLIDES = (*zwicker.NUMBERS, *pellacini.NUMBERS, *jubair.NUMBERS, *lmu.NUMBERS)
NUMBERS: tuple[SlideNumber, ...] = tuple(
    number
    for lecture in LECTURES
    for number in (*_OF_SLIDES, *(each for printed in PRINTED for each in printed.numbers))
    if number.lecture == lecture
)
"""Every number, lecture by lecture; those of printed listings last."""
