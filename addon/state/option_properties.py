# SPDX-License-Identifier: GPL-3.0-or-later
"""The options as Blender properties: of the operator (redo panel) and of the scene (panel, before the run)."""

import dataclasses
from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..maps.options import CHOICES, Options, OtherDomain, SchottkyChoice, SphereChoice, TileChoice
from . import sequence_properties

DEFAULTS = Options()
DEFAULT_TILE = TileChoice()
DEFAULT_SPHERE = SphereChoice()
DEFAULT_SCHOTTKY = SchottkyChoice()


class UniformizeProperties:
    """What the artist can choose. Mixed into the operator and the scene's settings."""

    method: EnumProperty(
        name="Method",
        items=[
            ("gk", "Generalized Koebe", "Rounds the holes in pairs: fewer steps for the same roundness"),
            ("ck", "Conventional Koebe", "Rounds one hole at a time: the classical iteration, for comparison"),
        ],
        default=DEFAULTS.method,
        description="Iteration that makes the holes round",
    )
    engine: EnumProperty(
        name="Engine",
        items=[
            ("condensed", "Condensed", "Eliminates the surface once and iterates on the holes' boundaries: fast"),
            ("mesh", "Mesh", "Fills the holes with triangles and solves on all of it in every step: slow"),
        ],
        default=DEFAULTS.engine,
        description="How the steps of the iteration are computed. Both give the same map",
    )
    cut: BoolProperty(
        name="Any Mesh",
        default=DEFAULTS.cut,
        description="Open, cut and split in the UVs, by as few edges as can be, what has no map as it is: closed "
        "surfaces, handles, edges with more than two faces, one-sided surfaces, degenerate and double faces. The mesh "
        "stays; the report names the cuts and selects them. Off: such surfaces are refused, what is wrong is selected",
    )
    outer: EnumProperty(
        name="Outer Loop",
        items=[
            ("auto", "Automatic", "Choose the boundary loop that leaves the surface the most even scale"),
            ("longest", "Longest", "The longest boundary loop becomes the outer circle"),
            ("active", "Active Vertex", "The boundary loop of the active vertex becomes the outer circle (Edit Mode)"),
        ],
        default=DEFAULTS.outer,
        description="Boundary loop that becomes the rim of the disk. All others become round holes inside it",
    )
    center: EnumProperty(
        name="Centre",
        items=[
            ("auto", "Automatic", "Where Balance puts it"),
            ("active", "Active Vertex", "The active vertex, which must be inside the surface (Edit Mode)"),
            ("cursor", "3D Cursor", "The vertex inside the surface that is nearest to the 3D cursor"),
        ],
        default=DEFAULTS.center,
        description="Vertex that becomes the centre of the disk, in the place of Balance",
    )
    point: EnumProperty(
        name="Rim Point",
        items=[
            ("auto", "Automatic", "As Upright turns the disk"),
            ("active", "Active Vertex", "The active vertex, which must be on a boundary loop (Edit Mode)"),
            ("cursor", "3D Cursor", "The boundary vertex that is nearest to the 3D cursor"),
        ],
        default=DEFAULTS.point,
        description="Boundary vertex that becomes the right end of the disk; its loop becomes the rim. "
        "In the place of Upright",
    )
    tolerance: FloatProperty(
        name="Tolerance",
        default=DEFAULTS.tolerance,
        min=1e-12,
        max=1e-2,
        precision=8,
        description="Stop when no circle moves by more than this between two sweeps, in units of the disk's radius",
    )
    max_sweeps: IntProperty(
        name="Sweeps",
        default=DEFAULTS.max_sweeps,
        min=1,
        soft_max=200,
        description="Stop after this many sweeps over all holes, and say so if the tolerance was not reached",
    )
    balance: EnumProperty(
        name="Balance",
        items=[
            ("none", "None", "Leave the disk as computed"),
            ("area", "Area", "Move the disk's centre for even texel density. Angles and circles stay exact"),
        ],
        default=DEFAULTS.balance,
        description="Use of the freedom that a conformal map leaves: which point becomes the centre of the disk",
    )
    importance: StringProperty(
        name="Importance",
        default=DEFAULTS.importance,
        description="Vertex group by which Balance is weighed: where its weight is 1 it asks for 4 times the texel "
        "density of where it is 0 (4 to the power of the weight). It only moves the disk's centre: angles and circles "
        "stay exact. Islands with a Centre are not balanced. Empty: all is as important",
    )
    polish: BoolProperty(
        name="Polish",
        default=DEFAULTS.polish,
        description="At the end, lower the angle error once more: points move between the circles and along them, the "
        "circles stay. A tenth less on fine meshes, a quarter on coarse ones; takes one to three times as long as "
        "the map",
    )
    upright: BoolProperty(
        name="Upright",
        default=DEFAULTS.upright,
        description="Turn every island so that the world's up (+Z, or +Y for what lies flat) is up in the UV Editor. "
        "A conformal map leaves the turn of the disk open",
    )
    symmetry: EnumProperty(
        name="Symmetry",
        items=[
            ("off", "Off", "As the map comes out, symmetric up to the triangles"),
            ("auto", "Automatic", "An island that is its own mirror image gets exactly symmetric UVs, about a vertical "
             "line. The plane is found; what is not symmetric stays as it is, and the report says why"),
        ],
        default=DEFAULTS.symmetry,
        description="Exact symmetry of the UVs. Circles stay circles",
    )
    tube: EnumProperty(
        name="Tube",
        items=[
            ("annulus", "Annulus", "A ring, nothing cut: texels get smaller towards the hole, very much on long tubes"),
            ("unroll", "Unrolled", "A rectangle, cut along a short path at the back (in the UVs only): even texels. "
             "Angles stay"),
        ],
        default=DEFAULTS.tube,
        description="What an island with two boundary loops becomes: a sleeve, a limb, a vase without a bottom",
    )
    layer: StringProperty(
        name="UV Layer",
        default=DEFAULTS.layer,
        maxlen=63,
        description="UV layer to write. Made if missing; other layers stay as they are",
    )
    placement: EnumProperty(
        name="Placement",
        items=[
            ("pack", "Per Object", "The islands of each object share the UV square. One island alone fills it"),
            ("together", "Together", "The islands of all objects share one UV square, as on a common texture"),
            ("keep", "In Place", "Every island keeps the position, size and rotation that it has in the UV layer. "
             "If one has none yet, all are packed"),
        ],
        default=DEFAULTS.placement,
        description="Where the islands' disks lie in the UV square",
    )
    margin: FloatProperty(
        name="Margin",
        default=DEFAULTS.margin,
        min=0.0,
        max=0.25,
        description="Space between islands, in units of the UV square",
    )
    most_lost: FloatProperty(
        name="Most Lost",
        default=DEFAULTS.most_lost,
        min=0.0,
        max=1.0,
        precision=3,
        description="Share of the surface's area that may have no area in the UVs, where 32 bits are too few for its "
        "faces. With more of it parts and other domains write nothing; Koebe Uniformize says so first",
    )
    checker: BoolProperty(
        name="Checker",
        default=DEFAULTS.checker,
        description="Show a checker on the surface: its squares stay square where the map is conformal. "
        "The material slots come back when it is taken off",
    )
    checker_size: FloatProperty(
        name="Squares",
        default=DEFAULTS.checker_size,
        min=1.0,
        soft_max=256.0,
        max=4096.0,
        description="Checker squares across the UV square, of the active object if there are several",
    )
    checker_even: BoolProperty(
        name="Even Squares",
        default=DEFAULTS.checker_even,
        description="The squares are equally large on all objects. Off: equally many across each UV square, "
        "so that their size shows the texel density",
    )


OPTION_NAMES = tuple(UniformizeProperties.__annotations__)
ACCURACY_NAMES = ("method", "engine", "tolerance", "max_sweeps", "most_lost")  # which most runs leave alone


def option(name: str) -> Any:
    """The property of that option, for an operator that has the same."""
    return UniformizeProperties.__annotations__[name]


EVENNESS = FloatProperty(
    name="Fewer ↔ More Even",
    default=0.5,
    min=0.0,
    max=1.0,
    subtype="FACTOR",
    description="0: as few parts as can be. 1: texels as even as can be, with more parts and longer cuts",
)


SEAMS = EnumProperty(
    name="Seams",
    items=[
        ("add", "Keep and Add", "Cut along the seams, and further where that makes the texels more even"),
        ("only", "Only These", "Cut along the seams alone: no further cut but what handles and closed surfaces need"),
    ],
    default="add",
    description="What the seams of the mesh are to the cuts. A tube with a seam along it is unrolled there",
)

WRITE_SEAMS = BoolProperty(
    name="Write Seams",
    default=False,
    description="Mark the cuts as seams of the mesh, to be edited by hand and taken up by the next run. "
    "Off: the mesh itself stays as it is",
)


class PartsProperties:
    """What the artist can choose of a surface that is cut into parts, beside the options of all maps that it has."""

    evenness: EVENNESS
    seams: SEAMS
    write_seams: WRITE_SEAMS
    most_lost: option("most_lost")
    layer: option("layer")
    checker: option("checker")
    checker_size: option("checker_size")
    checker_even: option("checker_even")


PART_OPTION_NAMES = tuple(PartsProperties.__annotations__)
WRITTEN_NAMES = ("layer", "checker", "checker_size", "checker_even")  # which all maps have


FIT = EnumProperty(
    name="Fit",
    items=[
        ("inside", "Inside", "As large as it fits the UV square. Angles are kept"),
        ("period", "Period 1", "Its first period is exactly 1 along U, so that an image that repeats meets itself "
         "there. Angles are kept; it may be larger than the UV square"),
        ("square", "Unit Square", "Its periods are exactly 1 along U and 1 along V, of a cylinder its height is 1: a "
         "square image that repeats fits all round. Stretched for it: angles are not kept"),
    ],
    default=DEFAULT_TILE.fit,
    description="How large the tile is in the UVs",
)

HOLES = EnumProperty(
    name="Holes",
    items=[
        ("circles", "Circles", "The other holes are circles of the round annulus whose unrolled image the cylinder is"),
        ("concentric", "Slits Round", "The other holes become slits round the cylinder, along U"),
        ("radial", "Slits Along", "The other holes become slits along the cylinder, along V"),
    ],
    default=DEFAULT_TILE.holes,
    description="What becomes of the loops that are no rims of the cylinder",
)

RIMS = EnumProperty(
    name="Rims",
    items=[
        ("auto", "Automatic", "The two longest loops. In Edit Mode with vertices selected and no face: the two loops "
         "that the selection touches"),
        ("selected", "Selected", "The two loops that have selected vertices, of all of the surface (Edit Mode)"),
    ],
    default=DEFAULT_TILE.rims,
    description="The two boundary loops that become the ends of the cylinder. The lower one is where V is 0",
)


LAYOUT = EnumProperty(
    name="Layout",
    items=[
        ("equirectangular", "Longitudes", "U runs once round the sphere, V from pole to pole, as in images of "
         "skies and worlds. Faces over the cut go on beyond U = 1, where the image repeats"),
        ("octahedral", "Octahedron", "The upper half is the middle of the UV square, the lower one is folded out into "
         "its corners: texels are more even. Faces over the cut go on beyond the square"),
    ],
    default=DEFAULT_SPHERE.layout,
    description="How the sphere is laid out as UVs",
)


ADD_SPHERE = BoolProperty(
    name="Add the Sphere",
    default=DEFAULT_SPHERE.add_sphere,
    description="Add the sphere itself as an object beside its source: the same faces, UVs and materials, and as large "
    "in area",
)


NORMALIZATION = EnumProperty(
    name="Normalization",
    items=[
        ("area", "Even Texels", "The map whose texels are the most even"),
        ("circles", "Equal Circles", "The map that leaves the most room to the circles along which the UVs are cut, "
         "both of each handle equally large"),
    ],
    default=DEFAULT_SCHOTTKY.normalization,
    description="Which of the maps of a surface with holes: they differ by a Möbius map of the disk. Without holes it "
    "makes no difference",
)


class DomainProperties:
    """What the artist can choose of other domains, of the options of all maps."""

    tolerance: option("tolerance")
    max_sweeps: option("max_sweeps")
    most_lost: option("most_lost")
    layer: option("layer")
    checker: option("checker")
    checker_size: option("checker_size")
    checker_even: option("checker_even")


class SphereProperties(DomainProperties):
    """What the artist can choose of a sphere."""

    layout: LAYOUT
    add_sphere: ADD_SPHERE


class SchottkyProperties(DomainProperties):
    """What the artist can choose of a surface with handles that are cut open."""

    normalization: NORMALIZATION


class TorusProperties(DomainProperties):
    """What the artist can choose of a torus tile."""

    fit: FIT


class RingProperties(TorusProperties):
    """The same of a cylinder."""

    holes: HOLES
    rims: RIMS


class SequenceProperties:
    """What the artist can choose of a sequence."""

    source: sequence_properties.SOURCE
    frame_start: sequence_properties.FRAME_START
    frame_end: sequence_properties.FRAME_END
    frame_step: sequence_properties.FRAME_STEP
    target: sequence_properties.TARGET
    play: sequence_properties.PLAY
    layer: option("layer")
    cut: option("cut")
    outer: option("outer")
    center: option("center")
    point: option("point")
    balance: option("balance")
    importance: option("importance")
    upright: option("upright")
    polish: option("polish")
    margin: option("margin")
    most_lost: option("most_lost")
    method: option("method")
    tolerance: option("tolerance")
    max_sweeps: option("max_sweeps")


SEQUENCE_OPTION_NAMES = tuple(SequenceProperties.__annotations__)
SEQUENCE_MAP_NAMES = tuple(name for name in SEQUENCE_OPTION_NAMES if name in OPTION_NAMES)
TORUS_OPTION_NAMES = (*TorusProperties.__annotations__, *DomainProperties.__annotations__)
RING_OPTION_NAMES = (*RingProperties.__annotations__, *TORUS_OPTION_NAMES)
SPHERE_OPTION_NAMES = (*SphereProperties.__annotations__, *DomainProperties.__annotations__)
SCHOTTKY_OPTION_NAMES = (*SchottkyProperties.__annotations__, *DomainProperties.__annotations__)
DOMAIN_OPTION_NAMES = {
    "torus": TORUS_OPTION_NAMES, "ring": RING_OPTION_NAMES, "sphere": SPHERE_OPTION_NAMES,
    "schottky": SCHOTTKY_OPTION_NAMES,
}  # fmt: skip


def domain_option_names(domain: str) -> tuple[str, ...]:
    """The options of the operator of a domain."""
    return DOMAIN_OPTION_NAMES[domain]


class KoebeSettings(UniformizeProperties, bpy.types.PropertyGroup):
    """The scene's settings, shown in the panel."""

    evenness: EVENNESS
    seams: SEAMS
    write_seams: WRITE_SEAMS
    fit: FIT
    holes: HOLES
    rims: RIMS
    layout: LAYOUT
    add_sphere: ADD_SPHERE
    normalization: NORMALIZATION
    source: sequence_properties.SOURCE
    scene_range: sequence_properties.SCENE_RANGE
    frame_start: sequence_properties.FRAME_START
    frame_end: sequence_properties.FRAME_END
    frame_step: sequence_properties.FRAME_STEP
    target: sequence_properties.TARGET
    play: sequence_properties.PLAY


SEQUENCE_SETTINGS = ("source", "scene_range", "frame_start", "frame_end", "frame_step", "target", "play")
SETTING_NAMES = tuple(
    dict.fromkeys(
        (
            *OPTION_NAMES, *PART_OPTION_NAMES, *RING_OPTION_NAMES, *SPHERE_OPTION_NAMES, *SCHOTTKY_OPTION_NAMES,
            *SEQUENCE_SETTINGS,
        )
    )
)  # fmt: skip


def settings_of(context: bpy.types.Context) -> KoebeSettings:
    """The scene's settings."""
    return context.scene.koebe_uv


def copy_options(source: Any, target: Any) -> None:
    """Set the options of the operator's properties from the settings, or the other way round."""
    for name in OPTION_NAMES:
        setattr(target, name, getattr(source, name))


def copy_part_options(source: Any, target: Any) -> None:
    """Set the options of the operator that cuts into parts from the settings."""
    for name in PART_OPTION_NAMES:
        setattr(target, name, getattr(source, name))


def copy_domain_options(source: Any, target: Any, domain: str) -> None:
    """Set the options of the operator of a domain from the settings."""
    for name in domain_option_names(domain):
        setattr(target, name, getattr(source, name))


def copy_sequence_options(source: Any, target: Any) -> None:
    """Set the options of the operator that maps a sequence from the settings."""
    for name in SEQUENCE_OPTION_NAMES:
        if name not in sequence_properties.RANGE_NAMES or not source.scene_range:
            setattr(target, name, getattr(source, name))


def sequence_options_of(properties: Any) -> Options:
    """The `Options` of the operator that maps a sequence. Raises OptionError."""
    values = {name: getattr(properties, name) for name in SEQUENCE_MAP_NAMES}
    return Options(**values, placement="pack", checker=False)


def domain_choice_of(domain: str, properties: Any) -> OtherDomain:
    """The choice of the operator of a domain. Raises OptionError."""
    kind = CHOICES[domain]
    known = {field.name for field in dataclasses.fields(kind)}.intersection(domain_option_names(domain))
    values = {name: getattr(properties, name) for name in known}
    return TileChoice(domain, **values) if kind is TileChoice else kind(**values)


def written_options_of(properties: Any) -> Options:
    """The `Options` of what an operator writes: its layer and checker. Raises OptionError."""
    return Options(**{name: getattr(properties, name) for name in WRITTEN_NAMES})


def options_of(properties: UniformizeProperties) -> Options:
    """The `Options` of a property group. Raises OptionError."""
    return Options(**{name: getattr(properties, name) for name in OPTION_NAMES})


def register() -> None:
    """Register the settings and hang them on the scene."""
    bpy.utils.register_class(KoebeSettings)
    bpy.types.Scene.koebe_uv = PointerProperty(type=KoebeSettings)


def unregister() -> None:
    """Undo `register`."""
    del bpy.types.Scene.koebe_uv
    bpy.utils.unregister_class(KoebeSettings)
