"""Pictures drawn by several processes: the same bytes, and nothing left behind however the program ends."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from core import (
    Camera,
    ClipScene,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    Settings,
    Texture,
    draw_picture,
)
from core.picture import Route
from core.picture.workers import BandWorkers
from core.picture.workers.sharing import have_colors_of_whole
from core.picture.workers.worker import memory_prefix
from tests.core.meshes import icosphere, torus

ROOT = Path(__file__).resolve().parents[3]
SHARED_FOLDER = Path("/dev/shm")
SPANS = Settings(fill="spans", depth="fixed-38")


def ball(subdivisions: int = 3, size: tuple[int, int] = (96, 80), eye=(0.4, 0.8, 2.6), **changes) -> Scene:
    positions, triangles = icosphere(subdivisions)
    colors = np.concatenate([np.abs(positions), np.ones((len(positions), 1))], axis=1)
    mesh = Mesh(positions, triangles, normals=positions, colors=colors)
    camera = Camera(np.array(eye), np.zeros(3))
    lights = (DirectionalLight(np.array([-1.0, -1.0, -1.0])), PointLight(np.array([2.0, 2.0, 1.0])))
    return replace(Scene((mesh,), camera, lights, size), **changes)


def plain_ball() -> Scene:
    """Return a ball of one colour under two lights, that is lit pixel by pixel."""
    positions, triangles = icosphere(4)
    return replace(ball(size=(120, 90)), meshes=(Mesh(positions, triangles, normals=positions),))


def textured_ball(with_torn_triangle: bool = False) -> Scene:
    """Return a textured ball lit from far away; the triangle above it has normals that no word of normals bears."""
    positions, triangles = icosphere(4)
    normals = positions
    if with_torn_triangle:
        positions = np.concatenate([positions, [[-0.4, 0.98, 0.5], [0.4, 0.98, 0.5], [0.0, 1.1, 0.5]]])
        normals = np.concatenate([normals, [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]])
        triangles = np.concatenate(
            [triangles, [[len(positions) - 3, len(positions) - 2, len(positions) - 1]]]
        )
    texture = Texture(np.random.default_rng(4).random((32, 32, 3), np.float32))
    mesh = Mesh(positions, triangles, normals, uvs=positions[:, :2] * 1.5, texture=texture)
    lights = (DirectionalLight(np.array([-1.0, -1.0, -1.0])),)
    return replace(ball(size=(220, 200)), meshes=(mesh,), lights=lights)


def textured_rings() -> Scene:
    positions, triangles = torus(24, 12)
    generator = np.random.default_rng(3)
    texture = Texture(generator.random((16, 16, 3), np.float32))
    uvs = generator.random((len(positions), 2)) * 2
    first = Mesh(positions, triangles, uvs=uvs, texture=texture)
    return Scene(
        (first, replace(first, transform=np.diag([0.7, 0.7, 2.0, 1.0])), ball().meshes[0]),
        Camera(np.array([0.3, 0.2, 1.2]), np.zeros(3), near=0.5),
        (PointLight(np.array([1.0, 2.0, 2.0])),),
        (101, 67),
        np.array([0.1, 0.2, 0.3, 1.0]),
    )


def loose_triangles(count: int, size: tuple[int, int]) -> ClipScene:
    generator = np.random.default_rng(count)
    clip = generator.normal(0.0, 1.0, (count, 3, 4))
    clip[:, :, 3] = generator.uniform(-0.2, 2.0, (count, 3))
    return ClipScene(clip, generator.random((count, 3, 4)), size)


def textured_sheets() -> Scene:
    """Return two sheets below, one behind the other, and one above: only the lower half has two layers."""
    sheets = [(-1.0, -0.7, 0.0), (-0.97, -0.72, 0.1), (-0.5, 0.97, 0.1)]
    positions = np.array(
        [
            corner
            for low, high, z in sheets
            for corner in ((-1, low, z), (1, low, z), (1, high, z), (-1, high, z))
        ]
    )
    triangles = np.array(
        [[4 * k + i for i in corners] for k in range(3) for corners in ((0, 1, 2), (0, 2, 3))]
    )
    uvs = np.tile([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], (3, 1))
    texture = Texture(np.random.default_rng(1).random((64, 64, 3), np.float32))
    mesh = Mesh(positions, triangles, uvs=uvs, texture=texture)
    return Scene((mesh,), Camera(np.array([0.2, 0.3, 2.9]), np.zeros(3)), (), (512, 512))


def smooth_below_and_steep_above() -> ClipScene:
    """Return two triangles: bytes are right for the lower one, not for the upper one, whose w differ a lot."""
    clip = np.array(
        [
            [[-1.0, -1.0, 0, 1], [1, -1, 0, 1], [0, -0.8, 0, 1]],
            [[-9.0, 4.5, 0, 9], [1, 0.5, 0, 1], [0, 0.9, 0, 1]],
        ]
    )
    colors = np.array([[0.5, 0.5, 0.5, 1], [0.52, 0.5, 0.5, 1], [0.5, 0.52, 0.5, 1]])
    bright = np.array([[1.0, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]])
    return ClipScene(clip, np.stack([colors, bright]), (60, 90))


SCENES = {
    "ball": (ball(), SPANS),
    "ball, one side drawn": (ball(), replace(SPANS, cull="back", shading="gouraud")),
    "ball in bytes": (ball(5, (200, 200)), replace(SPANS, cull="back", shading="gouraud")),
    "ball in bytes, both sides": (ball(5, (200, 200)), replace(SPANS, shading="gouraud")),
    "ball of flat faces": (ball(), replace(SPANS, shading="flat", depth="z-float32")),
    "ball behind the lower edge": (
        ball(eye=(0.0, 2.0, 2.0), size=(64, 97)),
        replace(SPANS, depth="inverse-w"),
    ),
    "rings with a texture": (textured_rings(), SPANS),
    "smooth below, steep above": (smooth_below_and_steep_above(), SPANS),
    "two layers in one band": (textured_sheets(), replace(SPANS, cull="back", shading="unlit")),
    "wireframe": (textured_rings(), replace(SPANS, polygon_mode="wireframe")),
    "blended": (loose_triangles(60, (50, 41)), replace(SPANS, blend="over")),
    "painter": (loose_triangles(60, (50, 41)), replace(SPANS, visibility="painters")),
    "another fill": (textured_rings(), Settings(fill="blocks")),
    "through the eye": (loose_triangles(200, (64, 64)), SPANS),
    "clipped": (loose_triangles(200, (64, 33)), replace(SPANS, clipping="sutherland-hodgman")),
    "two rows": (loose_triangles(40, (300, 2)), SPANS),
    "one row": (loose_triangles(40, (300, 1)), SPANS),
    "ball of one colour": (plain_ball(), replace(SPANS, cull="back")),
    "textured ball": (textured_ball(), replace(SPANS, cull="back")),
    "textured ball below a torn triangle": (textured_ball(True), replace(SPANS, cull="back")),
    "nothing": (ball(eye=(0.0, 0.0, 90.0), size=(9, 9)), SPANS),
}


@pytest.fixture(scope="module")
def workers() -> Iterator[BandWorkers]:
    with BandWorkers(2, always=True) as started:
        assert started.start(), started.failure
        yield started
        assert started.failure == ""


@pytest.mark.parametrize("encoding", ["srgb", "linear"])
@pytest.mark.parametrize("name", list(SCENES))
def test_two_processes_draw_the_bytes_of_one(workers: BandWorkers, name: str, encoding: str) -> None:
    scene, settings = SCENES[name]
    alone = draw_picture(scene, settings, encoding=encoding)
    for _ in range(3):  # the cut between the bands moves
        together = workers.draw(scene, settings, encoding)
        np.testing.assert_array_equal(together.pixels, alone.pixels)
        assert together.statistics["raster"].outgoing == alone.statistics["raster"].outgoing
        assert together.statistics["cull"].outgoing == alone.statistics["cull"].outgoing
        assert together.route.visible == alone.route.visible
    assert workers.sharing.process_count == 2 or "too few" in workers.sharing.reason
    assert not together.pixels.flags.writeable


def test_colours_that_one_band_needs_are_those_of_all_bands_and_later_again_the_cheap_ones() -> None:
    smooth, torn = textured_ball(), textured_ball(with_torn_triangle=True)
    assert draw_picture(torn, region=(0, 0, 220, 100)).route.color == "lit-texture"
    expected = {id(scene): draw_picture(scene) for scene in (smooth, torn)}
    assert [expected[id(scene)].route.color for scene in (smooth, torn)] == ["lit-texture", "deferred"]
    assert (expected[id(torn)].pixels[:90] != expected[id(smooth)].pixels[:90]).any()
    with BandWorkers(2, always=True) as workers:
        assert workers.start(), workers.failure
        for scene in (smooth, torn, torn, smooth, smooth, torn):
            together = workers.draw(scene)
            np.testing.assert_array_equal(together.pixels, expected[id(scene)].pixels)
            assert together.route.color == expected[id(scene)].route.color
            assert workers.sharing.process_count == 2


@pytest.mark.parametrize(
    ("allowed", "with_cheap", "with_plain"),
    [
        (["bytes", "bytes"], True, False),
        (["bytes", "deferred"], False, True),
        (["bytes", "palette"], True, False),
        (["palette", "palette"], True, False),
        (["palette", "deferred"], True, True),
        (["deferred", "deferred"], True, True),
        (["", "normals"], True, False),
    ],
)
def test_bands_have_the_colours_of_the_whole(allowed: list[str], with_cheap: bool, with_plain: bool) -> None:
    routes = [Route("words", name or "normals", visible=1, allowed=name) for name in allowed]
    assert have_colors_of_whole(routes, plain_colors=False) == with_cheap
    assert have_colors_of_whole(routes, plain_colors=True) == with_plain


@pytest.mark.parametrize("name", list(SCENES))
def test_two_processes_keep_the_depth_of_one(workers: BandWorkers, name: str) -> None:
    scene, settings = SCENES[name]
    alone = draw_picture(scene, settings, with_depth=True)
    together = workers.draw(scene, settings, with_depth=True)
    np.testing.assert_array_equal(together.pixels, alone.pixels)
    assert alone.depth is not None
    assert together.depth is not None
    assert together.depth.dtype == alone.depth.dtype
    np.testing.assert_array_equal(together.depth, alone.depth)
    assert not together.depth.flags.writeable
    assert workers.draw(scene, settings).pixels.tobytes() == alone.pixels.tobytes()


@pytest.mark.parametrize("with_depth", [False, True])
def test_pixels_go_to_the_memory_that_is_given(workers: BandWorkers, with_depth: bool) -> None:
    scene = ball(size=(75, 61))
    out = np.zeros((61, 75, 4), np.uint8)
    picture = workers.draw(scene, SPANS, with_depth=with_depth, out=out)
    assert np.shares_memory(picture.pixels, out)
    np.testing.assert_array_equal(out, draw_picture(scene, SPANS).pixels)
    assert workers.sharing.process_count == 2


@pytest.mark.parametrize(
    "out",
    [
        np.zeros((62, 75, 4), np.uint8),
        np.zeros((61, 75, 4), np.int8),
        np.zeros((61, 75, 8), np.uint8)[:, :, ::2],
    ],
    ids=["shape", "type", "gaps"],
)
def test_memory_that_does_not_fit_is_refused_for_the_whole_picture(workers: BandWorkers, out) -> None:
    pids = workers.pids
    with pytest.raises(ValueError, match=r"out must be \(61, 75, 4\)"):
        workers.draw(ball(size=(75, 61)), SPANS, out=out)
    assert workers.pids == pids


def test_three_processes_draw_the_bytes_of_one() -> None:
    scene = ball(size=(70, 50))
    with BandWorkers(3, always=True) as workers:
        assert workers.start()
        for step in range(4):
            turned = replace(scene, camera=replace(scene.camera, eye=np.array([step * 0.3, 0.5, 2.5])))
            np.testing.assert_array_equal(
                workers.draw(turned, SPANS).pixels, draw_picture(turned, SPANS).pixels
            )
        bands = workers.sharing.bands
        assert [band.first for band in bands] == [0, bands[0].end, bands[1].end]
        assert bands[2].end == 50


def test_a_picture_stays_when_the_next_one_is_drawn_and_the_workers_are_closed() -> None:
    with BandWorkers(2, always=True) as workers:
        assert workers.start()
        first = workers.draw(ball(), SPANS)
        kept = first.pixels.copy()
        workers.draw(ball(size=(400, 300)), SPANS)  # also asks for more memory
        workers.draw(ball(eye=(2.0, 0.0, 2.0)), SPANS)
    np.testing.assert_array_equal(first.pixels, kept)


def test_a_scene_that_is_refused_is_refused_here_and_the_workers_stay(workers: BandWorkers) -> None:
    flat_camera = Camera(np.array([0.0, 0.0, 3.0]), np.zeros(3), projection="orthographic")
    pids = workers.pids
    with pytest.raises(ValueError, match="needs a perspective camera"):
        workers.draw(ball(camera=flat_camera), replace(SPANS, depth="inverse-w"))
    with pytest.raises(ValueError, match="encoding must be"):
        workers.draw(ball(), SPANS, "cmyk")
    assert workers.draw(ball(), SPANS).route.visible > 0
    assert workers.pids == pids


def test_threads_draw_at_the_same_time(workers: BandWorkers) -> None:
    scenes = [ball(eye=(0.3 * step, 0.4, 2.5)) for step in range(8)]
    with ThreadPoolExecutor(4) as pool:
        pictures = list(pool.map(lambda scene: workers.draw(scene, SPANS), scenes))
    for scene, picture in zip(scenes, pictures, strict=True):
        np.testing.assert_array_equal(picture.pixels, draw_picture(scene, SPANS).pixels)


def test_small_pictures_stay_in_one_process() -> None:
    with BandWorkers(2) as workers:
        for _ in range(3):
            workers.draw(ball(), SPANS)
        assert workers.pids == ()
        assert workers.sharing.process_count == 1
        assert "not worth it" in workers.sharing.reason


def test_large_pictures_start_the_workers_and_do_not_wait_for_them() -> None:
    scene = ball(size=(700, 700))
    with BandWorkers(2) as workers:
        workers.draw(scene, SPANS)
        assert "first picture" in workers.sharing.reason
        workers.draw(scene, SPANS)
        assert "being started" in workers.sharing.reason
        assert len(workers.pids) == 1
        deadline = time.monotonic() + 30
        reasons = set()
        while workers.sharing.process_count == 1 and time.monotonic() < deadline:
            picture = workers.draw(scene, SPANS)
            reasons.add(workers.sharing.reason)
        assert reasons <= {"the worker processes are being started", "one process is timed first", ""}
        assert workers.sharing.process_count == 2
        assert workers.sharing.gain > 0
        np.testing.assert_array_equal(picture.pixels, draw_picture(scene, SPANS).pixels)


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


def is_gone(pid: int, but: set[str] | None = None, seconds: float = 5.0) -> bool:
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
    from core.picture.workers import BandWorkers

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
    assert process.stdout is not None
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


def has_ended(pid: int, seconds: float = 10.0) -> bool:
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
@pytest.mark.parametrize("is_drawing", [False, True])
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
            patch.setattr("core.picture.workers.band_workers.draw_picture", interrupt)
            with pytest.raises(KeyboardInterrupt):
                workers.draw(scene, SPANS)
        assert not any(is_running(pid) for pid in interrupted)
        assert workers.start()
        np.testing.assert_array_equal(workers.draw(scene, SPANS).pixels, draw_picture(scene, SPANS).pixels)
