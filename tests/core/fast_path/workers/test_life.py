"""Workers that are killed, closed or interrupted, or that fail: nothing is left behind however the program ends."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from threading import Thread

import numpy as np
import pytest

from core import Mesh, draw_picture
from core.fast_path.workers.band_workers import BandWorkers
from core.fast_path.workers.worker import memory_prefix
from tests.core.fast_path.band_scenes import SPANS, ball

ROOT = Path(__file__).resolve().parents[4]
SHARED_FOLDER = Path("/dev/shm")


def test_one_process_is_just_drawing() -> None:
    with BandWorkers(1, always=True) as workers:
        assert not workers.start()
        workers.draw(ball(), SPANS)
        assert workers.pids == ()
    with pytest.raises(ValueError, match="processes must be 1 or more, got 0"):
        BandWorkers(0)


def test_a_worker_that_is_killed_is_told_and_started_once_more() -> None:
    scene = ball()
    expected = draw_picture(scene, SPANS).pixels
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        killed = workers.pids
        os.kill(killed[0], getattr(signal, "SIGKILL", signal.SIGTERM))
        np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, expected)
        assert "ended with code" in workers.failure
        assert workers.sharing.reason == workers.failure
        assert workers.start()
        assert workers.pids != killed
        np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, expected)
        assert workers.sharing.process_count == 2
        os.kill(workers.pids[0], getattr(signal, "SIGKILL", signal.SIGTERM))
        for _ in range(3):
            np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, expected)
        assert workers.pids == ()
        assert not workers.start()
        assert workers.sharing.reason == workers.failure


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="no process can be stopped here")
@pytest.mark.parametrize("subdivisions", [6, pytest.param(2, marks=pytest.mark.slow)])
def test_a_worker_that_is_stopped_is_ended_and_the_picture_drawn(
    monkeypatch: pytest.MonkeyPatch, subdivisions: int
) -> None:
    """The order of the larger ball, 2 MB, does not fit into the pipe."""
    monkeypatch.setattr("core.fast_path.workers.worker.SECONDS_TO_TAKE", 0.1)
    monkeypatch.setattr("core.fast_path.workers.band_workers.SECONDS_TO_ANSWER", 0.1)
    scene = ball(subdivisions)
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        (stopped,) = workers.pids
        os.kill(stopped, signal.SIGSTOP)
        np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, draw_picture(scene, SPANS).pixels)
        assert workers.failure.startswith("a worker process ")
        assert workers.sharing.reason == workers.failure
        assert not is_running(stopped)


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="no process can be stopped here")
def test_closing_does_not_wait_for_a_picture_with_a_stopped_worker() -> None:
    scene, workers = ball(), BandWorkers(2, always=True)
    assert workers.start()
    (stopped,) = workers.pids
    os.kill(stopped, signal.SIGSTOP)
    drawn: list[np.ndarray] = []
    drawing = Thread(target=lambda: drawn.append(workers.draw(scene, SPANS).pixels))
    drawing.start()
    while not workers._lock.locked():
        time.sleep(0.001)
    workers.close()
    drawing.join()
    assert not is_running(stopped)
    assert workers.pids == ()
    np.testing.assert_array_equal(drawn[0], draw_picture(scene, SPANS).pixels)
    workers.draw(scene, SPANS)
    assert workers.sharing.reason == "the workers are closed"


class UnknownMesh(Mesh):
    """A class of the main module, which workers do not import."""


def test_a_worker_that_raises_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(UnknownMesh, "__module__", "__main__")
    monkeypatch.setattr(sys.modules["__main__"], "UnknownMesh", UnknownMesh, raising=False)
    known = ball()
    mesh = known.meshes[0]
    scene = replace(known, meshes=(UnknownMesh(mesh.positions, mesh.triangles),))
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, draw_picture(scene, SPANS).pixels)
        assert "Traceback" in workers.failure
        assert "UnknownMesh" in workers.failure


@pytest.mark.slow
def test_a_scene_that_cannot_be_sent_is_told() -> None:
    class LocalMesh(Mesh):
        """A class that has no name outside this function."""

    mesh = ball().meshes[0]
    scene = replace(ball(), meshes=(LocalMesh(mesh.positions, mesh.triangles),))
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        assert workers.draw(scene, SPANS).route.visible > 0
        assert "LocalMesh" in workers.failure


def memory_of(pid: int) -> set[str]:
    """Return the names of the shared memory that a process made."""
    if not SHARED_FOLDER.is_dir():
        return set()
    return {path.name for path in SHARED_FOLDER.glob(f"{memory_prefix(pid)}*")}


def is_gone(pid: int, but: set[str] | None = None, seconds: float = 60.0) -> bool:
    """Tell whether no shared memory of a process has a name, ``but`` these, at once or soon."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if memory_of(pid) <= (but or set()):
            return True
        time.sleep(0.01)
    return False


def test_closing_leaves_nothing_and_may_be_done_twice() -> None:
    others = memory_of(os.getpid())
    workers = BandWorkers(2, always=True)
    assert workers.start()
    workers.draw(ball(), SPANS)
    assert is_gone(os.getpid(), others)  # the name is gone while the memory is in use
    pids = workers.pids
    workers.close()
    workers.close()
    assert not any(is_running(pid) for pid in pids)
    workers.draw(ball(), SPANS)
    assert workers.sharing.reason == "the workers are closed"
    assert not workers.start()


def test_workers_that_nobody_holds_any_more_end() -> None:
    workers = BandWorkers(2, always=True)
    assert workers.start()
    pids = workers.pids
    del workers
    assert all(has_ended(pid) for pid in pids)


PROGRAM = """
    import numpy as np
    from core import Camera, Mesh, Scene, Settings
    from core.fast_path.workers.band_workers import BandWorkers

    print("main part", flush=True)
    corners = np.array([[-1.0, -1, 0], [1, -1, 0], [0, 1, 0]])
    scene = Scene((Mesh(corners, np.array([[0, 1, 2]])),), Camera(np.array([0.0, 0, 3]), np.zeros(3)))
    workers = BandWorkers(2, always=True)
    assert workers.start(), workers.failure
    picture = workers.draw(scene, Settings(fill="spans", depth="fixed-38"))
    assert workers.sharing.process_count == 2, workers.sharing
    print(*workers.pids, flush=True)
"""
"""A script without a guard around its main part, that closes nothing."""
HEARS_INTERRUPTS = """
    import signal
    signal.signal(signal.SIGINT, signal.default_int_handler)
"""
"""Where the tests run in the background of a shell, interrupts are ignored, and that is inherited."""
GO_ON = """
    while True:
        picture = workers.draw(scene, Settings(fill="spans", depth="fixed-38"))
"""


def start(program: str, folder: Path, **options) -> subprocess.Popen[str]:
    script = folder / "script.py"
    script.write_text(textwrap.dedent(program), encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "error"}
    return subprocess.Popen(
        [sys.executable, str(script)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
        env=environment,
        **options,
    )


def worker_of(process: subprocess.Popen[str]) -> int:
    assert process.stdout.readline() == "main part\n"
    return int(process.stdout.readline())


def is_running(pid: int) -> bool:
    """Tell whether a process runs; one that has ended and that nobody asked after does not."""
    status = Path(f"/proc/{pid}/stat")
    if Path("/proc/self/stat").exists():
        try:
            return status.read_text().rpartition(")")[2].split()[0] != "Z"
        except (FileNotFoundError, ProcessLookupError):
            return False
    try:
        os.kill(pid, 0)
    except OSError:
        return False
    return True


def has_ended(pid: int, seconds: float = 60.0) -> bool:
    deadline = time.monotonic() + seconds
    while is_running(pid) and time.monotonic() < deadline:
        time.sleep(0.02)
    return not is_running(pid)


def test_a_script_runs_its_main_part_once_and_ends_quietly(tmp_path: Path) -> None:
    process = start(PROGRAM, tmp_path)
    output, problems = process.communicate(timeout=60)
    assert (process.returncode, problems) == (0, "")
    assert output.count("main part") == 1
    assert has_ended(int(output.split()[-1]))
    assert is_gone(process.pid)


@pytest.mark.skipif(sys.platform == "win32", reason="there is no such signal")
@pytest.mark.parametrize("is_drawing", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_nothing_is_left_of_a_program_that_is_killed(tmp_path: Path, is_drawing: bool) -> None:
    pause = "\n    import time\n    time.sleep(60)\n"
    with start(PROGRAM + (GO_ON if is_drawing else pause), tmp_path) as process:
        worker = worker_of(process)
        assert is_running(worker)
        time.sleep(0.1)
        process.kill()
        _, problems = process.communicate(timeout=30)
    assert has_ended(worker)
    assert is_gone(process.pid)
    assert problems == ""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there is no such signal")
def test_an_interrupt_reaches_the_program_and_ends_the_workers(tmp_path: Path) -> None:
    """Ctrl+C goes to every process of the terminal."""
    with start(HEARS_INTERRUPTS + PROGRAM + GO_ON, tmp_path, start_new_session=True) as process:
        try:
            worker = worker_of(process)
            time.sleep(0.1)
            os.killpg(process.pid, signal.SIGINT)
            _, problems = process.communicate(timeout=30)
        finally:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == -signal.SIGINT
    assert problems.count("Traceback") == 1
    assert problems.rstrip().endswith("KeyboardInterrupt")
    assert has_ended(worker)


def test_an_interrupted_picture_leaves_no_answer_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = ball()
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        interrupted = workers.pids

        def interrupt(*_: object, **__: object) -> None:
            raise KeyboardInterrupt

        with monkeypatch.context() as patch:
            patch.setattr("core.fast_path.workers.band_workers.draw_picture", interrupt)
            with pytest.raises(KeyboardInterrupt):
                workers.draw(scene, SPANS)
        assert not any(is_running(pid) for pid in interrupted)
        assert workers.start()
        np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, draw_picture(scene, SPANS).pixels)
