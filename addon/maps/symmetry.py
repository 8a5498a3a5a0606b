# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes mapped islands exactly symmetric in the same run."""

from types import ModuleType

import numpy as np

from ..layers.circle_domain import DomainError, domain_in
from ..layers.mirror import symmetric
from .disk_outcomes import IslandOutcome

WORSE, NOISE = 1.05, 0.05  # factor on the angle error, plus degrees: the allowed cost of symmetry


def make_symmetric(koebe: ModuleType, one: IslandOutcome) -> None:
    """Make a mapped and placed island exactly symmetric, or note why it does not change."""
    if one.unrolled:
        one.remark = "not made symmetric, as it is unrolled"
        return
    try:
        domain = domain_in(koebe, one.island, one.uv)
        keys = [int(one.island.source_vertex[loop].min()) for loop in one.result.loops[1:]]
        made = symmetric(koebe, domain.numbered(keys))
    except DomainError as error:
        one.remark = f"not made symmetric: {error}"
        return
    report = koebe.distortion(one.island.vertices, one.island.triangles, made.image.uv.astype(np.float64))
    before = one.angle_error
    if report["angle_error_deg"]["mean"] > WORSE * before + NOISE:
        one.remark = (
            f"not made symmetric: the angle error would rise from {before:.2f}° to "
            f"{report['angle_error_deg']['mean']:.2f}°"
        )
        return
    one.symmetry, one.distortion = made, report
