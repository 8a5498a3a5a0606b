# SPDX-License-Identifier: GPL-3.0-or-later
"""The presets that come with the add-on: a row each. Options that a row does not name get their defaults."""

import dataclasses
from typing import Any

LEAST_MARGIN, MARGIN_SHARE = 2, 256  # pixels; of the texture's side: 4 pixels at 1024, and 2 at least


@dataclasses.dataclass(frozen=True)
class Preset:
    """A preset. @param options those that are not the default. The texture's size stays, and `by_size` gives a margin
    that fits it"""

    label: str
    does: str
    options: dict[str, Any]
    by_size: bool = False

    def values(self, pixels: int) -> dict[str, Any]:
        """Options by name, for a texture of this size."""
        margin = {"margin": float(max(LEAST_MARGIN, pixels // MARGIN_SHARE))} if self.by_size else {}
        return {**margin, **self.options, "pixels": pixels}


PRESETS = {
    "LIGHTMAP": Preset(
        "Lightmap",
        "a UV layer of its own for baked light: nothing overlaps, texels are even, and the margin fits Texture Size. "
        "The other layers and the layer that renders stay",
        {"shape": "PARTS", "layer": "Lightmap", "checker": False},
        by_size=True,
    ),
}
