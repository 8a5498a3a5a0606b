"""The node groups for Geometry Nodes: they equal what the solver and the operators compute, and come and go."""

import bpy
import numpy as np
import pytest
import scenes

EXACT = 1e-5
NAMES = ["Koebe Bend onto Surface", "Koebe Moebius", "Koebe Move Circles", "Koebe Scatter",
         "Koebe UV by Attribute"]


def add():
    return bpy.ops.node.koebe_add_groups()


def put(obj, name, **values):
    """A modifier with a group, and values of its inputs by name."""
    if name not in bpy.data.node_groups:
        add()
    modifier = obj.modifiers.new(name, "NODES")
    modifier.node_group = bpy.data.node_groups[name]
    for key, value in values.items():
        give(modifier, key, value)
    obj.update_tag()
    bpy.context.view_layer.update()
    return modifier


def give(modifier, name, value):
    """Give an input of a modifier a value."""
    key = identifier(modifier.node_group, name)
    if hasattr(modifier, "properties"):  # from 5.2 on
        getattr(modifier.properties.inputs, key).value = value
    elif isinstance(value, tuple):
        modifier[key][:] = value
    else:
        modifier[key] = value


def identifier(group, name):
    if hasattr(group, "interface"):  # from 4.0 on
        return next(one.identifier for one in group.interface.items_tree if one.name == name and one.in_out == "INPUT")
    return group.inputs[name].identifier


def evaluated(obj):
    bpy.context.view_layer.update()
    return obj.evaluated_get(bpy.context.evaluated_depsgraph_get())


def shown(obj):
    """Vertices (n, 3) with the modifiers."""
    found = evaluated(obj)
    points = scenes.read(found.to_mesh().vertices, "co", np.float32, 3)
    found.to_mesh_clear()
    return points


def shown_uv(obj):
    found = evaluated(obj)
    mesh = found.to_mesh()
    if "Koebe" in mesh.uv_layers:
        uv = scenes.corner_uv(mesh, "Koebe")
    else:  # before 3.5 nodes know UV layers as vectors
        uv = scenes.read(mesh.attributes["Koebe"].data, "vector", np.float32, 3)[:, :2]
    found.to_mesh_clear()
    return uv


def surface_of(name, vertices, triangles, uv):
    """An object with UVs (V, 2)."""
    obj = scenes.add_object(name, vertices, triangles)
    layer = obj.data.uv_layers.new(name="Koebe")
    layer.data.foreach_set("uv", uv[triangles].astype(np.float32).ravel())
    return obj


def panel_triangles():
    """The panel as arrays of triangles, whose vertices are 32-bit numbers."""
    obj = scenes.add_panel("Source")
    triangles = scenes.triangles(obj.data)[0].copy()
    vertices = scenes.read(obj.data.vertices, "co", np.float32, 3).astype(np.float64)
    bpy.data.objects.remove(obj)
    return vertices, triangles


@pytest.mark.parametrize("height", [None, 0.05])
def test_lifted_points_are_the_solvers(koebe, height):
    vertices, triangles = panel_triangles()
    result = koebe.lift(vertices, triangles, "circles", size=0.25, perforate=height is None, height=height)
    disk = koebe.uniformize(vertices, triangles).uv
    surface = surface_of("Surface", vertices, triangles, 0.5 + 0.5 * disk)
    top = result.patch < 2
    uv, place = result.uv[top].reshape(-1, 2), result.vertices[result.triangles[top].ravel()]
    up = np.repeat(result.patch[top], 3) * (height or 0.0)
    flat = scenes.add_object("Flat", np.column_stack([uv, up]), [])
    put(flat, "Koebe Bend onto Surface", Surface=surface)
    found = shown(flat)
    assert found.shape == place.shape
    assert np.abs(found - place).max() < EXACT


def test_place_size_and_height_move_and_scale_the_drawing():
    square = np.array([[0, 0], [2, 0], [2, 2], [0, 2]], dtype=float)
    surface = surface_of(
        "Square", np.column_stack([square, np.zeros(4)]), np.array([[0, 1, 2], [0, 2, 3]]), square / 2
    )
    surface.location = (5.0, 0.0, 0.0)
    points = np.array([[0.0, 0.0, 0.0], [1.0, 0.5, 2.0], [9.0, 9.0, 0.0]])
    flat = scenes.add_object("Flat", points, [])
    modifier = put(flat, "Koebe Bend onto Surface", Surface=surface, Place=(0.25, 0.5, 0.0), Size=0.5, Height=0.1)
    assert np.abs(shown(flat) - [[5.5, 1.0, 0.0], [6.5, 1.5, 0.2]]).max() < EXACT  # and the third is not on it
    give(modifier, "In Proportion", True)
    flat.update_tag()
    assert np.abs(shown(flat) - [[5.5, 1.0, 0.0], [6.5, 1.5, 0.2 * 0.5 * 2]]).max() < EXACT


def half_sphere(rings=40, around=80):
    """Half of the unit sphere with its stereographic map, which is conformal."""
    turn = 2 * np.pi * np.arange(around) / around
    radius = np.arange(1, rings + 1) / rings
    z = np.append(0.0, np.outer(radius, np.cos(turn) + 1j * np.sin(turn)))
    below = 1.0 + np.abs(z) ** 2
    vertices = np.column_stack([2 * z.real / below, 2 * z.imag / below, 2.0 / below - 1.0])
    at = lambda i, j: 1 + i * around + j % around  # noqa: E731
    faces = [(0, at(0, j), at(0, j + 1)) for j in range(around)]
    for i in range(rings - 1):
        for j in range(around):
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return vertices, np.array(faces), np.column_stack([z.real, z.imag]) * 0.5 + 0.5


def test_scattered_instances_stand_on_the_surface_as_large_as_the_map_is():
    surface = surface_of("Sphere", *half_sphere())
    stone = scenes.add_cube("Stone")
    put(surface, "Koebe Scatter", Instance=stone, Count=16, Size=0.5)
    matrices = [np.array(one.matrix_world) for one in bpy.context.evaluated_depsgraph_get().object_instances
                if one.is_instance]  # fmt: skip
    assert 16 * 16 * 0.7 < len(matrices) < 16 * 16 * 1.1
    for matrix in matrices:
        place, axes = matrix[:3, 3], matrix[:3, :3]
        size = np.linalg.norm(axes, axis=0)
        assert np.linalg.norm(place) == pytest.approx(1.0, abs=2e-3)
        assert np.dot(axes[:, 2] / size[2], place) == pytest.approx(1.0, abs=2e-3)
        w = (place[0] + 1j * place[1]) / (1.0 + place[2])
        scale = 2.0 * 2.0 / (1.0 + abs(w) ** 2)  # UVs have half of the disk's lengths
        assert size == pytest.approx(np.full(3, 0.5 * scale / 16), rel=0.03)
        turned = np.array([1.0 - w.real**2 + w.imag**2, -2.0 * w.real * w.imag])  # along u, times a number
        along = axes[:2, 0] / size[0]
        aside = abs(turned[0] * along[1] - turned[1] * along[0])
        assert np.dot(turned, along) > 0.0 and aside < 0.05 * np.linalg.norm(turned)


def test_moved_circles_are_the_operators(addon):
    center, turn = (0.3, -0.2), 0.7
    moved = scenes.add_panel("Moved")
    bpy.ops.uv.koebe_uniformize(checker=False)
    live = moved.copy()
    live.data = moved.data.copy()
    bpy.context.collection.objects.link(live)
    before = scenes.corner_uv(live.data, "Koebe")
    modifier = put(live, "Koebe Move Circles", Centre=(*center, 0.0), Turn=turn)
    scenes.select(moved)
    assert bpy.ops.uv.koebe_moebius(center=center, rotation=turn) == {"FINISHED"}
    assert np.abs(shown_uv(live) - scenes.corner_uv(moved.data, "Koebe")).max() < EXACT
    moebius = addon("surfaces.moebius")
    formula = moebius.rotation(turn).after(moebius.to_middle(complex(*center)))
    z = formula.apply(2.0 * before[:, 0].astype(np.float64) - 1.0 + 1j * (2.0 * before[:, 1] - 1.0))
    assert np.abs(shown_uv(live) - np.column_stack([z.real, z.imag]) * 0.5 - 0.5).max() < EXACT
    assert np.array_equal(scenes.corner_uv(live.data, "Koebe"), before)
    give(modifier, "Centre", (7.0, 0.0, 0.0))  # out of the disk: kept inside
    live.update_tag()
    assert np.isfinite(shown_uv(live)).all()


@pytest.mark.parametrize("factor", [0.0, 0.25, 1.0])
def test_uvs_of_an_attribute_are_played(factor):
    obj = scenes.add_panel(size=12)
    bpy.ops.uv.koebe_uniformize(checker=False)
    before = scenes.corner_uv(obj.data, "Koebe")
    stored = np.column_stack([before + [0.5, 0.25], np.zeros(len(before))]).astype(np.float32)
    stored[:8] = 0.0  # no UVs there
    obj.data.attributes.new("Koebe_0007", "FLOAT_VECTOR", "CORNER").data.foreach_set("vector", stored.ravel())
    put(obj, "Koebe UV by Attribute", Attribute="Koebe_0007", Factor=factor)
    expected = before + factor * np.array([0.5, 0.25])
    expected[:8] = before[:8]
    assert np.abs(shown_uv(obj) - expected).max() < EXACT
    obj.modifiers.clear()
    put(obj, "Koebe UV by Attribute", Attribute="None of that name")
    assert np.abs(shown_uv(obj) - before).max() < EXACT


def test_groups_come_as_assets_and_go():
    assert not bpy.ops.node.koebe_remove_groups.poll()
    assert add() == {"FINISHED"} and add() == {"CANCELLED"}
    assert sorted(bpy.data.node_groups.keys()) == NAMES
    assert all(group.asset_data.description for group in bpy.data.node_groups)
    obj = scenes.add_panel()
    put(obj, "Koebe Move Circles")
    assert bpy.ops.node.koebe_remove_groups() == {"FINISHED"}
    assert sorted(bpy.data.node_groups.keys()) == ["Koebe Moebius", "Koebe Move Circles"]
    assert bpy.ops.node.koebe_remove_groups() == {"CANCELLED"}
    assert add() == {"FINISHED"} and sorted(bpy.data.node_groups.keys()) == NAMES
    obj.modifiers.clear()
    assert bpy.ops.node.koebe_remove_groups() == {"FINISHED"} and not bpy.data.node_groups


def test_names_that_are_taken_stay_the_users():
    own = bpy.data.node_groups.new("Koebe Bend onto Surface", "GeometryNodeTree")
    assert add() == {"FINISHED"} and len(bpy.data.node_groups) == 6
    assert bpy.ops.node.koebe_remove_groups() == {"FINISHED"}
    assert list(bpy.data.node_groups) == [own]


def test_undo_takes_the_groups_back():
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.node.koebe_add_groups("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    assert not bpy.data.node_groups
