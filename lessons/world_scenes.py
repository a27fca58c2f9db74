"""Scenes of meshes in world space, seen by a camera."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import atan

import numpy as np

from core.records.motion import Motion
from core.scene import Camera, DirectionalLight, Material, Mesh, PointLight, Scene
from lessons.shapes import FACE_COLORS, RED_GREEN_BLUE, cube, floor, linear_color, plates

TEACHING_SIZE = (64, 48)
"""Raster of the small cases in pixels: every pixel can be pointed at."""

PICTURE_SIZE = (512, 512)
"""Raster of the meshes."""

BOXES = (
    ((-2.0, 0.5, -7.0), (1.0, 1.0, 1.0)),
    ((1.5, 0.75, -9.0), (1.0, 1.5, 1.0)),
    ((3.6, 0.5, -8.5), (1.5, 1.0, 1.5)),
    ((0.0, 1.0, -18.0), (2.0, 2.0, 2.0)),
    ((-6.0, 0.5, -4.0), (1.0, 1.0, 1.0)),
    ((6.0, 0.5, -3.0), (1.0, 1.0, 1.0)),
    ((0.0, 0.5, 6.0), (1.0, 1.0, 1.0)),
    ((5.0, 0.5, 5.0), (1.0, 1.0, 1.0)),
    ((-9.0, 0.5, 0.0), (1.0, 1.0, 1.0)),
    ((0.0, 1.75, -24.0), (40.0, 3.5, 1.0)),
)
"""Middle and sides of every box; the last one is a wall that crosses the view from side to side."""
BEHIND_WALL = (
    ((0.0, 1.6, -7.0), (3.5, 3.0, 0.4)),
    ((-1.0, 0.9, -10.0), (0.8, 0.8, 0.8)),
    ((0.6, 1.5, -12.0), (1.2, 1.2, 1.2)),
    ((-0.4, 2.4, -15.0), (1.0, 1.5, 1.0)),
    ((1.4, 2.2, -20.0), (2.0, 2.0, 2.0)),
    ((2.2, 1.0, -10.5), (1.0, 1.0, 1.0)),
    ((-2.9, 1.2, -11.0), (1.2, 1.6, 1.2)),
    ((-3.2, 0.7, -6.0), (0.6, 0.6, 0.6)),
    ((0.0, -0.1, -9.0), (14.0, 0.1, 20.0)),
)
"""A wall, boxes behind it, one that looks out beside it, two beside it, and a floor that the viewer stands on."""


def boxes_around() -> Scene:
    """Return ten boxes around a viewer, each a mesh: half of them are outside the view."""
    meshes = colored_boxes(BOXES)
    camera = Camera(eye=np.array([0.0, 1.6, 0.0]), target=np.array([0.0, 1.6, -1.0]), near=0.5, far=28.0)
    weak = DirectionalLight(np.array([-0.5, -0.3, -0.9]), np.full(3, 0.4))
    return Scene(meshes, camera, (sun(), weak), TEACHING_SIZE)


def colored_boxes(boxes: Sequence[tuple[Sequence[float], Sequence[float]]]) -> tuple[Mesh, ...]:
    """Return a mesh for each box, given by middle and sides; colours repeat."""
    meshes, shape = [], cube(1.0)
    for number, (middle, sides) in enumerate(boxes):
        matrix = np.diag([*sides, 1.0])
        matrix[:3, 3] = middle
        color = linear_color(FACE_COLORS[number % len(FACE_COLORS)])
        colors = np.tile(color, (len(shape.positions), 1))
        meshes.append(replace(shape, transform=matrix, colors=colors, name=f"box {number}"))
    return tuple(meshes)


def boxes_behind_wall() -> Scene:
    """Return a wall before boxes, each a mesh. Four are hidden; one of these is kept, as its texels reach below."""
    camera = Camera(eye=np.array([0.0, 1.6, 0.0]), target=np.array([0.0, 1.6, -1.0]), near=0.5, far=28.0)
    weak = DirectionalLight(np.array([-0.5, -0.3, -0.9]), np.full(3, 0.4))
    return Scene(colored_boxes(BEHIND_WALL), camera, (sun(), weak), TEACHING_SIZE)


def two_boxes() -> Scene:
    """Return a box and, before it to the right, one with an edge pushed in: the box around it has room to pass through.

    Notes
    -----
    On 17 x 17 pixels, the rays of row 8 run one unit in depth for every eighth of a unit to the side.
    """
    near, far = cube(1.0), cube(1.0)
    wedge = near.positions * (2.0, 3.0, 2.0) + (2.0, 0.0, -4.0)
    pushed = (wedge[:, 0] < 2) & (wedge[:, 2] < -4)
    wedge[pushed, 0], wedge[pushed, 2] = 1.75, -4.75
    first, second, third = (wedge[near.triangles[:, k]] for k in range(3))
    sides = np.cross(second - first, third - first)
    normals = np.empty_like(wedge)
    normals[near.triangles] = (sides / np.linalg.norm(sides, axis=1, keepdims=True))[:, None]
    meshes = (
        replace(near, positions=wedge, normals=normals, name="wedge"),
        replace(far, positions=far.positions * (5.5, 5.0, 2.0) + (0.25, 0.0, -8.0), name="box"),
    )
    camera = Camera(
        np.zeros(3), np.array([0.0, 0.0, -1.0]), field_of_view=2 * atan(17 / 16), near=0.5, far=20.0
    )
    return Scene(meshes, camera, (sun(), DirectionalLight(np.array([-0.5, -0.3, -0.9]))), TEACHING_SIZE)


def z_fighting() -> Scene:
    """Two plates, one a hair's breadth behind the other: less than a step of 16-bit depth, many of 24 bits."""
    camera = Camera(eye=np.array([1.0, 1.1, 3.1]), target=np.zeros(3), near=0.05, far=50.0)
    return Scene(plates(), camera, (sun(),), TEACHING_SIZE)


def textured_floor() -> Scene:
    """A floor to the horizon, where affine interpolation and a texture without mipmaps go wrong."""
    camera = Camera(eye=np.array([0.0, 1.6, 4.0]), target=np.array([0.0, 0.4, -2.0]), near=0.2, far=60.0)
    return Scene((floor(),), camera, (sun(),), PICTURE_SIZE)


def moving_camera() -> Scene:
    """The same floor on a small raster, under a camera that moves to the right from picture to picture."""
    return replace(textured_floor(), size=TEACHING_SIZE, motion=Motion(camera=(0.15, 0.0, 0.0)))


def lit_floor() -> Scene:
    """A floor of two large triangles: the light mirrored in its middle is far from every corner."""
    lying = Mesh(
        positions=np.array([[-4.0, 0.0, -8.0], [4.0, 0.0, -8.0], [4.0, 0.0, 0.0], [-4.0, 0.0, 0.0]]),
        triangles=np.array([[0, 2, 1], [0, 3, 2]]),
        normals=np.tile([0.0, 1.0, 0.0], (4, 1)),
        faces=np.array([0, 0]),
        material=Material(ambient=0.1, diffuse=0.3, specular=0.6, shininess=40.0),
        name="lit floor",
    )
    camera = Camera(eye=np.array([0.0, 2.0, 2.0]), target=np.array([0.0, 0.5, -4.0]), near=0.5, far=30.0)
    return Scene((lying,), camera, (PointLight(np.array([0.0, 2.0, -10.0])),), TEACHING_SIZE)


def box_in_light() -> Scene:
    """Return a box on a floor, in the light that falls to the left and to the back: its shadow lies on the floor."""
    half = 4.0
    lying = Mesh(
        positions=np.array([[-half, 0.0, -half], [half, 0.0, -half], [half, 0.0, half], [-half, 0.0, half]]),
        triangles=np.array([[0, 2, 1], [0, 3, 2]]),
        faces=np.array([0, 0]),
        name="floor",
    )
    lift = np.eye(4)
    lift[1, 3] = 0.5
    colors = np.tile(linear_color(FACE_COLORS[1]), (24, 1))
    box = replace(cube(1.0), transform=lift, colors=colors, name="box")
    camera = Camera(np.array([-3.0, 5.0, 5.0]), np.array([-0.4, 0.2, 0.0]), near=1.0, far=30.0)
    return Scene((lying, box), camera, (DirectionalLight(np.array([-1.0, -1.2, -0.6])),), TEACHING_SIZE)


def near_plane() -> Scene:
    """One triangle that reaches from far in front of the camera to behind it."""
    triangle = Mesh(
        positions=np.array([[-1.6, 0.1, -5.0], [1.2, 0.3, -3.0], [0.5, -0.2, 1.5]]),
        triangles=np.array([[0, 2, 1]]),
        normals=np.tile([0.0, 1.0, 0.0], (3, 1)),
        colors=RED_GREEN_BLUE,
        name="near-plane crosser",
    )
    camera = Camera(eye=np.array([0.0, 1.0, 0.0]), target=np.array([0.0, 0.7, -3.0]), near=0.5, far=20.0)
    return Scene((triangle,), camera, (sun(),), TEACHING_SIZE)


def mirror_cube() -> Scene:
    """Return a mirror of side 1 on a chequered floor, with a box before it: no reflection is as near as these."""
    lift, beside = np.eye(4), np.diag([0.5, 0.5, 0.5, 1.0])
    lift[1, 3], beside[:3, 3] = 0.5, (0.9, 0.25, 0.9)
    dark, bright = np.tile([0.02, 0.02, 0.02, 1.0], (24, 1)), np.tile(linear_color(FACE_COLORS[1]), (24, 1))
    matte, shiny = Material(specular=0.0), Material(specular=0.0, mirror=0.85)
    mirror = replace(cube(1.0), transform=lift, colors=dark, material=shiny, name="mirror")
    box = replace(cube(1.0), transform=beside, colors=bright, material=matte, name="box")
    camera = Camera(np.array([-1.3, 1.7, 3.0]), np.array([0.25, 0.35, 0.0]), near=0.5, far=40.0)
    below = replace(floor(4.0, 4.0), material=matte)
    return Scene((below, mirror, box), camera, (sun(),), TEACHING_SIZE, linear_color("#86A8DC"))


def sun() -> DirectionalLight:
    """Return light from above left."""
    return DirectionalLight(np.array([0.4, -0.8, -0.7]))


def of_mesh(mesh: Callable[[], Mesh], distance: float, color: str = "") -> Callable[[], Scene]:
    """Return a maker of the scene of one mesh in one colour, seen from the right and from above."""

    def make() -> Scene:
        direction = np.array([0.45, 0.5, 1.0])
        camera = Camera(
            eye=direction / np.linalg.norm(direction) * distance,
            target=np.zeros(3),
            near=distance / 10,
            far=3 * distance,
        )
        shape = mesh()
        if color:
            shape = replace(shape, colors=np.tile(linear_color(color), (len(shape.positions), 1)))
        weak = DirectionalLight(np.array([-0.9, -0.1, -0.3]), np.full(3, 0.25))
        return Scene((shape,), camera, (sun(), weak), PICTURE_SIZE)

    return make
