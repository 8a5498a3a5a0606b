"""Filled holes continue whatever lives on vertices and corners, and fail for one object alone."""

import contextlib

import bpy
import fingerprint
import numpy as np
import pytest
import scenes
import states

CO = ("co", np.float32, 3)


def add_flat(**options):
    """A flat panel: what is linear on it is harmonic on its patches as well."""
    obj = scenes.add_panel("Flat", height=lambda x, y: 0 * x, **{**states.SMALL, **options})
    states.consistent([obj])
    scenes.select(obj)
    return obj


def places(obj, key=None):
    """Vertices of the mesh, or of one of its shape keys."""
    return scenes.read(obj.data.shape_keys.key_blocks[key].data if key else obj.data.vertices, *CO).astype(float)


def fill(mode, which="holes"):
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.mesh.koebe_fill_holes(which=which) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")


def bent(x, y, z):
    """An affine map."""
    return np.stack([1.5 * x + 0.2 * y, y - 0.3 * x, z + 0.7 * x + 2.0], axis=-1)


def add_keys(obj):
    """A basis, an affine image of it, one relative to that, and one that is as the basis around the holes."""
    rest = places(obj)
    obj.shape_key_add(name="Basis")
    for name, values in (("Bent", bent(*rest.T)), ("Further", bent(*bent(*rest.T).T)), ("Same", rest)):
        obj.shape_key_add(name=name).data.foreach_set("co", np.float32(values).ravel())
    blocks = obj.data.shape_keys.key_blocks
    blocks["Further"].relative_key = blocks["Bent"]
    return rest


@pytest.mark.parametrize("active", [0, 1])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_new_vertices_follow_in_every_shape_key(mode, active):
    obj = add_flat()
    old = len(add_keys(obj))
    obj.active_shape_key_index = active
    before = {block.name: places(obj, block.name) for block in obj.data.shape_keys.key_blocks}
    fill(mode)
    basis = places(obj, "Basis")
    assert len(basis) > old
    for name, values in before.items():
        assert np.array_equal(places(obj, name)[:old], values), name
    assert np.abs(basis[:, 2]).max() < 1e-5  # in the plane of the others
    assert np.abs(basis[old:, :2]).max() < 1 and len(np.unique(basis.round(5), axis=0)) == len(basis)
    for name, expected in (("Bent", bent(*basis.T)), ("Further", bent(*bent(*basis.T).T)), ("Same", basis)):
        assert np.abs(places(obj, name) - expected).max() < 2e-5, name
    assert np.abs(places(obj) - basis).max() < 1e-6  # the mesh itself is its basis


def test_shape_keys_with_a_change_that_only_edit_mode_knows():
    """The basis is moved in Edit Mode: the keys relative to it move with it, and the new vertices as well."""
    found = []
    for filled in (False, True):
        states.new_file()
        obj = add_flat()
        add_keys(obj)
        obj.active_shape_key_index = 0
        scenes.edit_all()
        bpy.ops.transform.translate(value=(0, 0, 3))
        if filled:
            assert bpy.ops.mesh.koebe_fill_holes() == {"FINISHED"}
        bpy.ops.object.mode_set(mode="OBJECT")
        found.append({block.name: places(obj, block.name) for block in obj.data.shape_keys.key_blocks})
    without, filled = found
    for name, values in without.items():
        old = len(values)
        assert np.abs(filled[name][:old] - values).max() < 1e-6, name
        assert filled[name][old:, 2].min() >= values[:, 2].min() - 1e-4, name


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_new_vertices_have_the_weights_around_them(mode):
    """So no armature tears them off."""
    obj = add_flat()
    old = len(obj.data.vertices)
    for name, weight in (("All", lambda x: 1.0), ("Ramp", lambda x: 0.5 + 0.4 * x), ("None", lambda x: None)):
        group = obj.vertex_groups.new(name=name)
        for vertex in obj.data.vertices:
            if weight(vertex.co.x) is not None:
                group.add([vertex.index], weight(vertex.co.x), "REPLACE")
    fill(mode)
    for vertex in list(obj.data.vertices)[old:]:
        weights = {obj.vertex_groups[one.group].name: one.weight for one in vertex.groups}
        assert set(weights) == {"All", "Ramp"}
        assert weights["All"] == pytest.approx(1.0, abs=1e-6)
        assert weights["Ramp"] == pytest.approx(0.5 + 0.4 * vertex.co.x, abs=0.05)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("kind", ["FLOAT_COLOR", "BYTE_COLOR"])
@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
def test_colours_go_on(mode, kind, domain):
    obj = add_flat()
    mesh = obj.data
    old = len(mesh.vertices)
    mesh.color_attributes.new("Paint", kind, domain)
    vertex = scenes.read(mesh.loops, "vertex_index", np.int32) if domain == "CORNER" else np.arange(old)
    x = places(obj)[vertex, 0]
    colors = np.stack([0.5 + 0.4 * x, 0.2 + 0 * x, 0.5 - 0.4 * x, 1 + 0 * x], axis=1)
    mesh.attributes["Paint"].data.foreach_set("color", np.float32(colors).ravel())
    fill(mode)
    vertex = scenes.read(mesh.loops, "vertex_index", np.int32) if domain == "CORNER" else np.arange(len(mesh.vertices))
    found = scenes.read(mesh.attributes["Paint"].data, "color", np.float32, 4)
    x = places(obj)[vertex, 0]
    assert found[:, 0] == pytest.approx(0.5 + 0.4 * x, abs=0.06)
    assert found[:, 1] == pytest.approx(0.2, abs=5e-3) and found[:, 3] == pytest.approx(1, abs=5e-3)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_own_attributes_go_on(mode):
    obj = add_flat()
    mesh = obj.data
    counts = {"POINT": len(mesh.vertices), "CORNER": len(mesh.loops), "FACE": len(mesh.polygons)}
    for kind, name, width, dtype in (("FLOAT", "value", 1, np.float32), ("INT", "value", 1, np.int32),
                                     ("FLOAT_VECTOR", "vector", 3, np.float32)):  # fmt: skip
        for domain, count in counts.items():
            mesh.attributes.new(f"{kind} {domain}", kind, domain)
            mesh.attributes[f"{kind} {domain}"].data.foreach_set(name, np.full(count * width, 7, dtype))
    mesh.attributes.new("Text", "STRING", "POINT")
    text = b"rim" if bpy.app.version >= (4, 0, 0) else "rim"
    for item in mesh.attributes["Text"].data:
        item.value = text
    fill(mode)
    for attribute in mesh.attributes:
        if attribute.name.split(" ")[0] in ("FLOAT", "INT", "FLOAT_VECTOR"):
            name, width, dtype = fingerprint.VALUES[attribute.data_type]
            assert (scenes.read(attribute.data, name, dtype, width) == 7).all(), attribute.name
    assert {item.value for item in mesh.attributes["Text"].data} == {text}
    assert not mesh.validate()


def test_pins_are_not_multiplied():
    import bmesh

    obj = add_flat()
    obj.data.uv_layers.new(name="Koebe")
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(obj.data)
    old = len(edited.faces)
    for face in edited.faces:
        for corner in face.loops:
            corner[edited.loops.layers.uv["Koebe"]].pin_uv = True
    bpy.ops.mesh.koebe_fill_holes()
    edited = bmesh.from_edit_mesh(obj.data)
    layer = edited.loops.layers.uv["Koebe"]
    pinned = [any(corner[layer].pin_uv for corner in face.loops) for face in edited.faces]
    assert all(pinned[:old]) and not any(pinned[old:]) and len(pinned) > old


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_all_with_a_lone_triangle_leaves_that_alone_and_fills_the_others(mode):
    good = scenes.add_panel("Good", **states.SMALL)
    lone = scenes.add_object("Lone", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    later = scenes.add_panel("Later", **states.SMALL)
    states.consistent([good, lone, later])
    scenes.select(good, lone, later)
    bpy.ops.object.mode_set(mode=mode)
    before = fingerprint.of_object(fingerprint.fingerprint(), lone)
    assert bpy.ops.mesh.koebe_fill_holes(which="all") == {"FINISHED"}
    assert fingerprint.of_object(fingerprint.fingerprint(), lone) == before
    bpy.ops.object.mode_set(mode="OBJECT")
    for obj in (good, later):
        assert scenes.boundary_loops(obj.data) == []
    scenes.select(lone)
    with pytest.raises(RuntimeError, match="only the back of one face"):
        bpy.ops.mesh.koebe_fill_holes(which="all")


def test_a_sheet_of_two_triangles_is_not_closed_to_something_flat():
    """The patch may turn over the other diagonal, or there is none: never two faces at one place."""
    obj = scenes.add_object("Sheet", [(0, 0, 0), (1, 0, 0), (1, 1, 0.3), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])
    scenes.select(obj)
    with contextlib.suppress(RuntimeError):
        bpy.ops.mesh.koebe_fill_holes(which="all")
    faces = [frozenset(polygon.vertices) for polygon in obj.data.polygons]
    uses = np.bincount(scenes.read(obj.data.loops, "edge_index", np.int32))
    assert len(set(faces)) == len(faces) and uses.max() <= 2


def test_what_blender_could_end_by_is_refused():
    """New vertices of a mesh with an attribute of matrices bring some versions down."""
    obj = add_flat()
    try:
        obj.data.attributes.new("Matrix", "FLOAT4X4", "POINT")
    except TypeError:
        pytest.skip("this version has no such attributes")
    with pytest.raises(RuntimeError, match="Flat: the attribute 'Matrix' holds matrices"):
        bpy.ops.mesh.koebe_fill_holes()
