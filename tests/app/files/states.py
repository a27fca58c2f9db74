"""States of every kind, what holds everything that is saved, and the comparison of two of them."""

from dataclasses import fields, replace

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from app.files.state_files import EXTENSION, State, load_state, save_state
from app.files.state_models import Bookmark, Breakpoints, GridLook, Look, OrbitRecord
from app.session.document import VIEWS, Document, TeachingRaster
from core import STAGES, Settings, render
from core.methods import table
from core.scene import Camera, ClipScene, DirectionalLight, Material, Mesh, PointLight, Scene, Texture
from core.settings import families
from core.stages.needs import refusal

EVERYTHING = Look(
    view="scene",
    views={"raster": "clip"},
    grid=GridLook(
        buffers={"raster": "E0"},
        overlays={"raster": ["tie"]},
        ranges={"E0": (-1.5, 1.5)},
        fits_ranges=True,
        hidden_buffers=["w"],
        middle=(0.25, 0.75),
        zoom=3.0,
    ),
    orbits={"scene": OrbitRecord(azimuth=1.0, elevation=0.5, target=(0.0, 1.0, 0.0), extent=2.0)},
    other={"fill": "hierarchy", "block_size": 4},
    other_buffer="depth",
    panes=["overlays"],
    text_size=125,
    event="tie",
)
FRAME_BUFFERS = ("color", "depth", "primitive", "attributes", "cover_count")


def again(folder, state):
    """Save and load."""
    path = folder / f"state{EXTENSION}"
    save_state(path, state)
    loaded, warnings = load_state(path)
    assert warnings == ()
    return loaded


def assert_same(first, second):
    """Compare two states: every number of the documents, the pictures and the step."""
    for name in ("stage", "position", "level", "pin", "breakpoints", "look"):
        assert getattr(first, name) == getattr(second, name)
    assert tuple(first.bookmarks) == tuple(second.bookmarks)
    one, two = first.document, second.document
    for name in ("raster", "settings", "triangle", "before", "title"):
        assert getattr(one, name) == getattr(two, name)
    assert_same_value(one.scene, two.scene)
    pictures = [render(d.traced_scene, d.settings) for d in (one, two)]
    for name in FRAME_BUFFERS:
        assert getattr(pictures[0], name).tobytes() == getattr(pictures[1], name).tobytes()
    traces = [s.document.make_trace().stage(s.stage) for s in (first, second)]
    explained = [t.explain(min(first.position, t.steps.count)) for t in traces]
    assert (explained[0] is None) == (explained[1] is None)
    if explained[0] is not None:
        assert explained[0].key == explained[1].key
        for name, value in explained[0].values.items():
            assert np.asarray(value).tobytes() == np.asarray(explained[1].values[name]).tobytes()


def assert_same_value(first, second):
    """Compare records field by field, arrays bit for bit."""
    assert type(first) is type(second)
    if isinstance(first, np.ndarray):
        assert (first.dtype, first.shape) == (second.dtype, second.shape)
        assert first.tobytes() == second.tobytes()
        assert not second.flags.writeable
    elif isinstance(first, tuple):
        assert len(first) == len(second)
        for one, two in zip(first, second, strict=True):
            assert_same_value(one, two)
    elif hasattr(first, "__dataclass_fields__"):
        for field in fields(first):
            assert_same_value(getattr(first, field.name), getattr(second, field.name))
    else:
        assert first == second


stages = st.sampled_from(STAGES)
# Named by what they are not: Hypothesis takes a second to find out what UTF-8 can write.
characters = st.characters(exclude_categories=["Cs"])
notes = st.text(characters, max_size=9)
numbers = st.floats(-50, 50, allow_subnormal=False)


def numbers_of(*shape):
    return arrays.arrays(np.float64, shape, elements=numbers)


@st.composite
def settings_values(draw):
    chosen = {family: draw(st.sampled_from(table.names(family))) for family in families()}
    return Settings(**chosen, block_size=draw(st.integers(1, 64)))


@st.composite
def clip_scenes(draw):
    count = draw(st.integers(1, 3))
    texture = None
    if draw(st.booleans()):
        texture = Texture(draw(arrays.arrays(np.float32, (2, 3, 3), elements=st.floats(0, 1, width=32))), "t")
    shared = draw(st.none() | arrays.arrays(np.int64, (count, 3), elements=st.integers(0, 5)))
    return ClipScene(
        draw(numbers_of(count, 3, 4)),
        draw(arrays.arrays(np.float64, (count, 3, draw(st.integers(2, 5))), elements=st.floats(0, 1))),
        (draw(st.integers(1, 20)), draw(st.integers(1, 20))),
        texture,
        draw(arrays.arrays(np.float64, 4, elements=st.floats(0, 1))),
        shared,
    )


@st.composite
def mesh_scenes(draw):
    count = draw(st.integers(3, 6))
    triangles = draw(arrays.arrays(np.int64, (2, 3), elements=st.integers(0, count - 1)))
    mesh = Mesh(
        draw(numbers_of(count, 3)),
        triangles,
        draw(st.none() | numbers_of(count, 3)),
        draw(st.none() | numbers_of(count, 2)),
        draw(st.none() | arrays.arrays(np.float64, (count, 4), elements=st.floats(0, 1))),
        faces=draw(st.none() | st.just(np.array([4, 4]))),
        transform=draw(numbers_of(4, 4)),
        material=Material(0.25, draw(st.floats(0, 1)), 0.5, draw(st.floats(1, 100)), draw(st.floats(0, 1))),
        name=draw(st.text(characters, max_size=5)),
    )
    projection = draw(st.sampled_from(["perspective", "orthographic"]))
    target = draw(numbers_of(3))
    camera = Camera(
        target + np.array([0.5, 1.0, 4.0]),
        target,
        projection=projection,
        field_of_view=draw(st.floats(0.2, 2.5)),
        near=draw(st.floats(0.1, 1)),
        far=draw(st.floats(2, 100)),
    )
    lights = (
        DirectionalLight(np.array([0.0, -1.0, draw(numbers)]), casts_shadow=draw(st.booleans())),
        PointLight(draw(numbers_of(3))),
    )
    return Scene((mesh,), camera, lights, (12, 9))


@st.composite
def states(draw):
    scene = draw(st.one_of(clip_scenes(), mesh_scenes()))
    settings = draw(settings_values())
    is_orthographic = isinstance(scene, Scene) and scene.camera.projection == "orthographic"
    if is_orthographic and "perspective" in table.get("depth", settings.depth).needs:
        settings = replace(settings, depth="z-float32")
    for family in ("object_culling", "shadow"):
        if refusal(family, getattr(settings, family), scene):
            settings = replace(settings, **{family: "none"})
    raster = TeachingRaster(draw(st.integers(1, 16)), draw(st.integers(1, 12)))
    document = Document(
        scene,
        raster,
        settings,
        triangle=draw(st.none() | st.just(0)),
        before=draw(st.sampled_from(["earlier", "cleared"])),
        title=draw(st.text(characters, max_size=8)),
    )
    stage = draw(st.sampled_from(STAGES))
    with np.errstate(all="ignore"):
        count = document.make_trace().stage(stage).steps.count
    return State(
        document,
        stage,
        draw(st.integers(0, count)),
        draw(st.integers(0, 4)),
        draw(st.none() | st.tuples(st.integers(0, raster.columns - 1), st.integers(0, raster.rows - 1))),
        draw(
            st.lists(st.builds(Bookmark, stage=stages, position=st.integers(0, 99), note=notes), max_size=3)
        ),
        draw(
            st.builds(
                Breakpoints,
                pixels=st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9)), max_size=2),
                condition=st.sampled_from(["", "E0 < 0.5 and covered"]),
            )
        ),
        draw(st.builds(Look, views=st.dictionaries(stages, st.sampled_from(VIEWS), max_size=2))),
    )
