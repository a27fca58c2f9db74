"""No file of the current folder is run as code, whatever it is called: neither here nor in a child process."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NAMES = (
    *(
        *("abc", "base64", "collections", "contextlib", "copy", "ctypes", "dataclasses", "functools"),
        *("io", "json"),
    ),
    *("multiprocessing", "os", "pathlib", "pickle", "random", "re", "signal", "struct", "threading", "zlib"),
)
"""Twenty names of the standard library that a reader or a worker imports, or that its imports do."""

PLANTED = "open({found!r}, 'a').write(__name__ + '\\n')\n"

COMMAND = """
import sys
if __name__ == "__main__":
    from app.files.mesh_files import load_meshes
    from core.fast_path.workers.band_workers import BandWorkers
    from lessons.scenes import make_scene

    assert len(load_meshes("a.obj", None, lambda: False).meshes[0].triangles) == 1
    with BandWorkers(2, always=True) as workers:
        assert workers.start(), workers.failure
        workers.draw(make_scene("cube"))
        assert workers.sharing.process_count == 2, workers.sharing
"""
"""What the installed command does: a script in a folder of its own, without -P."""


def test_neither_a_reader_nor_a_worker_runs_files_of_the_current_folder(tmp_path: Path) -> None:
    here, found = tmp_path / "meshes", tmp_path / "found"
    here.mkdir()
    for name in NAMES:
        (here / f"{name}.py").write_text(PLANTED.format(found=str(found)))
    (here / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    command = tmp_path / "rasterscope.py"
    command.write_text(COMMAND)
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    environment["PYTHONPATH"] = str(ROOT)
    done = subprocess.run(
        [sys.executable, str(command)], cwd=here, env=environment, capture_output=True, encoding="utf-8"
    )
    ran = sorted(set(found.read_text().split())) if found.exists() else []
    assert (ran, done.returncode) == ([], 0), done.stderr
