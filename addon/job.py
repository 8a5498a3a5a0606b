# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects: read, map, write. The operator and the batch script share it.

`Job.compute` touches no Blender data and may run on any thread; everything else belongs to the main one.
"""

import dataclasses

from . import checker, compat, distortion_display, native, transfer
from .pipeline import Task, map_surfaces


class Job:
    """Maps the surfaces of some mesh objects. Objects that share a mesh count once."""

    def __init__(self, objects, options, selected_only=False):
        """Read the objects. Raises NativeError, or TransferError if one could not be written later."""
        self.koebe = native.load()
        self.options = options
        self.objects, self.tasks = [], []
        for obj in objects:
            if all(obj.data is not other.data for other in self.objects):
                self._add(obj, selected_only)
        if not self.objects:
            raise transfer.TransferError(
                "no faces are selected" if selected_only else "there is no mesh with faces"
            )
        if options.outer == "active" and all(task.outer == "auto" for task in self.tasks):
            raise transfer.TransferError(
                "the outer loop is to be that of the active vertex, but no vertex is active: "
                "select one on the loop, in Edit Mode"
            )
        self.cancel_token = self.koebe.CancelToken()
        self.outcomes = None

    def _add(self, obj, selected_only):
        surface = transfer.read_surface(obj, selected_only)
        if not surface.selected.any():
            return
        transfer.check_writable(obj, surface, self.options.layer)
        outer = self.options.outer
        if outer == "active":
            vertex = transfer.active_vertex(obj)
            outer = "auto" if vertex is None else vertex
        self.objects.append(obj)
        mirrored, pinned = obj.matrix_world.determinant() < 0.0, transfer.has_pins(obj, self.options.layer)
        self.tasks.append(Task(obj.name, surface, outer, mirrored, pinned))

    def compute(self, progress=None):
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        self.outcomes = map_surfaces(self.koebe, self.tasks, self.options, progress, self.cancel_token)

    def read_old_uv(self):
        """Note where the islands are now, for the placement "keep": call it before anything changes."""
        self.tasks = [
            dataclasses.replace(task, old_uv=transfer.read_uv(obj, self.options.layer))
            for obj, task in zip(self.objects, self.tasks, strict=True)
        ]

    @property
    def mapped_any(self):
        """Whether there is anything to write."""
        return any(outcome.mapped for outcome in self.outcomes)

    def check_writable(self):
        """Raise TransferError if one of the objects can no longer be written."""
        for obj, task in zip(self.objects, self.tasks, strict=True):
            transfer.check_writable(obj, task.surface, self.options.layer)

    @property
    def writable_in_edit_mode(self):
        """Whether `write` can do it there, and faster than by a change of mode."""
        averaged = self.options.checker and self.options.checker_even and len(self.objects) > 1
        colored = any(distortion_display.shown(obj) is not None for obj in self.objects)
        return compat.slow_mode_change() and not (averaged or colored)

    def write(self):
        """Write the UV layer of every object with a mapped island, and put the checker on if asked.

        The objects must not be in Edit Mode, unless `writable_in_edit_mode`; call `check_writable` first.
        """
        for obj, outcome in zip(self.objects, self.outcomes, strict=True):
            if not outcome.mapped:
                continue
            if obj.mode == "EDIT":
                transfer.write_edited_uv(obj, self.options.layer, outcome.task.surface, *outcome.corner_uv())
            else:
                transfer.write_uv(obj, self.options.layer, *outcome.corner_uv())
            kind = distortion_display.shown(obj)
            if kind is not None:
                distortion_display.put_on(obj, self.options.layer, kind)
        if self.options.checker:
            mapped = [obj for obj, outcome in zip(self.objects, self.outcomes, strict=True) if outcome.mapped]
            checker.dress(mapped, self.options.layer, self.options.checker_size, self.options.checker_even)
