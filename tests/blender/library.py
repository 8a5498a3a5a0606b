"""Objects that are linked from another file, or overridden."""

import bpy
import scenes


def save_away(folder, make):
    """Save what `make` puts into an empty file, in a collection "Away"; return the file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    obj = make()
    collection = bpy.data.collections.new("Away")
    bpy.context.scene.collection.children.link(collection)
    for one in obj.users_collection:
        one.objects.unlink(obj)
    collection.objects.link(obj)
    path = str(folder / "away.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    return path


def link(path):
    """Link the collection; return its object."""
    with bpy.data.libraries.load(path, link=True) as (_, into):
        into.collections = ["Away"]
    bpy.context.scene.collection.children.link(into.collections[0])
    bpy.context.view_layer.update()
    return into.collections[0].objects[0]


def override(path, mesh=True):
    """Link the collection and override its object, and its mesh if asked; return the object."""
    name = link(path).name
    collection = bpy.context.scene.collection.children[0]
    collection.override_hierarchy_create(bpy.context.scene, bpy.context.view_layer, do_fully_editable=True)
    obj = bpy.data.objects[name, None]
    if mesh and obj.data.library is not None:
        obj.data.override_create(remap_local_usages=True)
    bpy.context.view_layer.update()
    return obj


def through_a_file(folder):
    """Save the file and open it again."""
    path = str(folder / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)


def beside(*others):
    """Another object that can be written, selected together with others; the first of these is active."""
    good = scenes.add_panel("Good", size=12)
    scenes.select(*others, good)
    return good
