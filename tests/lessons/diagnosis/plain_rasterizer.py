"""Homework: rasterizers of single pixels, written plainly from the lectures, with places to plant one mistake.

They share nothing with the program. A corner is (x, y, depth, w, colour); y goes up, row 0 is the bottom row.
"""

from collections.abc import Callable
from dataclasses import dataclass

Color = tuple[float, ...]
Corner = tuple[float, float, float, float, Color]
Triangle = tuple[Corner, Corner, Corner]
Picture = list[list[Color]]


def edge(ax, ay, bx, by, x, y):
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax)


def owns(ax, ay, bx, by):
    """Return whether the edge from a to b of a counter-clockwise triangle owns its points: left, or level bottom."""
    return by < ay or (by == ay and bx > ax)


def covers(e, is_owner):
    return e > 0 or (e == 0 and is_owner)


def perspective(weights, ws, values):
    above = sum(k * value / w for k, w, value in zip(weights, ws, values, strict=True))
    below = sum(k / w for k, w in zip(weights, ws, strict=True))
    return above / below


def nearer(new, old):
    return new < old


def opaque(source, there):
    return source


def over(source, there):
    a = source[3]
    return (
        *(a * s + (1 - a) * t for s, t in zip(source[:3], there[:3], strict=True)),
        a + (1 - a) * there[3],
    )


@dataclass
class Homework:
    """One program; a mistake replaces one of its parts."""

    center: tuple[float, float] = (0.5, 0.5)
    owns: Callable = owns
    covers: Callable = covers
    interpolate: Callable = perspective
    passes: Callable = nearer
    cleared: float = 1.0
    blend: Callable = opaque
    weights: Callable = lambda weights: weights
    last: Callable = lambda i, j, corners: False
    """Whether a pixel is lost although it is covered."""

    def draw(self, triangles: list[Triangle], width: int, height: int) -> Picture:
        color = [[(0.0, 0.0, 0.0, 1.0)] * width for _ in range(height)]
        depth = [[self.cleared] * width for _ in range(height)]
        for triangle in triangles:
            a, b, c = triangle
            if edge(a[0], a[1], b[0], b[1], c[0], c[1]) < 0:
                a, b, c = a, c, b
            sides = [(b, c), (c, a), (a, b)]
            for j in range(height):
                for i in range(width):
                    x, y = i + self.center[0], j + self.center[1]
                    e = [edge(p[0], p[1], q[0], q[1], x, y) for p, q in sides]
                    owners = [self.owns(p[0], p[1], q[0], q[1]) for p, q in sides]
                    if not all(map(self.covers, e, owners)) or self.last(i, j, (a, b, c)):
                        continue
                    weights = self.weights([value / sum(e) for value in e])
                    z = sum(k * corner[2] for k, corner in zip(weights, (a, b, c), strict=True))
                    if not self.passes(z, depth[j][i]):
                        continue
                    depth[j][i] = z
                    ws = [a[3], b[3], c[3]]
                    channels = zip(a[4], b[4], c[4], strict=True)
                    source = tuple(self.interpolate(weights, ws, values) for values in channels)
                    color[j][i] = self.blend(source, color[j][i])
        return color


def to_byte(linear):
    linear = min(max(linear, 0.0), 1.0)
    encoded = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return int(255 * encoded + 0.5)


def shown(picture: Picture) -> list[list[tuple[int, ...]]]:
    """Return the bytes of a picture as a screen shows them."""
    return [[tuple(map(to_byte, color[:3])) for color in row] for row in picture]


def bresenham(
    x0,
    y0,
    x1,
    y1,
    ties=False,
    corrected=True,
    octants=True,
    down=-1,
    last=1,
    start=lambda dx, dy: 2 * dy - dx,
):
    """Return the pixels of a line as LMU's listing has them: D > 0, from left to right, the last pixel drawn."""
    steep = octants and not abs(y1 - y0) < abs(x1 - x0)
    if steep:
        x0, y0, x1, y1 = y0, x0, y1, x1
    if x0 > x1:
        x0, y0, x1, y1 = x1, y1, x0, y0
    dx, dy, step = x1 - x0, y1 - y0, 1
    if dy < 0:
        dy, step = -dy, down
    d, y, pixels = start(dx, dy), y0, []
    for x in range(x0, x1 + last):
        pixels.append((y, x) if steep else (x, y))
        if d > 0 or (ties and d == 0):
            y += step
            if corrected:
                d -= 2 * dx
        d += 2 * dy
    return pixels
