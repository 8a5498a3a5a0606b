# SPDX-License-Identifier: GPL-3.0-or-later
"""The job for each domain."""

from .domain_job import DomainJob, SchottkyJob, SphereJob
from .tile_job import TileJob

JOBS: dict[str, type[DomainJob]] = {"torus": TileJob, "ring": TileJob, "sphere": SphereJob, "schottky": SchottkyJob}
