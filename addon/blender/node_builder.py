# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds geometry nodes: each node with its inputs, in a row."""

from typing import Any

import bpy

from . import compat


class NodeBuilder:
    """A new tree of geometry nodes, and ways to fill it. Values are numbers, vectors, texts, or outputs of nodes."""

    def __init__(self, name: str) -> None:
        groups: Any = bpy.data.node_groups
        self.tree: Any = groups.new(name, "GeometryNodeTree")
        self._entry: Any = None

    def modifier_sockets(self) -> None:
        """Give the tree the input and output of a modifier."""
        for side in ("INPUT", "OUTPUT"):
            compat.add_socket(self.tree, side, "Geometry", "Geometry")
        compat.be_modifier(self.tree)

    def input(self, kind: str, name: str, default: Any = None, description: str = "") -> None:
        """Give the tree an input."""
        compat.add_socket(self.tree, "INPUT", kind, name, default, description)

    def given(self, name: str) -> Any:
        """The value of an input of the tree."""
        if self._entry is None:
            self._entry = self.tree.nodes.new("NodeGroupInput")
        return self._entry.outputs[name]

    def node(self, kind: str, output: str | int | None, fed: dict[str | int, Any] | None = None, **values: Any) -> Any:
        """A node's output of that name or number, or None. `fed` holds values or outputs by the name or number of an
        input."""
        return self.outputs(kind, [output], fed, **values)[0]

    def outputs(
        self, kind: str, outputs: list[Any], fed: dict[str | int, Any] | None = None, **values: Any
    ) -> list[Any]:
        """Several outputs of one node, as of `node`."""
        node = self.tree.nodes.new(kind)
        node.location = 180 * len(self.tree.nodes), -120 * (len(self.tree.nodes) % 3)
        for name, value in values.items():
            setattr(node, name, value)
        for key, value in (fed or {}).items():
            socket = node.inputs[key] if isinstance(key, int) else enabled(node.inputs, key)
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            else:
                socket.default_value = value
        return [
            None if one is None else node.outputs[one] if isinstance(one, int) else enabled(node.outputs, one)
            for one in outputs
        ]

    def math(self, operation: str, one: Any, other: Any = 0.0) -> Any:
        """A number computed from two."""
        return self.node("ShaderNodeMath", "Value", {0: one, 1: other}, operation=operation)

    def vector_math(self, operation: str, one: Any, other: Any = (0.0, 0.0, 0.0)) -> Any:
        """A vector computed from two."""
        return self.node("ShaderNodeVectorMath", "Vector", {0: one, 1: other}, operation=operation)

    def scaled(self, vector: Any, by: Any) -> Any:
        """A vector times a number."""
        return self.node("ShaderNodeVectorMath", "Vector", {0: vector, "Scale": by}, operation="SCALE")

    def vector(self, x: Any, y: Any, z: Any = 0.0) -> Any:
        """A vector of three numbers."""
        return self.node("ShaderNodeCombineXYZ", 0, {0: x, 1: y, 2: z})

    def parts(self, vector: Any) -> list[Any]:
        """The three numbers of a vector."""
        return self.outputs("ShaderNodeSeparateXYZ", [0, 1, 2], {0: vector})

    def named(self, name: Any) -> Any:
        """The values of a vector attribute."""
        return self.node("GeometryNodeInputNamedAttribute", "Attribute", {"Name": name}, data_type="FLOAT_VECTOR")


def store_uv(build: NodeBuilder, layer: Any, uv: Any) -> None:
    """Let the tree write UVs into a UV map of its geometry, and end with that. @param layer its name"""
    stored = build.node(
        "GeometryNodeStoreNamedAttribute", "Geometry",
        {"Geometry": build.node("NodeGroupInput", "Geometry"), "Name": layer, "Value": uv},
        data_type=compat.stored_uv_type(), domain="CORNER",
    )  # fmt: skip
    build.node("NodeGroupOutput", None, {0: stored})


def played(build: NodeBuilder, layer: Any, attribute: Any) -> Any:
    """The UVs that an attribute of that name holds, and those of the layer where it has none, or (0, 0)."""
    now = build.named(attribute)
    length = build.node("ShaderNodeVectorMath", "Value", {0: now}, operation="LENGTH")
    is_there = build.node("FunctionNodeCompare", "Result", {0: length, 1: 0.0}, operation="GREATER_THAN")
    return build.node(
        "GeometryNodeSwitch", "Output", {"Switch": is_there, "False": build.named(layer), "True": now},
        input_type="VECTOR",
    )  # fmt: skip


def enabled(sockets: Any, name: str) -> Any:
    """The socket of that name that is in use; others have other data types."""
    return next(socket for socket in sockets if socket.name == name and socket.enabled)


def enabled_inputs(sockets: Any) -> list[Any]:
    """The sockets in use, in order."""
    return [socket for socket in sockets if socket.enabled]
