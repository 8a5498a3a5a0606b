"""Which UV layer is written, and when none can be."""

import importlib
from pathlib import Path

import bmesh
import bpy
import numpy as np
import processes
import pytest
import scenes
import states

# Adds a layer to meshes with some UV layers, and removes it: enough to hit a fault of Blender that shows at times only.
ADD_LAYERS = """
import importlib.util, os, sys
import bpy
folder = os.environ["ADDON"]
spec = importlib.util.spec_from_file_location("probe", folder + "/__init__.py", submodule_search_locations=[folder])
sys.modules["probe"] = importlib.util.module_from_spec(spec)
compat = importlib.import_module("probe.blender.compat")
for number in range(60):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=2 + 7 * number % 29, y_subdivisions=2 + 5 * number % 29)
    mesh = bpy.context.object.data
    while mesh.uv_layers:
        mesh.uv_layers.remove(mesh.uv_layers[0])
    for name in "ABCDEF"[: number % 7]:
        mesh.uv_layers.new(name=name)
    bpy.ops.object.mode_set(mode="EDIT")
    for _ in range(40):
        compat.new_uv_layer(mesh, "Koebe")
        assert mesh.uv_layers[-1].name == "Koebe" and len(mesh.uv_layers) == number % 7 + 1
        mesh.uv_layers.remove(mesh.uv_layers["Koebe"])
        mesh.update()
print("DONE", flush=True)
"""


def test_the_layer_of_the_option_is_made_and_the_others_stay():
    obj = scenes.add_panel()
    obj.data.uv_layers.new(name="UVMap")
    bpy.ops.uv.koebe_uniformize(layer="Ünïcode 1")
    assert [layer.name for layer in obj.data.uv_layers] == ["UVMap", "Ünïcode 1"]
    assert obj.data.uv_layers.active.name == "Ünïcode 1"
    assert obj.data.uv_layers["UVMap"].active_render


def test_new_layers_in_edit_mode_never_end_blender(addon_name, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(ADD_LAYERS)
    installed = Path(importlib.import_module(addon_name).__file__).parent
    code, out, err = processes.finish(processes.start(script, tmp_path, ADDON=installed))
    assert (code, "DONE" in out) == (0, True), out + err


def test_the_longest_name_that_blender_keeps():
    obj = scenes.add_panel()
    name = "n" * 63
    bpy.ops.uv.koebe_uniformize(layer=name)
    bpy.ops.uv.koebe_uniformize(layer=name)
    assert [layer.name for layer in obj.data.uv_layers] == [name]


def test_a_full_mesh_is_refused_before_anything_is_computed(koebe, monkeypatch):
    obj = scenes.add_panel()
    for index in range(8):
        obj.data.uv_layers.new(name=f"Layer {index}")
    monkeypatch.setattr(koebe, "uniformize", lambda *a, **k: pytest.fail("computed in vain"))
    with pytest.raises(RuntimeError, match="8 UV layers"):
        bpy.ops.uv.koebe_uniformize()


def test_a_full_mesh_is_refused_and_left_alone_but_an_existing_layer_is_written():
    full, free = scenes.add_panel("Full"), scenes.add_panel("Free")
    for index in range(8):
        full.data.uv_layers.new(name=f"Layer {index}")
    before = scenes.mesh_state(full.data)
    scenes.select(free, full)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert scenes.mesh_state(full.data) == before and len(full.material_slots) == 0
    assert "Koebe" in free.data.uv_layers
    told = {entry.object_name: entry for entry in bpy.context.window_manager.koebe_uv.islands}
    assert told["Free"].mapped and not told["Full"].mapped and "8 UV layers" in told["Full"].message
    bpy.ops.uv.koebe_uniformize(layer="Layer 3")
    assert len(full.data.uv_layers) == 8 and len(full.material_slots) == 1
    assert np.array_equal(scenes.corner_uv(full.data, "Layer 3"), scenes.corner_uv(free.data, "Layer 3"))


def test_an_attribute_of_that_name_is_not_overwritten():
    obj = scenes.add_panel()
    attribute = obj.data.attributes.new("Koebe", "FLOAT", "POINT")
    attribute.data.foreach_set("value", np.arange(len(obj.data.vertices), dtype=np.float32))
    with pytest.raises(RuntimeError, match="Panel: .*attribute 'Koebe'"):
        bpy.ops.uv.koebe_uniformize()
    values = scenes.read(obj.data.attributes["Koebe"].data, "value", np.float32)
    assert np.array_equal(values, np.arange(len(values)))
    assert len(obj.data.uv_layers) == 0


def test_a_uv_layer_with_the_name_of_blenders_seams_breaks_no_run():
    """5.0 takes it for seams, all of them set: the map is as without it, and what has the name keeps it."""
    obj, plain = scenes.add_panel("Named"), scenes.add_panel("Plain")
    obj.data.uv_layers.new(name="uv_seam")
    if states.group_and_layer_may_share_a_name():
        obj.vertex_groups.new(name="Koebe")
    scenes.select(obj, plain)
    before = scenes.corner_uv(obj.data, "uv_seam").copy()
    for _ in range(3):
        assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
        assert bpy.ops.uv.koebe_distortion() == {"FINISHED"}
        assert len(bpy.context.window_manager.koebe_uv.islands) == 2
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), scenes.corner_uv(plain.data, "Koebe"))
    assert np.array_equal(scenes.corner_uv(obj.data, "uv_seam"), before)


def test_a_vertex_groups_name_is_refused_where_blender_keeps_it():
    obj = scenes.add_panel()
    obj.vertex_groups.new(name="Koebe")
    if states.group_and_layer_may_share_a_name():
        assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    else:
        with pytest.raises(RuntimeError, match="Panel: the name 'Koebe' is used by a vertex group"):
            bpy.ops.uv.koebe_uniformize()
        assert len(obj.data.uv_layers) == 0
    assert [group.name for group in obj.vertex_groups] == ["Koebe"]


@pytest.mark.parametrize("name", ["uv_seam", "sharp_edge", "material_index", "crease_edge", "position"])
def test_names_that_blender_uses_itself_are_refused(name):
    """5.0 ends when a UV layer gets the name sharp_edge, 4.5 when a seam is marked beside one named uv_seam."""
    obj = scenes.add_panel()
    with pytest.raises(RuntimeError, match=f"layer: Blender uses the name '{name}' itself"):
        bpy.ops.uv.koebe_uniformize(layer=name)
    assert len(obj.data.uv_layers) == 0


@pytest.mark.parametrize("name", ["", " ", ".hidden"])
def test_names_that_cannot_be_used_are_refused(name):
    obj = scenes.add_panel()
    with pytest.raises(RuntimeError, match="layer: "):
        bpy.ops.uv.koebe_uniformize(layer=name)
    assert len(obj.data.uv_layers) == 0


def test_a_linked_mesh_is_refused(tmp_path):
    scenes.add_panel("Away")
    library = tmp_path / "library.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(library), copy=True)
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(str(library), link=True) as (_, into):
        into.meshes = ["Away"]
    obj = bpy.data.objects.new("Linked", into.meshes[0])
    bpy.context.collection.objects.link(obj)
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="Linked: .*make it local"):
        bpy.ops.uv.koebe_uniformize()


def pin_one(obj, layer="Koebe"):
    """Pin the UVs of one corner."""
    bpy.ops.object.mode_set(mode="EDIT")
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.faces.ensure_lookup_table()
    mesh.faces[3].loops[0][mesh.loops.layers.uv[layer]].pin_uv = True
    bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("operator", ["torus", "ring", "sequence"])
def test_pinned_uvs_never_move(addon, mode, operator):
    obj = scenes.add_panel()
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    before = scenes.corner_uv(obj.data, "Koebe")
    pin_one(obj)
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode=mode)
    shows_pins = addon("blender.mesh_reading").shows_pins
    assert (shows_pins(obj, "Koebe"), shows_pins(obj, "Other")) == (mode == "OBJECT", False)
    with pytest.raises(RuntimeError, match="Panel: pinned UVs of 1 vertex would move. Unwrap to Parts keeps them"):
        getattr(bpy.ops.uv, f"koebe_{operator}")()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.uv.koebe_uniformize(layer="Other") == {"FINISHED"}


def test_faces_beside_a_pin_are_mapped():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    pin_one(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    scenes.select_faces(obj, range(60, 80))
    assert bpy.ops.uv.koebe_unwrap(checker=False) == {"FINISHED"}
