"""`uv.koebe_uniformize` on whole objects: what it writes, and what it leaves alone."""

import bpy
import numpy as np
import pytest
import scenes


def test_a_panel_with_holes_becomes_a_circle_domain():
    obj = scenes.add_panel()
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    scenes.assert_circle_domain(obj)
    assert obj.data.uv_layers.active.name == "Koebe"


@pytest.mark.parametrize("polish", [False, True])
def test_the_operator_writes_what_the_native_package_computes(koebe, polish):
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(outer="longest", tolerance=1e-5, upright=False, polish=polish)
    vertices = scenes.read(obj.data.vertices, "co", np.float32, 3)
    triangles, _ = scenes.triangles(obj.data)
    result = koebe.uniformize(
        vertices, triangles, outer="longest", tolerance=float(np.float32(1e-5)), balance="area", polish=polish
    )
    assert ("before_polish" in result.to_dict()["angle_error_deg"]) == polish
    expected = ((1.0 + result.uv) / 2.0).astype(np.float32)
    corner_vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), expected[corner_vertex])


def test_the_mesh_stays_bit_for_bit(addon):
    obj = scenes.add_panel()
    mesh = obj.data
    for name in ("First", "Second"):
        layer = mesh.uv_layers.new(name=name)
        values = np.random.default_rng(1).uniform(-2, 2, 2 * len(mesh.loops)).astype(np.float32)
        layer.data.foreach_set("uv", values)
    mesh.uv_layers["Second"].active_render = True
    mesh.edges[7].use_seam = True
    paint = bpy.data.materials.new("Paint")
    mesh.materials.append(paint)
    mesh.materials.append(None)
    mesh.polygons.foreach_set("material_index", np.arange(len(mesh.polygons), dtype=np.int32) % 2)
    before = scenes.mesh_state(mesh)
    bpy.ops.uv.koebe_uniformize()
    assert scenes.mesh_state(mesh, but_layer="Koebe") == before
    assert list(mesh.materials) == [paint, None]
    assert mesh.uv_layers["Second"].active_render
    assert [layer.name for layer in mesh.uv_layers] == ["First", "Second", "Koebe"]


def test_a_second_run_writes_the_same_layer_again_with_the_same_bits():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    first = scenes.corner_uv(obj.data, "Koebe").copy()
    obj.data.uv_layers["Koebe"].data.foreach_set("uv", np.zeros(2 * len(obj.data.loops), dtype=np.float32))
    bpy.ops.uv.koebe_uniformize()
    assert len(obj.data.uv_layers) == 1
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), first)


def test_several_objects_at_once_equal_one_by_one():
    one, two = scenes.add_panel("One"), scenes.add_panel("Two", size=20, holes=((0.1, 0.5, 0.3, 0.6),))
    scenes.select(one, two)
    bpy.ops.uv.koebe_uniformize()
    together = [scenes.corner_uv(obj.data, "Koebe").copy() for obj in (one, two)]
    for obj, expected in zip((one, two), together, strict=True):
        scenes.select(obj)
        bpy.ops.uv.koebe_uniformize(layer="Alone")
        assert np.array_equal(scenes.corner_uv(obj.data, "Alone"), expected)
    scenes.assert_circle_domain(two, holes=1)


def test_unselected_objects_are_not_touched():
    other = scenes.add_panel("Other")
    obj = scenes.add_panel("Chosen")
    bpy.ops.uv.koebe_uniformize()
    assert len(other.data.uv_layers) == 0 and len(other.material_slots) == 0
    assert len(obj.data.uv_layers) == 1


def test_objects_that_share_a_mesh_are_mapped_once():
    obj = scenes.add_panel()
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.collection.objects.link(twin)
    scenes.select(obj, twin)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert [layer.name for layer in obj.data.uv_layers] == ["Koebe"]
    assert len(bpy.context.window_manager.koebe_uv.islands) == 1
    scenes.assert_circle_domain(obj)


def test_non_uniform_scale_counts_as_the_shape_that_is_seen():
    stretched, applied = scenes.add_panel("Scaled"), scenes.add_panel("Applied")
    stretched.scale = (2.0, 0.5, 3.0)
    vertices = scenes.read(applied.data.vertices, "co", np.float32, 3) * np.float32([2.0, 0.5, 3.0])
    applied.data.vertices.foreach_set("co", vertices.ravel())
    plain = scenes.add_panel("Plain")
    scenes.select(stretched, applied, plain)
    bpy.ops.uv.koebe_uniformize()
    seen, expected, unscaled = (scenes.corner_uv(o.data, "Koebe") for o in (stretched, applied, plain))
    assert np.abs(seen - expected).max() < 1e-5
    assert np.abs(seen - unscaled).max() > 1e-2


def test_rotation_with_non_uniform_scale_under_a_parent_shears():
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    parent.scale = (1, 1, 3)
    obj, applied = scenes.add_panel("Sheared"), scenes.add_panel("Applied")
    obj.parent, obj.rotation_euler = parent, (0.7, 0.5, 0.3)
    bpy.context.view_layer.update()
    for vertex, source in zip(applied.data.vertices, obj.data.vertices, strict=True):
        vertex.co = obj.matrix_world @ source.co
    scenes.select(obj, applied)
    bpy.ops.uv.koebe_uniformize()
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - scenes.corner_uv(applied.data, "Koebe")).max() < 1e-5


def test_rotation_and_uniform_scale_change_nothing_to_speak_of():
    obj, moved = scenes.add_panel("Here"), scenes.add_panel("There")
    moved.location, moved.rotation_euler, moved.scale = (9, 8, 7), (0.4, 1.2, -2.0), (3, 3, 3)
    scenes.select(obj, moved)
    bpy.ops.uv.koebe_uniformize(upright=False)
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - scenes.corner_uv(moved.data, "Koebe")).max() < 1e-5


def test_a_mirrored_object_has_the_same_map_not_flipped():
    obj, mirrored = scenes.add_panel("Here"), scenes.add_panel("Mirrored")
    mirrored.scale = (-1, 1, 1)
    scenes.select(obj, mirrored)
    bpy.ops.uv.koebe_uniformize()
    scenes.assert_circle_domain(mirrored)
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - scenes.corner_uv(mirrored.data, "Koebe")).max() < 1e-5
    plain, warned = bpy.context.window_manager.koebe_uv.islands
    assert "negative" in warned.message and not plain.message


def test_ngons_and_quads_and_triangles_together():
    obj = scenes.add_panel()
    scenes.select_faces(obj, range(100, 200))
    bpy.ops.mesh.quads_convert_to_tris()
    bpy.ops.object.mode_set(mode="OBJECT")
    scenes.select_faces(obj, [polygon.index for polygon in obj.data.polygons if 70 in polygon.vertices])
    bpy.ops.mesh.dissolve_faces()
    bpy.ops.object.mode_set(mode="OBJECT")
    sizes = set(scenes.read(obj.data.polygons, "loop_total", np.int32).tolist())
    assert sizes > {3, 4} and max(sizes) > 4
    before = scenes.mesh_state(obj.data)
    bpy.ops.uv.koebe_uniformize()
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    scenes.assert_circle_domain(obj)


def test_the_loop_of_a_long_boundary_is_outside_if_asked():
    """A dome whose hole at the top is larger than its rim."""
    obj = scenes.add_object("Flare", *tube(rings=12, radius=lambda t: 1.0 + 2.0 * t))
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(outer="longest")
    loops = sorted(scenes.boundary_loops(obj.data), key=lambda loop: obj.data.vertices[loop[0]].co.z)
    low, high = (scenes.fit_circle(scenes.loop_uv(obj.data, "Koebe", loop))[1] for loop in loops)
    assert high == pytest.approx(0.5, abs=scenes.CIRCLE_TOLERANCE)
    assert low < 0.4


def tube(rings, radius, around=24):
    """Vertices and quads of an open surface of revolution."""
    angle = 2 * np.pi * np.arange(around) / around
    t = np.linspace(0.0, 1.0, rings + 1)
    vertices = [(radius(s) * np.cos(a), radius(s) * np.sin(a), s) for s in t for a in angle]
    at = lambda i, j: j * around + i % around  # noqa: E731
    return vertices, [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
                      for j in range(rings) for i in range(around)]  # fmt: skip


def test_undo_brings_everything_back_and_redo_the_result():
    obj = scenes.add_panel()
    before = scenes.mesh_state(obj.data)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.uv.koebe_uniformize("EXEC_DEFAULT", True)  # with an undo step, as from the interface
    mapped = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Panel"]
    assert scenes.mesh_state(obj.data) == before
    assert len(obj.data.uv_layers) == 0 and len(obj.material_slots) == 0
    bpy.ops.ed.redo()
    obj = bpy.data.objects["Panel"]
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), mapped)


def test_modifiers_and_shape_keys_do_not_matter():
    obj, plain = scenes.add_panel("Modified"), scenes.add_panel("Plain")
    obj.modifiers.new("Subdivide", "SUBSURF")
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Up").value = 1.0
    scenes.select(obj, plain)
    bpy.ops.uv.koebe_uniformize()
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), scenes.corner_uv(plain.data, "Koebe"))


@pytest.mark.parametrize("method", ["gk", "ck"])
def test_options_reach_the_native_package(koebe, monkeypatch, method):
    asked = {}
    original = koebe.uniformize

    def spy(vertices, triangles, **options):
        asked.update(options)
        return original(vertices, triangles, **{**options, "method": "gk", "engine": "condensed"})

    monkeypatch.setattr(koebe, "uniformize", spy)
    scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(method=method, engine="mesh", outer="longest", max_sweeps=7, balance="area")
    chosen = {key: asked[key] for key in ("method", "engine", "outer", "max_sweeps", "balance")}
    assert chosen == {"method": method, "engine": "mesh", "outer": "longest", "max_sweeps": 7, "balance": "area"}
