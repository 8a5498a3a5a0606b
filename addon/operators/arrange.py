# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that arrange islands, and that make the trim sheet they go to."""

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.noted_properties import note_group
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.arrange_job import ArrangedLayer, Arrangement
from ..jobs.island_layer import IslandLayer
from ..layers.arrange import FITS, MODES, box
from ..state.option_properties import option, shown_number
from ..state.trims import KoebeTrims, active_trim, rectangles, trims_of
from .answers import refused
from .layer_run import EACH_LAYER, LayerEdit
from .modal_run import redraw
from .polls import OnTargets, native_or_error

NO_TRIMS = "the trim sheet has no rectangle: press Make Grid, or + beside the list"
CHANGES = [
    ("GRID", "Make Grid", "Replace the rectangles by a grid over the UV square"),
    ("ADD", "Add", "Add a rectangle round the active object's UVs, in Edit Mode round the selected faces"),
    ("REMOVE", "Remove", "Remove the rectangle that is chosen in the list"),
]
MOST_CELLS = 26  # of a grid in one direction, as columns have letters


def _items(table: dict[str, tuple[str, str]]) -> list[tuple[str, str, str]]:
    return [(word, label, does[0].upper() + does[1:]) for word, (label, does) in table.items()]


class UV_OT_koebe_arrange(OnTargets, LayerEdit, bpy.types.Operator):
    """Move the islands of the active UV layer: to one line, into sorted rows, into the rectangles of the trim sheet, or
    onto their mirror images. In Edit Mode the islands of the selected faces. Islands with pinned UVs stay"""

    bl_idname = "uv.koebe_arrange"
    bl_label = "Koebe Arrange"
    nothing, not_done = "nothing was arranged.", "not arranged"

    layer: EACH_LAYER
    mode: EnumProperty(name="Arrange", items=_items(MODES), description="Where the islands go")
    in_square: BoolProperty(
        name="To UV Square", description="Align to the UV square. Off: to the box of the islands themselves"
    )
    margin: option("margin")
    pixels: option("pixels")
    trim: StringProperty(
        name="Trim", description="Name of the rectangle. Without a name, the one nearest to each island"
    )
    fit: EnumProperty(name="Fit", items=_items(FITS), description="Size of an island in its rectangle")
    turn: BoolProperty(
        name="Quarter Turns", default=True,
        description="Turn islands that are long in another direction than the rectangle",
    )  # fmt: skip
    tiles: IntProperty(
        name="Tiles Aside", min=-10, max=10, default=1,
        description="So many tiles to the right of the mirror image: textures repeat there, and bakes leave it out",
    )  # fmt: skip

    @classmethod
    def description(cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Each mode has its own tooltip."""
        does = MODES[properties.mode][1]
        return f"{does[0].upper()}{does[1:]}. In Edit Mode the islands of the selected faces. Pinned islands stay"

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        used = {"TRIM": ("trim", "fit", "turn"), "MIRROR": ("tiles",),
                **dict.fromkeys(("SIZE", "MATERIAL", "PART"), ("margin", "pixels"))}  # fmt: skip
        for name in ("mode", *used.get(self.mode, ("in_square",))):
            self.layout.prop(self, name)

    def execute(self, context: bpy.types.Context) -> set[str]:
        koebe = native_or_error(self)
        if koebe is None:
            return {"CANCELLED"}
        sheet = rectangles(trims_of(context), self.trim)
        if self.mode == "TRIM" and not len(sheet):
            return refused(self, f"the trim sheet has no rectangle {self.trim!r}" if self.trim else NO_TRIMS)
        wanted = Arrangement(
            self.mode, self.in_square, shown_number(self.margin) / self.pixels, sheet, self.fit, self.turn, self.tiles
        )
        layer, editing = self.layer, context.mode == "EDIT_MESH"
        return self._edit(
            context, target_objects(context),
            lambda run, obj: ArrangedLayer.of(obj, layer, editing).arrange(run, koebe, wanted),
        )  # fmt: skip


class UV_OT_koebe_trims(bpy.types.Operator):
    """Change the trim sheet of the scene, whose rectangles Into Trims takes"""

    bl_idname = "uv.koebe_trims"
    bl_label = "Koebe Trim Sheet"
    bl_options = {"REGISTER", "UNDO"}

    action: EnumProperty(
        name="Change", items=CHANGES, description="What is changed",
    )  # fmt: skip
    columns: IntProperty(name="Columns", min=1, max=MOST_CELLS, default=1, description="Number of cells side by side")
    rows: IntProperty(name="Rows", min=1, max=MOST_CELLS, default=4, description="Number of cells one above the other")

    @classmethod
    def description(cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Each change has its own tooltip."""
        return next(does for word, _, does in CHANGES if word == properties.action)

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        for name in ("columns", "rows") if self.action == "GRID" else ():
            self.layout.prop(self, name)

    def execute(self, context: bpy.types.Context) -> set[str]:
        trims = trims_of(context)
        try:
            with transaction() as run:
                note_group(run, trims)
                {"GRID": self._grid, "ADD": self._add, "REMOVE": self._remove}[self.action](context, trims)
                redraw(context)
                edit_mode.undo_all(context)
        except TransferError as error:
            return refused(self, str(error))
        return {"FINISHED"}

    def _grid(self, context: bpy.types.Context, trims: KoebeTrims) -> None:
        trims.items.clear()
        for row in range(self.rows):
            for column in range(self.columns):
                made = trims.items.add()
                made.name = f"{chr(ord('A') + column)}{row + 1}"
                made.lower = column / self.columns, 1.0 - (row + 1) / self.rows
                made.upper = (column + 1) / self.columns, 1.0 - row / self.rows
        trims.active = 0

    def _add(self, context: bpy.types.Context, trims: KoebeTrims) -> None:
        """Raises TransferError."""
        lower, upper = np.zeros(2), np.ones(2)
        if context.mode in {"OBJECT", "EDIT_MESH"} and target_objects(context):
            layer = IslandLayer.of(target_objects(context)[0], "", context.mode == "EDIT_MESH")
            points = layer.uv[np.repeat(layer.chosen, layer.surface.face_size)]
            points = points[np.isfinite(points).all(axis=1)]
            lower, upper = box(points) if len(points) else (lower, upper)
        made = trims.items.add()
        made.name, made.lower, made.upper = f"Trim {len(trims.items)}", lower.tolist(), upper.tolist()
        trims.active = len(trims.items) - 1

    def _remove(self, context: bpy.types.Context, trims: KoebeTrims) -> None:
        """Raises TransferError."""
        if active_trim(trims) is None:
            raise TransferError("no rectangle of the trim sheet is chosen")
        trims.items.remove(trims.active)
        trims.active = max(0, min(trims.active, len(trims.items) - 1))
