# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators on shapes, and what they found, kept with the window manager for the panel to show."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, PointerProperty, StringProperty

from . import results
from .errors import few, lines
from .modal_run import ModalRun
from .native import NativeError
from .noted import note_group
from .properties import UniformizeProperties
from .shape_jobs import CarryJob, MeasureJob
from .shapes import ShapeError
from .targets import target_objects
from .transaction import transaction
from .transfer import TransferError


class KoebeModuleNumber(bpy.types.PropertyGroup):
    """A number of a conformal module."""

    value: FloatProperty(precision=6, description="Length in the unit disk")  # its name: r_1, y_2, ...


class KoebeShape(bpy.types.PropertyGroup):
    """A shape that was compared; its name is that of its object."""

    measured: BoolProperty(description="Whether there is a distance")
    distance: FloatProperty(precision=6, description="L2 distance of the conformal modules")
    message: StringProperty(description="Why there is none, or what to watch out for")


class KoebeShapes(bpy.types.PropertyGroup):
    """The last comparison: the first shape, and the others with their distances from it."""

    source: StringProperty(description="Name of the object whose module it is")
    module: CollectionProperty(type=KoebeModuleNumber, description="Its conformal module")
    others: CollectionProperty(type=KoebeShape, description="What it was compared with")
    carried: CollectionProperty(type=KoebeShape, description="What its texture was carried to, and how well it fits")


class _ShapeOperator(ModalRun):
    """What the operators on shapes have in common."""

    bl_options = {"REGISTER", "UNDO"}

    def _job(self, context):
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        try:
            return self._new_job(target_objects(context))
        except (NativeError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None

    def execute(self, context):
        try:
            return super().execute(context)
        except ShapeError as error:
            return self._refuse(error)

    def _end(self, context):
        try:
            return super()._end(context)
        except ShapeError as error:
            return self._refuse(error)

    def _refuse(self, error):
        self.report({"ERROR"}, f"Koebe UV: {error}")
        return {"CANCELLED"}


def _in_object_mode(cls, context, least):
    if context.mode != "OBJECT":
        cls.poll_message_set("Works in Object Mode, on whole objects")
        return False
    if len(target_objects(context)) < least or context.active_object not in context.selected_objects:
        cls.poll_message_set(
            "Select mesh objects, the active one among them" if least == 1
            else "Select the other surfaces, then the one whose texture it is: it must be the active one"
        )  # fmt: skip
        return False
    return context.active_object.type == "MESH"


class UV_OT_koebe_compare_shapes(_ShapeOperator, bpy.types.Operator):
    """Compute the conformal module of the active object, the fingerprint of its shape by its holes, and how far the
    other selected objects are from it. Changes nothing"""

    bl_idname = "uv.koebe_compare_shapes"
    bl_label = "Koebe Compare Shapes"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        return _in_object_mode(cls, context, 1)

    def _new_job(self, objects):
        return MeasureJob(objects)

    def _finish(self, context, job):
        with transaction() as run:
            shapes = context.window_manager.koebe_shapes
            note_group(run, shapes)
            shapes.source = job.names[0]
            shapes.module.clear()
            for name, value in job.module:
                number = shapes.module.add()
                number.name, number.value = name, value
            shapes.others.clear()
            for one in job.comparisons[1:]:
                entry = shapes.others.add()
                entry.name, entry.measured = one.name, one.distance is not None
                entry.distance = one.distance if entry.measured else 0.0
                entry.message = one.message or ("" if one.converged else "not converged")
            shapes.carried.clear()
            _redraw(context)
            for one in job.comparisons[1:]:
                found = one.message if one.distance is None else f"distance {one.distance:.6g}"
                self.report({"INFO"}, f"{one.name}: {found}")
            if not job.comparisons[0].converged:
                self.report({"WARNING"}, f"{job.names[0]}: not converged")
            if job.failures:
                self.report({"WARNING"}, "Koebe UV: left out. " + few(job.failures))
            return {"FINISHED"}


class UV_OT_koebe_carry_texture(_ShapeOperator, bpy.types.Operator):
    """Give the other selected objects UVs such that the active object's texture fits them too: their holes are laid
    over its holes as well as a conformal map can. The active object must be mapped, and is not changed"""

    bl_idname = "uv.koebe_carry_texture"
    bl_label = "Koebe Carry Texture"

    layer: UniformizeProperties.__annotations__["layer"]
    fit_holes: BoolProperty(
        name="Fit Holes",
        default=False,
        description="Bend the map so that every hole lies exactly on the active object's. Where the shapes differ the "
        "map is not conformal any more. Off: angles are kept, and the holes fit as well as they can",
    )
    material: BoolProperty(
        name="Material",
        default=True,
        description="Objects without a material get the active object's",
    )

    @classmethod
    def poll(cls, context):
        return _in_object_mode(cls, context, 2)

    def _new_job(self, objects):
        return CarryJob(objects, self.layer, self.fit_holes)

    def _finish(self, context, job):
        with transaction() as run:
            job.write(run, self.material)
            done = [one for one in job.carried if one is not None]
            if not done:
                self.report({"ERROR"}, lines("Koebe UV: nothing was carried.", job.failures))
                return {"CANCELLED"}
            shapes = context.window_manager.koebe_shapes
            note_group(run, shapes)
            note_group(run, context.window_manager.koebe_uv)
            shapes.carried.clear()
            for one in done:
                results.record_moved(context, one.name, job.layer, one.shape.island, one)
                entry = shapes.carried.add()
                entry.name, entry.measured, entry.distance, entry.message = one.name, True, one.residual, one.message
            _redraw(context)
            for one in done:
                self.report({"WARNING" if one.message or len(one.flipped) else "INFO"}, _line(one))
            if job.failures:
                self.report({"WARNING"}, "Koebe UV: not carried. " + few(job.failures))
            return {"FINISHED"}


def _line(one):
    """What was carried to one object, and how well it fits."""
    fit = "fitted holes, " if one.fitted else ""
    text = (
        f"{one.name}: holes apart by {100 * one.residual:.2g} % of the texture ({fit}worst {100 * one.largest:.2g} %), "
        f"angle error {one.angle_error:.2f}°, {len(one.flipped)} flips"
    )
    return f"{text}; {one.message}" if one.message else text


def _redraw(context):
    for area in context.screen.areas if context.screen else ():
        area.tag_redraw()


CLASSES = (KoebeModuleNumber, KoebeShape, KoebeShapes, UV_OT_koebe_compare_shapes, UV_OT_koebe_carry_texture)


def register():
    """Register the operators, and hang what they find on the window manager."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.WindowManager.koebe_shapes = PointerProperty(type=KoebeShapes)


def unregister():
    """Undo `register`."""
    del bpy.types.WindowManager.koebe_shapes
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
