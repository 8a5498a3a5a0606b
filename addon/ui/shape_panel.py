# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel for shapes: the fingerprint of one, its distance to others, one texture for several."""

from typing import Any

import bpy

from ..operators.carry_texture import UV_OT_koebe_carry_texture
from ..operators.compare_shapes import UV_OT_koebe_compare_shapes
from ..state.option_properties import settings_of
from ..state.shape_report import KoebeShapes, shapes_of
from .panel_parts import ClosedPanel, draw_message

MAX_NUMBERS = 24  # of a module, one hole per row: x, y and radius
MAX_ENTRIES = 12  # objects that were compared, or got a texture


class ShapesPanel(ClosedPanel):
    """The conformal module of the active object, and the other selected ones held against it."""

    bl_label = "Compare and Carry"
    help_at = "10-one-texture-for-several-shapes"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        shapes = shapes_of(context)
        layout.operator(UV_OT_koebe_compare_shapes.bl_idname, text="Compare Shapes", icon="CON_SIZELIKE")
        if shapes.source:
            draw_module(layout.column(align=True), shapes)
        if len(shapes.others):
            draw_entries(layout.column(align=True), f"Distance from {shapes.source}", shapes.others, "{:.5f}")
        column = layout.column(align=True)
        texture = column.operator(UV_OT_koebe_carry_texture.bl_idname, text="Carry Texture", icon="UV_DATA")
        texture.layer, texture.fit_holes = settings_of(context).layer, False
        fitted = column.operator(UV_OT_koebe_carry_texture.bl_idname, text="Carry and Fit Holes")
        fitted.layer, fitted.fit_holes = settings_of(context).layer, True
        if len(shapes.carried):
            draw_entries(layout.column(align=True), "Holes apart, of the texture", shapes.carried, "{:.2%}")


def draw_module(column: bpy.types.UILayout, shapes: KoebeShapes) -> None:
    """Draw the module's numbers, one hole per row: x, y and radius."""
    column.label(text=f"Circles of {shapes.source}", icon="MESH_CIRCLE")
    numbers = list(shapes.module)
    if not numbers:
        column.label(text="Without holes all are the same")
    rows = {"": dict(zip("xyr", "xyr", strict=True))} if numbers else {}
    for number in numbers[:MAX_NUMBERS]:
        letter, hole = number.name.split("_")
        rows.setdefault(hole, {})[letter] = f"{number.value:.3f}"
    for hole, values in rows.items():
        split = column.split(factor=0.13)
        split.label(text=hole)
        row = split.row(align=True)
        for letter in "xyr":
            row.label(text=values.get(letter, ""))
    if len(numbers) > MAX_NUMBERS:
        column.label(text=f"and {len(numbers) - MAX_NUMBERS} more numbers")


def draw_entries(column: bpy.types.UILayout, title: str, entries: Any, form: str) -> None:
    """Draw one line per object: its name and its number, or why there is none."""
    column.label(text=title)
    for entry in entries[:MAX_ENTRIES]:
        split = column.split(factor=0.65)
        split.label(text=entry.name, icon="CHECKMARK" if entry.measured and not entry.message else "ERROR")
        split.label(text=form.format(entry.distance) if entry.measured else "")
        draw_message(column, entry.message)
    if len(entries) > MAX_ENTRIES:
        column.label(text=f"and {len(entries) - MAX_ENTRIES} more objects")
