# SPDX-License-Identifier: GPL-3.0-or-later
"""The last run's report, island by island, kept with the window manager for the panel to show."""

import contextlib
import json
from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..blender.noted_properties import note_group
from ..blender.transaction import Transaction
from ..maps.carried_uv import Carried
from ..maps.circle_fit import fitted_circle
from ..maps.domain_outcomes import DomainOutcome
from ..maps.handles import SchottkyIsland, SchottkyOutcome
from ..maps.offending_elements import offending_elements
from ..maps.outcomes import IslandOutcome, SurfaceOutcome
from ..maps.parts import PartsOutcome
from ..maps.sequence import SequenceOutcome
from ..maps.spheres import SphereIsland, SphereOutcome
from ..maps.surface import Island
from ..maps.tiles import TileIsland, TileOutcome, modulus_text, periods_text
from ..maps.wording import cut_line, explain, failure_line, notes, too_uneven, warnings


class KoebeLoopReport(bpy.types.PropertyGroup):
    """A boundary loop of an island."""

    vertices: StringProperty(description="Vertices of the mesh along the loop, as JSON")
    radius: FloatProperty(description="Radius of its circle in the unit disk; of a cap of the sphere, in radians")
    roundness: FloatProperty(description="Deviation from a circle before the last step, as in the paper")
    uv_center: FloatVectorProperty(size=2, description="Centre of its circle in the UVs")
    uv_radius: FloatProperty(description="Radius of its circle in the UVs, 0 if it is no circle there")


class KoebeIslandReport(bpy.types.PropertyGroup):
    """An island of the last run."""

    object_name: StringProperty(description="Name of the object whose island this is")
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
    density: FloatProperty(description="Density at 95 % of the area over that at 5 %, of a sphere on it")
    cut_edges: StringProperty(description="Of parts: the edges along which the UVs are cut, as JSON, or nothing")
    cut_length: FloatProperty(description="Of parts: the length of all cuts, in units of the root of the area")
    domain: StringProperty(description="The domain: torus, ring, sphere or schottky; else empty")
    modulus: StringProperty(description="Of a torus the ratio of its periods, of a cylinder i times height over period")
    periods: StringProperty(description="Of a tile: its periods in the UVs")
    layout: StringProperty(description="Of a sphere: how it is laid out as UVs")
    torn_faces: StringProperty(description="Of a sphere: the faces that fit to no UVs of its layout, as JSON")
    handles: IntProperty(description="Of a fundamental domain: the handles that are cut open")
    by_circles: BoolProperty(description="Of a fundamental domain: whether the UVs are cut along circles, or edges")
    offer: StringProperty(description="The operators that take an island that this one does not, with spaces between")
    moved: StringProperty(description="What a Möbius map by hand has made of the island, empty without one")
    corners: StringProperty(description="Corners of the mesh on the loops of an island that was moved, as JSON")
    history: StringProperty(description="What the report was for each state of such an island, as JSON")
    loops: CollectionProperty(type=KoebeLoopReport, description="Boundary loops, the outer one first")


class KoebeReport(bpy.types.PropertyGroup):
    """The last run."""

    islands: CollectionProperty(type=KoebeIslandReport, description="Islands of the last run")
    active: IntProperty(name="Island", description="Island whose details are shown")
    show_all: BoolProperty(
        name="All of It", default=False, description="Show the report's messages in full, however long they are"
    )
    show_circles: BoolProperty(
        name="Show Circles",
        default=True,
        description="Draw over the UVs the circles of the last run, with the numbers of the report's loops, and in "
        "Object Mode, in which Blender shows no UVs, the outlines of the islands",
    )


def report_of(context: bpy.types.Context) -> KoebeReport:
    """The report that is shown."""
    return context.window_manager.koebe_uv


def record(
    run: Transaction,
    context: bpy.types.Context,
    outcomes: list[SurfaceOutcome],
    layer: str,
    refused: list[tuple[str, str]],
) -> None:
    """Replace the report: by outcomes that were written to a UV layer, and names and reasons of what was left out."""
    with _new_report(run, context, refused) as report:
        _record_maps(report, outcomes, layer)


def _record_maps(report: KoebeReport, outcomes: list[SurfaceOutcome], layer: str) -> None:
    for outcome in outcomes:
        if outcome.not_written:
            _record_failure(report, outcome.name, outcome.not_written)
            continue
        said_of: dict[int, list[str]] = {}
        for one, text in notes(outcome):
            said_of.setdefault(id(one), []).append(text)
        for index, one in enumerate(outcome.islands):
            entry = report.islands.add()
            entry.object_name, entry.island, entry.layer = outcome.name, index, layer
            if one.error is None:
                _record_result(entry, outcome, one)
                said = said_of.get(id(one), [])
                entry.note, entry.uneven = "; ".join(said), too_uneven(one)
                if one.opening is not None and said and said[0] == cut_line(one.opening):
                    entry.cuts = json.dumps([
                        path
                        for kind, vertices in one.opening.cuts
                        for path in ([[v] for v in vertices.tolist()] if kind == "bow_tie" else [vertices.tolist()])
                    ])
            else:
                entry.message = explain(one.error)
                kind, elements = offending_elements(outcome.task.surface, one)
                entry.offenders = json.dumps([kind, elements.tolist()])


@contextlib.contextmanager
def _new_report(
    run: Transaction, context: bpy.types.Context, refused: list[tuple[str, str]]
) -> Iterator[KoebeReport]:
    """An empty report to fill; what was left out is added to it in the end."""
    report = report_of(context)
    note_group(run, report)
    report.islands.clear()
    yield report
    for name, text in refused:
        _record_failure(report, name, text)
    # What has to be looked at comes first.
    report.active = next((index for index, entry in enumerate(report.islands) if not entry.mapped), 0)


def record_sequences(
    run: Transaction, context: bpy.types.Context, sequences: list[tuple[SequenceOutcome, list[str]]]
) -> None:
    """Replace the report by the sequences of objects, each with the UV layers of its shapes, empty where they are none.

    There is an entry for each shape and island.
    """
    with _new_report(run, context, []) as report:
        for outcome, layers in sequences:
            if not outcome.mapped:
                _record_failure(report, outcome.task.name, failure_line(outcome))
                continue
            said = outcome.figures()
            for label, layer, made in zip(outcome.labels, layers, outcome.maps, strict=True):
                start = len(report.islands)
                _record_maps(report, [made], layer)
                for entry in report.islands[start:]:
                    entry.object_name, entry.shape = outcome.task.name, label
                    entry.note = "; ".join(filter(None, [said, entry.note]))


def record_parts(
    run: Transaction,
    context: bpy.types.Context,
    outcomes: list[PartsOutcome],
    layer: str,
    refused: list[tuple[str, str]],
) -> None:
    """Replace the report by the parts of objects, an entry for each object. They have no circles to be drawn."""
    with _new_report(run, context, refused) as report:
        for outcome in outcomes:
            if outcome.failed or outcome.not_written:
                offer = " ".join(getattr(outcome.error, "offer", ()))
                _record_failure(report, outcome.name, failure_line(outcome), offer)
            for result in outcome.mapped:
                entry = report.islands.add()
                entry.object_name, entry.layer, entry.parts = outcome.name, layer, len(result.parts)
                entry.mapped = entry.converged = True
                entry.angle_error, entry.flipped = result.angle_error_stored_deg["mean"], result.flipped
                entry.converged = result.converged
                entry.density, entry.cut_length = result.density_ratio_5_95, result.cut_length
                entry.seconds = result.seconds
                if outcome.cuts is not None and outcome.cuts.any():
                    entry.cut_edges = json.dumps(np.flatnonzero(outcome.cuts).tolist())
                entry.flipped_faces = json.dumps(outcome.flipped_faces.tolist())
                entry.message = "; ".join([*(warning["text"] for warning in outcome.warnings()), *outcome.remarks])


def record_domains(
    run: Transaction,
    context: bpy.types.Context,
    outcomes: list[DomainOutcome],
    layer: str,
    refused: list[tuple[str, str]],
) -> None:
    """Replace the report by the other domains of objects, an entry for each island."""
    with _new_report(run, context, refused) as report:
        for outcome in outcomes:
            if outcome.not_written:
                _record_failure(report, outcome.name, outcome.not_written)
                continue
            for index, one in enumerate(outcome.islands):
                entry = report.islands.add()
                entry.object_name, entry.island, entry.layer = outcome.name, index, layer
                if one.error is None:
                    _record_domain(entry, outcome, one)
                    continue
                entry.message, entry.offer = explain(one.error), " ".join(getattr(one.error, "offer", ()))
                kind, elements = offending_elements(outcome.task.surface, one)
                entry.offenders = json.dumps([kind, elements.tolist()])


def _record_domain(entry: KoebeIslandReport, outcome: DomainOutcome, one: Any) -> None:
    result = one.result
    entry.mapped, entry.converged, entry.sweeps = True, result.converged, result.sweeps
    entry.domain = outcome.choice.domain
    entry.angle_error, entry.seconds = one.angle_error, result.seconds["total"]
    entry.flipped, entry.flipped_faces = len(one.flipped), json.dumps(one.flipped_faces.tolist())
    entry.uneven, entry.cut_edges = too_uneven(one), json.dumps(np.flatnonzero(one.cuts).tolist())
    entry.message = "; ".join([*(warning["text"] for warning in outcome.warnings(one)), *outcome.remarks])
    entry.note = "; ".join(outcome.notes(one))
    for of_loop in result.loops:
        entry.loops.add().vertices = json.dumps(one.island.source_vertex[of_loop["vertices"]].tolist())
    if isinstance(outcome, TileOutcome):
        _record_tile(entry, outcome, one)
    elif isinstance(outcome, SphereOutcome):
        _record_sphere(entry, outcome, one)
    elif isinstance(outcome, SchottkyOutcome):
        _record_handles(entry, one)


def _record_tile(entry: KoebeIslandReport, outcome: TileOutcome, one: TileIsland) -> None:
    entry.modulus, entry.periods = modulus_text(one.result), periods_text(one.tile)
    entry.cut_length = one.result.cut_length
    for number, (loop, of_loop) in enumerate(zip(entry.loops, one.result.loops, strict=True)):
        loop.uv_center, loop.uv_radius = one.circle(of_loop, outcome.choice.fit)
        loop.name = ("Rim", "Rim 2")[number] if of_loop["rim"] else f"{number + 1 - 2 * (entry.domain == 'ring')}"


def _record_sphere(entry: KoebeIslandReport, outcome: SphereOutcome, one: SphereIsland) -> None:
    entry.layout, entry.density = outcome.choice.layout, one.density_ratio
    entry.torn_faces = json.dumps(one.torn_faces.tolist())
    for number, (loop, of_loop) in enumerate(zip(entry.loops, one.result.loops, strict=True)):
        loop.radius, loop.name = of_loop["radius"], f"{number + 1}"


def _record_handles(entry: KoebeIslandReport, one: SchottkyIsland) -> None:
    entry.handles, entry.by_circles = len(one.result.handles), one.result.by_circles
    entry.density = one.density_ratio
    for number, (loop, (center, radius)) in enumerate(zip(entry.loops, one.circles, strict=True)):
        loop.uv_center, loop.uv_radius = center, radius
        loop.name = f"{number}" if number else "Rim"


def _record_failure(report: KoebeReport, name: str, text: str, offer: str = "") -> None:
    """The entry of an object that was left out as a whole."""
    entry = report.islands.add()
    entry.object_name, entry.message, entry.offer = name, text.removeprefix(f"{name}: "), offer


def _record_result(entry: KoebeIslandReport, outcome: SurfaceOutcome, one: IslandOutcome) -> None:
    result = one.result
    entry.mapped, entry.converged, entry.sweeps = True, result.converged, result.sweeps
    entry.angle_error = one.angle_error
    entry.roundness = float(result.roundness.max())
    entry.flipped, entry.seconds = len(one.flipped), result.seconds["total"]
    entry.flipped_faces = json.dumps(np.unique(one.sheet.triangle_face[one.flipped]).tolist())
    entry.message = "; ".join([*(warning["text"] for warning in warnings(outcome.task, one)), *outcome.remarks])
    for vertices, center, uv_radius, radius, roundness in zip(
        result.loops, *one.circles(), result.radii, result.roundness, strict=True
    ):
        loop = entry.loops.add()
        loop.uv_center = center
        loop.uv_radius = 0.0 if one.unrolled else float(uv_radius)
        loop.vertices = json.dumps(one.island.source_vertex[vertices].tolist())
        loop.radius, loop.roundness = float(radius), float(roundness)


def record_moved(context: bpy.types.Context, name: str, layer: str, island: Island, placed: Carried) -> None:
    """Bring the entry of an object of one island up to date with new UVs of the same loops; note the report before.

    placed  has uv (n, 2) of the island's vertices, angle_error in degrees and flipped (k,) triangles
    """
    number = {v: i for i, v in enumerate(island.source_vertex.tolist())}
    for entry in report_of(context).islands:
        if entry.object_name != name or entry.layer != layer or not entry.mapped:
            continue
        entry.angle_error, entry.flipped = placed.angle_error, len(placed.flipped)
        entry.flipped_faces = json.dumps(np.unique(island.triangle_face[placed.flipped]).tolist())
        for loop in entry.loops:
            rim = [number[v] for v in json.loads(loop.vertices) if v in number]
            center, radius, _ = fitted_circle(placed.uv[rim].astype(np.float64))
            loop.uv_center, loop.uv_radius = center, radius


def active_entry(context: bpy.types.Context) -> KoebeIslandReport | None:
    """The island of the report whose details are shown, or None."""
    report = report_of(context)
    if not 0 <= report.active < len(report.islands):
        return None
    return report.islands[report.active]


def entries_of_object(context: bpy.types.Context) -> list[KoebeIslandReport]:
    """All islands of the object whose details are shown."""
    active = active_entry(context)
    return [entry for entry in report_of(context).islands if active and entry.object_name == active.object_name]


CLASSES = (KoebeLoopReport, KoebeIslandReport, KoebeReport)


def register() -> None:
    """Register the report and hang it on the window manager, which no undo changes."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.koebe_uv = PointerProperty(type=KoebeReport)


def unregister() -> None:
    """Undo `register`."""
    del bpy.types.WindowManager.koebe_uv
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
