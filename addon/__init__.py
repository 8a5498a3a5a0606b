# SPDX-License-Identifier: GPL-3.0-or-later
"""Koebe UV: conformal UV maps of surfaces with holes, holes become circles."""

from types import ModuleType
from typing import Any

bl_info = {
    "name": "Koebe UV",
    "description": "Unwraps any model, in parts or to a disk with round holes",
    "author": "The Koebe UV developers",
    "version": (0, 0, 0),  # filled when the package is built
    "blender": (3, 4, 0),
    "location": "3D View and UV Editor > Sidebar > Koebe; U menu; UV menu",
    "category": "UV",
}


def _parts() -> tuple[ModuleType, ...]:
    """The modules that register something. Imported late, as the rest of the package needs no bpy."""
    from .blender import compat
    from .operators import (
        arrange,
        bake_texture,
        carry_texture,
        checker,
        compare_shapes,
        distortion,
        domains,
        even_slider,
        fill_holes,
        flat_copy,
        hole_rings,
        lift,
        live,
        moebius,
        node_groups,
        option_presets,
        pack,
        parts,
        redo,
        relax_brush,
        render_layer,
        select_from_report,
        sequence,
        sew,
        symmetrize,
        texel_density,
        uniformize,
        unwrap,
    )
    from .state import (
        density_report,
        lift_properties,
        moved_circles,
        option_properties,
        run_report,
        saved_report,
        shape_report,
        trims,
    )
    from .ui import (
        circle_overlay,
        circle_tool,
        cut_sketch,
        distortion_legend,
        menus,
        outline_overlay,
        panels,
        preferences,
        preset_menu,
        progress_bar,
        trim_overlay,
    )

    return (
        compat, option_properties, lift_properties, run_report, saved_report, moved_circles, shape_report,
        density_report, trims,
        unwrap, uniformize, parts, domains, sequence, redo, checker, select_from_report, distortion, fill_holes,
        compare_shapes, carry_texture, option_presets, moebius, symmetrize, pack, sew, live, relax_brush, flat_copy,
        even_slider, render_layer, texel_density, arrange, bake_texture, lift, node_groups, hole_rings,
        distortion_legend, cut_sketch, progress_bar, outline_overlay, trim_overlay, circle_overlay, circle_tool,
        preset_menu, panels, menus, preferences,
    )  # fmt: skip


def _operators(part: ModuleType) -> list[Any]:
    """The operators of a module that says nothing else of how it is registered."""
    if hasattr(part, "register"):
        return []
    return [one for name, one in vars(part).items() if "_OT_" in name and one.__module__ == part.__name__]


def register() -> None:
    """Called by Blender when the add-on is enabled."""
    from bpy.utils import register_class

    for part in _parts():
        for name, operator in vars(part).items():
            if "_OT_" in name:  # Blender would show the line breaks, and cuts off text after 239 letters
                operator.bl_description = " ".join((operator.__doc__ or "").split())
        for operator in _operators(part):
            register_class(operator)
        if hasattr(part, "register"):
            part.register()


def unregister() -> None:
    """Called by Blender when the add-on is disabled."""
    from bpy.utils import unregister_class

    for part in reversed(_parts()):
        if hasattr(part, "unregister"):
            part.unregister()
        for operator in reversed(_operators(part)):
            unregister_class(operator)
