"""Files with objects in all the states that an artist can bring them into."""

import bpy
import fingerprint
import numpy as np
import scenes

SMALL = {"size": 12}  # a panel of 124 faces with three holes


def new_file():
    """Nothing in the file, and nothing in the reports."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    bpy.context.window_manager.koebe_uv.islands.clear()
    shapes = bpy.context.window_manager.koebe_shapes
    for name in ("module", "others", "carried"):
        getattr(shapes, name).clear()
    shapes.source = ""


def material(name):
    """The material of that name, made if it is missing."""
    return bpy.data.materials.get(name) or bpy.data.materials.new(name)


def plain(name="Plain"):
    return scenes.add_panel(name, **SMALL)


def dressed(name="Dressed"):
    """Slots of all sorts: of the mesh, empty, of the object, and of both."""
    obj = plain(name)
    for one in ("Paint", None, "Paint", "Metal"):
        obj.data.materials.append(one and material(one))
    for index, one in ((2, "Skin"), (3, "Old")):
        obj.material_slots[index].link = "OBJECT"
        obj.material_slots[index].material = material(one)
    obj.material_slots[3].link = "DATA"
    obj.active_material_index = 2
    numbers = np.arange(len(obj.data.polygons), dtype=np.int32) % 4
    obj.data.polygons.foreach_set("material_index", numbers)
    return obj


def numbered(name="Numbered"):
    """No slots, but faces with numbers of slots."""
    obj = plain(name)
    obj.data.polygons.foreach_set("material_index", np.arange(len(obj.data.polygons), dtype=np.int32) % 3)
    return obj


def layered(name="Layered"):
    """UV layers, with one that is for rendering and another active, colours, and attributes of many kinds."""
    obj = plain(name)
    mesh, random = obj.data, np.random.default_rng(7)
    for layer in ("First", "Koebe", "Last"):
        uv = random.uniform(0, 1, 2 * len(mesh.loops)).astype(np.float32)
        mesh.uv_layers.new(name=layer).data.foreach_set("uv", uv)
    mesh.uv_layers["Last"].active_render = True
    mesh.uv_layers.active_index = 1
    for number, (kind, domain) in enumerate(
        [("FLOAT", "POINT"), ("INT", "POINT"), ("FLOAT_VECTOR", "CORNER"), ("BOOLEAN", "FACE"), ("INT", "EDGE"),
         ("FLOAT2", "POINT"), ("INT8", "CORNER")]
    ):  # fmt: skip
        mesh.attributes.new(f"Own {number}", kind, domain)
        attribute = mesh.attributes[f"Own {number}"]
        name_, width, dtype = fingerprint.VALUES[kind]
        values = random.integers(0, 2, width * len(attribute.data)).astype(dtype)
        attribute.data.foreach_set(name_, values)
    for color, kind, domain in (("Red", "BYTE_COLOR", "CORNER"), ("Green", "FLOAT_COLOR", "POINT")):
        mesh.color_attributes.new(color, kind, domain)
        values = random.uniform(0, 1, 4 * len(mesh.attributes[color].data)).astype(np.float32)
        mesh.attributes[color].data.foreach_set("color", values)
    mesh.color_attributes.active_color = mesh.color_attributes["Red"]
    return obj


def keyed(name="Keyed"):
    """Shape keys, one relative to another, vertex groups and an armature modifier."""
    obj = plain(name)
    obj.shape_key_add(name="Basis")
    for key in ("Up", "Further up"):
        block = obj.shape_key_add(name=key)
        for point in block.data:
            point.co.z += 0.5
    obj.data.shape_keys.key_blocks["Further up"].relative_key = obj.data.shape_keys.key_blocks["Up"]
    obj.active_shape_key_index = 1
    for group, share in (("Bone", 1.0), ("Half", 0.5)):
        made = obj.vertex_groups.new(name=group)
        for vertex in obj.data.vertices:
            if share == 1.0 or vertex.co.x > 0:
                made.add([vertex.index], share * (0.6 + 0.4 * vertex.co.y), "REPLACE")
    obj.modifiers.new("Armature", "ARMATURE")
    return obj


def group_and_layer_may_share_a_name():
    """Not from Blender 5.1 on."""
    return bpy.app.version < (5, 1, 0)


def named(name="Named"):
    """The add-on's own names, taken by something else."""
    obj = plain(name)
    for group in ("Koebe", "Koebe Distortion") if group_and_layer_may_share_a_name() else ("Koebe Distortion",):
        obj.vertex_groups.new(name=group)
    obj.data.uv_layers.new(name="Koebe Checker")
    obj["koebe_own"], obj.data["own"] = 3, "mine"
    material("Koebe Checker")
    return obj


def twins():
    """Two objects with one mesh, and seams."""
    obj = plain("Twin")
    middle = np.abs(scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]) < 1e-5
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", middle[ends].all(axis=1))
    other = bpy.data.objects.new("Other twin", obj.data)
    bpy.context.collection.objects.link(other)
    return [obj, other]


def full(name="Full"):
    """No room for another UV layer."""
    obj = plain(name)
    for index in range(8):
        obj.data.uv_layers.new(name=f"Layer {index}")
    return obj


def broken(name="Broken"):
    """Cannot be mapped: a vertex is no number."""
    obj = plain(name)
    obj.data.vertices[5].co.z = np.nan
    return obj


def consistent(objects):
    """Let Edit Mode make the flags of selection consistent, as everything is that an artist has touched."""
    scenes.select(*objects)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")


def many():
    """A file with an object in each of these states, all selected, and one more that is not."""
    new_file()
    aside = plain("Aside")
    objects = [dressed(), numbered(), layered(), keyed(), named(), *twins(), full(), broken()]
    consistent([aside, *objects])
    scenes.select(*objects)
    return objects


def worn():
    """The same file with the checker on and the distortion shown, on what can show them."""
    many()
    bpy.ops.uv.koebe_uniformize(checker_size=8)
    bpy.ops.uv.koebe_distortion(kind="area")


def edited():
    """Several meshes in Edit Mode, one of them hidden and one that cannot be selected; another one selected beside."""
    new_file()
    objects = [keyed(), layered(), named(), broken(), plain("Hidden"), plain("Locked")]
    beside = plain("Beside")
    consistent([*objects, beside])
    scenes.select(*objects)
    scenes.edit_all()
    objects[4].hide_set(True)
    objects[5].hide_select = True
    beside.select_set(True)


def edited_in_sight():
    """Two meshes in Edit Mode that can be seen and selected."""
    new_file()
    objects = [keyed(), layered()]
    consistent(objects)
    scenes.select(*objects)
    scenes.edit_all()


def edited_worn():
    """The same with the checker on and the distortion shown."""
    edited()
    bpy.ops.uv.koebe_uniformize(checker_size=8)
    bpy.ops.uv.koebe_distortion(kind="area")
