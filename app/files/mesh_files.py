"""Opening mesh files, in a process that can be ended: a path becomes a scene that is centred, framed and lit.

The files that open are OBJ (with MTL and texture), PLY, STL, OFF, GLB, glTF, XYZ and DXF. All of their triangles are
there in the order of the file, and triangles of one polygon know it (``Mesh.faces``). An OBJ file that names
no material file takes an image beside it, ``<stem>_texture.png`` or ``<stem>.png``, as its texture. What a
file names but does not have, such as a texture, is a warning; anything else that is wrong is an error. Of a file
without faces, lines and points of OBJ, DXF and XYZ and PLY's edges and vertices open as segments and points, with a
sentence that says so.
"""

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, replace
from math import sqrt, tan
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any, BinaryIO

import numpy as np

from app.files.mesh_formats import read_file
from app.files.mesh_formats.reading import LoadedMeshes, MeshFileError, Report, Wires
from core.records.arrays import Floats
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, Mesh, Scene, Texture
from core.transform.matrices import projection, transform, world_to_camera

# A mesh file read in a process of its own, which can be ended at any moment.


POLL_SECONDS = 0.05
"""How often cancelling is asked for: well under the half second that a person notices."""

START = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from app.files.mesh_files import serve; serve()"
)
PROJECT = Path(__file__).resolve().parents[2]
"""The folder that ``app`` is imported from."""


class OpeningCancelledError(Exception):
    """The person who opened a file does not want it any more."""


def read_in_process(
    path: Path, report: Report, is_cancelled: Callable[[], bool], allows_outside: bool = False
) -> LoadedMeshes:
    """Read ``path`` as ``app.files.mesh_formats.read_file`` does, in another process.

    Raises
    ------
    MeshFileError
        As the reader, or if the process ended without a result.
    OpeningCancelledError
        As soon as ``is_cancelled()``; the process is ended then and waited for.

    Notes
    -----
    No thread can be stopped from outside while trimesh or NumPy works in it; a process can.
    """
    # -P and no empty entry: a file of the current folder must not be taken for a module.
    places = [*filter(None, sys.path), str(PROJECT)]
    order = [json.dumps(places), os.fspath(path.absolute()), "outside" if allows_outside else ""]
    process = subprocess.Popen(
        [sys.executable, "-P", "-c", START, *order],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        start_new_session=True,  # Ctrl+C in the terminal is for the program, which ends the process
    )
    assert process.stdout is not None
    messages: SimpleQueue[tuple[str, Any]] = SimpleQueue()
    listener = Thread(target=listen, args=(process.stdout, messages), name="mesh file", daemon=True)
    listener.start()
    try:
        while True:
            if is_cancelled():
                raise OpeningCancelledError(f"opening {path.name} was cancelled")
            try:
                kind, content = messages.get(timeout=POLL_SECONDS)
            except Empty:
                continue
            if kind == "progress":
                report(*content)
            elif kind == "meshes":
                return restored(content)
            elif kind == "error":
                raise content
            else:
                raise MeshFileError(f"{path.name} cannot be read: its reader ended {content}")
    finally:
        process.kill()
        process.wait()
        listener.join()
        process.stdout.close()


def listen(pipe: BinaryIO, messages: "SimpleQueue[tuple[str, Any]]") -> None:
    """Put what the process says into ``messages``, and its end behind that, whatever happens."""
    end = "before its result was complete"
    try:
        while True:
            messages.put(pickle.load(pipe))
    except EOFError:
        end = "without a result"
    except pickle.UnpicklingError as problem:
        end = f"in the middle of its result: {problem}"
    finally:
        messages.put(("end", end))


def restored(loaded: LoadedMeshes) -> LoadedMeshes:
    """Return ``loaded`` after its way through the pipe, with arrays checked and read-only again."""
    textures: dict[int, Texture] = {}
    meshes = []
    for mesh in loaded.meshes:
        texture = mesh.texture
        if texture is not None:
            texture = textures.setdefault(id(texture), replace(texture))
        meshes.append(replace(mesh, texture=texture))
    return replace(loaded, meshes=tuple(meshes))


def serve() -> None:
    """Read the file that the command line names and say on the standard output what came of it.

    Where nobody listens any more, nothing is said.
    """
    with suppress(BrokenPipeError), os.fdopen(os.dup(sys.stdout.fileno()), "wb") as pipe:
        # Whatever a library prints must not come between the messages. A program without a console has no stderr.
        other = os.open(os.devnull, os.O_WRONLY) if sys.stderr is None else sys.stderr.fileno()
        os.dup2(other, sys.stdout.fileno())

        def say(kind: str, content: object) -> None:
            pickle.dump((kind, content), pipe, protocol=pickle.HIGHEST_PROTOCOL)
            pipe.flush()

        def report(fraction: float | None, doing: str) -> None:
            say("progress", (fraction, doing))

        try:
            say("meshes", read_file(Path(sys.argv[2]), report, bool(sys.argv[3])))
        except MeshFileError as problem:
            say("error", problem)


# Opening mesh files: a path becomes a scene that is centred, framed and lit, or one clear sentence.

VIEWED_FROM = (0.35, 0.4, 1.0)
"""Direction from the model to the camera: from the front, a little from the right and from above."""

MARGIN = 1.08
"""How much farther away the camera stands than where the model touches the border of the picture."""


@dataclass(frozen=True, eq=False)
class OpenedFile:
    """A scene from a mesh file, and what of the file could not be had."""

    scene: AnyScene
    """Meshes with a camera; of a file without faces, its segments or points in clip space."""
    warnings: tuple[str, ...]
    """One sentence each; empty: everything that the file names is there."""


def open_mesh(
    path: str | Path,
    progress: Report | None = None,
    is_cancelled: Callable[[], bool] | None = None,
    size: tuple[int, int] = (512, 512),
    allows_outside: bool = False,
) -> OpenedFile:
    """Open a mesh file as a scene.

    Parameters
    ----------
    progress : callable, optional
        Called in this thread with how far the work is, from 0 to 1 or ``None``, and what is being done.
    is_cancelled : callable, optional
        Asked in this thread many times a second. Where it is given the file is read in a process of its own,
        so that the work ends at once.
    size : (width, height)
        Raster of the scene in pixels.
    allows_outside : bool
        Whether files that it names may be read from outside its folder.

    Raises
    ------
    MeshFileError
        For every file that cannot be opened; the message is one sentence.
    OpeningCancelledError
        If ``is_cancelled()``.
    """
    loaded = load_meshes(path, progress, is_cancelled, allows_outside)
    scene = frame_meshes(loaded.meshes, size) if loaded.wires is None else frame_wires(loaded.wires, size)
    if is_cancelled is not None and is_cancelled():
        raise OpeningCancelledError(f"opening {Path(path).name} was cancelled")
    return OpenedFile(scene, loaded.warnings)


def load_meshes(
    path: str | Path,
    progress: Report | None = None,
    is_cancelled: Callable[[], bool] | None = None,
    allows_outside: bool = False,
) -> LoadedMeshes:
    """Return the meshes of a file; parameters and errors as ``open_mesh``."""
    report = progress or ignore_progress
    report(0.0, "")
    if is_cancelled is None:
        loaded = read_file(Path(path), report, allows_outside)
    else:
        loaded = read_in_process(Path(path), report, is_cancelled, allows_outside)
        if is_cancelled():
            raise OpeningCancelledError(f"opening {Path(path).name} was cancelled")
    report(1.0, "")
    return loaded


def ignore_progress(fraction: float | None, doing: str) -> None:
    """Take a report of progress that nobody wants."""


def frame_meshes(meshes: tuple[Mesh, ...], size: tuple[int, int] = (512, 512)) -> Scene:
    """Return a scene in which a perspective camera sees all of ``meshes``, which stay where they are.

    The camera looks from the front and slightly above at the centre of the bounding box. Near and far leave
    room to orbit around the model. A strong light comes from above left, a weak one from the right.

    Parameters
    ----------
    meshes : tuple of Mesh
    size : (width, height)
        Raster in pixels.
    """
    camera = frame_clouds([world_positions(mesh) for mesh in meshes], size)
    lights = (
        DirectionalLight(np.array([0.4, -0.8, -0.7]), np.full(3, 0.75)),
        DirectionalLight(np.array([-0.9, -0.1, -0.3]), np.full(3, 0.2)),
    )
    return Scene(meshes=meshes, camera=camera, lights=lights, size=size)


def frame_wires(wires: Wires, size: tuple[int, int] = (512, 512)) -> ClipScene:
    """Return points or segments in the clip space of a camera as that of `frame_meshes`; white where uncoloured.

    A drawing, which is flat, is seen from the front.
    """
    cloud = wires.positions[np.unique(wires.index)].T
    camera = frame_clouds([cloud], size, VIEWED_FROM if np.ptp(cloud[2]) else (0.0, 0.0, 1.0))
    matrix = projection(camera, size[0] / size[1]) @ world_to_camera(camera)
    clip = transform(matrix, np.column_stack([wires.positions, np.ones(len(wires.positions))]))
    colors = np.ones((len(clip), 4)) if wires.colors is None else wires.colors
    kind = "segments" if wires.index.shape[1] == 2 else "points"
    return ClipScene(clip[wires.index], colors[wires.index], size, shared=wires.index, kind=kind)


def frame_clouds(
    clouds: list[Floats], size: tuple[int, int], viewed_from: tuple[float, float, float] = VIEWED_FROM
) -> Camera:
    """Return the camera of `frame_meshes` for the world positions (3, N) of several meshes."""
    low = np.min([points.min(axis=1) for points in clouds], axis=0)
    high = np.max([points.max(axis=1) for points in clouds], axis=0)
    target = low / 2 + high / 2
    scale = float((high - low).max()) or 1.0

    # The axes of the camera, and the four planes of a view volume whose tip is at the camera.
    toward = np.array(viewed_from) / np.linalg.norm(viewed_from)
    right = np.cross([0.0, 1.0, 0.0], toward)
    right /= np.linalg.norm(right)
    up = np.cross(toward, right)
    field_of_view = Camera(eye=toward, target=np.zeros(3)).field_of_view
    steep = tan(field_of_view / 2)
    across = right / (steep * size[0] / size[1])
    planes = np.stack([toward + across, toward - across, toward + up / steep, toward - up / steep])

    # The camera stands where the outermost point comes to lie on the border of the picture.
    distance = radius = 0.0
    for points in clouds:
        x, y, z = (points[k] / scale - target[k] / scale for k in range(3))
        radius = max(radius, sqrt(float((x * x + y * y + z * z).max())))
        for plane in planes:
            distance = max(distance, MARGIN * float((plane[0] * x + plane[1] * y + plane[2] * z).max()))
    radius = radius or 1.0  # a single point
    distance = max(distance, 1.1 * radius)
    return Camera(
        eye=target + toward * (distance * scale),
        target=target,
        field_of_view=field_of_view,
        near=max(0.9 * (distance - radius), 0.02 * distance) * scale,
        far=(distance + 1.5 * radius) * scale,
    )


def world_positions(mesh: Mesh) -> Floats:
    """Return (3, N) float64 world x, y, z of the vertices that triangles of ``mesh`` use."""
    used = np.zeros(len(mesh.positions), np.bool_)
    used[mesh.triangles.ravel()] = True
    x, y, z = (mesh.positions[used, k] for k in range(3))
    return np.stack([row[0] * x + row[1] * y + row[2] * z + row[3] for row in mesh.transform[:3]])
