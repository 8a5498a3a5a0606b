# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that map to other domains than the disk: tiles of a flat torus or a cylinder, layouts of a sphere,
surfaces with handles cut open."""

import bpy

from ..blender.targets import target_objects
from ..jobs.domain_job import DomainJob
from ..jobs.job_of_domain import job_type
from ..maps.domain import Domain
from ..maps.handles import SCHOTTKY
from ..maps.spheres import SPHERE
from ..maps.tiles import RING, TORUS
from ..state.option_properties import ACCURACY_NAMES, choice_of, mixin, option_names, written_options_of
from .run_operator import MapOperator


def shown(domain: str) -> tuple[str, ...]:
    """A domain's options, with those that most runs do not change at the end."""
    return tuple(sorted(option_names(domain), key=lambda name: name in ACCURACY_NAMES))


class DomainOperator(MapOperator):
    """Mixin of these operators. `domain` is a row of maps/domain_table.py."""

    domain: Domain

    def __init_subclass__(cls) -> None:
        cls.bl_idname = f"uv.koebe_{cls.domain.name}"
        cls.bl_label = f"Koebe {cls.domain.button}"
        cls.__doc__ = cls.domain.tooltip
        cls.options_shown = shown(cls.domain.name)

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> DomainJob:
        choice = choice_of(self.domain.name, self)
        return job_type(choice)(target_objects(context), written_options_of(self), choice, selected_only, refused=[])


class UV_OT_koebe_torus(DomainOperator, mixin("TorusProperties", option_names("torus")), bpy.types.Operator):
    domain = TORUS


class UV_OT_koebe_ring(DomainOperator, mixin("RingProperties", option_names("ring")), bpy.types.Operator):
    domain = RING


class UV_OT_koebe_sphere(DomainOperator, mixin("SphereProperties", option_names("sphere")), bpy.types.Operator):
    domain = SPHERE


class UV_OT_koebe_schottky(DomainOperator, mixin("SchottkyProperties", option_names("schottky")), bpy.types.Operator):
    domain = SCHOTTKY


OPERATORS = {
    operator.domain.name: operator for operator in (
        UV_OT_koebe_torus, UV_OT_koebe_ring, UV_OT_koebe_sphere, UV_OT_koebe_schottky)
}  # fmt: skip
