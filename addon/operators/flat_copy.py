# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that make flat pieces of a UV layout: a mesh object, and a drawing for cutting."""

import os
from pathlib import Path

import bpy
from bpy.props import BoolProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..blender.copied_object import add_copied_object
from ..blender.targets import attempt, target_objects
from ..blender.transaction import Transaction, transaction
from ..jobs.flat_job import Flat, read_flat
from ..maps.flat_svg import flat_svg
from ..maps.wording import few, lines
from .modal_run import OperatorBase
from .polls import has_targets
from .tooltip import tooltip

GAP = 0.05  # of a layout's width, between two objects
LAYER = "UV layer that is laid flat. Without a name, the active layer"


class FlatOperator(OperatorBase):
    """The common part of both operators."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_targets(cls, context, "Select a mapped mesh object, in Object Mode", ("OBJECT",))

    def _read(self, context: bpy.types.Context, layer: str) -> tuple[list[Flat], list[str]]:
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        return read_flat(target_objects(context), layer)

    def _say(self, done: list[Flat], problems: list[str], where: str) -> set[str]:
        if not done:
            self.report({"ERROR"}, lines("Koebe UV: nothing was laid flat.", problems))
            return {"CANCELLED"}
        for flat in done:
            fine = flat.layout.is_true and not flat.layout.left_out
            self.report({"INFO"} if fine else {"WARNING"}, f"{flat.describe()}{where}")
        if problems:
            self.report({"WARNING"}, "Koebe UV: left out. " + few(problems))
        return {"FINISHED"}


class OBJECT_OT_koebe_flat_copy(FlatOperator, bpy.types.Operator):
    """Make a flat mesh object of the UV layout, as large as the surface. It has the same faces, is cut where the UVs
    are cut, and lies at the 3D cursor. A message says how far its lengths are off"""

    bl_idname = "object.koebe_flat_copy"
    bl_label = "Koebe Flat Copy"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}

    layer: StringProperty(name="UV Layer", description=LAYER)

    def execute(self, context: bpy.types.Context) -> set[str]:
        with transaction() as run:
            found, problems = self._read(context, self.layer)
            done, made = [], []
            x, y, z = context.scene.cursor.location
            for flat in found:
                with attempt(run, flat.obj.name, problems):
                    place = (x, y, z)
                    copy = add_copied_object(run, context, flat.obj, flat.layout, flat.layer, flat.uv, place, "Flat")
                    made.append(copy)
                    done.append(flat)
                    x += (1.0 + GAP) * float(flat.layout.points[:, 0].max())
            if made:
                _select_only(run, context, made)
            return self._say(done, problems, "")


def _select_only(run: Transaction, context: bpy.types.Context, made: list[bpy.types.Object]) -> None:
    """Select the new objects, as Blender does."""
    layer = context.view_layer
    chosen = [obj.name for obj in layer.objects if obj.select_get(view_layer=layer)]
    active = layer.objects.active and layer.objects.active.name
    run.before_write(_restore_selection, layer, chosen, active)
    for obj in layer.objects:
        obj.select_set(obj in made, view_layer=layer)
    layer.objects.active = made[0]


def _restore_selection(layer: bpy.types.ViewLayer, chosen: list[str], active: str | None) -> None:
    for obj in layer.objects:
        obj.select_set(obj.name in chosen, view_layer=layer)
    layer.objects.active = layer.objects.get(active) if active else None


class UV_OT_koebe_flat_svg(FlatOperator, ExportHelper, bpy.types.Operator):
    """Write the UV layout as a drawing for cutting and engraving: outlines and holes of the islands in millimetres, as
    large as the surface. A message says how far the lengths are off"""

    bl_idname = "uv.koebe_flat_svg"
    bl_label = "Koebe Flat SVG"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER"}

    filename_ext = ".svg"
    filepath: StringProperty(name="File", subtype="FILE_PATH", description="SVG file to write")
    filter_glob: StringProperty(default="*.svg", options={"HIDDEN"})
    layer: StringProperty(name="UV Layer", description=LAYER)
    scale: FloatProperty(
        name="Scale",
        default=1.0,
        min=1e-6,
        soft_max=10.0,
        precision=4,
        description="Scale of the drawing: 1 is true size, by the units of the scene",
    )
    edges: BoolProperty(
        name="Edges", default=False, description="Draw the edges between faces too, in black, for engraving"
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        found, problems = self._read(context, self.layer)
        if found:
            millimetres = 1000.0 * context.scene.unit_settings.scale_length * self.scale
            text = flat_svg([(flat.obj.name, flat.layout) for flat in found], millimetres, self.edges)
            try:
                _write_whole(Path(self.filepath), text)
            except OSError as error:
                self.report({"ERROR"}, f"Koebe UV: {self.filepath}: {error.strerror or error}")
                return {"CANCELLED"}
        return self._say(found, problems, f"; {self.filepath}")


def _write_whole(path: Path, text: str) -> None:
    """Write a file completely or not at all."""
    part = path.with_name(f".{path.name}.part")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


CLASSES = (OBJECT_OT_koebe_flat_copy, UV_OT_koebe_flat_svg)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
