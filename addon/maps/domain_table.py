# SPDX-License-Identifier: GPL-3.0-or-later
"""The domains beside the disk, by their names, in the order of the panel. A new kind of map is a row here."""

from .handles import SCHOTTKY
from .spheres import SPHERE
from .tiles import RING, TORUS

DOMAINS = {domain.name: domain for domain in (TORUS, RING, SPHERE, SCHOTTKY)}
