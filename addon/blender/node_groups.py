# SPDX-License-Identifier: GPL-3.0-or-later
"""Node groups for Geometry Nodes that bend things onto a mapped surface: makes, finds and removes them as assets."""

from collections.abc import Callable
from typing import Any

import bpy

from . import compat
from .node_builder import NodeBuilder, enabled_inputs, played, store_uv
from .transaction import Transaction

KEY = "koebe_group"  # a custom property with the name under which a group was made
TINY = 1e-20  # an area in the UVs under which the map has no scale
INSIDE = 0.999  # the largest distance of the point that moves to the middle of a disk of radius 1
ROW = 0.75**0.5  # from one row of a triangular lattice to the next


def find_groups() -> dict[str, Any]:
    """The groups that the add-on has made in this file, by the names under which it made them."""
    found: dict[str, Any] = {}
    for group in bpy.data.node_groups:
        if group.library is None and group.bl_idname == "GeometryNodeTree" and str(group.get(KEY)) in GROUPS:
            found.setdefault(str(group[KEY]), group)
    return found


def add_groups(run: Transaction) -> list[str]:
    """Make the groups that are missing, and mark them as assets. Returns their names."""
    run.before_write(_keep_only, set(bpy.data.node_groups.keys()))
    found, made = find_groups(), []
    for name, (build, description) in GROUPS.items():
        if name not in found:
            builder = NodeBuilder(name)
            builder.tree[KEY] = name
            build(builder)
            builder.tree.asset_mark()
            builder.tree.asset_data.description = description
            builder.tree.asset_data.tags.new("Koebe UV")
            made.append(name)
    return made


def remove_groups() -> tuple[list[str], list[str]]:
    """Remove the groups that nothing uses. Returns their names, and the names of those that are used."""
    found = find_groups()
    data: Any = bpy.data
    users = data.user_map(subset=list(found.values()))
    kept: set[str] = set()
    while True:
        free = [name for name in found if name not in kept]
        ours = {found[name] for name in free}
        used = [name for name in free if users[found[name]] - ours]
        if not used:
            break
        kept.update(used)
    bpy.data.batch_remove([found[name] for name in free])
    return free, sorted(kept)


def _keep_only(names: set[str]) -> None:
    for group in [one for one in bpy.data.node_groups if one.name not in names]:
        bpy.data.node_groups.remove(group)


# -------------------------------------------------------------------------------- the surface


class _Place:
    """The place on a surface at a UV: nodes of a tree.

    point, valid  of the surface, and whether there is one
    """

    def __init__(self, build: NodeBuilder, surface: Any, layer: Any, uv: Any) -> None:
        self._build, self._surface, self._layer, self._uv = build, surface, layer, uv
        self.point, self.valid = self._sampled(build.node("GeometryNodeInputPosition", 0), "FLOAT_VECTOR")

    def normal(self) -> Any:
        """The surface's normal there, smooth as between vertices."""
        build = self._build
        smooth = _on_domain(build, build.node("GeometryNodeInputNormal", 0), "FLOAT_VECTOR", "POINT")
        return build.vector_math("NORMALIZE", self._sampled(smooth, "FLOAT_VECTOR")[0])

    def scale(self) -> Any:
        """Length on the surface over length in the UVs."""
        build = self._build
        area, number = build.node("GeometryNodeInputMeshFaceArea", "Area"), build.node("GeometryNodeInputIndex", 0)
        apart = build.node("GeometryNodeSplitEdges", 0, {0: self._surface})
        flat = build.node("GeometryNodeSetPosition", 0, {"Geometry": apart, "Position": build.named(self._layer)})
        below = build.node(
            "GeometryNodeSampleIndex", "Value", {"Geometry": flat, "Value": area, "Index": number},
            data_type="FLOAT", domain="FACE",
        )  # fmt: skip
        ratio = build.math("DIVIDE", area, build.math("MAXIMUM", below, TINY))
        of_face = _on_domain(build, build.math("SQRT", ratio), "FLOAT", "FACE")
        return self._sampled(_on_domain(build, of_face, "FLOAT", "POINT"), "FLOAT")[0]

    def _sampled(self, value: Any, kind: str) -> list[Any]:
        """The surface's value of a field there, and whether there is a place."""
        tree = self._build.tree
        node = tree.nodes.new("GeometryNodeSampleUVSurface")
        node.data_type = kind
        for socket, fed in zip(
            enabled_inputs(node.inputs), (self._surface, value, self._build.named(self._layer), self._uv), strict=True
        ):
            tree.links.new(fed, socket)
        return [socket for socket in node.outputs if socket.enabled]


def _on_domain(build: NodeBuilder, value: Any, kind: str, domain: str) -> Any:
    return build.node("GeometryNodeFieldOnDomain", "Value", {"Value": value}, data_type=kind, domain=domain)


def _without_place(build: NodeBuilder, geometry: Any, place: _Place) -> Any:
    """The geometry without the points that have no place on the surface."""
    no_place = build.node("FunctionNodeBooleanMath", 0, {0: place.valid}, operation="NOT")
    return build.node(
        "GeometryNodeDeleteGeometry", 0, {"Geometry": geometry, "Selection": no_place}, domain="POINT", mode="ALL"
    )


def _object(build: NodeBuilder, name: str) -> Any:
    """The geometry of an object input, where it is in the world."""
    return build.node(
        "GeometryNodeObjectInfo", "Geometry", {"Object": build.given(name)}, transform_space="RELATIVE"
    )


UV_MAP = "UV Map", "Koebe", "Name of the surface's UV map. Its islands must not overlap"


def _lift(build: NodeBuilder) -> None:
    """x and y are a place in the UVs, z is the height above the surface."""
    build.modifier_sockets()
    build.input("Object", "Surface", None, "The mapped surface")
    build.input("String", *UV_MAP)
    build.input("Vector", "Place", (0.0, 0.0, 0.0), "Place in the UVs to which the origin comes")
    build.input("Float", "Size", 1.0, "Length in the UVs of a length of 1 in the geometry")
    build.input("Float", "Height", 1.0, "Factor of the heights")
    build.input("Bool", "In Proportion", False, "Heights grow with the pattern, by the local scale of the map")
    surface, layer, size = _object(build, "Surface"), build.given("UV Map"), build.given("Size")
    whole = build.node("GeometryNodeRealizeInstances", 0, {0: build.given("Geometry")})
    position = build.node("GeometryNodeInputPosition", 0)
    x, y, z = build.parts(position)
    uv = build.vector_math("ADD", build.scaled(build.vector(x, y), size), build.given("Place"))
    place = _Place(build, surface, layer, uv)
    local = build.math("MULTIPLY", place.scale(), size)
    by = build.node(
        "GeometryNodeSwitch", "Output", {"Switch": build.given("In Proportion"), "False": 1.0, "True": local},
        input_type="FLOAT",
    )  # fmt: skip
    height = build.math("MULTIPLY", build.math("MULTIPLY", z, build.given("Height")), by)
    above = build.vector_math("ADD", place.point, build.scaled(place.normal(), height))
    placed = build.node(
        "GeometryNodeSetPosition", 0, {"Geometry": _without_place(build, whole, place), "Position": above}
    )
    build.node("NodeGroupOutput", None, {0: placed})


def _scatter(build: NodeBuilder) -> None:
    """A triangular lattice in the UV square; each instance stands on the surface, and u goes along its x."""
    build.modifier_sockets()
    build.input("Object", "Instance", None, "Object to scatter. A width of 1 fills the distance to the next")
    build.input("String", *UV_MAP)
    build.input("Int", "Count", 20, "Instances along the UV square")
    build.input("Float", "Size", 0.9, "Size of the instances")
    build.input("Bool", "Keep Surface", True, "Show the surface too")
    surface, layer, count = build.given("Geometry"), build.given("UV Map"), build.given("Count")
    count = build.math("MAXIMUM", count, 1.0)
    step = build.math("DIVIDE", 1.0, count)
    rows = build.math("FLOOR", build.math("DIVIDE", count, ROW))
    number = build.node("GeometryNodeInputIndex", 0)
    row = build.math("FLOOR", build.math("DIVIDE", build.math("ADD", number, 0.5), count))
    column = build.math("SUBTRACT", number, build.math("MULTIPLY", row, count))
    shift = build.math("MULTIPLY_ADD", build.math("MODULO", row, 2.0), 0.5)
    shift.node.inputs[2].default_value = 0.25
    u = build.math("MULTIPLY", build.math("ADD", column, shift), step)
    v = build.math("MULTIPLY", build.math("MULTIPLY", build.math("ADD", row, 0.5), step), ROW)
    line = build.node("GeometryNodeMeshLine", 0, {"Count": build.math("MULTIPLY", count, rows)})
    flat = build.node("GeometryNodeSetPosition", 0, {"Geometry": line, "Position": build.vector(u, v)})
    uv = build.node("GeometryNodeInputPosition", 0)
    place = _Place(build, surface, layer, uv)
    there = _without_place(build, flat, place)
    fed: dict[str | int, Any] = {"Object": build.given("Instance"), "As Instance": True}
    instance = build.node("GeometryNodeObjectInfo", "Geometry", fed)
    width = build.math("MULTIPLY", build.math("MULTIPLY", place.scale(), step), build.given("Size"))
    stood = build.node(
        "GeometryNodeInstanceOnPoints", 0,
        {"Points": there, "Instance": instance, "Rotation": _stand(build, place, surface, layer, uv, step),
         "Scale": build.vector(width, width, width)},
    )  # fmt: skip
    placed = build.node("GeometryNodeSetPosition", 0, {"Geometry": stood, "Position": place.point})
    shown = build.node(
        "GeometryNodeSwitch", "Output", {"Switch": build.given("Keep Surface"), "True": surface}, input_type="GEOMETRY"
    )
    joined = build.tree.nodes.new("GeometryNodeJoinGeometry")
    for one in (placed, shown):
        build.tree.links.new(one, joined.inputs[0])
    build.node("NodeGroupOutput", None, {0: joined.outputs[0]})


def _stand(build: NodeBuilder, place: _Place, surface: Any, layer: Any, uv: Any, step: Any) -> Any:
    """The rotation that stands an instance on the surface, with its x along the direction of u."""
    near = build.math("MULTIPLY", step, 0.1)
    ends = []
    for sign in (1.0, -1.0):
        aside = build.vector(build.math("MULTIPLY", near, sign), 0.0)
        beside = _Place(build, surface, layer, build.vector_math("ADD", uv, aside))
        ends.append(build.node(
            "GeometryNodeSwitch", "Output", {"Switch": beside.valid, "False": place.point, "True": beside.point},
            input_type="VECTOR",
        ))  # fmt: skip
    along = build.vector_math("SUBTRACT", *ends)
    upright = _aligned(build, (0.0, 0.0, 0.0), "Z", "AUTO", place.normal())
    return _aligned(build, upright, "X", "Z", along)


def _aligned(build: NodeBuilder, rotation: Any, axis: str, pivot: str, vector: Any) -> Any:
    """A rotation turned until an axis has the direction of a vector."""
    return build.node(
        compat.align_node(), 0, {"Rotation": rotation, "Vector": vector}, axis=axis, pivot_axis=pivot
    )


# -------------------------------------------------------------------------------- circles


DISK_INPUTS = (
    ("Vector", "Centre", (0.0, 0.0, 0.0), "Point that moves to the middle. The rim is the circle of radius 1 round 0"),
    ("Float", "Turn", 0.0, "Turn about the middle afterwards, in radians"),
    ("Vector", "Disk", (0.5, 0.5, 0.0), "Middle of the disk in the UVs"),
    ("Float", "Radius", 0.5, "Radius of the disk in the UVs"),
)
FIELD, CIRCLES, LIFT, SCATTER = "Koebe Moebius", "Koebe Move Circles", "Koebe Bend onto Surface", "Koebe Scatter"
PLAYED = "Koebe UV by Attribute"


def _moebius(build: NodeBuilder) -> None:
    """w = exp(i turn) (z - a) / (1 - conj(a) z), where z and w are places in the unit disk."""
    build.input("Vector", "UV", (0.0, 0.0, 0.0), "Place in the UVs")
    for one in DISK_INPUTS:
        build.input(*one)
    compat.add_socket(build.tree, "OUTPUT", "Vector", "UV")
    disk, radius = build.given("Disk"), build.given("Radius")
    centre = build.given("Centre")
    ax, ay, _ = build.parts(centre)
    # Keep |a| below 1: beyond, the map would turn the disk inside out.
    length = build.node("ShaderNodeVectorMath", "Value", {0: build.vector(ax, ay)}, operation="LENGTH")
    inside = build.math("MINIMUM", build.math("DIVIDE", INSIDE, build.math("MAXIMUM", length, TINY)), 1.0)
    ax, ay = (build.math("MULTIPLY", one, inside) for one in (ax, ay))
    # z = (UV - disk) / radius.
    whole = build.vector_math("SUBTRACT", build.given("UV"), disk)
    x, y, _ = build.parts(build.scaled(whole, build.math("DIVIDE", 1.0, build.math("MAXIMUM", radius, TINY))))
    # (z - a) / (1 - conj(a) z), as numerator times conjugate over a square.
    above = build.math("SUBTRACT", x, ax), build.math("SUBTRACT", y, ay)
    below = (
        build.math("SUBTRACT", 1.0, _dot(build, (ax, ay), (x, y))),
        build.math("SUBTRACT", build.math("MULTIPLY", ay, x), build.math("MULTIPLY", ax, y)),
    )
    length_2 = build.math("MAXIMUM", _dot(build, below, below), TINY)
    real = build.math("DIVIDE", _dot(build, above, below), length_2)
    imaginary = build.math("DIVIDE", _cross(build, below, above), length_2)
    # Times exp(i turn).
    turn = build.given("Turn")
    cos, sin = build.math("COSINE", turn), build.math("SINE", turn)
    turned = build.vector(
        _cross(build, (cos, sin), (imaginary, real)), _dot(build, (sin, cos), (real, imaginary))
    )
    build.node("NodeGroupOutput", None, {0: build.vector_math("ADD", disk, build.scaled(turned, radius))})


def _dot(build: NodeBuilder, one: tuple[Any, Any], other: tuple[Any, Any]) -> Any:
    return build.math("ADD", *(build.math("MULTIPLY", *pair) for pair in zip(one, other, strict=True)))


def _cross(build: NodeBuilder, one: tuple[Any, Any], other: tuple[Any, Any]) -> Any:
    first, second = build.math("MULTIPLY", one[0], other[1]), build.math("MULTIPLY", one[1], other[0])
    return build.math("SUBTRACT", first, second)


def _circles(build: NodeBuilder) -> None:
    """The field on the UVs of the geometry."""
    build.modifier_sockets()
    build.input("String", *UV_MAP)
    for one in DISK_INPUTS:
        build.input(*one)
    layer = build.given("UV Map")
    group = build.tree.nodes.new("GeometryNodeGroup")
    group.node_tree = find_groups()[FIELD]
    build.tree.links.new(build.named(layer), group.inputs["UV"])
    for _, name, *_ in DISK_INPUTS:
        build.tree.links.new(build.given(name), group.inputs[name])
    store_uv(build, layer, group.outputs["UV"])


def _by_attribute(build: NodeBuilder) -> None:
    """The attribute's UVs in the UV map, as far as the factor says."""
    build.modifier_sockets()
    build.input("String", "Attribute", "Koebe_0001", "Name of the attribute with UVs, as Unwrap Sequence makes them")
    build.input("String", "UV Map", "Koebe", "Name of the UV map that shows them")
    build.input("Float", "Factor", 1.0, "0: the UV map as it is. 1: the attribute. Between them the UVs move")
    layer = build.given("UV Map")
    own = build.named(layer)
    way = build.vector_math("SUBTRACT", played(build, layer, build.given("Attribute")), own)
    store_uv(build, layer, build.vector_math("ADD", own, build.scaled(way, build.given("Factor"))))


GROUPS: dict[str, tuple[Callable[[NodeBuilder], None], str]] = {
    LIFT: (_lift, "Bends geometry onto a mapped surface: x and y are a place in the UVs, z is the height"),
    SCATTER: (_scatter, "Scatters instances over a mapped surface, as large as the map is there"),
    FIELD: (_moebius, "A Möbius map of a disk in the UVs: circles stay circles"),
    CIRCLES: (_circles, "Moves the circles of a UV map: drag a point of the disk to the middle, and turn it"),
    PLAYED: (_by_attribute, "Plays UVs that an attribute holds in a UV map, or goes from one to the other"),
}
