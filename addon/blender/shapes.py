# SPDX-License-Identifier: GPL-3.0-or-later
"""The shapes of a mesh: in frames, with modifiers, drivers and animation, and its shape keys."""

import dataclasses
from collections.abc import Generator, Sequence
from typing import Any

import bpy
import numpy as np

from ..maps.options import label_of
from ..surfaces.surface import Surface
from . import compat, edit_mode
from .errors import TransferError
from .mesh_object import MeshObject
from .targets import GONE, check_mesh
from .transaction import transaction


@dataclasses.dataclass(frozen=True)
class MeshShape:
    """A shape of a mesh.

    shape             its frame, or the name of its key
    local             (V, 3) in the object's space, in 32 bits
    to_world          (3, 3)
    triangle_corners  as in `Surface`, by Blender's triangulation of this shape; None if not requested
    """

    shape: str | int
    local: np.ndarray
    to_world: np.ndarray
    triangle_corners: np.ndarray | None = None

    @property
    def label(self) -> str:
        """Its name in messages."""
        return label_of(self.shape)

    @property
    def positions(self) -> np.ndarray:
        """Positions (V, 3) as in `read_surface`."""
        positions = self.local.astype(np.float64)
        if np.array_equal(self.to_world, np.eye(3)):
            return positions
        return np.einsum("ij,kj->ik", positions, self.to_world)


def key_names(obj: MeshObject) -> list[str]:
    """The shape keys, the basis first. Raises TransferError without one."""
    keys = obj.data.shape_keys
    if keys is None or not len(keys.key_blocks):
        raise TransferError(f"{obj.name}: it has no shape keys")
    basis = keys.reference_key.name
    return [basis, *(block.name for block in keys.key_blocks if block.name != basis)]


def key_shapes(obj: MeshObject, names: Sequence[str]) -> list[MeshShape]:
    """The shape keys of these names, each at value 1 on the key that it is relative to. In Edit Mode as in
    `read_surface`."""
    keys, to_world = obj.data.shape_keys, _rotation(obj)
    return [MeshShape(name, compat.read(keys.key_blocks[name].data, "co", np.float32, 3), to_world) for name in names]


def frame_shapes(
    context: bpy.types.Context, obj: MeshObject, surface: Surface, frames: Sequence[int]
) -> Generator[MeshShape, None, None]:
    """The shapes in these frames. When it ends, or is closed, the scene is in its former frame.

    Blender must leave Edit Mode for this, and returns. Raises TransferError, which names the frame, if a modifier makes
    other faces than the `surface` that was read.
    """
    name, scene = obj.name, context.scene
    before = scene.frame_current, scene.frame_subframe
    with transaction() as run:
        run.before_write(_set_frame, scene, *before)
        back = edit_mode.leave(run, context)
        for number, frame in enumerate(frames):
            scene.frame_set(frame)
            found = bpy.data.objects.get((name, None))
            if found is None or found.type != "MESH":
                raise TransferError(f"{name}: {GONE}")
            yield _evaluated(context, found, surface, frame, with_triangles=number == 0)
        if back is not None:
            back()
        _set_frame(scene, *before)


def check_frames(context: bpy.types.Context, obj: MeshObject) -> None:
    """Raise TransferError unless Blender evaluates the object."""
    check_mesh(obj)
    if not obj.visible_get(view_layer=context.view_layer):
        raise TransferError(
            f"{obj.name}: it is hidden, so Blender does not animate it: show it first"
        )


def deformed_surface(context: bpy.types.Context, obj: MeshObject, surface: Surface) -> Surface:
    """The surface that was just read, in the shape that modifiers and shape keys give it now.

    In Edit Mode only modifiers count that are shown there. Raises TransferError, as `check_frames` and `frame_shapes`.
    """
    check_frames(context, obj)
    shape = _evaluated(context, obj, surface, context.scene.frame_current, with_triangles=True)
    assert shape.triangle_corners is not None
    return dataclasses.replace(surface, positions=shape.positions, triangle_corners=shape.triangle_corners)


def _set_frame(scene: Any, frame: int, subframe: float) -> None:
    scene.frame_set(frame, subframe=subframe)


def _rotation(obj: bpy.types.Object) -> np.ndarray:
    return np.array(obj.matrix_world, dtype=np.float64)[:3, :3]


def _evaluated(
    context: bpy.types.Context, obj: MeshObject, surface: Surface, frame: int, with_triangles: bool
) -> MeshShape:
    evaluated = obj.evaluated_get(context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        if not _same_faces(mesh, surface):
            making = ", ".join(repr(one.name) for one in obj.modifiers if one.show_viewport)
            raise TransferError(
                f"{obj.name}: in {label_of(frame)} it has other faces than its mesh (modifiers: {making or 'none'}): "
                "turn off in the viewport each modifier that adds, removes or joins faces"
            )
        corners = None
        if with_triangles:
            mesh.calc_loop_triangles()
            corners = compat.read_indices(mesh.loop_triangles, "loops", 3)
        return MeshShape(frame, compat.vertex_positions(mesh), _rotation(evaluated), corners)
    finally:
        evaluated.to_mesh_clear()


def _same_faces(mesh: bpy.types.Mesh, surface: Surface) -> bool:
    if (len(mesh.vertices), len(mesh.loops), len(mesh.polygons)) != (
        len(surface.positions), len(surface.corner_vertex), len(surface.face_start),
    ):  # fmt: skip
        return False
    vertex, _ = compat.corner_indices(mesh)
    starts = compat.read_indices(mesh.polygons, "loop_start")
    return np.array_equal(vertex, surface.corner_vertex) and np.array_equal(starts, surface.face_start)
