# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of Lift Pattern as Blender properties: of the operator (redo panel) and of the scene (panel)."""

import math
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, PointerProperty, StringProperty

from ..blender.compat import path_options
from ..maps.lifting import DRAWN, LiftChoice, is_used
from ..maps.option_table import own_rows
from .option_properties import property_of, shown_number

PATTERNS = [
    ("circles", "Circles", "Circles that are even on the surface"),
    ("voronoi", "Voronoi", "Voronoi cells that are even on the surface"),
    ("hexagons", "Hexagons", "A lattice of hexagons that is even in the map"),
    ("triangles", "Triangles", "A lattice of triangles that is even in the map"),
    ("diamonds", "Diamonds", "A lattice of diamonds that is even in the map"),
    ("stripes", "Stripes", "Stripes that are even in the map"),
    ("truchet", "Truchet", "Tiles of quarter circles, turned at random, that are even in the map"),
    ("file", "File", "The closed paths of an SVG file, or a PNG file whose white is raised"),
    ("object", "Curve or Text", "The closed curves of a curve object or text object of the scene"),
]
WAYS = [
    ("perforate", "Perforate", "Cut the outlines out of the surface"),
    ("raise", "Relief", "Raise the outlines along the normals, with upright walls"),
]
OWN = own_rows("lift")

PROPERTIES = {
    "pattern": EnumProperty(name="Pattern", items=PATTERNS, default="circles", description="The pattern to be lifted"),
    "file": StringProperty(
        name="File", subtype="FILE_PATH", options=path_options(), description="SVG or PNG file with the pattern"
    ),
    "drawing": StringProperty(name="Object", description="Curve object or text object with the pattern"),
    "way": EnumProperty(name="Make", items=WAYS, default="perforate", description="What is made of the outlines"),
    **{name: property_of(OWN[name]) for name in (
        "height", "size", "graded", "bridge", "rim", "thickness", "shape", "even", "around", "rows", "repeats", "turn",
        "seed",
    )},
    "seams": BoolProperty(name="Cut at Seams", default=False, description="Cut the surface open at its seams first"),
    "hide": BoolProperty(
        name="Hide Original", default=True,
        description="Hide the object, as its surface lies in the same place as the new object's",
    ),
}  # fmt: skip
LIFT_NAMES = tuple(PROPERTIES)
SHOWN = tuple(name for name in LIFT_NAMES if name not in ("seams", "hide"))  # in the redo panel

LiftProperties: Any = type("LiftProperties", (), {"__annotations__": PROPERTIES})


class KoebeLiftSettings(LiftProperties, bpy.types.PropertyGroup):
    """The scene's settings of Lift Pattern, shown in the panel."""


def lift_settings_of(context: bpy.types.Context) -> KoebeLiftSettings:
    """The scene's settings."""
    return context.scene.koebe_lift


def copy_lift_options(source: Any, target: Any) -> None:
    """Copy all options."""
    for name in LIFT_NAMES:
        setattr(target, name, getattr(source, name))


def draw_lift_options(layout: bpy.types.UILayout, options: Any, names: tuple[str, ...]) -> None:
    """Draw a row for each of these options that matters now."""
    for name in names:
        if not is_used(name, options):
            continue
        active = bpy.context.active_object
        if name == "drawing":
            layout.prop_search(options, name, bpy.data, "objects")
        elif name == "graded" and active is not None and active.type == "MESH":
            layout.prop_search(options, name, active, "vertex_groups")
        else:
            layout.prop(options, name)


def lift_choice_of(options: Any) -> LiftChoice:
    """The choice of an operator. Its pattern is the name of a file, if the options name a file."""

    def number(name: str) -> Any:
        value = shown_number(getattr(options, name))
        return value if is_used(name, options) else 0

    others = {name: number(name) or None for name in ("bridge", "thickness", "even")}
    others |= {"shape": options.shape, "turn": math.degrees(number("turn"))}
    if is_used("rim", options):
        others["rim"] = options.rim
    others |= {name: number(name) for name in ("repeats", "rows")}
    if is_used("seed", options):
        others["seed"] = options.seed
    pattern = bpy.path.abspath(options.file) if options.pattern in DRAWN else options.pattern
    cursor = is_used("around", options) and options.around == "cursor"
    lengths, perforate = (number("height"), number("size")), options.way == "perforate"
    graded = options.graded if is_used("graded", options) else ""
    return LiftChoice(pattern, perforate, *lengths, options.seams, cursor, others, graded)


def register() -> None:
    """Register the settings and add them to the scene."""
    bpy.utils.register_class(KoebeLiftSettings)
    bpy.types.Scene.koebe_lift = PointerProperty(type=KoebeLiftSettings)


def unregister() -> None:
    """The reverse of `register`."""
    del bpy.types.Scene.koebe_lift
    bpy.utils.unregister_class(KoebeLiftSettings)
