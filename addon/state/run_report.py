# SPDX-License-Identifier: GPL-3.0-or-later
"""The report on the objects' last maps, island by island, kept with the window manager for the panel to show."""

import json
from collections.abc import Iterable
from types import ModuleType
from typing import Any

import bpy
import numpy as np
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    IntVectorProperty,
    StringProperty,
)

from ..blender.noted_properties import note_group
from ..blender.transaction import Transaction
from ..layers.distortion import texel_figures
from ..maps.carried_uv import Carried
from ..surfaces.surface import Island
from .registering import added_to

COLLECTIONS = ("loops", "warnings")  # of an island's report


class KoebeLoopReport(bpy.types.PropertyGroup):
    """A boundary loop of an island."""

    vertices: StringProperty(description="Vertices of the mesh along the loop, as JSON")
    radius: FloatProperty(description="Radius of its circle in the unit disk; of a cap of the sphere, in radians")
    roundness: FloatProperty(description="Deviation from a circle before the last step, as in the paper")
    uv_center: FloatVectorProperty(size=2, description="Centre of its circle in the UVs")
    uv_radius: FloatProperty(description="Radius of its circle in the UVs, 0 if it is no circle there")


class KoebeWarningReport(bpy.types.PropertyGroup):
    """What to watch out for in an island."""

    text: StringProperty(description="What is seen, and what to do about it")
    of: StringProperty(description="What can be selected: faces or vertices, else empty")
    elements: StringProperty(description="Their numbers, as JSON")


class KoebeIslandReport(bpy.types.PropertyGroup):
    """An island of an object's last map."""

    run: IntProperty(description="Number of the run that made it: islands of one run may share the UV square")
    object_name: StringProperty(description="Name of the object whose island this is, at that time")
    object_key: StringProperty(description="By what the object is known in this session, whatever its name")
    mesh_key: StringProperty(description="By what its mesh is known")
    mesh_size: IntVectorProperty(size=3, description="Vertices, faces and corners of its mesh then")
    shape: StringProperty(description="Of a sequence: the frame or the shape key, else empty")
    island: IntProperty(description="Number of the island among those of its object")
    mapped: BoolProperty(description="Whether the island has UVs now")
    converged: BoolProperty(description="Whether the tolerance was reached")
    message: StringProperty(description="Why the island could not be mapped, or what to watch out for")
    offenders: StringProperty(description="Kind and numbers of the elements at fault, as JSON")
    layer: StringProperty(description="UV layer that was written")
    sweeps: IntProperty(description="Sweeps over all holes")
    angle_error: FloatProperty(description="Mean difference of the angles on the surface and in the UVs, degrees")
    roundness: FloatProperty(description="Largest deviation from a circle before the last step")
    flipped: IntProperty(description="Triangles that are turned over in the UVs")
    flipped_faces: StringProperty(description="Their faces, as JSON")
    note: StringProperty(description="What was done to the island beside its map: cut, made symmetric")
    uneven: BoolProperty(description="Whether nobody can paint on it: its texels are too uneven, or too small")
    cuts: StringProperty(description="Vertices of the mesh along each cut, as JSON, with the first of its pieces")
    seconds: FloatProperty(description="Time of the computation")
    parts: IntProperty(description="Parts that the object was cut into, 0 if it was not")
    density: FloatProperty(description="Texel density at 95 % of the area over the density at 5 %")
    even: FloatProperty(description="How even it was made: 0 is conformal, 1 true to size")
    coverage: FloatProperty(description="Share of the UV square that it takes")
    together: BoolProperty(description="Whether islands of other objects share the UV square with it")
    cut_edges: StringProperty(description="Of parts: the edges along which the UVs are cut, as JSON, or nothing")
    cut_length: FloatProperty(description="Of parts: the length of all cuts, in units of the root of the area")
    domain: StringProperty(description="The domain: torus, ring, sphere or schottky; else empty")
    modulus: StringProperty(
        description="For a torus: the ratio of its periods. For a cylinder: i times height over period"
    )
    periods: StringProperty(description="Of a tile: its periods in the UVs")
    layout: StringProperty(description="Of a sphere: how it is laid out as UVs")
    torn_faces: StringProperty(description="Of a sphere: the faces that its layout cannot place in the UVs, as JSON")
    moved_faces: StringProperty(
        description="Of a sphere: the faces with corners that its layout moves so that no face is flipped, as JSON"
    )
    handles: IntProperty(description="Of a fundamental domain: the handles that are cut open")
    by_circles: BoolProperty(description="Of a fundamental domain: whether the UVs are cut along circles, or edges")
    offer: StringProperty(description="The operators that take an island that this one does not, with spaces between")
    moved: StringProperty(description="How the island was changed after its map, by hand or by symmetry. Else empty")
    corners: StringProperty(description="Corners of the mesh on the loops of an island that was moved, as JSON")
    history: StringProperty(description="What the report was for each state of such an island, as JSON")
    warnings: CollectionProperty(type=KoebeWarningReport, description="What to watch out for, in an artist's words")
    loops: CollectionProperty(type=KoebeLoopReport, description="Boundary loops, the outer one first")

    @property
    def owner(self) -> Any:
        """The object, also under another name; if it is gone, one with its mesh; else the object of that name, or
        None."""
        named = bpy.data.objects.get((self.object_name, None))
        if not self.object_key or (named is not None and key_of(named) == self.object_key):
            return named
        users = [obj for obj in bpy.data.objects if self._is_of(obj)]
        return next((obj for obj in users if key_of(obj) == self.object_key), users[0] if users else named)

    def _is_of(self, obj: Any) -> bool:
        """Whether an object has the mesh that was mapped, with that layer."""
        mesh = obj.data
        return isinstance(mesh, bpy.types.Mesh) and key_of(mesh) == self.mesh_key and (
            not self.mapped or bool(self.shape) or self.layer in mesh.uv_layers
        )

    @property
    def owner_name(self) -> str:
        """Its name now."""
        return getattr(self.owner, "name", self.object_name)


def key_of(block: bpy.types.ID) -> str:
    """What stays while a data-block has another name. Undo keeps it, too."""
    return str(getattr(block, "session_uid", 0) or block.as_pointer())  # from 4.2 on it has a number


class KoebeReport(bpy.types.PropertyGroup):
    """The last map of each object, the last run's first."""

    islands: CollectionProperty(type=KoebeIslandReport, description="Islands of all objects")
    active: IntProperty(name="Island", description="Island whose details are shown")
    show_all: BoolProperty(
        name="Full Messages", default=False, description="Show the report's messages in full, however long they are"
    )
    show_circles: BoolProperty(
        name="Show Circles",
        default=True,
        description="Draw the circles of the last run over the UVs, with the numbers of the loops. In Object Mode, "
        "where Blender shows no UVs, draw the outlines of the islands too",
    )


def report_of(context: bpy.types.Context) -> KoebeReport:
    """The report that is shown."""
    return context.window_manager.koebe_uv


def record(run: Transaction, context: bpy.types.Context, rows: Iterable[dict[str, Any]]) -> None:
    """Replace the report on some objects by rows as in `Outcome.rows`, with the names above. Lists are kept as JSON.

    The report on other objects stays behind it, as long as they are there.
    """
    report, rows = report_of(context), list(rows)
    note_group(run, report)
    number = 1 + max((entry.run for entry in report.islands), default=0)
    names = {row["object_name"] for row in rows}
    for index in reversed(range(len(report.islands))):
        entry = report.islands[index]
        if entry.owner_name in names or entry.owner is None:
            report.islands.remove(index)
    for place, row in enumerate(rows):
        entry = report.islands.add()
        for name in COLLECTIONS:
            for item in row.pop(name, ()):
                _fill(getattr(entry, name).add(), item)
        _fill(entry, row)
        entry.run, entry.mesh_size = number, _mesh_size(entry)
        entry.object_key, entry.mesh_key = (key_of(one) if one else "" for one in (entry.owner, mesh_of(entry)))
        if place < len(report.islands) - 1:
            report.islands.move(len(report.islands) - 1, place)
    report.active = -1
    report.active = max(active_index(context), 0)


def mesh_of(entry: KoebeIslandReport) -> Any:
    """The mesh of the entry's object, or None."""
    mesh = getattr(entry.owner, "data", None)
    return mesh if isinstance(mesh, bpy.types.Mesh) else None


def _mesh_size(entry: KoebeIslandReport) -> tuple[int, ...]:
    """Vertices, faces and corners of the object's mesh now; zeros without one. In Edit Mode as of the last update."""
    mesh = mesh_of(entry)
    if mesh is None:
        return 0, 0, 0
    return len(mesh.vertices), len(mesh.polygons), len(mesh.loops)


def outdated(entry: KoebeIslandReport) -> str:
    """Why an entry is not about what is there now, or empty."""
    if any(entry.mesh_size) and tuple(entry.mesh_size) != _mesh_size(entry):  # files of 1.0 have none
        return "The mesh has changed since then: unwrap it again"
    mesh = mesh_of(entry)
    if entry.mapped and not entry.shape and mesh is not None and entry.layer not in mesh.uv_layers:
        return f"There is no UV layer {entry.layer!r} any more: it was undone, removed or renamed"
    return ""


def _fill(group: bpy.types.PropertyGroup, row: dict[str, Any]) -> None:
    for name, value in row.items():
        setattr(group, name, json.dumps(value) if isinstance(value, list) else value)


def record_moved(
    context: bpy.types.Context, koebe: ModuleType, name: str, layer: str, island: Island, placed: Carried
) -> None:
    """Update an object's entry, of one island, with new UVs of the same loops. Notes the report before.

    placed  has uv (n, 2) of the island's vertices, angle_error in degrees and flipped (k,) triangles
    """
    number = {v: i for i, v in enumerate(island.source_vertex.tolist())}
    for entry in report_of(context).islands:
        if entry.owner_name != name or entry.layer != layer or not entry.mapped:
            continue
        entry.angle_error, entry.flipped = placed.angle_error, len(placed.flipped)
        _fill(entry, texel_figures(island, placed.uv))
        entry.flipped_faces = json.dumps(np.unique(island.triangle_face[placed.flipped]).tolist())
        for loop in entry.loops:
            rim = [number[v] for v in json.loads(loop.vertices) if v in number]
            center, radius, _ = koebe.fit_circle(placed.uv[rim].astype(np.float64))
            loop.uv_center, loop.uv_radius = center, radius


def forget(run: Transaction, context: bpy.types.Context, name: str, layer: str) -> None:
    """Remove an object's entries of a layer whose UVs lie elsewhere now."""
    report = report_of(context)
    note_group(run, report)
    for index in reversed(range(len(report.islands))):
        if (report.islands[index].owner_name, report.islands[index].layer) == (name, layer):
            report.islands.remove(index)
    report.active = min(report.active, max(len(report.islands) - 1, 0))


def even_of(context: bpy.types.Context, name: str, layer: str) -> float | None:
    """E with which the parts of an object's layer were made, if the report knows it."""
    entries = report_of(context).islands
    return next((one.even for one in entries if (one.owner_name, one.layer) == (name, layer) and one.parts), None)


def names_of_active(context: bpy.types.Context) -> set[str]:
    """Names of the active object and of the others with its mesh: the report on one is about all of them."""
    obj: Any = context.active_object
    if obj is None or obj.data is None or obj.data.users == 1:
        return set() if obj is None else {obj.name}
    return {other.name for other in bpy.data.objects if other.data == obj.data}


def active_index(context: bpy.types.Context) -> int:
    """The number of the island whose details are shown: of the active object's islands the chosen one, else the first
    that could not be mapped, else the first; -1 without any."""
    report, names = report_of(context), names_of_active(context)
    own = [index for index, entry in enumerate(report.islands) if entry.owner_name in names]
    if report.active in own:
        return report.active
    return next((index for index in own if not report.islands[index].mapped), own[0] if own else -1)


def active_entry(context: bpy.types.Context) -> KoebeIslandReport | None:
    """The island of the report whose details are shown, or None."""
    index = active_index(context)
    return report_of(context).islands[index] if index >= 0 else None


def entries_of_object(context: bpy.types.Context) -> list[KoebeIslandReport]:
    """All islands of the object whose details are shown."""
    names = names_of_active(context)
    return [entry for entry in report_of(context).islands if entry.owner_name in names]


def selectable_entries(context: bpy.types.Context) -> list[KoebeIslandReport]:
    """The island whose elements operators select, and behind it the other islands of its object: as shown, or, for
    scripts, the island with the number `active` if the active object has no map."""
    report = report_of(context)
    islands = report.islands
    first = active_entry(context) or (islands[report.active] if 0 <= report.active < len(islands) else None)
    if first is None:
        return []
    return [first, *(entry for entry in islands if entry.owner_name == first.owner_name and entry != first)]


def failed_beside(context: bpy.types.Context) -> list[str]:
    """Names of the other objects of the last run that have an island without a map."""
    islands = report_of(context).islands
    last = max((entry.run for entry in islands), default=0)
    failed = [entry.owner_name for entry in islands if entry.run == last and not entry.mapped]
    own = names_of_active(context)
    return [name for name in dict.fromkeys(failed) if name not in own]


GROUPS = (KoebeLoopReport, KoebeWarningReport, KoebeIslandReport, KoebeReport)
register, unregister = added_to(bpy.types.WindowManager, "koebe_uv", *GROUPS)
