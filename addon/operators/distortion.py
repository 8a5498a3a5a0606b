# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that shows distortion as colours of the faces."""

from typing import Any

import bpy

from ..blender import distortion_attribute, edit_mode
from ..blender.mesh_object import MeshObject
from ..blender.mesh_reading import read_layer, read_surface
from ..blender.noted_properties import set_property
from ..blender.targets import attempt, check_mesh, target_objects, with_own_meshes
from ..blender.transaction import Transaction, transaction
from ..layers import distortion
from .answers import finished, refused
from .polls import OnTargets

KINDS = [
    ("none", "Off", "Take the colours off and show the materials again"),
    (distortion.ANGLE, "Angle", "Colour the faces by how far the angles of the UVs are from the angles of the surface"),
    (distortion.AREA, "Texel Density", "Colour the faces by how many texels they get, compared with the mean"),
]
SHADING_KEY = "koebe_shading"  # on the screen: the former surface colours of its 3D Views


class UV_OT_koebe_distortion(OnTargets, bpy.types.Operator):
    """Colour the faces of the selected objects by the distortion of their UVs, or take the colours off again"""

    bl_idname = "uv.koebe_distortion"
    bl_label = "Koebe Distortion"
    needs = "Select a mesh object, in Object Mode or in Edit Mode"

    kind: bpy.props.EnumProperty(
        name="Distortion", items=KINDS, default=distortion.ANGLE, description="Quantity that the colours show"
    )
    layer: bpy.props.StringProperty(name="UV Layer", default="Koebe", description="UV layer to judge")

    @classmethod
    def description(cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Each button has its own tooltip."""
        return next(text for kind, _, text in KINDS if kind == properties.kind)

    def execute(self, context: bpy.types.Context) -> set[str]:
        with transaction() as run:
            objects = with_own_meshes(target_objects(context))
            problems: list[str] = []
            with edit_mode.left_if_faster(run, context):
                for obj in objects:
                    with attempt(run, obj.name, problems):
                        self._color(run, obj)
            if len(problems) == len(objects):
                return refused(self, "", problems)
            _show_colors(run, context, self.kind != "none")
            edit_mode.undo_all(context)
            return finished(self, "not coloured", problems)

    def _color(self, run: Transaction, obj: MeshObject) -> None:
        if self.kind == "none":
            if distortion_attribute.is_on(obj.data):
                check_mesh(obj)
            distortion_attribute.take_off(run, obj)
            return
        distortion_attribute.check(obj, self.layer)
        surface = read_surface(obj, selected_only=False)
        colors = distortion_attribute.corner_colors(surface, read_layer(obj, self.layer), self.kind)
        distortion_attribute.put_on(run, obj, self.kind, colors)


def _show_colors(run: Transaction, context: bpy.types.Context, on: bool) -> None:
    """Make the 3D Views of all windows show colour attributes in Solid shading, or their former colours again."""
    for screen in dict.fromkeys(window.screen for window in context.window_manager.windows):
        views = [area.spaces.active for area in screen.areas if area.type == "VIEW_3D"]
        run.before_write(_restore_shading, views, [view.shading.color_type for view in views])
        before = screen.get(SHADING_KEY)
        if on and before is None:
            set_property(run, screen, SHADING_KEY, " ".join(view.shading.color_type for view in views))
        if not on and before is not None:
            set_property(run, screen, SHADING_KEY, None)
        for index, view in enumerate(views):
            if on:
                view.shading.color_type = "VERTEX"
            elif view.shading.color_type == "VERTEX":
                known = (before or "").split()
                view.shading.color_type = known[index] if len(known) == len(views) else "MATERIAL"
        for area in screen.areas:
            area.tag_redraw()


def _restore_shading(views: list[Any], kinds: list[str]) -> None:
    for view, kind in zip(views, kinds, strict=True):
        view.shading.color_type = kind
