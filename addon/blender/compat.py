# SPDX-License-Identifier: GPL-3.0-or-later
"""All differences between Blender versions that matter to the add-on: by feature if there is one, else by version."""

import functools
from typing import Any

import bmesh
import bpy
import numpy as np

MAX_UV_LAYERS = 8  # Blender's limit
# Whether no UV layer may have a vertex group's name: 5.1 removes the group with such a layer, 5.2 gives another name.
GROUPS_TAKE_NAMES = bpy.app.version >= (5, 1, 0)


def corner_uv(layer: bpy.types.MeshUVLoopLayer) -> np.ndarray:
    """UV coordinates (C, 2) of a UV layer, in 32 bits. The mesh must not be in Edit Mode."""
    values = np.empty(2 * len(layer.data), dtype=np.float32)
    collection, name = _uv_collection(layer)
    collection.foreach_get(name, values)
    return values.reshape(-1, 2)


def set_corner_uv(layer: bpy.types.MeshUVLoopLayer, uv: np.ndarray) -> None:
    """Write UV coordinates (C, 2) into a UV layer. The mesh must not be in Edit Mode.

    Where UV layers are attributes, too, it writes the attribute: through `layer.uv` Blender 4.2 to 5.0 writes into the
    arrays of its undo steps, and undo then restores nothing.
    """
    collection, name = _uv_collection(layer)
    attribute = layer.id_data.attributes.get(layer.name)
    if name == "vector" and attribute is not None and attribute.data_type == "FLOAT2":
        collection = attribute.data
    collection.foreach_set(name, np.ascontiguousarray(uv, dtype=np.float32).ravel())


def _uv_collection(layer: bpy.types.MeshUVLoopLayer) -> tuple[Any, str]:
    if hasattr(layer, "uv"):  # from 3.5 on
        return layer.uv, "vector"
    return layer.data, "uv"


def remove_uv_layer(mesh: bpy.types.Mesh, name: str) -> None:
    """Remove a UV layer. In Edit Mode Blender 5.0 sometimes leaves it at the first call, and says nothing."""
    for _ in range(2):
        if name in mesh.uv_layers:
            mesh.uv_layers.remove(mesh.uv_layers[name])


def new_uv_layer(mesh: bpy.types.Mesh, name: str) -> Any:
    """Add a UV layer of zeros, also in Edit Mode. The layer, or None if Blender has no room for it.

    Blender gives it another name if that name is taken. From 5.1 on it is made as an attribute: `uv_layers.new` reads
    beyond its array in Edit Mode and for a name that is taken. 5.1 crashes then, and 5.2 at times.
    """
    if bpy.app.version < (5, 1, 0):
        return mesh.uv_layers.new(name=name, do_init=False)
    if len(mesh.uv_layers) >= MAX_UV_LAYERS:
        return None
    first = not mesh.uv_layers
    made = mesh.attributes.new(name, "FLOAT2", "CORNER").name
    if mesh.is_editmode and f".pn.{made}" not in mesh.attributes:  # the pins, as `uv_layers.new` adds them
        mesh.attributes.new(f".pn.{made}", "BOOLEAN", "CORNER")
    if first:
        mesh.uv_layers.active = mesh.uv_layers[made]
        mesh.uv_layers[made].active_render = True
    return mesh.uv_layers[made]


def selected_uv(mesh: bpy.types.Mesh, layer_name: str) -> list[np.ndarray]:
    """The selection in a UV layer: bool arrays of the corners (C,), of the edges (C,) that start at them, and from 5.0
    on of the faces (P,). A missing layer has no selection. The mesh must not be in Edit Mode."""
    layer = mesh.uv_layers.get(layer_name)
    if layer is not None and not hasattr(layer, "uv"):
        return [read(layer.data, name, bool) for name in _OLD_UV_FLAGS]
    found = []
    for name, domain in _uv_flags(layer_name):
        flags = _flag_attribute(mesh, name, domain)
        count = len(mesh.polygons if domain == "FACE" else mesh.loops)
        found.append(np.zeros(count, dtype=bool) if flags is None else read(flags.data, "value", bool))
    return found


def set_selected_uv(mesh: bpy.types.Mesh, layer_name: str, selected: list[np.ndarray]) -> None:
    """Set the selection in a UV layer. @param selected as `selected_uv` returns it. Not in Edit Mode."""
    layer = mesh.uv_layers.get(layer_name)
    if layer is None:
        return
    if not hasattr(layer, "uv"):
        for name, values in zip(_OLD_UV_FLAGS, selected, strict=True):
            layer.data.foreach_set(name, values)
        return
    for (name, domain), values in zip(_uv_flags(layer_name), selected, strict=True):
        flags = _flag_attribute(mesh, name, domain)
        if flags is None and values.any() and name not in mesh.attributes:
            flags = mesh.attributes.new(name, "BOOLEAN", domain)
        if flags is not None:
            flags.data.foreach_set("value", values)


def select_edited_uv(face: Any, layer: Any, selected: list[Any]) -> None:
    """Set the UV selection of a face in Edit Mode. @param selected iterators over arrays as `selected_uv` returns them:
    the next values are those of this face"""
    corner_flags, edge_flags, *of_face = selected
    for corner in face.loops:
        if ONE_UV_SELECTION:
            corner.uv_select_vert, corner.uv_select_edge = next(corner_flags), next(edge_flags)
        else:
            uv = corner[layer]
            uv.select, uv.select_edge = next(corner_flags), next(edge_flags)
    for flags in of_face:
        face.uv_select = next(flags)


# Whether a mesh has one UV selection for all its layers: from 5.0 on.
ONE_UV_SELECTION = hasattr(bmesh.types.BMLoop, "uv_select_vert")
_OLD_UV_FLAGS = ("select", "select_edge")  # before 3.5


def _uv_flags(layer_name: str) -> list[tuple[str, str]]:
    """Name and domain of the attributes that hold the selection in a UV layer."""
    if ONE_UV_SELECTION:
        return [(".uv_select_vert", "CORNER"), (".uv_select_edge", "CORNER"), (".uv_select_face", "FACE")]
    return [(f".vs.{layer_name}", "CORNER"), (f".es.{layer_name}", "CORNER")]


def _flag_attribute(mesh: bpy.types.Mesh, name: str, domain: str) -> Any:
    """The attribute of that name, if it holds flags."""
    found = mesh.attributes.get(name)
    return found if found is not None and (found.domain, found.data_type) == (domain, "BOOLEAN") else None


def pins(mesh: bpy.types.Mesh, layer: bpy.types.MeshUVLoopLayer) -> np.ndarray:
    """Whether each corner (C,) is pinned in a UV layer of the mesh. The mesh must not be in Edit Mode."""
    if not hasattr(layer, "pin"):  # before 3.5
        return read(layer.data, "pin_uv", bool)
    found = mesh.attributes.get(f".pn.{layer.name}")
    return np.zeros(len(mesh.loops), dtype=bool) if found is None else read(found.data, "value", bool)


def reads_pins_at_once(mesh: bpy.types.Mesh) -> bool:
    """Whether `pins` takes some milliseconds. Before 3.5 pins are read one by one."""
    return "uv" in bpy.types.MeshUVLoopLayer.bl_rna.properties or len(mesh.loops) < 100_000


def slow_mode_change() -> bool:
    """Whether leaving and entering Edit Mode takes longer than writing a mesh's corners one by one."""
    return "uv" not in bpy.types.MeshUVLoopLayer.bl_rna.properties  # from 3.5 on it takes half the time


def read(collection: Any, name: str, dtype: type, width: int = 1) -> np.ndarray:
    """One property of all items of a collection as an array (n,) or (n, width)."""
    values: np.ndarray = np.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def read_indices(collection: Any, name: str, width: int = 1) -> np.ndarray:
    """Like `read`, for indices, as int32.

    Blender copies indices at once into unsigned integers only; signed ones are copied one by one.
    """
    return read(collection, name, np.uint32, width).view(np.int32)


def corner_indices(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Vertex (C,) and edge (C,) of each corner. The mesh must not be in Edit Mode."""
    names = (".corner_vert", ".corner_edge")
    if all(name in mesh.attributes for name in names):  # from 3.6 on, and much faster there
        vertex, edge = (read(mesh.attributes[name].data, "value", np.int32) for name in names)
        return vertex, edge
    return read_indices(mesh.loops, "vertex_index"), read_indices(mesh.loops, "edge_index")


def seam_edges(mesh: bpy.types.Mesh) -> np.ndarray:
    """Whether each edge (E,) is a seam. The mesh must not be in Edit Mode."""
    name = _seam_attribute()
    if name is None:
        return read(mesh.edges, "use_seam", bool)
    seams = mesh.attributes.get(name)
    if seams is None or seam_name_taken(mesh):
        return np.zeros(len(mesh.edges), dtype=bool)
    return read(seams.data, "value", bool)


def corner_normals(mesh: bpy.types.Mesh) -> np.ndarray:
    """Normals (C, 3) of the corners, split at sharp edges and as custom normals say. Not in Edit Mode."""
    if hasattr(mesh, "corner_normals"):  # from 4.1 on
        return read(mesh.corner_normals, "vector", np.float32, 3)
    mesh.calc_normals_split()
    try:
        return read(mesh.loops, "normal", np.float32, 3)
    finally:
        mesh.free_normals_split()


def has_seams(mesh: bpy.types.Mesh) -> bool:
    """Whether the mesh already has a place for seams."""
    name = _seam_attribute()
    return name is None or name in mesh.attributes


def seam_name_taken(mesh: bpy.types.Mesh) -> str | None:
    """The name under which seams are kept, if other data of the mesh has it."""
    name = _seam_attribute()
    if name is None or name not in mesh.attributes:
        return None
    found = mesh.attributes[name]
    return None if (found.domain, found.data_type) == ("EDGE", "BOOLEAN") else name


def set_seam_edges(mesh: bpy.types.Mesh, seams: np.ndarray, remove: bool = False) -> None:
    """Make exactly these edges (E,) seams. With `remove`, remove the place as well. Not in Edit Mode."""
    mesh.edges.foreach_set("use_seam", seams)
    name = _seam_attribute()
    if remove and name is not None and name in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[name])


@functools.cache
def _seam_attribute() -> str | None:
    """Name of the attribute that holds seams, faster to read than the edges; None if there is none."""
    probe = bpy.data.meshes.new("Koebe probe")
    try:
        probe.vertices.add(2)
        probe.edges.add(1)
        probe.edges[0].use_seam = True
        return next((name for name in ("uv_seam", ".uv_seam") if name in probe.attributes), None)
    finally:
        bpy.data.meshes.remove(probe)


def _look() -> None:
    """Ask Blender what it draws everything anew for: once, and not in a run, where Esc would wait for the drawing."""
    _seam_attribute()


def register() -> None:
    """Look as soon as there is a file, unless the add-on runs in the background."""
    if not bpy.app.background:
        bpy.app.timers.register(_look, first_interval=0.0, persistent=True)


def unregister() -> None:
    """The reverse of `register`."""
    if bpy.app.timers.is_registered(_look):
        bpy.app.timers.unregister(_look)


def vertex_positions(mesh: bpy.types.Mesh) -> np.ndarray:
    """Positions (V, 3) of the vertices, in 32 bits. The mesh must not be in Edit Mode."""
    if "position" in mesh.attributes:  # from 3.5 on, and much faster there
        return read(mesh.attributes["position"].data, "vector", np.float32, 3)
    return read(mesh.vertices, "co", np.float32, 3)


def chosen_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Whether each face (P,) is selected and not hidden. The mesh must not be in Edit Mode."""
    return _face_flag(mesh, ".select_poly") & ~_face_flag(mesh, ".hide_poly")


def shown_faces(mesh: bpy.types.Mesh) -> np.ndarray:
    """Whether each face (P,) is not hidden. The mesh must not be in Edit Mode."""
    return ~_face_flag(mesh, ".hide_poly")


def _face_flag(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    if name not in mesh.attributes:  # then all values are false
        return np.zeros(len(mesh.polygons), dtype=bool)
    return read(mesh.attributes[name].data, "value", bool)


def enable_nodes(material: bpy.types.Material) -> None:
    """Give a new material its node tree. From 5.0 on it has one from the start."""
    if material.node_tree is None:
        material.use_nodes = True


def used_nodes(material: bpy.types.Material) -> list[Any]:
    """The nodes that a material is drawn with. Before 5.0 a material can have nodes and not use them."""
    if material.node_tree is None or (bpy.app.version < (5, 0, 0) and not material.use_nodes):
        return []
    return list(material.node_tree.nodes)


def image_pixels(image: bpy.types.Image) -> np.ndarray:
    """The numbers (4 for each pixel) of an image."""
    values = np.empty(len(image.pixels), dtype=np.float32)  # type: ignore[arg-type]
    image.pixels.foreach_get(values)
    return values


def add_socket(tree: Any, side: str, kind: str, name: str, default: Any = None, description: str = "") -> None:
    """Give geometry nodes an input or output. @param side "INPUT" or "OUTPUT", @param kind as in NodeSocketFloat"""
    if hasattr(tree, "interface"):  # from 4.0 on
        made = tree.interface.new_socket(name, in_out=side, socket_type=f"NodeSocket{kind}")
    else:
        made = (tree.inputs if side == "INPUT" else tree.outputs).new(f"NodeSocket{kind}", name)
    made.description = description
    if default is not None:
        made.default_value = default


SEAM_COLOR = 0.859, 0.145, 0.071  # as Blender draws seams at first


def seam_color() -> tuple[float, float, float]:
    """The colour of seams in the 3D View, which is not in each theme of 5.2."""
    red, green, blue = getattr(bpy.context.preferences.themes[0].view_3d, "edge_seam", SEAM_COLOR)
    return red, green, blue


def be_modifier(tree: Any) -> None:
    """Let geometry nodes be chosen in a modifier. Before 4.0 all can be chosen."""
    if hasattr(tree, "is_modifier"):
        tree.is_modifier = True


def align_node() -> str:
    """The node that turns a rotation until an axis has the direction of a vector."""
    new = "FunctionNodeAlignRotationToVector"  # from 4.2 on
    return new if hasattr(bpy.types, new) else "FunctionNodeAlignEulerToVector"


def stored_uv_type() -> str:
    """The type by which geometry nodes store UVs: 3.4 has no UV layers there, but vectors under their names."""
    return "FLOAT2" if hasattr(bpy.types.MeshUVLoopLayer, "uv") else "FLOAT_VECTOR"


def flat_shader(name: str, coordinates: int = 2) -> Any:
    """A built-in shader of the gpu module for points with so many coordinates."""
    import gpu

    try:
        return gpu.shader.from_builtin(name)
    except ValueError:  # up to 4.0 the names had the number of coordinates
        return gpu.shader.from_builtin(f"{coordinates}D_{name}")


def path_options() -> Any:
    """Options of a property for the path of a file: from 4.5 on Blender warns of // without them."""
    known = "is_path_supports_blend_relative" in bpy.types.Property.bl_rna.properties
    return {"PATH_SUPPORTS_BLEND_RELATIVE"} if known else set()


def user_folder(package: str) -> str:
    """A folder for the add-on's own files, made if it is missing."""
    if package.startswith("bl_ext.") and hasattr(bpy.utils, "extension_path_user"):
        return bpy.utils.extension_path_user(package, create=True)
    return bpy.utils.user_resource("DATAFILES", path="koebe_uv", create=True)
