"""Everything of a file that an operator could spoil, as hashes by name: equal dictionaries, equal files.

Nothing here uses the add-on, and nothing writes: a mesh in Edit Mode is read through bmesh.
"""

import hashlib

import bmesh
import bpy
import numpy as np

# How the values of an attribute are read: name of the property, numbers each, type of number.
VALUES = {
    "FLOAT": ("value", 1, np.float32), "INT": ("value", 1, np.int32), "BOOLEAN": ("value", 1, bool),
    "FLOAT_VECTOR": ("vector", 3, np.float32), "FLOAT2": ("vector", 2, np.float32), "INT8": ("value", 1, np.int32),
    "FLOAT_COLOR": ("color", 4, np.float32), "BYTE_COLOR": ("color", 4, np.float32), "INT32_2D": ("value", 2, np.int32),
    "INT16_2D": ("value", 2, np.int32), "QUATERNION": ("value", 4, np.float32), "FLOAT4X4": ("value", 16, np.float32),
}  # fmt: skip
OBJECT_PROPERTIES = (
    "type", "mode", "active_material_index", "active_shape_key_index", "show_only_shape_key", "hide_select",
    "hide_viewport", "hide_render", "use_fake_user", "users",
)  # fmt: skip
KEY_PROPERTIES = ("value", "mute", "vertex_group", "slider_min", "slider_max", "interpolation", "frame")
ACTIVE_COLOR = ("active_color_index", "render_color_index", "active_color_name", "default_color_name")


def fingerprint():
    """Hashes of all that is in the open file, by name."""
    found = {}
    for collection in ("objects", "meshes", "shape_keys", "materials", "node_groups", "collections", "images"):
        found[f"names of {collection}"] = sorted(str(item.name_full) for item in getattr(bpy.data, collection))
    for obj in bpy.data.objects:
        _add(found, obj.name_full, _object(obj))
    for mesh in bpy.data.meshes:
        _add(found, f"mesh {mesh.name_full}", _mesh(mesh))
    for key in bpy.data.shape_keys:
        _add(found, f"key {key.name_full}", _shape_keys(key))
    for material in bpy.data.materials:
        _add(found, f"material {material.name_full}", _material(material))
    _add(found, "file", _surroundings())
    return {name: _hash(value) for name, value in found.items()}


def differences(one, other):
    """Names that do not have the same hash in both."""
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))


def of_object(prints, obj):
    """The part of a fingerprint that tells of one object, its mesh and its keys."""
    mesh = obj.data
    owners = {obj.name_full, f"mesh {mesh.name_full}"}
    if mesh.shape_keys is not None:
        owners.add(f"key {mesh.shape_keys.name_full}")
    return {name: value for name, value in prints.items() if name.split(": ")[0] in owners}


def _add(found, owner, values):
    found.update({f"{owner}: {name}": value for name, value in values.items()})


def _hash(value):
    digest = hashlib.blake2b(digest_size=8)
    digest.update(value.tobytes() if isinstance(value, np.ndarray) else repr(value).encode())
    return digest.hexdigest()


def plain(value):
    """A custom property as plain values; data-blocks by their names."""
    if isinstance(value, bpy.types.ID):
        return f"<{value.name_full}>"
    if hasattr(value, "to_dict"):
        return sorted((name, plain(item)) for name, item in value.items())
    if hasattr(value, "to_list"):
        return value.to_list()
    return value


def _custom(owner):
    own = {prop.identifier for prop in owner.bl_rna.properties if prop.is_runtime}  # before 5.0 these are among them
    return sorted((name, plain(value)) for name, value in owner.items() if name not in own and name != "cycles")


def group(properties):
    """A property group as plain values, but for the time that something took, and what a session knows objects by."""
    result = {}
    for prop in properties.bl_rna.properties:
        name = prop.identifier
        if name in ("rna_type", "seconds", "object_key", "mesh_key"):
            continue
        value = getattr(properties, name)
        if prop.type == "COLLECTION":
            value = [group(item) for item in value]
        elif prop.type == "POINTER":
            value = value and group(value)
        elif getattr(prop, "is_array", False):
            value = list(value)
        result[name] = value
    return result


def _object(obj):
    values = {name: getattr(obj, name) for name in OBJECT_PROPERTIES}
    values["matrix"] = [tuple(row) for row in obj.matrix_basis]
    values["data"] = obj.data and obj.data.name_full
    values["custom"] = _custom(obj)
    values["modifiers"] = [(one.name, one.type) for one in obj.modifiers]
    values["groups"] = [(one.name, one.index, one.lock_weight) for one in obj.vertex_groups]
    values["active group"] = obj.vertex_groups.active_index
    values["slots"] = [(slot.link, slot.material and slot.material.name_full) for slot in obj.material_slots]
    values["behind the slots"] = _behind_the_slots(obj)
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            if obj.name in layer.objects and layer.objects[obj.name] == obj:
                where = f"in {scene.name} {layer.name}"
                values[f"selected {where}"] = obj.select_get(view_layer=layer)
                values[f"hidden {where}"] = obj.hide_get(view_layer=layer)
    return values


def _behind_the_slots(obj):
    """The materials that the object holds where its mesh's are shown: only a turn of the link shows them."""
    if obj.library is not None or obj.override_library is not None:
        return None
    found = []
    for slot in obj.material_slots:
        link = slot.link
        if link == "DATA":
            slot.link = "OBJECT"
        found.append(slot.material and slot.material.name_full)
        if link == "DATA":
            slot.link = link
    return found


def _mesh(mesh):
    values = {"custom": _custom(mesh), "users": mesh.users, "fake user": mesh.use_fake_user}
    values["materials"] = [material and material.name_full for material in mesh.materials]
    values["edited"] = mesh.is_editmode
    layers = mesh.uv_layers
    values["uv layers"] = [(one.name, one.active, one.active_render, one.active_clone) for one in layers]
    colors = mesh.color_attributes
    values["active color"] = [getattr(colors, name, None) for name in ACTIVE_COLOR] if len(colors) else None
    values.update(_edited(mesh) if mesh.is_editmode else _arrays(mesh))
    return values


def _read(items, name, width, dtype):
    values = np.empty(len(items) * width, dtype=dtype)
    items.foreach_get(name, values)
    return values


def _arrays(mesh):
    values = {
        "co": _read(mesh.vertices, "co", 3, np.float32),
        "edges": _read(mesh.edges, "vertices", 2, np.int32),
        "corner vertex": _read(mesh.loops, "vertex_index", 1, np.int32),
        "corner edge": _read(mesh.loops, "edge_index", 1, np.int32),
        "face start": _read(mesh.polygons, "loop_start", 1, np.int32),
        "face size": _read(mesh.polygons, "loop_total", 1, np.int32),
        "face material": _read(mesh.polygons, "material_index", 1, np.int32),
        "face smooth": _read(mesh.polygons, "use_smooth", 1, bool),
        "seam": _read(mesh.edges, "use_seam", 1, bool),
        "sharp": _read(mesh.edges, "use_edge_sharp", 1, bool),
        "weights": [[(one.group, one.weight) for one in vertex.groups] for vertex in mesh.vertices],
    }
    for domain in ("vertices", "edges", "polygons"):
        for name in ("select", "hide"):
            values[f"{domain} {name}"] = _read(getattr(mesh, domain), name, 1, bool)
    for layer in mesh.uv_layers:
        items = layer.uv if hasattr(layer, "uv") else layer.data
        values[f"uv {layer.name}"] = _read(items, "vector" if hasattr(layer, "uv") else "uv", 2, np.float32)
        if hasattr(layer, "uv"):
            continue
        for name in ("pin_uv", "select"):
            values[f"uv {layer.name} {name}"] = _read(layer.data, name, 1, bool)
    for one in mesh.attributes:
        key = f"attribute {one.name} {one.domain} {one.data_type}"
        if one.data_type == "STRING":
            values[key] = [item.value for item in one.data]
        else:
            array = _read(one.data, *VALUES[one.data_type])
            own = one.name.startswith(".") or (one.name, one.data_type) == ("uv_seam", "BOOLEAN")
            if own and not array.any():
                continue  # Blender's own flags: none is as good as all off, and Edit Mode takes such away
            values[key] = array
    return values


def _edited(mesh):
    edited = bmesh.from_edit_mesh(mesh)
    for elements in (edited.verts, edited.edges, edited.faces):
        elements.index_update()
    corners = [corner for face in edited.faces for corner in face.loops]
    values = {
        "co": [tuple(vertex.co) for vertex in edited.verts],
        "edges": [(tuple(v.index for v in edge.verts), edge.seam, edge.smooth) for edge in edited.edges],
        "faces": [([v.index for v in face.verts], face.material_index, face.smooth) for face in edited.faces],
        "select mode": sorted(edited.select_mode),
        "history": [(type(one).__name__, one.index) for one in map(edited.select_history.__getitem__,
                                                                   range(len(edited.select_history)))],
        "active face": edited.faces.active and edited.faces.active.index,
    }
    for name, elements in (("verts", edited.verts), ("edges", edited.edges), ("faces", edited.faces)):
        values[f"{name} flags"] = [(one.select, one.hide) for one in elements]
    for name, elements, access in (
        ("verts", edited.verts, edited.verts), ("edges", edited.edges, edited.edges),
        ("loops", corners, edited.loops), ("faces", edited.faces, edited.faces),
    ):  # fmt: skip
        for kind in dir(access.layers):
            if kind.startswith("_") or kind in ("bevel_weight", "crease", "paint_mask", "skin", "freestyle"):
                continue
            for layer in getattr(access.layers, kind).values():
                found = [_layer_value(one[layer]) for one in elements]
                flags = kind == "deform" or kind == "bool" and layer.name.startswith(".")
                if not flags or any(found):  # none is as good as all off
                    values[f"{name} {kind} {layer.name}"] = found
    return values


def _layer_value(value):
    if hasattr(value, "uv"):
        return tuple(value.uv), value.pin_uv
    if hasattr(value, "items"):
        return sorted(value.items())
    try:
        return tuple(value)
    except TypeError:
        return value


def _shape_keys(key):
    values = {"custom": _custom(key), "relative": key.use_relative, "reference": key.reference_key.name}
    for block in key.key_blocks:
        values[f"{block.name} settings"] = [getattr(block, name) for name in KEY_PROPERTIES]
        values[f"{block.name} relative to"] = block.relative_key.name
        if not key.user.is_editmode:  # there they are of the last time that the arrays were brought up to date
            values[block.name] = _read(block.data, "co", 3, np.float32)
    return values


def _material(material):
    values = {"custom": _custom(material), "users": material.users, "color": tuple(material.diffuse_color)}
    if material.node_tree is not None:
        values["nodes"] = [
            (node.bl_idname, node.name, [_socket(one) for one in node.inputs]) for node in material.node_tree.nodes
        ]
        values["links"] = len(material.node_tree.links)
    return values


def _socket(socket):
    value = getattr(socket, "default_value", None)
    return tuple(value) if hasattr(value, "__len__") and not isinstance(value, str) else value


def _surroundings():
    manager = bpy.context.window_manager
    values = {"mode": bpy.context.mode, "report": group(manager.koebe_uv), "shapes": group(manager.koebe_shapes)}
    for scene in bpy.data.scenes:
        values[f"{scene.name} settings"] = group(scene.koebe_uv)
        values[f"{scene.name} trims"] = group(scene.koebe_trims)
        values[f"{scene.name} select mode"] = tuple(scene.tool_settings.mesh_select_mode)
        for layer in scene.view_layers:
            active = layer.objects.active
            values[f"{scene.name} {layer.name} active"] = active and active.name_full
    for screen in bpy.data.screens:
        values[f"{screen.name} custom"] = _custom(screen)
        values[f"{screen.name} shading"] = [
            (space.shading.type, space.shading.color_type)
            for area in screen.areas for space in area.spaces if space.type == "VIEW_3D"
        ]  # fmt: skip
    return values
