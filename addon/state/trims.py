# SPDX-License-Identifier: GPL-3.0-or-later
"""The trim sheet of the scene: named rectangles of the UV plane."""

from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty, CollectionProperty, FloatVectorProperty, IntProperty, StringProperty

from .registering import added_to


class KoebeTrim(bpy.types.PropertyGroup):
    """A rectangle of the trim sheet."""

    name: StringProperty(name="Name", default="Trim", description="Name of the rectangle on the trim sheet")
    lower: FloatVectorProperty(
        name="Lower Left", size=2, precision=4, step=1, description="Lower left corner of the rectangle in the UVs"
    )
    upper: FloatVectorProperty(
        name="Upper Right", size=2, precision=4, step=1, default=(1.0, 1.0),
        description="Upper right corner of the rectangle in the UVs",
    )  # fmt: skip


class KoebeTrims(bpy.types.PropertyGroup):
    """The trim sheet. The active rectangle is the one that is chosen in the list."""

    items: CollectionProperty(type=KoebeTrim)
    active: IntProperty(description="Number of the rectangle that is chosen in the list")
    shown: BoolProperty(
        name="Show Trims", default=True, description="Draw the rectangles of the trim sheet in the UV Editor"
    )


def trims_of(context: bpy.types.Context) -> KoebeTrims:
    """The scene's trim sheet."""
    return context.scene.koebe_trims


def active_trim(trims: KoebeTrims) -> KoebeTrim | None:
    """The rectangle that is chosen in the list."""
    return trims.items[trims.active] if 0 <= trims.active < len(trims.items) else None


def rectangles(trims: KoebeTrims, name: str = "") -> np.ndarray:
    """Left, bottom, right and top (r, 4) of the rectangles of a name, or of all. Corners may be in any order."""
    items: Any = [item for item in trims.items if not name or item.name == name]
    found = [[*map(min, item.lower, item.upper), *map(max, item.lower, item.upper)] for item in items]
    return np.array(found, dtype=np.float64).reshape(-1, 4)


register, unregister = added_to(bpy.types.Scene, "koebe_trims", KoebeTrim, KoebeTrims)
