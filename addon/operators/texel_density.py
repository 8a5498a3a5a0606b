# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that measure, set and copy the texel density of a UV layer."""

import bpy
from bpy.props import BoolProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.noted_properties import note_group
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.density_job import DensityLayer
from ..layers.uv_density import island_density
from ..state.density_report import density_of, density_words
from ..state.option_properties import option, settings_of, shown_number
from .answers import refused
from .layer_run import EACH_LAYER, LayerEdit
from .modal_run import redraw
from .polls import OnTargets, in_object_mode


class UV_OT_koebe_measure_density(OnTargets, bpy.types.Operator):
    """Measure the texel density of the active object: of all its faces, of the selected faces in Edit Mode, and of the
    islands with the fewest and the most texels"""

    bl_idname = "uv.koebe_measure_density"
    bl_label = "Koebe Measure Texel Density"

    layer: EACH_LAYER
    take: BoolProperty(
        name="Take It", description="Set Pixels per Unit to the density of the selected faces, else of the whole object"
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        editing = context.mode == "EDIT_MESH"
        try:
            found = DensityLayer.of(target_objects(context)[0], self.layer, editing)
        except TransferError as error:
            return refused(self, str(error))
        whole, chosen = found.density(), found.density(chosen=True) if editing else 0.0
        each = [island_density(island, found.uv) for island in found.islands()]
        settings = settings_of(context)
        with transaction() as run:
            noted = density_of(context)
            note_group(run, noted)
            noted.object_name, noted.layer, noted.islands = found.obj.name, found.name, len(each)
            noted.whole, noted.chosen = whole, chosen
            noted.least, noted.most = min(each, default=0.0), max(each, default=0.0)
            if self.take and (chosen or whole) > 0.0:
                note_group(run, settings)
                settings.density = (chosen or whole) * settings.pixels
            redraw(context)
            edit_mode.undo_all(context)
        said = f", selected faces {density_words(context, chosen)}" if chosen else ""
        self.report({"INFO"}, f"{found.obj.name}: {density_words(context, whole)}{said}")
        return {"FINISHED"}


class SetsDensity(LayerEdit):
    """Mixin of operators that give islands a density."""

    nothing, not_done = "no density was set.", "no density was set"

    def _set(self, context: bpy.types.Context, objects: list[MeshObject], density: float) -> set[str]:
        """Scale the islands of the objects; in Edit Mode those with a selected face."""
        layer, editing = self.layer, context.mode == "EDIT_MESH"
        return self._edit(
            context, objects, lambda run, obj: DensityLayer.of(obj, layer, editing).set_density(run, density)
        )


class UV_OT_koebe_set_density(OnTargets, SetsDensity, bpy.types.Operator):
    """Scale each island to Pixels per Unit on a texture of Texture Size, each about its own middle. In Edit Mode only
    the islands of the selected faces. Islands with pinned UVs stay"""

    bl_idname = "uv.koebe_set_density"
    bl_label = "Koebe Set Texel Density"

    layer: EACH_LAYER
    density: option("density")
    pixels: option("pixels")

    def execute(self, context: bpy.types.Context) -> set[str]:
        return self._set(context, target_objects(context), shown_number(self.density) / self.pixels)


class UV_OT_koebe_copy_density(SetsDensity, bpy.types.Operator):
    """Scale the islands of the other selected objects to the mean texel density of the active object"""

    bl_idname = "uv.koebe_copy_density"
    bl_label = "Koebe Copy Texel Density"

    layer: EACH_LAYER

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return in_object_mode(cls, context, 2, "the object whose texel density they get")

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        source, *others = target_objects(context)
        try:
            density = DensityLayer.of(source, self.layer, selected_only=False).density()
            if not density > 0.0:
                raise TransferError(f"{source.name}: its UVs have no area")
        except TransferError as error:
            return refused(self, self.nothing, [str(error)])
        return self._set(context, [obj for obj in others if obj.data != source.data], density)
