# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of Lift Pattern as Blender properties: of the operator (redo panel) and of the scene (panel)."""

import math
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..blender.compat import path_options
from ..maps.lifting import DRAWN, LiftChoice, is_used
from ..maps.option_table import ranges_of
from .option_properties import shown_number

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
SHAPES = [
    ("disk", "Disk", "A surface with holes as a disk with round holes"),
    ("ring", "Cylinder", "A surface with two rims as a cylinder. The pattern goes on over the cut"),
    ("torus", "Torus", "A torus as a tile that repeats both ways. The pattern goes on over the cuts"),
    ("sphere", "Sphere", "A closed surface without handles as a sphere, for circles, Voronoi cells and drawings"),
    ("parts", "Parts", "Any surface without a crowded edge, cut into parts. Outlines that meet a cut are left out"),
]
RANGES = ranges_of("lift")
TURNS: dict[str, Any] = {end: math.radians(degrees) for end, degrees in RANGES["turn"].items()}


def _length(name: str, description: str, **own: Any) -> Any:
    return FloatProperty(name=name, description=description, default=0.0, min=0.0, subtype="DISTANCE", **own)


PROPERTIES = {
    "pattern": EnumProperty(name="Pattern", items=PATTERNS, default="circles", description="The pattern to be lifted"),
    "file": StringProperty(
        name="File", subtype="FILE_PATH", options=path_options(), description="SVG or PNG file with the pattern"
    ),
    "drawing": StringProperty(name="Object", description="Curve object or text object with the pattern"),
    "way": EnumProperty(name="Make", items=WAYS, default="perforate", description="What is made of the outlines"),
    "height": FloatProperty(
        name="Height", default=0.0, subtype="DISTANCE",
        description="Height of the outlines, or of an image's white. Below 0 sinks them. 0: by the size",
    ),
    "size": _length("Size", "From one outline to the next on the surface, or a drawing's width. 0: automatic"),
    "bridge": _length("Bridge", "Width that stays between two outlines, below half of Size. 0: a fifth of Size"),
    "thickness": _length("Thickness", "Makes a closed solid of this thickness. 0: the surface stays a sheet"),
    "shape": EnumProperty(
        name="Shape", items=SHAPES, default="disk", description="Map of the surface in which the pattern is drawn"
    ),
    "even": FloatProperty(
        name="Even", default=0.0, subtype="FACTOR", **RANGES["even"],
        description="0: the pattern keeps its form. 1: it keeps its size",
    ),
    "repeats": IntProperty(
        name="Repeats", default=0, soft_max=200, **RANGES["repeats"],
        description="How often the pattern repeats round the surface. 0: as Size asks for, and a drawing once",
    ),
    "turn": FloatProperty(
        name="Turn", default=0.0, subtype="ANGLE", **TURNS,
        description="Turns a drawing in the map, counter-clockwise",
    ),
    "seed": IntProperty(
        name="Seed", default=1, description="Another seed spreads the outlines anew", **RANGES["seed"]
    ),
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
        if name == "drawing":
            layout.prop_search(options, name, bpy.data, "objects")
        else:
            layout.prop(options, name)


def lift_choice_of(options: Any) -> LiftChoice:
    """The choice of an operator. Its pattern is the name of a file, if the options name a file."""

    def number(name: str) -> Any:
        value = shown_number(getattr(options, name))
        return value if is_used(name, options) else 0

    others = {name: number(name) or None for name in ("bridge", "thickness", "even")}
    others |= {"shape": options.shape, "repeats": number("repeats"), "turn": math.degrees(number("turn"))}
    if is_used("seed", options):
        others["seed"] = options.seed
    pattern = bpy.path.abspath(options.file) if options.pattern in DRAWN else options.pattern
    return LiftChoice(pattern, options.way == "perforate", number("height"), number("size"), options.seams, others)


def register() -> None:
    """Register the settings and add them to the scene."""
    bpy.utils.register_class(KoebeLiftSettings)
    bpy.types.Scene.koebe_lift = PointerProperty(type=KoebeLiftSettings)


def unregister() -> None:
    """The reverse of `register`."""
    del bpy.types.Scene.koebe_lift
    bpy.utils.unregister_class(KoebeLiftSettings)
