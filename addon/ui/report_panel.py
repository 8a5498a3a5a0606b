# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel that shows the last run, island by island."""

import json
from typing import Any, Literal

import bpy

from ..maps.domains import DOMAINS
from ..maps.wording import UNEVEN, counted, density_text
from ..operators.select_from_report import (
    UV_OT_koebe_select_cuts,
    UV_OT_koebe_select_flipped,
    UV_OT_koebe_select_loop,
    UV_OT_koebe_select_offenders,
    UV_OT_koebe_select_torn,
)
from ..operators.uniformize import UV_OT_koebe_uniformize
from ..state.option_properties import copy_options, settings_of
from ..state.run_report import KoebeIslandReport, active_entry, entries_of_object, report_of
from .panel_parts import KoebePanel, draw_domain_button, draw_message, draw_parts_button

MAX_LOOP_BUTTONS = 40
MOST_LINES = 6  # of each message, until all is asked for
# Radius of an annulus's hole, in units of its rim, below which texels differ by the inverse: better unrolled.
LONG_TUBE = 0.2


class KOEBE_UL_islands(bpy.types.UIList):
    """The islands of the last run, one a line."""

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
        """The name has most of the room, as that tells the islands apart; the icon tells what was not mapped."""
        split = layout.split(factor=0.66 if item.mapped else 1.0)
        name = item.object_name
        if item.shape:
            name = f"{item.shape}, island" if item.island else item.shape
        number = f" {item.island + 1}" if item.island or not item.shape else ""
        split.label(text=f"{name}{number}", icon=island_icon(item))
        if item.mapped:
            split.label(text=f"{item.flipped} flips" if item.flipped else f"{item.angle_error:.2f}°")


def island_icon(entry: KoebeIslandReport) -> Literal["CANCEL", "CHECKMARK", "ERROR"]:
    """Good, to be looked at, or not mapped."""
    if not entry.mapped:
        return "CANCEL"
    return "CHECKMARK" if entry.converged and not entry.flipped and not entry.message else "ERROR"


class ReportPanel(KoebePanel):
    """The last run, island by island."""

    bl_label = "Report"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        report = report_of(context)
        if not report.islands:
            layout.label(text="No run yet")
        if len(report.islands) > 1:
            layout.template_list("KOEBE_UL_islands", "", report, "islands", report, "active", rows=3)
        entry = active_entry(context)
        if entry is None:
            return
        which = "" if entry.parts else f", island {entry.island + 1}"
        if entry.shape:
            which = f", {entry.shape}{which if entry.island else ''}"
        layout.label(text=f"{entry.object_name}{which}", icon=island_icon(entry))
        if entry.uneven:
            draw_message(layout, UNEVEN)
            draw_parts_button(layout.column(align=True), settings_of(context), dial=False)
        most = 0 if report.show_all else MOST_LINES
        counts = [draw_message(layout, text, most) for text in (entry.message, entry.note, entry.moved)]
        if max(counts) > MOST_LINES:
            layout.prop(report, "show_all", toggle=True)
        if entry.mapped:
            draw_unroll(layout, context, entry)
            draw_result(layout.column(), entry)
            return
        if entry.offenders:
            layout.operator(UV_OT_koebe_select_offenders.bl_idname, icon="RESTRICT_SELECT_OFF")
        draw_offer(layout.column(align=True), context, entry)


def draw_result(column: bpy.types.UILayout, entry: KoebeIslandReport) -> None:
    """Figures of a mapped island, and buttons that select its loops and its flipped faces."""
    table = column.column(align=True)
    sweeps = ("Sweeps", f"{entry.sweeps}" if entry.converged else f"{entry.sweeps}, not converged")
    of_circles = [("Roundness", f"{entry.roundness:.1e}"), sweeps]
    density = f"1 : {density_text(entry.density)}, on 90 %"
    of_parts = [
        ("Parts", f"{entry.parts}"),
        ("Cut length", f"{entry.cut_length:.1f} × √area"),
        ("Density", density),
    ]
    of_tile = [
        ("Modulus", entry.modulus),
        *(("Period" if not number else "", text) for number, text in enumerate(entry.periods.split(" and "))),
        sweeps,
    ]
    torn = len(json.loads(entry.torn_faces or "[]"))
    of_sphere = [
        ("Scale", density),
        ("Caps", f"{len(entry.loops)}"),
        ("Torn", f"{torn}"),
        sweeps,
    ]
    of_handles = [
        ("Handles", f"{entry.handles}"),
        ("Holes", f"{len(entry.loops)}"),
        ("Cut along", "circles" if entry.by_circles else "edges"),
        ("Density", density),
        sweeps,
    ]
    of_domain = {"sphere": of_sphere, "schottky": of_handles}.get(entry.domain, of_tile)
    for name, value in (
        ("Angle error", f"{entry.angle_error:.2f}°"),
        *([("Even", f"{entry.even:.2f}")] if entry.even else []),
        *(of_parts if entry.parts else of_domain if entry.domain else of_circles),
        ("Flipped", counted(len(json.loads(entry.flipped_faces or "[]")), "face")),
        ("Time", f"{entry.seconds:.2f} s"),
    ):
        split = table.split(factor=0.45)
        split.label(text=name)
        split.label(text=value)
    if any(one.cuts or one.cut_edges for one in entries_of_object(bpy.context)):
        column.operator(UV_OT_koebe_select_cuts.bl_idname, icon="RESTRICT_SELECT_OFF")
    if entry.flipped:
        column.operator(UV_OT_koebe_select_flipped.bl_idname, icon="RESTRICT_SELECT_OFF")
    if torn:
        column.operator(UV_OT_koebe_select_torn.bl_idname, icon="RESTRICT_SELECT_OFF")
    if not entry.loops:
        return
    column.label(text="Select Loop")
    grid = column.grid_flow(row_major=True, columns=4, even_columns=True, align=True)
    for index in range(min(len(entry.loops), MAX_LOOP_BUTTONS)):
        text = entry.loops[index].name or ("Rim" if index == 0 else f"{index}")
        grid.operator(UV_OT_koebe_select_loop.bl_idname, text=text).loop = index


def draw_offer(column: bpy.types.UILayout, context: bpy.types.Context, entry: KoebeIslandReport) -> None:
    """The buttons of what takes a surface that is no such domain."""
    for offer in entry.offer.split():
        if offer in DOMAINS:
            draw_domain_button(column, settings_of(context), offer)
        elif offer == "uniformize":
            button = column.operator(UV_OT_koebe_uniformize.bl_idname, icon="MESH_CIRCLE")
            copy_options(settings_of(context), button)
        else:
            draw_parts_button(column, settings_of(context), dial=False)


def draw_unroll(layout: bpy.types.UILayout, context: bpy.types.Context, entry: KoebeIslandReport) -> None:
    """The offer to unroll a long tube."""
    if entry.domain or entry.shape or len(entry.loops) != 2:
        return
    if entry.loops[1].uv_radius > 0.0 and entry.loops[1].radius < LONG_TUBE:
        button = layout.operator(UV_OT_koebe_uniformize.bl_idname, text="Long Tube: Unroll It", icon="MESH_CYLINDER")
        copy_options(settings_of(context), button)
        button.tube = "unroll"
