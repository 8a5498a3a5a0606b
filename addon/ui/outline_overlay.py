# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the outlines of the islands in the UV Editor in Object Mode, where Blender shows no UVs."""

import bpy
import numpy as np

from ..blender import sequence_player, vector_attribute
from ..blender.mesh_object import MeshObject
from ..blender.mesh_reading import read_layout
from ..blender.targets import target_objects
from ..layers.uv_outline import outline
from ..operators.moebius import UV_OT_koebe_moebius
from ..state.run_report import report_of
from . import drawing
from .circle_tool import CIRCLES_TOOL

OUTLINE = (0.75, 0.75, 0.75, 0.8)

# By the names of mesh, layer and attribute: corners (k, 2) and their UVs (k, 2, 2).
_known: dict[tuple[str, str, str | None], tuple[np.ndarray, np.ndarray]] = {}
_stale = False  # whether a mesh has changed since the outlines were read


@bpy.app.handlers.persistent
def after_undo(*_: object) -> None:
    """Called by Blender after undo and redo, and after a file was opened."""
    global _stale
    _stale = True


@bpy.app.handlers.persistent
def after_update(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Called by Blender after changes."""
    global _stale
    _stale = _stale or any(isinstance(update.id, bpy.types.Mesh) for update in depsgraph.updates)


@bpy.app.handlers.persistent
def after_frame(*_: object) -> None:
    """Called by Blender after a change of frame: while an animation plays, it does not draw UV Editors by itself."""
    if bpy.app.background or bpy.app.is_job_running("RENDER"):
        return
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                area.tag_redraw()


def forget() -> None:
    """Read the outlines again if meshes have changed. Drags are not among these changes."""
    global _stale
    if _stale and UV_OT_koebe_moebius.held is None:
        _known.clear()
        _stale = False


def outlines_of(obj: MeshObject, layer: str, attribute: str | None) -> tuple[np.ndarray, np.ndarray]:
    """Corners at the ends of a UV layer's outlines, and their UVs: those of an attribute, where it has any."""
    key = (obj.data.name_full, layer, attribute)
    if key not in _known:
        vertex, edge, following, uv = read_layout(obj, layer)
        if attribute is not None:
            played = vector_attribute.corner_values(obj, attribute)
            uv = np.where(played.any(axis=1, keepdims=True), played, uv)
        ends = outline(vertex, edge, following, uv)
        _known[key] = ends, uv[ends]
    return _known[key]


def draw() -> None:
    """Draw the outlines of the report's objects; with the tool Koebe Circles, of all objects that it works on.

    If the object plays a sequence, they are those of the present frame.
    """
    context = bpy.context
    report = report_of(context)
    if context.space_data.mode != "UV" or context.mode != "OBJECT" or not report.show_circles:
        return
    forget()
    tool = context.workspace.tools.from_space_image_mode("UV")
    all_of_them = tool is not None and tool.idname == CIRCLES_TOOL
    reported = {(entry.owner_name, entry.layer) for entry in report.islands if entry.mapped}
    for obj in target_objects(context):
        active = obj.data.uv_layers.active
        if active is None:
            continue
        attribute = sequence_player.attribute_shown(obj, active.name, context.scene.frame_current)
        if not (all_of_them or attribute is not None or (obj.name, active.name) in reported):
            continue
        ends, uv = outlines_of(obj, active.name, attribute)
        held = UV_OT_koebe_moebius.held
        if held is not None and held[0] == obj.name:
            uv = uv[~np.isin(ends[:, 0], held[1])]
        draw_segments(context, uv)


def draw_segments(context: bpy.types.Context, uv: np.ndarray) -> None:
    """Draw lines between pairs of places of the UVs (k, 2, 2)."""
    to_region = context.region.view2d.view_to_region
    start, end = (np.array(to_region(x, x, clip=False)) for x in (0.0, 1.0))
    points = np.ascontiguousarray((start + (end - start) * uv).reshape(-1, 2), dtype=np.float32)
    if len(points):
        drawing.segments(points, None, OUTLINE, 1.0)


HANDLERS = (
    (bpy.app.handlers.depsgraph_update_post, after_update),
    (bpy.app.handlers.frame_change_post, after_frame),
    (bpy.app.handlers.undo_post, after_undo),
    (bpy.app.handlers.redo_post, after_undo),
    (bpy.app.handlers.load_post, after_undo),
)


def register() -> None:
    """Draw in every UV Editor."""
    drawing.add("IMAGE_EDITOR", "outlines", draw)
    for handlers, function in HANDLERS:
        handlers.append(function)


def unregister() -> None:
    """The reverse of `register`."""
    for handlers, function in HANDLERS:
        handlers.remove(function)
    drawing.remove("IMAGE_EDITOR", "outlines")
    _known.clear()
