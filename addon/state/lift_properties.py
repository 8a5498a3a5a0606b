# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of Patterned Copy as Blender properties: of the operator (redo panel) and of the scene (panel)."""

import math
from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..blender.compat import path_options
from ..maps.lifting import DRAWN, LiftChoice, first_value, is_used
from ..maps.option_table import own_rows
from .option_properties import property_of, shown_number
from .registering import added_to

PATTERNS = [
    ("circles", "Circles", "Circles that are even on the surface"),
    ("voronoi", "Voronoi", "Voronoi cells that are even on the surface"),
    ("hexagons", "Hexagons", "A lattice of hexagons that is even in the map"),
    ("triangles", "Triangles", "A lattice of triangles that is even in the map"),
    ("diamonds", "Diamonds", "A lattice of diamonds that is even in the map"),
    ("stripes", "Stripes", "Stripes that are even in the map"),
    ("truchet", "Quarter Circles", "Tiles of quarter circles, turned at random, that are even in the map"),
    ("file", "File", "The closed paths of an SVG file, or a PNG file whose white is raised"),
    ("object", "Curve or Text", "The closed curves of a curve object or text object of the scene"),
]
WAYS = [
    ("perforate", "Holes", "Cut the outlines out of the surface"),
    ("raise", "Relief", "Raise the outlines along the normals, with upright walls"),
]
OWN = own_rows("lift")

PROPERTIES = {
    "pattern": EnumProperty(name="Pattern", items=PATTERNS, default="circles", description="Pattern on the surface"),
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
AUTOMATIC = ("size", "bridge", "height", "rows", "repeats")  # options whose 0 is automatic
NAMES = 0.4  # of a row's width, as Blender gives to names


def switch(option: str, on: bool, name: str, description: str) -> Any:
    """A switch that is on if an option is 0, or if it is not 0. Blender stores the option alone."""

    def is_on(properties: Any) -> bool:
        return (getattr(properties, option) != 0) == on

    def turn(properties: Any, to: bool) -> None:
        value = first_value(option, properties, area_of(properties)) if to == on else 0
        kind = type(getattr(properties, option))
        setattr(properties, option, kind(value))

    return BoolProperty(name=name, description=description, get=is_on, set=turn, options={"SKIP_SAVE"})


def area_of(properties: Any) -> float:
    """The area that automatic values follow: of the surface that an operator has used, else of the active object."""
    if getattr(properties, "area", 0.0):
        return float(properties.area)
    obj: Any = bpy.context.active_object
    if obj is None or obj.type != "MESH":
        return 1.0
    areas = np.zeros(len(obj.data.polygons))
    obj.data.polygons.foreach_get("area", areas)
    return float(areas.sum()) * abs(obj.matrix_world.determinant()) ** (2 / 3) or 1.0


SWITCHES = {
    "solid": switch("thickness", True, "Solid", "Make a closed solid of a thickness. Off: the surface stays a sheet"),
    **{f"automatic_{name}": switch(name, False, "Automatic", "The value follows the surface. Off: choose it yourself")
       for name in AUTOMATIC},
}  # fmt: skip

LiftProperties: Any = type("LiftProperties", (), {"__annotations__": {**PROPERTIES, **SWITCHES}})


class KoebeLiftSettings(LiftProperties, bpy.types.PropertyGroup):
    """The scene's settings of Patterned Copy, shown in the panel."""


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
        elif name in AUTOMATIC:
            draw_automatic(layout, options, name)
        elif name == "thickness":
            layout.prop(options, "solid")
            if options.thickness:
                layout.prop(options, name)
        elif name == "graded" and active is not None and active.type == "MESH":
            layout.prop_search(options, name, active, "vertex_groups")
        else:
            layout.prop(options, name)


def draw_automatic(layout: bpy.types.UILayout, options: Any, name: str) -> None:
    """Draw an option: the word Automatic, or its value and the button that makes it automatic again."""
    row = layout.row()
    row.use_property_split = False
    split = row.split(factor=NAMES)
    label = split.row()
    label.alignment = "RIGHT"
    label.label(text=OWN[name].blender["label"])
    value, automatic = split.row(align=True), f"automatic_{name}"
    if getattr(options, automatic):
        value.prop(options, automatic, toggle=True)
    else:
        value.prop(options, name, text="")
        value.prop(options, automatic, text="", icon="LOOP_BACK")


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


register, unregister = added_to(bpy.types.Scene, "koebe_lift", KoebeLiftSettings)
