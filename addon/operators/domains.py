# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that map to domains that are no disk: tiles of a flat torus or a cylinder, layouts of a sphere,
surfaces with handles cut open."""

import bpy

from ..blender.targets import target_objects
from ..jobs.domain_job import DomainJob, SchottkyJob, SphereJob
from ..jobs.tile_job import TileJob
from ..state.option_properties import (
    ACCURACY_NAMES,
    RingProperties,
    SchottkyProperties,
    SphereProperties,
    TorusProperties,
    choice_of,
    option_names,
    written_options_of,
)
from .run_operator import MapOperator
from .tooltip import tooltip

JOBS: dict[str, type[DomainJob]] = {
    "torus": TileJob, "ring": TileJob, "sphere": SphereJob, "schottky": SchottkyJob,
}  # fmt: skip


def shown(domain: str) -> tuple[str, ...]:
    """The options of a domain, those last that most runs leave alone."""
    return tuple(sorted(option_names(domain), key=lambda name: name in ACCURACY_NAMES))


class DomainOperator(MapOperator):
    """Mixed into these operators. `domain` is one of maps/domains.py."""

    domain: str

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> DomainJob:
        choice = choice_of(self.domain, self)
        return JOBS[self.domain](target_objects(context), written_options_of(self), choice, selected_only, refused=[])


class UV_OT_koebe_torus(DomainOperator, TorusProperties, bpy.types.Operator):
    """Unwrap a surface with one handle to a tile of a flat torus: angles are kept, holes are round, and a pattern with
    its periods has no seam. The cut is in the UVs alone"""

    bl_idname = "uv.koebe_torus"
    bl_label = "Koebe Unwrap to Torus Tile"
    bl_description = tooltip(__doc__)
    domain = "torus"
    options_shown = shown("torus")


class UV_OT_koebe_ring(DomainOperator, RingProperties, bpy.types.Operator):
    """Unwrap a surface with two rims to a cylinder, unrolled: angles are kept, the rims are straight, and a pattern
    with its period has no seam. The cut is in the UVs alone"""

    bl_idname = "uv.koebe_ring"
    bl_label = "Koebe Unwrap to Cylinder"
    bl_description = tooltip(__doc__)
    domain = "ring"
    options_shown = shown("ring")


class UV_OT_koebe_sphere(DomainOperator, SphereProperties, bpy.types.Operator):
    """Unwrap a surface without handles, closed or with holes, to the sphere and this to UVs: angles are kept on the
    sphere, holes are round caps. The cut is in the UVs alone"""

    bl_idname = "uv.koebe_sphere"
    bl_label = "Koebe Unwrap to Sphere"
    bl_description = tooltip(__doc__)
    domain = "sphere"
    options_shown = shown("sphere")


class UV_OT_koebe_schottky(DomainOperator, SchottkyProperties, bpy.types.Operator):
    """Unwrap a surface with any number of handles, closed or with holes, into the disk: angles are kept, holes are
    round, and both sides of each cut through a handle differ by a Möbius map. The cuts are in the UVs alone"""

    bl_idname = "uv.koebe_schottky"
    bl_label = "Koebe Unwrap Handles"
    bl_description = tooltip(__doc__)
    domain = "schottky"
    options_shown = shown("schottky")


OPERATORS = {
    "torus": UV_OT_koebe_torus, "ring": UV_OT_koebe_ring, "sphere": UV_OT_koebe_sphere,
    "schottky": UV_OT_koebe_schottky,
}  # fmt: skip
register, unregister = bpy.utils.register_classes_factory(tuple(OPERATORS.values()))
