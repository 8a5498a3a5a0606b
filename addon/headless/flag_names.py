# SPDX-License-Identifier: GPL-3.0-or-later
"""Translates names of the panel's buttons and options to words of the command line."""

import re

from ..maps.domain_table import DOMAINS

# Texts of other rooms use the panel's names.
FLAGS = {
    "Unwrap to Parts": "--parts",
    **{domain.button: f"--domain {name}" for name, domain in DOMAINS.items()},
    "Unwrap to Disk": "--domain disk",
    "Tube: Ring": "--tube annulus",
    "Fit: Inside": "--fit inside",
    "Target: Attributes": "--sequence-target attribute",
    "set Balance to Area": "take --balance area",
    "set Even to 0": "take --even 0",
    "set Even above 0": "take --even above 0",
    "Even above 0": "--even above 0",
    "set Holes to Circles": "take --holes circles",
    "choose another layer name": "choose another name with --layer",
    "layer: ": "--layer: ",
}
_NAMES = re.compile("|".join(rf"(?<![\w-]){re.escape(name)}" for name in FLAGS))


def in_flags(text: object) -> str:
    """The text with flags in place of the panel's names."""
    return _NAMES.sub(lambda match: FLAGS[match[0]], str(text))


def flag(name: str) -> str:
    """The flag of an option."""
    return f"--{name.replace('_', '-')}"
