"""Every operator that writes, in the modes and states it may be called in: how to build the file, and its options."""

import bpy
import numpy as np
import scenes
import states
from tori import torus_arrays


def carried():
    """A mapped and painted source that wears the checker, and targets in several states."""
    states.new_file()
    source = states.dressed("Source")
    bpy.ops.uv.koebe_uniformize(outer="longest")
    targets = [states.plain(), states.keyed(), states.layered(), states.full()]
    scenes.select(targets[0])
    bpy.ops.uv.koebe_uniformize()
    states.consistent([source, *targets])
    scenes.select(source, *targets)


def reported():
    """A report, and another object in Edit Mode."""
    states.new_file()
    obj = states.keyed()
    bpy.ops.uv.koebe_uniformize()
    other, hidden = states.plain("Other"), states.plain("Hidden")
    states.consistent([obj, other, hidden])
    scenes.select(other, hidden)
    bpy.ops.object.mode_set(mode="EDIT")
    hidden.hide_set(True)


def reported_in_object_mode():
    """A report, and another object selected."""
    states.new_file()
    obj = states.keyed()
    bpy.ops.uv.koebe_uniformize()
    other = states.plain("Other")
    states.consistent([obj, other])
    scenes.select(other)


def mapped_alone():
    """A mapped object, selected."""
    states.new_file()
    obj = states.keyed()
    bpy.ops.uv.koebe_uniformize(checker=False)
    states.consistent([obj])
    scenes.select(obj)


def sewable():
    """A sheet in two islands, in Edit Mode, with the edges of the cut selected."""
    states.new_file()
    obj, other = scenes.add_sheet(6, seams=(3,)), states.plain("Other")
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(seams="only", checker=False)
    states.consistent([obj, other])
    scenes.select_seams(obj)


def relaxable():
    """A mapped sheet in Edit Mode, with uneven UVs."""
    states.new_file()
    obj = scenes.add_sheet(6)
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(seams="only", checker=False)
    uv = scenes.corner_uv(obj.data, "Koebe") ** 2
    obj.data.uv_layers["Koebe"].data.foreach_set("uv", uv.ravel())
    states.consistent([obj])
    scenes.select(obj)
    scenes.edit_all()


def offending():
    """A report of the active object, which cannot be mapped, and of another one."""
    states.new_file()
    good, bad = states.keyed(), states.broken()
    scenes.select(good, bad)
    bpy.ops.uv.koebe_uniformize()
    states.consistent([good, bad])
    scenes.select(bad)


def flipped():
    """A report on a tube so long that 32-bit UVs cannot tell its last faces apart."""
    states.new_file()
    around, rings = 12, 30
    turn = 2 * np.pi * np.arange(around) / around
    vertices = [(0.1 * np.cos(a), 0.1 * np.sin(a), 0.1 * j) for j in range(rings + 1) for a in turn]
    at = lambda i, j: j * around + i % around  # noqa: E731
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(rings) for i in range(around)]
    tube, other = scenes.add_object("Long", vertices, faces), states.plain("Other")
    scenes.select(tube)
    bpy.ops.uv.koebe_uniformize()
    assert bpy.context.window_manager.koebe_uv.islands[0].flipped > 0
    states.consistent([tube, other])
    scenes.select(other)


def in_edit_mode(start):
    """The same start in Edit Mode, with all selected."""

    def begin():
        start()
        scenes.edit_all()

    return begin


def tori():
    """Tori, one of them with materials, one with a layer of the name, and a panel that is none."""
    states.new_file()
    plain, other, worn = (scenes.add_object(name, *torus_arrays(10, 8)) for name in ("Torus", "Other", "Worn"))
    worn.data.materials.append(states.material("Paint"))
    other.data.uv_layers.new(name="Koebe")
    other.data.uv_layers.new(name="First")
    objects = [plain, other, worn, states.plain()]
    states.consistent(objects)
    scenes.select(*objects)


def mapped_tori():
    """The same as tiles, with the checker on and the colours of the distortion."""
    tori()
    bpy.ops.uv.koebe_torus()
    bpy.ops.uv.koebe_distortion(kind="area")


def bare_tori():
    """The same as tiles without a checker."""
    tori()
    bpy.ops.uv.koebe_torus(checker=False)


def chosen():
    """Options of the panel that are not the defaults."""
    states.many()
    settings = bpy.context.scene.koebe_uv
    settings.margin, settings.method, settings.layer = 0.1, "ck", "Other"


def chosen_in_edit_mode():
    """The same in Edit Mode."""
    states.edited_in_sight()
    bpy.context.scene.koebe_uv.margin = 0.1


def edited_to_fill():
    """Two meshes in Edit Mode with all selected, and their UVs in the layer."""
    states.edited_in_sight()
    bpy.ops.uv.koebe_uniformize(checker=False)


def mapped():
    """Objects in several states, mapped, with a report and the colours of the distortion."""
    states.worn()


def mapped_in_edit_mode():
    """The same in Edit Mode."""
    states.edited_in_sight()
    bpy.ops.uv.koebe_uniformize(checker=False)


def textured():
    """A mapped object with an image by its old UVs."""
    states.new_file()
    obj = states.layered("Textured")
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    material = bpy.data.materials.new("Paint")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("Paint", 8, 8)
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    obj.data.materials.append(material)
    states.consistent([obj])
    scenes.select(obj)


def even(name="Even"):
    """A panel that is its own mirror image, mapped."""
    holes = ((0.026, 0.101, 0.35, 0.65), (0.401, 0.476, 0.35, 0.65), (0.651, 0.851, 0.45, 0.62))
    return scenes.add_panel(name, size=20, holes=holes, height=lambda x, y: 0.3 * x * x + 0.2 * np.sin(2.0 * y))


def symmetric():
    """Two objects of which one is its own mirror image, mapped and with the colours of the distortion."""
    states.new_file()
    objects = [even(), states.layered()]
    scenes.select(*objects)
    bpy.ops.uv.koebe_uniformize(checker=False)
    bpy.ops.uv.koebe_distortion(kind="area")
    states.consistent(objects)
    scenes.select(*objects)


def symmetric_in_edit_mode():
    """The same in Edit Mode."""
    symmetric()
    bpy.ops.object.mode_set(mode="EDIT")


def moving():
    """Keys, of which one moves, and a wave, in a file that is in another frame than those to be mapped."""
    states.new_file()
    obj = states.keyed()
    block = obj.data.shape_keys.key_blocks["Up"]
    for frame, value in ((1, 0.0), (5, 1.0)):
        block.value = value
        block.keyframe_insert("value", frame=frame)
    obj.modifiers.new("Wave", "WAVE").height = 0.1
    bpy.context.scene.frame_set(7)
    states.consistent([obj])
    scenes.select(obj)


def moving_in_edit_mode():
    """The same in Edit Mode, with some faces selected."""
    moving()
    scenes.select_faces(bpy.context.object, range(60))


def disk_and_closed():
    """A surface that is a disk, and a closed one: Automatic takes another shape for each."""
    states.new_file()
    objects = [states.plain(), scenes.add_cube()]
    states.consistent(objects)
    scenes.select(*objects)


def panels_and_closed():
    """Surfaces in several states that can be lifted, one of them linked twice, and a closed one."""
    states.new_file()
    objects = [states.dressed(), states.keyed(), *states.twins(), scenes.add_cube()]
    states.consistent(objects)
    scenes.select(*objects)


QUICK = {"darts": 0.0, "even": 0.0}  # parts are computed at every fault, and what breaks is not the computing
RUNS = {
    "unwrap": (disk_and_closed, "uv.koebe_unwrap", {}),
    "unwrap in Edit Mode": (in_edit_mode(disk_and_closed), "uv.koebe_unwrap", {}),
    "uniformize": (states.many, "uv.koebe_uniformize", {}),
    "uniformize what is worn": (states.worn, "uv.koebe_uniformize", {"checker_size": 5.0, "checker_even": False}),
    "uniformize in Edit Mode": (states.edited, "uv.koebe_uniformize", {}),
    "uniformize in Edit Mode, in sight": (states.edited_in_sight, "uv.koebe_uniformize", {"layer": "First"}),
    "uniformize in Edit Mode what is worn": (states.edited_worn, "uv.koebe_uniformize", {"layer": "Last"}),
    "uniformize in Edit Mode without a checker": (states.edited, "uv.koebe_uniformize", {"checker": False}),
    "parts": (states.many, "uv.koebe_parts", QUICK),
    "parts of what is worn": (states.worn, "uv.koebe_parts", {**QUICK, "evenness": 0.2, "checker": False}),
    "parts in Edit Mode": (states.edited, "uv.koebe_parts", QUICK),
    "parts with seams": (states.many, "uv.koebe_parts", {**QUICK, "write_seams": True, "evenness": 1.0}),
    "parts with seams in Edit Mode": (states.edited, "uv.koebe_parts", {**QUICK, "write_seams": True, "evenness": 1.0}),
    "torus": (tori, "uv.koebe_torus", {}),
    "torus of what is worn": (mapped_tori, "uv.koebe_torus", {"fit": "period", "checker_size": 16.0}),
    "torus in Edit Mode": (in_edit_mode(tori), "uv.koebe_torus", {"fit": "square"}),
    "ring": (states.many, "uv.koebe_ring", {}),
    "ring of what is worn": (states.worn, "uv.koebe_ring", {"holes": "radial", "fit": "square"}),
    "ring in Edit Mode": (states.edited, "uv.koebe_ring", {"holes": "concentric", "checker": False}),
    "sphere": (states.many, "uv.koebe_sphere", {}),
    "sphere of what is worn": (states.worn, "uv.koebe_sphere", {"layout": "octahedral", "checker_size": 16.0}),
    "sphere in Edit Mode": (states.edited, "uv.koebe_sphere", {"layout": "octahedral", "checker": False}),
    "sphere added": (states.many, "uv.koebe_sphere", {"add_sphere": True}),
    "sphere added in Edit Mode": (states.edited, "uv.koebe_sphere", {"add_sphere": True}),
    "handles": (tori, "uv.koebe_schottky", {}),
    "handles of what is worn": (mapped_tori, "uv.koebe_schottky", {"normalization": "circles", "checker_size": 16.0}),
    "handles in Edit Mode": (in_edit_mode(tori), "uv.koebe_schottky", {"checker": False}),
    "sequence of frames": (moving, "uv.koebe_sequence", {"frame_end": 3}),
    "sequence of frames in Edit Mode": (moving_in_edit_mode, "uv.koebe_sequence", {"frame_end": 3, "target": "LAYERS"}),
    "sequence of keys": (moving, "uv.koebe_sequence", {"source": "SHAPE_KEYS", "target": "LAYERS"}),
    "sequence of keys in Edit Mode": (moving_in_edit_mode, "uv.koebe_sequence", {"source": "SHAPE_KEYS"}),
    "checker on tiles": (bare_tori, "uv.koebe_checker", {}),
    "checker off tiles": (mapped_tori, "uv.koebe_checker", {}),
    "checker on": (states.many, "uv.koebe_checker", {}),
    "checker off": (states.worn, "uv.koebe_checker", {}),
    "checker on in Edit Mode": (states.edited, "uv.koebe_checker", {}),
    "checker off in Edit Mode": (states.edited_worn, "uv.koebe_checker", {}),
    "distortion on": (states.many, "uv.koebe_distortion", {"layer": "Koebe"}),
    "distortion on in Edit Mode": (edited_to_fill, "uv.koebe_distortion", {"layer": "Koebe"}),
    "distortion changed": (states.worn, "uv.koebe_distortion", {"kind": "angle"}),
    "distortion off": (states.worn, "uv.koebe_distortion", {"kind": "none"}),
    "distortion changed in Edit Mode": (states.edited_worn, "uv.koebe_distortion", {"kind": "angle"}),
    "distortion off in Edit Mode": (states.edited_worn, "uv.koebe_distortion", {"kind": "none"}),
    "fill": (states.many, "mesh.koebe_fill_holes", {"which": "all"}),
    "fill in Edit Mode": (states.edited, "mesh.koebe_fill_holes", {}),
    "fill in Edit Mode, in sight": (edited_to_fill, "mesh.koebe_fill_holes", {}),
    "reset in Edit Mode": (chosen_in_edit_mode, "uv.koebe_reset", {}),
    "reset": (chosen, "uv.koebe_reset", {}),
    "carry": (carried, "uv.koebe_carry_texture", {"fit_holes": True}),
    "move circles": (mapped, "uv.koebe_moebius", {"rim": 1, "center": (0.1, 0.2)}),
    "move circles in Edit Mode": (mapped_in_edit_mode, "uv.koebe_moebius", {"hole": 2, "rotation": 1.0}),
    "symmetrize": (symmetric, "uv.koebe_symmetrize", {}),
    "symmetrize in Edit Mode": (symmetric_in_edit_mode, "uv.koebe_symmetrize", {}),
    "use for rendering": (states.worn, "uv.koebe_use_for_rendering", {"layer": "Koebe"}),
    "use for rendering in Edit Mode": (states.edited_worn, "uv.koebe_use_for_rendering", {"layer": "Koebe"}),
    "preset": (chosen, "uv.koebe_preset", {}),
    "preset in Edit Mode": (chosen_in_edit_mode, "uv.koebe_preset", {}),
    "measure density in Edit Mode": (mapped_in_edit_mode, "uv.koebe_measure_density", {"take": True}),
    "set density": (states.worn, "uv.koebe_set_density", {"layer": "Koebe"}),
    "set density in Edit Mode": (mapped_in_edit_mode, "uv.koebe_set_density", {"layer": "Koebe"}),
    "copy density": (carried, "uv.koebe_copy_density", {}),
    "pack": (mapped, "uv.koebe_pack", {}),
    "pack in Edit Mode": (mapped_in_edit_mode, "uv.koebe_pack", {"layer": "Koebe", "atlas": True}),
    "arrange": (mapped, "uv.koebe_arrange", {"mode": "SIZE"}),
    "arrange in Edit Mode": (mapped_in_edit_mode, "uv.koebe_arrange", {"mode": "LEFT", "in_square": True}),
    "trim sheet": (mapped, "uv.koebe_trims", {"action": "GRID"}),
    "sew": (sewable, "uv.koebe_sew", {}),
    "bake": (textured, "uv.koebe_bake_texture", {"layer": "Koebe", "margin": 2}),
    "relax": (relaxable, "uv.koebe_relax", {"center": (0.5, 0.5), "radius": 0.2}),
    "flat copy": (mapped, "object.koebe_flat_copy", {}),
    "lift": (panels_and_closed, "object.koebe_lift", {"size": 0.4}),
    "relief of what is worn": (mapped, "object.koebe_lift", {"size": 0.4, "way": "raise"}),
    "add node groups": (states.many, "node.koebe_add_groups", {}),
    "loops around holes": (mapped_alone, "mesh.koebe_loops_around_holes", {}),
    "compare": (carried, "uv.koebe_compare_shapes", {}),
    "show an object": (reported_in_object_mode, "object.koebe_show", {"object_name": "Keyed"}),
    "select a loop": (reported, "uv.koebe_select_loop", {"loop": 2}),
    "select a loop in Object Mode": (reported_in_object_mode, "uv.koebe_select_loop", {"loop": 1}),
    "select what is wrong": (offending, "uv.koebe_select_offenders", {}),
    "select what a warning speaks of": (flipped, "uv.koebe_select_warning", {}),
    "select what is flipped": (flipped, "uv.koebe_select_flipped", {}),
}


def operator(name):
    """The operator of that name."""
    space, function = name.split(".")
    return getattr(getattr(bpy.ops, space), function)
