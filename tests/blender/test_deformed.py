"""Deformed Shape: the map is of the shape that modifiers and shape keys show, and the mesh stays as it was."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def stretched(obj):
    """A modifier that makes the object three times as long in x."""
    modifier = obj.modifiers.new("Long", "DISPLACE")
    modifier.direction, modifier.mid_level, modifier.strength = "X", 0.0, 2.0
    group = obj.vertex_groups.new(name="At")
    x = scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]
    for vertex, share in enumerate((x - x.min()) / np.ptp(x)):
        group.add([vertex], float(share), "REPLACE")
    modifier.vertex_group = "At"
    modifier.strength = 2.0 * float(np.ptp(x))
    modifier.show_in_editmode = modifier.show_on_cage = True
    bpy.context.view_layer.update()


def keyed(obj):
    """A shape key at value 1 that makes the object three times as long in x."""
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Long")
    for point in key.data:
        point.co.x *= 3.0
    key.value = 1.0
    bpy.context.view_layer.update()


def form(obj):
    """Length over height of the UVs."""
    across = np.sort(np.ptp(scenes.corner_uv(obj.data, "Koebe"), axis=0))
    return across[1] / across[0]


@pytest.mark.parametrize("shape", ["PARTS", "AUTO"])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("deform", [stretched, keyed])
def test_the_shape_that_is_shown_is_unwrapped(deform, mode, shape):
    if deform is keyed and mode == "EDIT":
        pytest.skip("Edit Mode shows the key that is edited")
    obj = scenes.add_sheet()
    deform(obj)
    positions = scenes.read(obj.data.vertices, "co", np.float32, 3)
    given = {"shape": shape, "seams": "only", "checker": False}
    scenes.edit_all(mode)
    assert bpy.ops.uv.koebe_unwrap(**given) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert form(obj) == pytest.approx(1.0, abs=0.05)
    scenes.edit_all(mode)
    assert bpy.ops.uv.koebe_unwrap(deformed=True, **given) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert form(obj) == pytest.approx(3.0, abs=0.1)
    assert np.array_equal(scenes.read(obj.data.vertices, "co", np.float32, 3), positions)


@pytest.mark.parametrize("operator", ["uniformize", "parts", "ring", "torus", "sphere"])
def test_modifiers_that_make_faces_are_named(operator):
    obj = scenes.add_sheet()
    obj.modifiers.new("Thick", "SOLIDIFY")
    with pytest.raises(RuntimeError, match="it has other faces than its mesh .modifiers: 'Thick'.: turn off"):
        getattr(bpy.ops.uv, f"koebe_{operator}")(deformed=True)
    assert not obj.data.uv_layers


def test_a_hidden_object_says_so():
    obj = scenes.add_sheet()
    obj.hide_viewport = True
    with pytest.raises(RuntimeError):
        bpy.ops.uv.koebe_parts(deformed=True)
    assert not obj.data.uv_layers
