"""What goes through the pipe: meshes once, an orbit in a few hundred bytes."""

import gc
import pickle
from dataclasses import replace

import numpy as np

from core import Camera, DirectionalLight, Mesh, Scene, Settings, Texture
from core.fast_path.workers.serving import Message, Receiver, Sender, is_sent_once
from tests.core.meshes import icosphere


def scene_of(mesh: Mesh, step: int = 0) -> Scene:
    camera = Camera(np.array([0.1 * step, 0.0, 3.0]), np.zeros(3))
    return Scene((mesh,), camera, LIGHTS)


LIGHTS = (DirectionalLight(np.array([0.0, -1.0, -1.0])),)


def ball() -> Mesh:
    positions, triangles = icosphere(3)
    return Mesh(positions, triangles, texture=Texture(np.ones((8, 8, 3), np.float32)))


def byte_count(message: Message) -> int:
    return len(pickle.dumps(message))


def test_the_first_picture_sends_the_mesh_and_an_orbit_a_few_hundred_bytes() -> None:
    sender, mesh, settings = Sender(), ball(), Settings()
    first = sender.message((scene_of(mesh), settings))
    assert byte_count(first) > mesh.positions.nbytes
    for step in range(1, 4):
        message = sender.message((scene_of(mesh, step), settings))
        assert not message.new
        assert byte_count(message) < 1000


def test_what_arrives_is_what_was_sent_and_is_the_same_object_again() -> None:
    sender, receiver, mesh = Sender(), Receiver(), ball()
    first = receiver.content(sender.message(scene_of(mesh)))
    second = receiver.content(sender.message(scene_of(mesh, 1)))
    assert first.meshes[0] is second.meshes[0]
    arrived = first.meshes[0]
    for name in ("positions", "triangles", "transform"):
        np.testing.assert_array_equal(getattr(arrived, name), getattr(mesh, name))
    assert arrived.texture is not None
    assert arrived.material == arrived.material
    assert not arrived.positions.flags.writeable
    np.testing.assert_array_equal(second.camera.eye, [0.1, 0.0, 3.0])


def test_large_arrays_that_cannot_change_are_sent_once() -> None:
    frozen = np.zeros(1000)
    assert not is_sent_once(frozen)
    frozen.flags.writeable = False
    assert is_sent_once(frozen)
    assert not is_sent_once(frozen[:4])
    sender = Sender()
    assert len(sender.message([frozen, frozen]).new) == 1
    assert byte_count(sender.message([frozen])) < 100


def test_what_is_gone_is_forgotten_on_both_sides() -> None:
    sender, receiver, mesh = Sender(), Receiver(), ball()
    receiver.content(sender.message(scene_of(mesh)))
    kept = len(receiver)
    other = replace(mesh, texture=None, positions=mesh.positions * 2)
    receiver.content(sender.message(scene_of(other)))
    assert len(receiver) > kept
    del mesh
    gc.collect()
    message = sender.message(scene_of(other))
    assert message.forgotten
    receiver.content(message)
    del other
    gc.collect()
    receiver.content(sender.message(None))
    assert len(receiver) == len(LIGHTS)
