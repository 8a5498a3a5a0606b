# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that map to other domains than the disk: tiles of a flat torus or a cylinder, layouts of a sphere,
surfaces with handles cut open."""

import bpy

from ..blender.targets import target_objects
from ..jobs.domain_job import DomainJob
from ..jobs.domain_jobs import JOBS
from ..maps.domains import DOMAINS
from ..state.option_properties import ACCURACY_NAMES, choice_of, mixin, option_names, written_options_of
from .run_operator import MapOperator
from .tooltip import tooltip


def shown(domain: str) -> tuple[str, ...]:
    """A domain's options, with those that most runs do not change at the end."""
    return tuple(sorted(option_names(domain), key=lambda name: name in ACCURACY_NAMES))


class DomainOperator(MapOperator):
    """Mixin of these operators. `domain` is a name in maps/domains.py."""

    domain: str

    def __init_subclass__(cls) -> None:
        cls.bl_idname = f"uv.koebe_{cls.domain}"
        cls.bl_label = f"Koebe {DOMAINS[cls.domain].button}"
        cls.bl_description = tooltip(cls.__doc__)
        cls.options_shown = shown(cls.domain)

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> DomainJob:
        choice = choice_of(self.domain, self)
        return JOBS[self.domain](target_objects(context), written_options_of(self), choice, selected_only, refused=[])


class UV_OT_koebe_torus(DomainOperator, mixin("TorusProperties", option_names("torus")), bpy.types.Operator):
    """Unwrap a surface with one handle to a tile of a flat torus: angles are kept, holes are round, and a pattern with
    its periods has no seam. The cut is in the UVs alone"""

    domain = "torus"


class UV_OT_koebe_ring(DomainOperator, mixin("RingProperties", option_names("ring")), bpy.types.Operator):
    """Unwrap a surface with two rims to a cylinder, unrolled: angles are kept, the rims are straight, and a pattern
    with its period has no seam. The cut is in the UVs alone"""

    domain = "ring"


class UV_OT_koebe_sphere(DomainOperator, mixin("SphereProperties", option_names("sphere")), bpy.types.Operator):
    """Unwrap a surface without handles, closed or with holes, to the sphere and this to UVs: angles are kept on the
    sphere, holes are round caps. The cut is in the UVs alone"""

    domain = "sphere"


class UV_OT_koebe_schottky(DomainOperator, mixin("SchottkyProperties", option_names("schottky")), bpy.types.Operator):
    """Unwrap a surface with any number of handles, closed or with holes, into the disk: angles are kept, holes are
    round, and both sides of each cut through a handle differ by a Möbius map. The cuts are in the UVs alone"""

    domain = "schottky"


OPERATORS = {
    kind.domain: kind for kind in (UV_OT_koebe_torus, UV_OT_koebe_ring, UV_OT_koebe_sphere, UV_OT_koebe_schottky)
}
register, unregister = bpy.utils.register_classes_factory(tuple(OPERATORS.values()))
