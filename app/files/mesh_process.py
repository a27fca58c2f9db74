"""A mesh file read in a process of its own, which can be ended at any moment."""

import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread
from typing import Any, BinaryIO

from app.files.mesh_formats import LoadedMeshes, MeshFileError, Report, read_file
from core.scene import Texture

POLL_SECONDS = 0.05
"""How often cancelling is asked for: well under the half second that a person notices."""

START = "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from app.files.mesh_process import serve; serve()"
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
