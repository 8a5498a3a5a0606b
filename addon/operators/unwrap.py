# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator of the main button: it unwraps to the shape that is asked for, by the job of that shape's operator."""

from typing import Any

import bpy

from ..blender.targets import target_objects
from ..jobs.auto_job import AutoJob
from ..jobs.map_job import Job
from ..maps.domain import Domain
from ..maps.domain_table import DOMAINS
from ..state.option_properties import UNWRAP_OPTION_NAMES, choice_of, mixin, options_of
from .domains import OPERATORS
from .parts import UV_OT_koebe_parts
from .run_operator import MapOperator
from .uniformize import UV_OT_koebe_uniformize

# By shape: the name of its map, and the rows of the redo panel, eight with the shape itself.
MAPS = {"DISK": "uniformize", "PARTS": "parts", **{domain.shape: name for name, domain in DOMAINS.items()}}
SHAPE_OF = {of: shape for shape, of in MAPS.items()}
ROWS = {
    "AUTO": ("evenness", "keep_angles", "even", "margin", "cut_hard", "seams", "checker"),
    "DISK": ("even", "loops", "outer", "tube", "placement", "checker", "checker_size"),
    "PARTS": ("evenness", "keep_angles", "even", "margin", "cut_hard", "seams", "checker"),
    **{domain.shape: domain.redo for domain in DOMAINS.values()},
}


class UV_OT_koebe_unwrap(MapOperator, mixin("UnwrapProperties", UNWRAP_OPTION_NAMES), bpy.types.Operator):
    """Unwrap the selected objects, or in Edit Mode the selected faces. Automatic makes a disk with round holes if the
    report finds nothing wrong with it, else parts. The mesh is not changed"""

    bl_idname = "uv.koebe_unwrap"
    bl_label = "Koebe Unwrap"

    @property
    def options_shown(self) -> tuple[str, ...]:
        """The rows of the redo panel."""
        return ("shape", *ROWS[self.shape])

    @property
    def domain(self) -> "Domain | None":
        """As of the operators of the other domains."""
        return DOMAINS.get(MAPS[self.shape])

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> Job:
        if self.shape == "AUTO":
            return self._auto_job(context, selected_only)
        operators: dict[str, Any] = {"uniformize": UV_OT_koebe_uniformize, "parts": UV_OT_koebe_parts, **OPERATORS}
        # That operator's job, with the options of this one.
        return operators[MAPS[self.shape]]._new_job(self, context, selected_only)

    def _auto_job(self, context: bpy.types.Context, selected_only: bool) -> AutoJob:
        own: dict[str, Any] = {"cut": False, "even": 0.0 if self.keep_angles else self.even}
        if self.placement == "together":
            own["placement"] = "pack"  # parts have the UV square to themselves
        choice, options = choice_of("parts", self), options_of(self, **own)
        job = AutoJob(target_objects(context), options, choice, selected_only, refused=[])
        if options.placement == "keep":
            job.read_old_uv()
        return job
