# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that make flat pieces of a UV layout: a mesh object, and a drawing for cutting."""

import os
from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ExportHelper
from mathutils import Vector

from ..blender.copied_object import add_copied_object, add_text
from ..blender.selection import select_objects
from ..blender.targets import attempt, target_objects
from ..blender.transaction import transaction
from ..jobs.flat_job import Flat, FlattenJob, read_flat
from ..layers.flat_svg import flat_svg
from ..maps.flat_pattern import FlatPattern
from ..maps.wording import counted
from .answers import finished, refused
from .modal_run import ModalRun
from .polls import OnTargets

GAP = 0.05  # of a layout's width, between two objects
BESIDE = 0.1  # of an object's width, between the objects and their flat pieces
LAYER = "UV layer that is laid flat. Without a name, the active layer"
PAGES = [
    ("A4", "210 × 297 mm"), ("A3", "297 × 420 mm"), ("A2", "420 × 594 mm"), ("A1", "594 × 841 mm"),
    ("A0", "841 × 1189 mm"), ("letter", "8.5 × 11 inches"), ("tabloid", "11 × 17 inches"),
    ("none", "One sheet, as large as it needs to be"),
]  # fmt: skip
PIECES = [
    ("UVS", "UV Layout", "The islands of the UV layer as they are, with the surface's area"),
    ("TRUE", "True to Size", "The surface is cut anew, along its seams and where it bends, and keeps its lengths as "
     "well as it can: for cloth, leather, paper or sheet metal. The UVs stay as they are"),
]  # fmt: skip


def pieces_option() -> Any:
    return EnumProperty(name="Pieces", items=PIECES, default="UVS", description="What is laid flat")


class FlatOperator(OnTargets, ModalRun):
    """The common part of both operators. UV layouts are read at once. Pieces true to size are computed, and Esc ends
    that."""

    needs, modes = "Select a mapped mesh object, in Object Mode", ("OBJECT",)
    pieces: str

    def execute(self, context: bpy.types.Context) -> set[str]:
        if self.pieces == "TRUE":
            return super().execute(context)
        return self._as_they_are(context)

    def _as_they_are(self, context: bpy.types.Context) -> set[str]:
        raise NotImplementedError

    def _read(self, context: bpy.types.Context, layer: str) -> tuple[list[Flat], list[str]]:
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        return read_flat(target_objects(context), layer)

    def _say(self, done: list[Flat], problems: list[str], where: str) -> set[str]:
        if not done:
            return refused(self, "nothing was laid flat.", problems)
        for flat in done:
            fine = flat.layout.is_true and not flat.layout.left_out
            self.report({"INFO"} if fine else {"WARNING"}, f"{flat.describe()}{where}")
        return finished(self, "not flattened", problems)


class OBJECT_OT_koebe_flat_copy(FlatOperator, bpy.types.Operator):
    """Make a flat mesh object of the UV layout, at the 3D cursor, or of pieces that are cut anew and true to size,
    beside the object. It has the same faces. A message says how far its lengths are off"""

    bl_idname = "object.koebe_flat_copy"
    bl_label = "Koebe Flat Copy"
    bl_options = {"REGISTER", "UNDO"}

    pieces: pieces_option()
    layer: StringProperty(name="UV Layer", description=LAYER)
    numbers: BoolProperty(
        name="Numbers", default=True,
        description="Add text objects: the number of each piece, and at both sides of each cut its number",
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self.execute(context) if self.pieces == "UVS" else super().invoke(context, event)

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        self.layout.prop(self, "pieces")
        self.layout.prop(self, "layer" if self.pieces == "UVS" else "numbers")

    def _job(self, context: bpy.types.Context) -> FlattenJob:
        return FlattenJob(target_objects(context))

    def _finish(self, context: bpy.types.Context, job: FlattenJob) -> set[str]:
        flats = job.flats()
        return self._lay(context, flats, job.problems, _place_beside(flats))

    def _as_they_are(self, context: bpy.types.Context) -> set[str]:
        found, problems = self._read(context, self.layer)
        return self._lay(context, found, problems, _at_cursor(context))

    def _lay(
        self, context: bpy.types.Context, found: list[Flat], problems: list[str], corner: tuple[float, float, float]
    ) -> set[str]:
        """Add the copies in a row, from the corner on."""
        with transaction() as run:
            done, made = [], []
            x, y, z = corner
            for flat in found:
                with attempt(run, flat.obj.name, problems):
                    place = (x, y, z)
                    copy = add_copied_object(run, context, flat.obj, flat.layout, flat.layer, flat.uv, place, "Flat")
                    made.append(copy)
                    for label in flat.labels if self.numbers else ():
                        add_text(copy, label.text, tuple(label.at.tolist()), label.height, label.angle)
                    done.append(flat)
                    x += (1.0 + GAP) * float(flat.layout.points[:, 0].max())
            if made:
                select_objects(run, context, made)
            return self._say(done, problems, "")


def _at_cursor(context: bpy.types.Context) -> tuple[float, float, float]:
    x, y, z = context.scene.cursor.location
    return x, y, z


def _place_beside(flats: list[Flat]) -> tuple[float, float, float]:
    """A place at the right of all the objects, at the height of the first."""
    if not flats:
        return 0.0, 0.0, 0.0
    boxes = [flat.obj.matrix_world @ Vector(corner) for flat in flats for corner in flat.obj.bound_box]
    left, right = min(corner.x for corner in boxes), max(corner.x for corner in boxes)
    origin = flats[0].obj.matrix_world.translation
    return right + BESIDE * max(right - left, float(flats[0].layout.points[:, 0].max())), origin.y, origin.z


class UV_OT_koebe_flat_svg(FlatOperator, ExportHelper, bpy.types.Operator):
    """Write the UV layout as a drawing for cutting and engraving, in millimetres and as large as the surface, or a
    pattern that is cut anew, true to size, on pages. A message says how far the lengths are off"""

    bl_idname = "uv.koebe_flat_svg"
    bl_label = "Koebe Flat SVG"
    bl_options = {"REGISTER"}

    filepath: StringProperty(name="File", subtype="FILE_PATH", description="File to write")
    filter_glob: StringProperty(default="*.svg;*.dxf", options={"HIDDEN"})
    pieces: pieces_option()
    layer: StringProperty(name="UV Layer", description=LAYER)
    scale: FloatProperty(
        name="Scale",
        default=1.0,
        min=1e-6,
        soft_max=10.0,
        precision=4,
        description="Scale of the drawing: 1 is true size, by the units of the scene",
    )
    edges: BoolProperty(
        name="Edges", default=False, description="Draw the edges between faces too, in black, for engraving"
    )

    page: EnumProperty(
        name="Page", items=[(name, name, text) for name, text in PAGES], default="A4", description="Size of a page"
    )
    allowance: FloatProperty(
        name="Allowance",
        default=0.0,
        min=0.0,
        max=100.0,
        description="Millimetres round each piece, outside of the line where it is sewn",
    )
    drawing: EnumProperty(
        name="Format",
        items=[("SVG", "SVG", "A file for each page"), ("DXF", "DXF", "One file, for cutting machines")],
        default="SVG",
        description="Format of the pattern",
    )

    @property
    def filename_ext(self) -> str:
        """Of the file, for Blender."""
        return ".dxf" if self.pieces == "TRUE" and self.drawing == "DXF" else ".svg"

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        browser: Any = ExportHelper
        answer: set[str] = browser.invoke(self, context, event)
        return answer

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.use_property_split = True
        own = ("layer", "scale", "edges") if self.pieces == "UVS" else ("scale", "page", "allowance", "drawing")
        for name in ("pieces", *own):
            self.layout.prop(self, name)

    def cancel(self, context: bpy.types.Context) -> None:
        """The file browser was closed: nothing runs."""

    def _millimetres(self, context: bpy.types.Context) -> float:
        return 1000.0 * context.scene.unit_settings.scale_length * self.scale

    def _job(self, context: bpy.types.Context) -> FlattenJob:
        options = {"page": self.page, "allowance": self.allowance}
        return FlattenJob(target_objects(context), millimetres=self._millimetres(context), **options)

    def _finish(self, context: bpy.types.Context, job: FlattenJob) -> set[str]:
        patterns = job.patterns()
        if not patterns:
            return refused(self, "nothing was laid flat.", job.problems)
        path, written = Path(self.filepath), []
        for number, (name, pattern) in enumerate(patterns):
            own = path if number == 0 else path.with_name(f"{path.stem} {bpy.path.clean_name(name)}{path.suffix}")
            try:
                written.append(_write_pages(own, self._pages(pattern)))
            except OSError as error:
                return refused(self, f"{own}: {error.strerror or error}")
        for (name, pattern), text in zip(patterns, written, strict=True):
            self.report({"INFO"}, f"{name}: {pattern.describe()}; {text}")
        return finished(self, "not flattened", job.problems)

    def _pages(self, pattern: FlatPattern) -> list[str]:
        return [pattern.result.dxf] if self.drawing == "DXF" else pattern.result.svg

    def _as_they_are(self, context: bpy.types.Context) -> set[str]:
        found, problems = self._read(context, self.layer)
        if found:
            layouts = [(flat.obj.name, flat.layout) for flat in found]
            text = flat_svg(layouts, self._millimetres(context), self.edges)
            try:
                _write_whole(Path(self.filepath), text)
            except OSError as error:
                return refused(self, f"{self.filepath}: {error.strerror or error}")
        return self._say(found, problems, f"; {self.filepath}")


def _write_pages(path: Path, pages: list[str]) -> str:
    """Write each page to a file, the second one to NAME-2. Returns what was written, in words."""
    for number, page in enumerate(pages, 1):
        _write_whole(path if number == 1 else path.with_name(f"{path.stem}-{number}{path.suffix}"), page)
    return str(path) if len(pages) == 1 else f"{counted(len(pages), 'page')}, {path} and after it"


def _write_whole(path: Path, text: str) -> None:
    """Write a file completely or not at all."""
    part = path.with_name(f".{path.name}.part")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
