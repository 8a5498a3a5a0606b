# SPDX-License-Identifier: GPL-3.0-or-later
"""The job for each domain."""

from ..maps.options import Chosen
from .domain_job import DomainJob, SphereJob
from .ring_job import RingJob

OWN: dict[str, type[DomainJob]] = {"ring": RingJob, "sphere": SphereJob}  # of domains with more than all have


def job_type(choice: Chosen) -> type[DomainJob]:
    """The job for the choice of a domain."""
    return OWN.get(choice.domain.name, DomainJob)
