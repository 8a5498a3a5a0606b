# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that select elements named in the report: offending elements, flipped faces, a boundary loop."""

import json

import bpy

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.selection import edges_along, select_objects, select_only
from ..blender.transaction import Transaction, transaction
from ..jobs.map_job import Job
from ..state.run_report import KoebeIslandReport, selectable_entries
from ..surfaces.offending_elements import EDGES, FACES, VERTICES
from .answers import refused
from .modal_run import OperatorBase


def active_object(context: bpy.types.Context) -> MeshObject | None:
    """The mesh object of the island whose elements are selected, or None if it no longer exists."""
    entries = selectable_entries(context)
    obj = context.view_layer.objects.get(entries[0].owner_name) if entries else None
    return obj if obj is not None and obj.type == "MESH" else None


class ReportOperator(OperatorBase):
    """Mixin of operators that select elements of the report's island in Edit Mode."""

    bl_options = {"REGISTER", "UNDO"}
    missing = ""  # why there is nothing to select

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if active_object(context) is None:
            cls.poll_message_set("There is no report, or the object of the report is gone")
            return False
        if context.mode not in {"OBJECT", "EDIT_MESH"}:
            cls.poll_message_set("Works in Object Mode and in Edit Mode")
            return False
        if not cls._has_elements(selectable_entries(context)):
            cls.poll_message_set(cls.missing)
            return False
        return True

    @classmethod
    def _has_elements(cls, entries: list[KoebeIslandReport]) -> bool:
        """Whether there is something to select."""
        return True

    def _chosen(self, obj: MeshObject, entry: KoebeIslandReport) -> tuple[str, list[int]]:
        """Kind and numbers of the elements to select."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        entries, obj = selectable_entries(context), active_object(context)
        assert obj is not None  # `poll` has checked this
        try:
            edit_mode.check(context, obj)
            with transaction() as run:
                edit_mode.enter(run, context, obj)
                select_only(run, context, [(obj, *self._chosen(obj, entries[0]))])
                edit_mode.undo_all(context)
                return {"FINISHED"}
        except TransferError as error:
            return refused(self, str(error))


class UV_OT_koebe_select_offenders(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the elements because of which this island could not be mapped"""

    bl_idname = "uv.koebe_select_offenders"
    bl_label = "Select Elements at Fault"
    missing = "The report names no wrong elements"

    @classmethod
    def _has_elements(cls, entries: list[KoebeIslandReport]) -> bool:
        return bool(entries[0].offenders)

    def _chosen(self, obj: MeshObject, entry: KoebeIslandReport) -> tuple[str, list[int]]:
        return json.loads(entry.offenders)


class FacesOperator(ReportOperator):
    """Selects faces that the report lists as JSON."""

    faces: str

    def _chosen(self, obj: MeshObject, entry: KoebeIslandReport) -> tuple[str, list[int]]:
        return FACES, json.loads(getattr(entry, self.faces) or "[]")


class UV_OT_koebe_select_flipped(FacesOperator, bpy.types.Operator):
    """Select, in Edit Mode, the faces of this island that are turned over in the UVs. Textures look mirrored on them,
    or do not show at all"""

    bl_idname = "uv.koebe_select_flipped"
    bl_label = "Select Flipped Faces"
    faces = "flipped_faces"


class UV_OT_koebe_select_torn(FacesOperator, bpy.types.Operator):
    """Select, in Edit Mode, the faces of this island to which no UVs fit: the faces round the poles of the sphere, or
    round the middles of the square's sides"""

    bl_idname = "uv.koebe_select_torn"
    bl_label = "Select Torn Faces"
    faces = "torn_faces"


class UV_OT_koebe_select_warning(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the faces or vertices of this warning"""

    bl_idname = "uv.koebe_select_warning"
    bl_label = "Select Elements of the Warning"

    warning: bpy.props.IntProperty(name="Warning", min=0, description="Number of the warning in the report")

    def _chosen(self, obj: MeshObject, entry: KoebeIslandReport) -> tuple[str, list[int]]:
        found = entry.warnings[self.warning] if self.warning < len(entry.warnings) else None
        if found is None or not found.of:
            raise TransferError(f"{obj.name}: the report has no warning {self.warning} with something to select")
        return found.of, json.loads(found.elements)


class UV_OT_koebe_select_loop(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the edges of a boundary loop of this island: the rim of the disk or a hole"""

    bl_idname = "uv.koebe_select_loop"
    bl_label = "Select Boundary Loop"

    loop: bpy.props.IntProperty(
        name="Loop", min=0, description="Number of the loop: 0 is the outer one, the rim of the disk"
    )

    def _chosen(self, obj: MeshObject, entry: KoebeIslandReport) -> tuple[str, list[int]]:
        if self.loop >= len(entry.loops):
            raise TransferError(f"{obj.name}: the island has {len(entry.loops)} loops")
        found = edges_along(obj, json.loads(entry.loops[self.loop].vertices))
        edges = [edge for edge in found if edge is not None]
        if len(edges) < len(found):
            raise TransferError(f"{obj.name}: its mesh has changed since it was mapped: the loop is no longer there")
        return EDGES, edges


class UV_OT_koebe_select_cuts(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the edges along which this object was cut in the UVs, and the vertices in which faces were
    separated. Mark them as seams to keep these cuts"""

    bl_idname = "uv.koebe_select_cuts"
    bl_label = "Select Cuts"
    missing = "This object was not cut"

    @classmethod
    def _has_elements(cls, entries: list[KoebeIslandReport]) -> bool:
        return any(entry.cuts or entry.cut_edges for entry in entries)

    def _chosen(self, obj: MeshObject, entry: KoebeIslandReport) -> tuple[str, list[int]]:
        entries = selectable_entries(bpy.context)
        of_parts = [edge for one in entries if one.cut_edges for edge in json.loads(one.cut_edges)]
        if of_parts:
            return EDGES, of_parts
        paths = [path for one in entries if one.cuts for path in json.loads(one.cuts)]
        edges = [edge for path in paths for edge in edges_along(obj, path, closed=False)]
        if not edges:
            return VERTICES, sorted({vertex for path in paths for vertex in path})
        if None in edges:
            raise TransferError(f"{obj.name}: its mesh has changed since it was mapped: the cuts are no longer there")
        return EDGES, [edge for edge in edges if edge is not None]


def select_offenders(run: Transaction, context: bpy.types.Context, job: Job) -> bool:
    """Select the offending elements of failed islands, in the objects in Edit Mode. Returns whether there are any."""
    chosen = []
    for target, outcome in zip(job.targets, job.outcomes, strict=True):
        obj = target.obj
        if obj is not None and obj.mode == "EDIT" and not outcome.not_written:
            chosen += [(obj, *found) for found in outcome.offending()]
    if chosen:
        select_only(run, context, chosen)
    return bool(chosen)


class OBJECT_OT_koebe_show(bpy.types.Operator):
    """Make this object the active one, so that the report shows its map"""

    bl_idname = "object.koebe_show"
    bl_label = "Koebe Show Object"
    bl_options = {"REGISTER", "UNDO"}

    object_name: bpy.props.StringProperty(name="Object", description="Name of an object of the report")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if context.mode != "OBJECT":
            cls.poll_message_set("Works in Object Mode")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = context.view_layer.objects.get(self.object_name)
        if obj is None:
            return refused(self, f"there is no object {self.object_name!r} in this view layer")
        with transaction() as run:
            select_objects(run, context, [obj])
        return {"FINISHED"}
