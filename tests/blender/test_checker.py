"""The checker material: what it shows, and that it comes off without a trace."""

import bpy
import numpy as np
import pytest
import scenes


def nodes_of(material, kind):
    return [node for node in material.node_tree.nodes if node.bl_idname == kind]


def test_it_is_a_node_material_driven_by_the_layer():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(layer="Round", checker_size=20)
    (slot,) = obj.material_slots
    material = slot.material
    assert material.name == "Koebe Checker"
    (uv,) = nodes_of(material, "ShaderNodeUVMap")
    assert uv.uv_map == "Round"
    checkers = nodes_of(material, "ShaderNodeTexChecker")
    assert 20.0 in [node.inputs["Scale"].default_value for node in checkers]
    for node in checkers:
        assert node.inputs["Vector"].links[0].from_node == uv
    (output,) = nodes_of(material, "ShaderNodeOutputMaterial")
    assert output.target == "ALL" and output.inputs["Surface"].is_linked  # EEVEE and Cycles


def test_not_asked_for_it_is_not_there():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    assert len(obj.material_slots) == 0 and len(bpy.data.materials) == 0


def test_one_material_per_layer_and_its_size_follows():
    one, two = scenes.add_panel("One"), scenes.add_panel("Two")
    scenes.select(one, two)
    bpy.ops.uv.koebe_uniformize(checker_size=8)
    bpy.ops.uv.koebe_uniformize(checker_size=16)
    (material,) = bpy.data.materials
    assert one.material_slots[0].material == two.material_slots[0].material == material
    assert 16.0 in [node.inputs["Scale"].default_value for node in nodes_of(material, "ShaderNodeTexChecker")]


def test_a_users_material_of_that_name_is_not_taken():
    own = bpy.data.materials.new("Koebe Checker")
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    assert obj.material_slots[0].material not in (own, None)
    assert len(bpy.data.materials) == 2


def dress(obj):
    """Slots of all sorts: of the mesh, empty, of the object, and of both."""
    paint, metal, skin, old = (bpy.data.materials.new(name) for name in ("Paint", "Metal", "Skin", "Old"))
    for material in (paint, None, paint, metal):
        obj.data.materials.append(material)
    obj.material_slots[2].link = "OBJECT"
    obj.material_slots[2].material = skin
    obj.material_slots[3].link = "OBJECT"
    obj.material_slots[3].material = old
    obj.material_slots[3].link = "DATA"
    for polygon in obj.data.polygons:
        polygon.material_index = polygon.index % 4


def slots(obj):
    """Every slot as it is, with what the object holds behind a mesh's slot."""
    result = []
    for slot in obj.material_slots:
        link, material = slot.link, slot.material
        slot.link = "OBJECT"
        result.append((link, material, slot.material))
        slot.link = link
    return result


@pytest.mark.parametrize("dressed", [False, True])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_on_and_off_leaves_no_trace(dressed, mode):
    obj = scenes.add_panel()
    if dressed:
        dress(obj)
    scenes.select_faces(obj)  # entering Edit Mode makes the selection flags consistent
    bpy.ops.object.mode_set(mode="OBJECT")
    before = slots(obj), list(obj.data.materials), dict(obj.items()), scenes.mesh_state(obj.data)
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.uv.koebe_checker()
    assert [slot.material.name for slot in obj.material_slots] == ["Koebe Checker"] * (4 if dressed else 1)
    bpy.ops.uv.koebe_checker()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (slots(obj), list(obj.data.materials), dict(obj.items()), scenes.mesh_state(obj.data)) == before


def test_the_operator_twice_and_off_leaves_no_trace():
    obj = scenes.add_panel()
    dress(obj)
    before = slots(obj), list(obj.data.materials)
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.uv.koebe_uniformize(layer="Other")
    assert {slot.material.name for slot in obj.material_slots} == {"Koebe Checker.001"}
    bpy.ops.uv.koebe_checker()
    assert (slots(obj), list(obj.data.materials)) == before


def test_it_comes_off_after_the_file_was_saved_and_opened(tmp_path):
    obj = scenes.add_panel()
    dress(obj)
    names = [(link, a and a.name, b and b.name) for link, a, b in slots(obj)]
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    obj = bpy.data.objects["Panel"]
    bpy.ops.uv.koebe_checker()
    assert [(link, a and a.name, b and b.name) for link, a, b in slots(obj)] == names


def test_a_render_with_cycles_shows_both_colours(tmp_path):
    """A flat round panel seen from above: light and dark squares, each on a good part of it."""
    scene = bpy.context.scene
    scenes.add_panel(height=lambda x, y: 0 * x, holes=((0.1, 0.3, 0.3, 0.5),))
    bpy.ops.uv.koebe_uniformize(checker_size=8)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 1.4, (0, 0, 3)
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy = 3.0
    for item in (camera, sun):
        scene.collection.objects.link(item)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.device, scene.cycles.use_denoising = 4, "CPU", False
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x = scene.render.resolution_y = 64
    scene.render.filepath = str(tmp_path / "checker.png")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    red = np.array(image.pixels[:]).reshape(64, 64, 4)[2:62, 2:62, 0]
    assert (red > 0.65).mean() > 0.2
    assert (red < 0.55).mean() > 0.2


def squares_in_space(obj):
    """Mean side of a checker square on the surface."""
    mesh = obj.data
    to_world = np.array(obj.matrix_world)[:3, :3]
    vertices, _ = scenes.triangles(mesh)
    points = (scenes.read(mesh.vertices, "co", np.float32, 3) @ to_world.T)[vertices]
    in_space = 0.5 * np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1).sum()
    fine = obj.material_slots[0].material.node_tree.nodes["Fine"].inputs["Scale"].default_value
    return np.sqrt(in_space / scenes.signed_areas(mesh, "Koebe").sum()) / fine


@pytest.mark.parametrize("even", [True, False])
def test_squares_are_even_over_objects_if_asked(even):
    one, two = scenes.add_panel("One"), scenes.add_panel("Two")
    two.scale = (3, 3, 3)
    scenes.select(one, two)
    bpy.ops.uv.koebe_uniformize(checker_even=even, checker_size=20)
    assert one.material_slots[0].material.node_tree.nodes["Fine"].inputs["Scale"].default_value == 20
    assert squares_in_space(two) / squares_in_space(one) == pytest.approx(1 if even else 3, rel=1e-3)


@pytest.mark.parametrize("operator", ["koebe_checker", "koebe_uniformize"])
def test_where_nothing_could_be_written_no_material_is_left(addon, monkeypatch, operator):
    """Each object fails by itself, after the material for all of them was made."""
    scenes.select(scenes.add_panel("One", size=12), scenes.add_panel("Other", size=12))

    def broken(run, obj, *rest):
        raise MemoryError("none left")

    monkeypatch.setattr(addon("blender.checker"), "put_on", broken)
    with pytest.raises(RuntimeError, match="none left"):
        getattr(bpy.ops.uv, operator)()
    assert [material.name for material in bpy.data.materials] == []
    assert [len(obj.data.uv_layers) for obj in bpy.data.objects] == [0, 0]
