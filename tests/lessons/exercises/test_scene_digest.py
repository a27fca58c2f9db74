"""Two scenes have one digest where they show the same shapes, and only there."""

from dataclasses import replace

from lessons.scene_edits import scene_digest
from lessons.scenes import make_scene
from lessons.window_scenes import equal_depths, two_triangles, two_triangles_turned


def test_tables_of_other_depths_are_other_scenes() -> None:
    digests = [scene_digest(make()) for make in (equal_depths, two_triangles, two_triangles_turned)]
    assert len(set(digests)) == 3
    table = two_triangles().table
    assert table is not None
    other = replace(two_triangles(), table=replace(table, test="less-equal"))
    assert scene_digest(other) != digests[1]
    assert scene_digest(two_triangles()) == digests[1]


def test_a_raster_and_colours_make_no_other_scene() -> None:
    scene = make_scene("shared-edge")
    assert scene_digest(replace(scene, size=(32, 24))) == scene_digest(scene)
