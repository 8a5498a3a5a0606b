"""Objects that Blender does not evaluate are mapped as they are in the world, as if they were shown."""

import json

import bpy
import numpy as np
import processes
import pytest
import scenes

SCALE = (1.0, 3.0, 1.0)  # of the parent: with another one the angles are wrong


def new_collection(scene=None):
    collection = bpy.data.collections.new("Aside")
    (scene or bpy.context.scene).collection.children.link(collection)
    return collection


def move(objects, collection):
    for obj in objects:
        for old in obj.users_collection:
            old.objects.unlink(obj)
        if collection is not None:
            collection.objects.link(obj)


def disabled(obj, parent):
    obj.hide_viewport = True


def disabled_with_its_parent(obj, parent):
    obj.hide_viewport = parent.hide_viewport = True


def disabled_by_animation(obj, parent):
    for one in (obj, parent):
        one.hide_viewport = True
        one.keyframe_insert("hide_viewport", frame=1)


def hidden_by_the_eye(obj, parent):
    obj.hide_set(True)


def excluded(obj, parent):
    move([obj, parent], new_collection())
    bpy.context.view_layer.layer_collection.children["Aside"].exclude = True


def collection_disabled(obj, parent):
    collection = new_collection()
    move([obj, parent], collection)
    collection.hide_viewport = True


def other_scene(obj, parent):
    move([obj, parent], bpy.data.scenes.new("Other").collection)


def disabled_in_another_scene(obj, parent):
    other_scene(obj, parent)
    obj.hide_viewport = True


def other_scene_at_its_own_frame(obj, parent):
    parent.keyframe_insert("scale", frame=20)
    parent.scale = (1.0, 1.0, 1.0)
    parent.keyframe_insert("scale", frame=1)
    other_scene(obj, parent)
    bpy.data.scenes["Other"].frame_set(20)


def no_scene(obj, parent):
    move([obj, parent], None)
    obj.use_fake_user = parent.use_fake_user = True


def excluded_with_a_constraint(obj, parent):
    target = bpy.data.objects.new("Target", None)
    target.scale = SCALE
    parent.scale = (1.0, 1.0, 1.0)
    bpy.context.collection.objects.link(target)
    parent.constraints.new("COPY_SCALE").target = target
    excluded(obj, parent)
    move([target], bpy.data.collections["Aside"])


def excluded_with_a_driver(obj, parent):
    driver = parent.driver_add("scale", 1).driver
    driver.expression = "3.0"
    parent.scale = (1.0, 1.0, 1.0)
    excluded(obj, parent)


def only_in_another_view_layer(obj, parent):
    excluded(obj, parent)
    other = bpy.context.scene.view_layers.new("Other")
    other.layer_collection.children["Aside"].exclude = False


STATES = [
    disabled, disabled_with_its_parent, disabled_by_animation, hidden_by_the_eye, excluded, collection_disabled,
    other_scene, disabled_in_another_scene, other_scene_at_its_own_frame, no_scene, excluded_with_a_constraint,
    excluded_with_a_driver, only_in_another_view_layer,
]  # fmt: skip


@pytest.mark.parametrize("state", STATES, ids=lambda state: state.__name__)
def test_its_place_is_that_in_the_world(addon_name, tmp_path, state):
    obj = scenes.add_panel(size=14)
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    parent.scale, obj.parent, obj.rotation_euler = SCALE, parent, (0.2, 0.1, 0.4)
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    expected = scenes.corner_uv(obj.data, "Koebe").copy()
    obj.data.uv_layers.remove(obj.data.uv_layers["Koebe"])
    state(obj, parent)
    state = scenes.mesh_state(obj.data)
    code, out, err = processes.run_batch(
        addon_name, tmp_path, "--output", "out.blend", "--report", "out.json", "--objects", "Panel"
    )
    assert code == 0, out + err
    (entry,) = json.loads((tmp_path / "out.json").read_text())["objects"]
    objects = {obj.name for obj in bpy.data.objects}
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    obj = bpy.data.objects["Panel"]
    assert np.allclose(scenes.corner_uv(obj.data, "Koebe"), expected, rtol=0, atol=1e-6)
    assert entry["flipped"] == 0
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == state
    assert {obj.name for obj in bpy.data.objects} == objects, "what made Blender evaluate it is gone"


def test_all_of_a_scene_whatever_their_state(addon_name, tmp_path):
    """Without --objects: those that are shown and those that are not, in one run, each as by itself."""
    for name, scale in (("Shown", (1, 1, 1)), ("Disabled", (1, 2, 1)), ("Excluded", (3, 1, 1))):
        obj = scenes.add_panel(name, size=12)
        obj.scale = scale
    scenes.select(*(bpy.data.objects[name] for name in ("Shown", "Disabled", "Excluded")))
    bpy.ops.uv.koebe_uniformize(checker=False, layer="Expected")
    bpy.data.objects["Disabled"].hide_viewport = True
    excluded(bpy.data.objects["Excluded"], bpy.data.objects["Excluded"])
    code, out, err = processes.run_batch(addon_name, tmp_path, "--output", "out.blend")
    assert code == 0, out + err
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    for obj in bpy.data.objects:
        layers = (scenes.corner_uv(obj.data, layer) for layer in ("Koebe", "Expected"))
        assert np.allclose(*layers, rtol=0, atol=1e-6), obj.name


def test_an_object_whose_mesh_is_edited_through_another(addon_name, tmp_path):
    obj = scenes.add_panel(size=12)
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.collection.objects.link(twin)
    bpy.ops.object.mode_set(mode="EDIT")
    code, out, err = processes.run_batch(addon_name, tmp_path, "--output", "out.blend", "--objects", "Twin")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert code == 0, out + err
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out.blend"))
    assert scenes.corner_uv(bpy.data.objects["Twin"].data, "Koebe").any()
