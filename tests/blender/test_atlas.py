"""Parts of several objects in one UV square."""

import bpy
import numpy as np
import pytest
import scenes

ATLAS = {"checker": False, "darts": 0.0, "atlas": True}


def triangles_in_uv(obj):
    """(t, 3, 2)"""
    obj.data.calc_loop_triangles()
    corners = np.array([triangle.loops[:] for triangle in obj.data.loop_triangles])
    return scenes.corner_uv(obj.data, "Koebe")[corners]


def density(obj):
    """The mean texel density: sides of the UV square per unit of length."""
    vertices = scenes.read(obj.data.vertices, "co", float, 3)
    faces = np.array([triangle.vertices[:] for triangle in obj.data.loop_triangles])
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    surface = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() * obj.scale[0] ** 2
    return np.sqrt(np.abs(scenes.signed_areas(obj.data, "Koebe")).sum() / surface)


def times_covered(triangles, count=3000):
    """How many triangles cover each of some random points of the square."""
    points = np.random.default_rng(1).random((count, 2))
    covered = np.zeros(count, dtype=int)
    for a, b, c in triangles:
        sides = [(q[0] - p[0]) * (points[:, 1] - p[1]) - (q[1] - p[1]) * (points[:, 0] - p[0])
                 for p, q in ((a, b), (b, c), (c, a))]  # fmt: skip
        covered += np.all(np.array(sides) > 0.0, axis=0)
    return covered


def three_objects():
    objects = [scenes.add_panel(size=14), scenes.add_panel("Small", size=8), scenes.add_panel("Large", size=10)]
    objects[1].scale = (0.5,) * 3
    objects[2].scale = (2.0,) * 3
    scenes.select(*objects)
    return objects


def test_objects_share_the_square_at_one_density():
    objects = three_objects()
    assert bpy.ops.uv.koebe_parts(**ATLAS) == {"FINISHED"}
    triangles = [triangles_in_uv(obj) for obj in objects]
    together = np.concatenate(triangles)
    assert together.min() >= 0.0 and together.max() <= 1.0
    covered, rows = times_covered(together), bpy.context.window_manager.koebe_uv.islands
    assert covered.max() == 1 and covered.sum() == sum(times_covered(own).sum() for own in triangles)
    assert covered.mean() == pytest.approx(rows[0].coverage, abs=0.04)
    assert np.ptp([density(obj) for obj in objects]) < 0.1 * density(objects[0])


def test_without_it_objects_lie_on_each_other():
    objects = three_objects()
    assert bpy.ops.uv.koebe_parts(**ATLAS | {"atlas": False}) == {"FINISHED"}
    assert times_covered(np.concatenate([triangles_in_uv(obj) for obj in objects])).max() > 1


def test_each_object_has_its_row_and_its_own_seams():
    objects = three_objects()
    assert bpy.ops.uv.koebe_parts(write_seams=True, evenness=0.8, **ATLAS) == {"FINISHED"}
    rows = [row for row in bpy.context.window_manager.koebe_uv.islands if row.mapped]
    assert [row.object_name for row in rows] == [obj.name for obj in objects]
    assert "Large" in rows[0].note and rows[0].parts == rows[1].parts
    for obj in objects:
        uv = scenes.corner_uv(obj.data, "Koebe")
        ends = {}
        for polygon in obj.data.polygons:
            loops = list(polygon.loop_indices)
            for one, other in zip(loops, [*loops[1:], loops[0]], strict=True):
                ends.setdefault(obj.data.loops[one].edge_index, []).append(np.sort(uv[[one, other]], axis=0))
        cut = {edge for edge, sides in ends.items() if len(sides) == 2 and np.abs(sides[0] - sides[1]).max() > 0}
        assert cut == {edge.index for edge in obj.data.edges if edge.use_seam}


def test_what_cannot_be_mapped_is_left_out():
    objects = three_objects()
    flat = scenes.add_object("Flat", np.zeros((3, 3)), np.array([[0, 1, 2]]))
    scenes.select(*objects, flat)
    assert bpy.ops.uv.koebe_parts(**ATLAS) == {"FINISHED"}
    together = np.concatenate([triangles_in_uv(obj) for obj in objects])
    assert times_covered(together).max() == 1
    assert "Koebe" not in flat.data.uv_layers
    assert [row.object_name for row in bpy.context.window_manager.koebe_uv.islands if not row.mapped] == ["Flat"]


def test_a_group_that_one_object_has():
    objects = three_objects()
    group = objects[2].vertex_groups.new(name="Important")
    group.add(list(range(len(objects[2].data.vertices))), 1.0, "ADD")
    assert bpy.ops.uv.koebe_parts(importance="Important", **ATLAS) == {"FINISHED"}
    assert density(objects[2]) == pytest.approx(4.0 * density(objects[0]), rel=0.1)


def test_automatic_makes_parts_of_all():
    objects = three_objects()
    assert bpy.ops.uv.koebe_unwrap(shape="AUTO", **ATLAS) == {"FINISHED"}
    assert times_covered(np.concatenate([triangles_in_uv(obj) for obj in objects])).max() == 1


def test_an_object_too_small_beside_the_others_is_left_out():
    objects = [scenes.add_panel(size=8), scenes.add_panel("Tiny", size=8)]
    objects[1].scale = (1e-25,) * 3
    scenes.select(*objects)
    assert bpy.ops.uv.koebe_parts(**ATLAS) == {"FINISHED"}
    row = next(row for row in bpy.context.window_manager.koebe_uv.islands if row.object_name == "Tiny")
    assert not row.mapped and "too small beside the other objects" in row.message
    assert "Koebe" in objects[0].data.uv_layers and "Koebe" not in objects[1].data.uv_layers
    objects[1].scale = (1e-3,) * 3
    assert bpy.ops.uv.koebe_parts(**ATLAS) == {"FINISHED"}
    assert density(objects[1]) == pytest.approx(density(objects[0]), rel=0.1)
