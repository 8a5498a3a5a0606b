# SPDX-License-Identifier: GPL-3.0-or-later
"""The modifier that plays a sequence: nodes that copy the current frame's vector attribute into a UV layer."""

from typing import Any

import bpy

from .mesh_object import MeshObject
from .node_builder import NodeBuilder, enabled, played, store_uv
from .transaction import Transaction

NAME = "Koebe Sequence"  # of the modifier and its nodes
STORE = "GeometryNodeStoreNamedAttribute"
DIGITS = 4  # of a frame in an attribute's name, padded with zeros; a minus counts
LAYER, PREFIX, FRAMES = "koebe_layer", "koebe_prefix", "koebe_frames"  # what the nodes play, in their properties


def put_on(run: Transaction, obj: MeshObject, layer: str, prefix: str, frames: range) -> None:
    """Make the object show in each frame the UVs of the attribute named `prefix` plus the frame.

    Outside the frames the first or last frame's UVs stay. Where an attribute is (0, 0), the layer's UVs stay.
    """
    old = _own(obj)
    groups = {group.name for group in bpy.data.node_groups if group.library is None}
    names = [one.name for one in obj.modifiers]
    kept = (old.name, old.node_group, old.show_viewport, old.show_render) if old else None
    run.before_write(_restore, obj, names, groups, kept)
    nodes = _nodes(layer, prefix, frames)
    nodes[LAYER], nodes[PREFIX], nodes[FRAMES] = layer, prefix, [frames[0], frames[-1], frames.step]
    modifier: Any = old or obj.modifiers.new(NAME, "NODES")
    modifier.node_group = nodes
    modifier.show_viewport = modifier.show_render = True


def frame_shown(obj: MeshObject, layer: str, now: int) -> int | None:
    """The frame whose UVs the modifier shows in that layer at the scene's frame `now`, or None if it shows none."""
    own = _own(obj)
    if own is None or not own.show_viewport or own.node_group.get(LAYER) != layer:
        return None
    first, last, step = own.node_group[FRAMES]
    return int(min(max(first + (now - first) // step * step, first), last))


def attribute_shown(obj: MeshObject, layer: str, now: int) -> str | None:
    """The name of the attribute with these UVs, if the mesh has it."""
    frame = frame_shown(obj, layer, now)
    if frame is None:
        return None
    own = _own(obj)
    name = f"{own.node_group[PREFIX]}{frame:0{DIGITS}d}"
    return name if name in obj.data.attributes else None


def shown_instead(obj: MeshObject, layer: str) -> str | None:
    """The message if a modifier of an earlier run shows its own UVs in place of that layer's, or None."""
    own = _own(obj)
    stores = own.node_group.nodes if own is not None and (own.show_viewport or own.show_render) else ()
    for node in stores:
        if node.bl_idname == STORE and enabled(node.inputs, "Name").default_value == layer:
            return f"its modifier {own.name!r} hides this map: it plays a sequence. Remove the modifier to see this map"
    return None


def _own(obj: MeshObject) -> Any:
    """The modifier of an earlier run, or None."""
    for one in obj.modifiers:
        if one.type == "NODES" and one.node_group is not None and one.node_group.name.startswith(NAME):
            return one
    return None


def _restore(obj: MeshObject, names: list[str], groups: set[str], old: tuple[Any, ...] | None) -> None:
    for added in [one for one in obj.modifiers if one.name not in names]:
        obj.modifiers.remove(added)
    if old is not None and old[0] in obj.modifiers:
        before: Any = obj.modifiers[old[0]]
        _, before.node_group, before.show_viewport, before.show_render = old
    for made in [one for one in bpy.data.node_groups if one.library is None and one.name not in groups]:
        bpy.data.node_groups.remove(made)


def _nodes(layer: str, prefix: str, frames: range) -> Any:
    build = NodeBuilder(NAME)
    build.modifier_sockets()
    store_uv(build, layer, played(build, layer, _attribute_name(build, prefix, frames)))
    return build.tree


def _attribute_name(build: NodeBuilder, prefix: str, frames: range) -> Any:
    """The attribute's name for the scene's frame, as in Python: `prefix` and f"{frame:04d}"."""
    first, step, last = float(frames[0]), float(frames.step), float(len(frames) - 1)
    scene = build.node("GeometryNodeInputSceneTime", "Frame")
    number = build.math("FLOOR", build.math("DIVIDE", build.math("SUBTRACT", scene, first), step))
    number = build.math("MINIMUM", build.math("MAXIMUM", number, 0.0), last)
    frame = build.math("ADD", build.math("MULTIPLY", number, step), first)
    is_negative = build.math("LESS_THAN", frame, 0.0)
    digits = build.node("FunctionNodeValueToString", "String", {"Value": build.math("ABSOLUTE", frame)})
    length = build.node("FunctionNodeStringLength", "Length", {"String": digits})
    width = build.math("MAXIMUM", length, build.math("SUBTRACT", float(DIGITS), is_negative))
    zeros = "0" * (DIGITS - 1)
    position = build.math("SUBTRACT", build.math("ADD", length, float(len(zeros))), width)
    padded = build.node(
        "FunctionNodeSliceString", "String",
        {"String": _replaced(build, f"{zeros}#", "#", digits), "Position": position, "Length": width},
    )  # fmt: skip
    mark = next(chr(code) for code in range(ord("#"), ord("~")) if chr(code) not in prefix)  # at most 63 bytes
    pattern = build.node(
        "GeometryNodeSwitch", "Output", {"Switch": is_negative, "False": f"{prefix}{mark}", "True": f"{prefix}-{mark}"},
        input_type="STRING",
    )  # fmt: skip
    return _replaced(build, pattern, mark, padded)


def _replaced(build: NodeBuilder, text: Any, mark: str, by: Any) -> Any:
    """A text with a mark replaced by another text."""
    return build.node("FunctionNodeReplaceString", "String", {"String": text, "Find": mark, "Replace": by})
