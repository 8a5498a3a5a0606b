# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel that shows the last map of the active object, island by island."""

import json
from typing import Any, Literal

import bpy

from ..blender import rendered_layer
from ..maps.verdicts import Figure, figures, is_good
from ..maps.wording import counted
from ..operators.select_from_report import (
    OBJECT_OT_koebe_show,
    UV_OT_koebe_select_cuts,
    UV_OT_koebe_select_flipped,
    UV_OT_koebe_select_loop,
    UV_OT_koebe_select_offenders,
    UV_OT_koebe_select_torn,
    UV_OT_koebe_select_warning,
)
from ..state.option_properties import settings_of
from ..state.run_report import (
    KoebeIslandReport,
    KoebeWarningReport,
    active_entry,
    entries_of_object,
    failed_beside,
    names_of_active,
    outdated,
    report_of,
)
from .panel_parts import ClosedPanel, KoebePanel, draw_map_button, draw_message, draw_unwrap

MAX_LOOP_BUTTONS = 40
MAX_OTHERS = 5  # objects that could not be mapped, beside the active one
MOST_LINES = 6  # of each message, until everything is requested
# Radius of an annulus's hole, over its rim's. Below it texels differ by the inverse: it should be unrolled.
LONG_TUBE = 0.2


class KOEBE_UL_islands(bpy.types.UIList):
    """The islands of the active object, one a line."""

    def filter_items(self, context: bpy.types.Context, data: Any, name: str) -> tuple[list[int], list[int]]:
        """Show the active object's islands."""
        names = names_of_active(context)
        return [self.bitflag_filter_item * (entry.owner_name in names) for entry in getattr(data, name)], []

    def draw_item(
        self,
        context: bpy.types.Context,
        layout: bpy.types.UILayout,
        data: Any,
        item: KoebeIslandReport,
        icon: int,
        active_data: Any,
        active_property: str,
    ) -> None:
        """Give the name most of the room, as it tells the islands apart. The icon shows islands without a map."""
        split = layout.split(factor=0.66 if item.mapped else 1.0)
        name = item.owner_name
        if item.shape:
            name = f"{item.shape}, island" if item.island else item.shape
        number = f" {item.island + 1}" if item.island or not item.shape else ""
        split.label(text=f"{name}{number}", icon=island_icon(item))
        if item.mapped:
            split.label(text=f"{item.flipped} flips" if item.flipped else f"{item.angle_error:.2f}°")


def island_icon(entry: KoebeIslandReport) -> Literal["CANCEL", "CHECKMARK", "ERROR"]:
    """The icon for good, to be looked at, or not mapped."""
    if not entry.mapped:
        return "CANCEL"
    return "CHECKMARK" if is_good(entry) else "ERROR"


def shared_coverage(
    context: bpy.types.Context, entry: KoebeIslandReport, of_object: list[KoebeIslandReport]
) -> float:
    """How much of the UV square the islands cover that share it with this one.

    of_object    the islands of its object
    """
    if entry.parts:
        return entry.coverage  # of all parts
    islands = [one for one in report_of(context).islands if one.together and one.run == entry.run] if (
        entry.together) else of_object
    return sum(one.coverage for one in islands if one.shape == entry.shape)


class ReportPanel(KoebePanel):
    """The last map of the active object, island by island."""

    bl_label = "Report"
    help_at = "3-judge"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        report = report_of(context)
        for name in failed_beside(context)[:MAX_OTHERS]:
            layout.operator(OBJECT_OT_koebe_show.bl_idname, text=f"Not mapped: {name}", icon="ERROR").object_name = name
        entry = active_entry(context)
        if entry is None:
            obj: Any = context.active_object
            known = settings_of(context).layer in getattr(getattr(obj, "data", None), "uv_layers", ())
            nothing = "no report on its UVs" if known else "no map yet"  # of a duplicate, for example
            layout.label(text="No map yet: press Unwrap" if obj is None else f"{obj.name}: {nothing}")
            return
        of_object = entries_of_object(context)
        if len(of_object) > 1:
            layout.template_list("KOEBE_UL_islands", "", report, "islands", report, "active", rows=3)
        several = len([one for one in of_object if one.shape == entry.shape]) > 1
        which = f", island {entry.island + 1}" if several else ""
        if entry.shape:
            which = f", {entry.shape}{which if entry.island else ''}"
        old = outdated(entry)
        layout.label(text=f"{entry.owner_name}{which}", icon="ERROR" if old else island_icon(entry))
        draw_message(layout, old)
        if entry.mapped:
            column = layout.column(align=True)
            for figure in figures(entry, shared_coverage(context, entry, of_object)):
                draw_figure(column, figure)
            draw_selections(layout.column(), entry, of_object)
            if entry.uneven:
                draw_map_button(layout.column(align=True), settings_of(context), "parts")
            draw_unroll(layout, context, entry)
            for number, warning in enumerate(entry.warnings):
                draw_warning(layout.box().column(align=True), number, warning)
            draw_layers(layout.column(align=True), entry)
        most = 0 if report.show_all else MOST_LINES
        note = "" if entry.moved else entry.note  # which speaks of the map before
        said = ("" if entry.mapped else entry.message, note, entry.moved)
        if max([draw_message(layout, text, most) for text in said]) > MOST_LINES:
            layout.prop(report, "show_all", toggle=True)
        if entry.mapped:
            return
        if entry.offenders:
            layout.operator(UV_OT_koebe_select_offenders.bl_idname, icon="RESTRICT_SELECT_OFF")
        draw_offer(layout.column(align=True), context, entry)


def draw_figure(column: bpy.types.UILayout, figure: Figure) -> None:
    """A figure with its verdict; where it is not good, in red, and what to do about it."""
    split = column.split(factor=0.6)
    split.alert = not figure.is_good
    split.label(text=figure.name, icon="CHECKMARK" if figure.is_good else "ERROR")
    split.label(text=figure.value)
    draw_message(column, figure.advice)


def draw_layers(column: bpy.types.UILayout, entry: KoebeIslandReport) -> None:
    """Which other UV layers are shown where the object's materials are."""
    obj: Any = entry.owner
    if obj is not None and obj.type == "MESH":
        for sentence in rendered_layer.sentences(obj, entry.layer):
            draw_message(column, sentence)


def draw_warning(column: bpy.types.UILayout, number: int, warning: KoebeWarningReport) -> None:
    """What to watch out for, and the button that selects it."""
    draw_message(column, warning.text)
    if warning.of:
        button = column.operator(UV_OT_koebe_select_warning.bl_idname, text="Select", icon="RESTRICT_SELECT_OFF")
        button.warning = number


def draw_selections(
    column: bpy.types.UILayout, entry: KoebeIslandReport, of_object: list[KoebeIslandReport]
) -> None:
    """Buttons that select cuts, flipped and torn faces, where there are any."""
    if any(one.cuts or one.cut_edges for one in of_object):
        column.operator(UV_OT_koebe_select_cuts.bl_idname, icon="RESTRICT_SELECT_OFF")
    if entry.flipped:
        column.operator(UV_OT_koebe_select_flipped.bl_idname, icon="RESTRICT_SELECT_OFF")
    if json.loads(entry.torn_faces or "[]"):
        column.operator(UV_OT_koebe_select_torn.bl_idname, icon="RESTRICT_SELECT_OFF")


class DetailsPanel(ClosedPanel):
    """The other figures of a map, its warnings as the solver says them, and its loops."""

    bl_label = "Details"
    help_at = "3-judge"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        entry = active_entry(context)
        return entry is not None and entry.mapped

    def draw(self, context: bpy.types.Context) -> None:
        entry = active_entry(context)
        assert entry is not None  # as `poll` has seen
        draw_details(self.layout.column(), entry)
        draw_message(self.layout, entry.message, 0 if report_of(context).show_all else MOST_LINES)


def draw_details(column: bpy.types.UILayout, entry: KoebeIslandReport) -> None:
    """Figures of a mapped island, and buttons that select its loops."""
    table = column.column(align=True)
    sweeps = ("Iterations", f"{entry.sweeps}" if entry.converged else f"{entry.sweeps}, not converged")
    # Rows that differ by the kind of map.
    of_circles = [("Roundness", f"{entry.roundness:.1e}"), sweeps]
    of_parts = [
        ("Parts", f"{entry.parts}"),
        ("Cut length", f"{entry.cut_length:.1f} × √area"),
    ]
    of_tile = [
        ("Modulus", entry.modulus),
        *(("Repeats after" if not number else "", text) for number, text in enumerate(entry.periods.split(" and "))),
        sweeps,
    ]
    torn, moved, flipped = (
        len(json.loads(faces or "[]")) for faces in (entry.torn_faces, entry.moved_faces, entry.flipped_faces)
    )
    of_sphere = [
        ("Holes", f"{len(entry.loops)}"),
        ("Torn", counted(torn, "face")),
        ("Moved", counted(moved, "face")),
        sweeps,
    ]
    of_handles = [
        ("Mug handles", f"{entry.handles}"),
        ("Holes", f"{len(entry.loops)}"),
        ("Cut along", "circles" if entry.by_circles else "edges"),
        sweeps,
    ]
    of_domain = {"sphere": of_sphere, "schottky": of_handles}.get(entry.domain, of_tile)
    for name, value in (
        *([("Even", f"{entry.even:.2f}")] if entry.even else []),
        *(of_parts if entry.parts else of_domain if entry.domain else of_circles),
        ("Flipped", counted(flipped, "face")),
        ("Time", f"{entry.seconds:.2f} s"),
    ):
        split = table.split(factor=0.45)
        split.label(text=name)
        split.label(text=value)
    if not entry.loops:
        return
    column.label(text="Select Boundary")
    grid = column.grid_flow(row_major=True, columns=4, even_columns=True, align=True)
    for index in range(min(len(entry.loops), MAX_LOOP_BUTTONS)):
        text = entry.loops[index].name or ("Rim" if index == 0 else f"{index}")
        grid.operator(UV_OT_koebe_select_loop.bl_idname, text=text).loop = index


def draw_offer(column: bpy.types.UILayout, context: bpy.types.Context, entry: KoebeIslandReport) -> None:
    """Draw the buttons of operators that take a surface that does not fit this domain."""
    for offer in entry.offer.split():
        draw_map_button(column, settings_of(context), offer)


def draw_unroll(layout: bpy.types.UILayout, context: bpy.types.Context, entry: KoebeIslandReport) -> None:
    """Draw the offer to unroll a long tube."""
    if entry.domain or entry.shape or len(entry.loops) != 2:
        return
    if entry.loops[1].uv_radius > 0.0 and entry.loops[1].radius < LONG_TUBE:
        draw_unwrap(layout, settings_of(context), "DISK", "Long Tube: Unroll It", "MESH_CYLINDER").tube = "unroll"
