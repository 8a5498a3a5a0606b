"""Edit Mode: only the selected faces are mapped, and the artist stays where they were."""

import bpy
import numpy as np
import pytest
import scenes


def parts(obj):
    """Faces inside and outside of a circle that no hole meets."""
    center = scenes.read(obj.data.polygons, "center", np.float32, 3)
    inside = np.hypot(center[:, 0], center[:, 1]) < 0.8
    return np.flatnonzero(inside), np.flatnonzero(~inside)


def corners_of(obj, faces):
    """Corners of these faces."""
    start = scenes.read(obj.data.polygons, "loop_start", np.int32)
    size = scenes.read(obj.data.polygons, "loop_total", np.int32)
    return np.concatenate([np.arange(start[f], start[f] + size[f]) for f in faces])


@pytest.mark.parametrize("existing", [False, True])
def test_only_selected_faces_get_uvs(existing):
    obj = scenes.add_panel()
    old = np.zeros((len(obj.data.loops), 2), dtype=np.float32)
    if existing:
        old = np.random.default_rng(2).uniform(0, 1, old.shape).astype(np.float32)
        obj.data.uv_layers.new(name="Koebe").data.foreach_set("uv", old.ravel())
    inside, outside = parts(obj)
    scenes.select_faces(obj, inside)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(obj.data, "Koebe")
    others = corners_of(obj, outside)
    assert np.array_equal(uv[others], old[others])
    points = uv[corners_of(obj, inside)]
    if not existing:  # where there are others, test_beside.py has the place
        assert np.abs(np.hypot(*(points - 0.5).T).max() - 0.5) < 1e-6  # they fill the disk
    assert np.flatnonzero(scenes.read(obj.data.polygons, "select", bool)).tolist() == inside.tolist()


def test_selected_faces_are_mapped_like_a_mesh_of_their_own():
    obj = scenes.add_panel()
    inside, _ = parts(obj)
    vertices = scenes.read(obj.data.vertices, "co", np.float32, 3)
    faces = [list(obj.data.polygons[f].vertices) for f in inside]
    used = np.unique(np.concatenate(faces))
    own = scenes.add_object("Own", vertices[used], [np.searchsorted(used, f) for f in faces])
    scenes.select(own)
    bpy.ops.uv.koebe_uniformize()
    scenes.select(obj)
    scenes.select_faces(obj, inside)
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="OBJECT")
    part = scenes.corner_uv(obj.data, "Koebe")[corners_of(obj, inside)]
    assert np.array_equal(part, scenes.corner_uv(own.data, "Koebe"))


def test_the_mesh_its_selection_and_the_active_face_stay():
    obj = scenes.add_panel()
    scenes.select_faces(obj, range(0, len(obj.data.polygons) // 2))
    bpy.ops.object.mode_set(mode="OBJECT")
    before = scenes.mesh_state(obj.data)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before


def test_hidden_faces_are_not_mapped():
    obj = scenes.add_panel()
    inside, outside = parts(obj)
    scenes.select_faces(obj, outside)
    bpy.ops.mesh.hide()
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert not uv[corners_of(obj, outside)].any()
    assert uv[corners_of(obj, inside)].all()


def test_nothing_selected_says_so():
    obj = scenes.add_panel()
    scenes.select_faces(obj, [])
    with pytest.raises(RuntimeError, match="no faces are selected"):
        bpy.ops.uv.koebe_uniformize()
    assert bpy.context.mode == "EDIT_MESH"
    assert len(obj.data.uv_layers) == 0


def test_edits_that_only_edit_mode_knows_are_seen():
    obj = scenes.add_panel()
    scenes.select_faces(obj)
    bpy.ops.transform.resize(value=(4, 1, 1))
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="OBJECT")
    written = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.uv.koebe_uniformize(layer="Outside")
    assert np.array_equal(written, scenes.corner_uv(obj.data, "Outside"))


def test_several_objects_in_edit_mode_and_a_selected_one_that_is_not():
    one, two, three = (scenes.add_panel(name) for name in ("One", "Two", "Three"))
    scenes.select(one, two)
    scenes.edit_all()
    three.select_set(True)
    bpy.ops.uv.koebe_uniformize()
    assert {obj.name for obj in bpy.context.objects_in_mode} == {"One", "Two"}
    assert three.select_get() and bpy.context.active_object is one
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(scenes.corner_uv(one.data, "Koebe"), scenes.corner_uv(two.data, "Koebe"))
    assert len(three.data.uv_layers) == 0


def test_the_loop_of_the_active_vertex_becomes_the_rim():
    import bmesh

    obj = scenes.add_panel()
    loops = scenes.boundary_loops(obj.data)
    hole = min(loops, key=len)
    scenes.edit_all()
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    mesh.select_history.add(mesh.verts[hole[0]])
    bmesh.update_edit_mesh(obj.data)
    bpy.ops.uv.koebe_uniformize(outer="active")
    bpy.ops.object.mode_set(mode="OBJECT")
    radii = {len(loop): scenes.fit_circle(scenes.loop_uv(obj.data, "Koebe", loop))[1] for loop in loops}
    assert radii.pop(len(hole)) == pytest.approx(0.5, abs=1e-6)
    assert max(radii.values()) < 0.5


def test_active_vertex_without_one_says_so():
    scenes.add_panel()
    with pytest.raises(RuntimeError, match="no vertex is active"):
        bpy.ops.uv.koebe_uniformize(outer="active")


def test_undo_in_edit_mode():
    obj = scenes.add_panel()
    scenes.select_faces(obj)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.uv.koebe_uniformize("EXEC_DEFAULT", True)  # with an undo step, as from the interface
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Panel"]
    assert obj.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert len(obj.data.uv_layers) == 0 and len(obj.material_slots) == 0


def test_the_old_place_is_kept_as_in_object_mode():
    """The UVs of a mesh in Edit Mode are read without leaving it."""
    found = []
    for mode in ("OBJECT", "EDIT"):
        obj = scenes.add_panel()
        vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
        uv = scenes.read(obj.data.vertices, "co", np.float32, 3)[vertex, :2]
        obj.data.uv_layers.new(name="Koebe").data.foreach_set("uv", (0.1 * uv + 0.7).astype(np.float32).ravel())
        meshes = len(bpy.data.meshes)
        scenes.edit_all(mode)
        assert bpy.ops.uv.koebe_uniformize(placement="keep") == {"FINISHED"}
        assert bpy.context.mode == ("EDIT_MESH" if mode == "EDIT" else "OBJECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        assert len(bpy.data.meshes) == meshes
        found.append(scenes.corner_uv(obj.data, "Koebe"))
    assert np.array_equal(*found)
    assert found[0].min() > 0.5  # where it was, not in the whole square


@pytest.mark.parametrize("existing", [False, True])
def test_islands_and_shape_keys_are_as_in_object_mode(existing):
    """The corners of an island are not in a row, and some Blenders get them without a change of mode."""
    found = []
    for mode in ("OBJECT", "EDIT"):
        obj = scenes.add_panel()
        middle = np.abs(scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]) < 1e-5
        ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
        obj.data.edges.foreach_set("use_seam", middle[ends].all(axis=1))
        for name in ("Basis", "Bent"):
            obj.shape_key_add(name=name)
        obj.data.shape_keys.key_blocks["Bent"].data[0].co = (9, 9, 9)
        obj.data.uv_layers.new(name="Other")
        if existing:
            obj.data.uv_layers.new(name="Koebe")
        scenes.edit_all(mode)
        assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
        bpy.ops.object.mode_set(mode="OBJECT")
        assert obj.data.uv_layers.active.name == "Koebe"
        assert obj.data.shape_keys.key_blocks["Bent"].data[0].co[:] == (9, 9, 9)
        assert len(bpy.context.window_manager.koebe_uv.islands) > 1
        found.append(scenes.corner_uv(obj.data, "Koebe"))
    assert np.array_equal(*found)
