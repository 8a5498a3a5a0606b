# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes the textures of an object into images that fit another of its UV layers, by Blender's own bake.

It works on a copy of the mesh in a scene of its own, so that the object, its materials and the scene's settings for
rendering and baking stay as they are.
"""

import contextlib
import dataclasses
from typing import Any

import bpy

from . import compat, material_slots
from .errors import TransferError
from .mesh_object import MeshObject
from .rendered_layer import rendered
from .texture_nodes import LaidImage, baking_material, blank_material, laid_images, lay_by
from .transaction import Transaction

NAME = "Koebe bake"
MOST_MARGIN = 32767  # Blender's
KINDS = ("objects", "meshes", "materials", "scenes", "images")  # of data-blocks that are made, in the order of removal


def _known() -> dict[str, set[str]]:
    return {kind: {block.name_full for block in getattr(bpy.data, kind)} for kind in KINDS}


def _remove_others(known: dict[str, set[str]], kinds: tuple[str, ...] = KINDS) -> None:
    for kind in kinds:
        data = getattr(bpy.data, kind)
        for block in [block for block in data if block.name_full not in known[kind]]:
            data.remove(block)


@dataclasses.dataclass
class _Stage:
    """A scene with a copy of the object's mesh. @param blank takes what is not wanted of a bake"""

    scene: Any
    copy: Any
    blank: bpy.types.Image
    layer: str
    margin: int

    @classmethod
    def of(cls, obj: MeshObject, layer: str, margin: int) -> "_Stage":
        """Raises TransferError."""
        scene: Any = bpy.data.scenes.new(NAME)
        copy = bpy.data.objects.new(NAME, obj.data.copy())
        copy.matrix_world = obj.matrix_world
        copy.data.uv_layers.active = copy.data.uv_layers[layer]
        scene.collection.objects.link(copy)
        try:
            scene.render.engine = "CYCLES"
        except TypeError:
            raise TransferError("Cycles bakes, and it is switched off: enable it in the preferences") from None
        scene.cycles.samples, scene.cycles.use_denoising = 1, False  # one sample is the texture itself
        view = scene.view_layers[0]
        view.update()
        copy.select_set(True, view_layer=view)
        view.objects.active = copy
        return cls(scene, copy, bpy.data.images.new(NAME, 16, 16), layer, margin)

    def bake(self, run: Transaction, shown: list[LaidImage | None], alpha: bool, target: bpy.types.Image) -> None:
        """Bake into the target what each slot shows, or how opaque it is. Raises TransferError."""
        for slot, laid in zip(self.copy.material_slots, shown, strict=True):
            slot.link = "DATA"
            slot.material = blank_material(self.blank) if laid is None else baking_material(laid, alpha, target)
        normal = not alpha and any(laid is not None and laid.normal for laid in shown)
        context: dict[str, Any] = {
            "scene": self.scene, "view_layer": self.scene.view_layers[0],
            "active_object": self.copy, "object": self.copy,
            "selected_objects": [self.copy], "selected_editable_objects": [self.copy],
        }  # fmt: skip
        # An interrupt between the body of `with` and its end would leave the override in force, and from 4.5 on Blender
        # crashes at the next update once its scene is removed. So the transaction ends it too, before that.
        override = contextlib.ExitStack()
        run.before_write(override.close)
        try:
            with override:
                override.enter_context(bpy.context.temp_override(**context))
                answer = bpy.ops.object.bake(
                    type="NORMAL" if normal else "EMIT", uv_layer=self.layer, margin=self.margin, use_clear=True,
                    save_mode="INTERNAL", target="IMAGE_TEXTURES", normal_space="TANGENT", normal_r="POS_X",
                    normal_g="POS_Y", normal_b="POS_Z", use_selected_to_active=False,
                )  # fmt: skip
        except RuntimeError as error:
            raise TransferError(f"Blender's bake failed: {str(error).removeprefix('Error: ').strip()}") from error
        if answer != {"FINISHED"}:
            raise TransferError("Blender's bake failed: it was cancelled")


def carry(run: Transaction, obj: MeshObject, layer: str, margin: int) -> list[bpy.types.Image]:
    """Give the object copies of its materials that show the same by another of its UV layers, with new images.

    The former materials and images stay in the file. Returns the new images. Raises TransferError.
    """
    mesh = obj.data
    # The images that lie by other UVs, and by which.
    shown = [slot.material for slot in obj.material_slots]
    layers = {one.name for one in mesh.uv_layers}
    laid = {one: laid_images(one, rendered(mesh), layers, layer) for one in set(shown) if one is not None}
    keys = list(dict.fromkeys(_key(one) for material in shown if material for one in laid[material]))
    if not keys:
        raise TransferError(f"{obj.name}: no image of its materials lies by other UVs than those of {layer}")
    # A stage of its own for the bakes. It goes in the end, and after an error.
    known = _known()
    run.before_write(_remove_others, known)
    stage = _Stage.of(obj, layer, min(margin, MOST_MARGIN))
    made = {}
    for key in keys:
        of_slot = [next((one for one in laid[it] if _key(one) == key), None) if it else None for it in shown]
        made[key] = _baked(run, stage, of_slot, key[0])
    _remove_others(known, KINDS[:-1])
    bpy.data.images.remove(stage.blank)
    # Materials that show the baked images.
    copies = {material: _copied(material, laid[material], made, layer) for material in laid if laid[material]}
    for index, material in enumerate(shown):
        if material not in copies:
            continue
        if obj.material_slots[index].link == "OBJECT":
            material_slots.set_own(run, obj, index, copies[material])
        else:
            material_slots.set_of_mesh(run, mesh, index, copies[material])
    for material in (one for one in copies if one.library is None):
        run.before_write(setattr, material, "use_fake_user", material.use_fake_user)
        material.use_fake_user = True
    return list(made.values())


def _key(laid: LaidImage) -> tuple[bpy.types.Image, int, bool]:
    """Textures with one key become one image."""
    return laid.image, laid.number, laid.normal


def _baked(
    run: Transaction, stage: _Stage, shown: list[LaidImage | None], source: bpy.types.Image
) -> bpy.types.Image:
    """A new image for textures that show the same one. Raises TransferError."""
    width, height = source.size
    if not (width and height):
        raise TransferError(f"the image {source.name} has no pixels: its file is missing")
    alpha = any(laid is not None and laid.alpha for laid in shown)
    space = source.colorspace_settings
    made: Any = bpy.data.images.new(
        f"{source.name} {stage.layer}", width, height, alpha=alpha, float_buffer=source.is_float, is_data=space.is_data
    )
    made.colorspace_settings.name = space.name
    stage.bake(run, shown, False, made)
    if alpha:
        opacity: Any = bpy.data.images.new(NAME, width, height, float_buffer=True, is_data=True)
        stage.bake(run, shown, True, opacity)
        pixels, opaque = (compat.image_pixels(image) for image in (made, opacity))
        pixels[3::4] = opaque[::4]
        made.pixels.foreach_set(pixels)
        made.update()
        bpy.data.images.remove(opacity)
    made.pack()
    return made


def _copied(
    material: bpy.types.Material, laid: list[LaidImage], made: dict[Any, bpy.types.Image], layer: str
) -> bpy.types.Material:
    copy = material.copy()
    copy.name = f"{material.name} {layer}"
    for one in laid:
        lay_by(copy.node_tree, one.node, made[_key(one)], layer)
    return copy
