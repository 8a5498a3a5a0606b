# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects for an operator: whether their meshes can be written, and are still what was read."""

import dataclasses
import traceback
from collections.abc import Iterable
from contextlib import AbstractContextManager

import bpy
import numpy as np

from ..surfaces.errors import KnownError
from .errors import TransferError
from .mesh_object import MeshObject, mesh_objects
from .mesh_reading import bring_up_to_date, read_mark
from .transaction import Transaction

GONE = "it was deleted or renamed during the run"


def target_objects(context: bpy.types.Context) -> list[MeshObject]:
    """The mesh objects in Edit Mode, or else the selected ones; the active one first."""
    objects = context.objects_in_mode_unique_data if context.mode == "EDIT_MESH" else context.selected_objects
    return sorted(mesh_objects(objects), key=lambda obj: obj != context.active_object)


def with_own_meshes(objects: Iterable[MeshObject]) -> list[MeshObject]:
    """The first of the objects for each mesh."""
    first: dict[str, MeshObject] = {}
    for obj in objects:
        first.setdefault(obj.data.name_full, obj)
    return list(first.values())


MAKE_FACES = ("BOOLEAN", "NODES", "REMESH", "SKIN", "WIREFRAME")  # modifiers whose faces are not those of the mesh


def makes_faces(obj: MeshObject) -> bool:
    """Whether modifiers show other faces than the mesh has. Those that play stored UVs do not."""
    shown = [one for one in obj.modifiers if one.show_viewport and one.type in MAKE_FACES]
    groups = [getattr(one, "node_group", None) for one in shown]
    return any(group is None or not group.name.startswith("Koebe ") for group in groups)


def check_readable(obj: MeshObject) -> None:
    """Raise TransferError if the object's mesh is not up to date."""
    mesh = obj.data
    if mesh.is_editmode and obj.mode != "EDIT":
        raise TransferError(f"{obj.name}: another object with the same mesh is in Edit Mode: leave Edit Mode first")
    users = [obj] if mesh.users == 1 else [other for other in bpy.data.objects if other.data == mesh]
    if any(other.mode not in {"OBJECT", "EDIT"} for other in users):
        raise TransferError(f"{obj.name}: its mesh is in a sculpt or paint mode: leave that mode first")


def check_mesh(obj: MeshObject) -> None:
    """Raise TransferError unless the object's mesh can be read and written, and the file keeps it."""
    mesh = obj.data
    if mesh.library is not None:
        raise TransferError(f"{obj.name}: its mesh is linked from another file: make it local first")
    if mesh.override_library is not None:
        raise TransferError(f"{obj.name}: its mesh is a library override, which cannot keep UVs: make it local first")
    check_readable(obj)


@dataclasses.dataclass(frozen=True)
class Target:
    """An object that was read, to be written later. It is found by its name, as it may be gone by then."""

    name: str
    mark: tuple[np.ndarray, ...]

    @classmethod
    def of(cls, obj: MeshObject) -> "Target":
        """A target for this object, whose surface was just read."""
        return cls(obj.name, read_mark(obj))

    @property
    def obj(self) -> MeshObject | None:
        """The object of that name in this file, or None."""
        return bpy.data.objects.get((self.name, None))

    def find(self) -> MeshObject:
        """The object. Raises TransferError if it is gone, has another mesh, or cannot be written any more."""
        obj = self.obj
        if obj is None or obj.type != "MESH":
            raise TransferError(f"{self.name}: {GONE}")
        check_mesh(obj)
        bring_up_to_date(obj)
        if not all(map(_same, read_mark(obj), self.mark)):
            raise TransferError(f"{self.name}: its mesh has changed during the run")
        return obj


def _same(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two arrays are equal, bit for bit: a NaN equals itself."""
    return one.shape == other.shape and bool((one.view(np.int32) == other.view(np.int32)).all())


def attempt(run: Transaction, name: str, problems: list[str]) -> AbstractContextManager[None]:
    """A part of the run that may fail alone: the reason, with the object's name first, goes to the problems."""
    return run.attempt(lambda error: problems.append(reason(name, error)))


def reason(name: str, error: Exception) -> str:
    """Why the object of that name failed, name first. Unforeseen errors go to the console in full."""
    if isinstance(error, KnownError):
        text = str(error)
        return text if text.startswith(f"{name}: ") else f"{name}: {text}"
    if bpy.data.objects.get((name, None)) is None:
        return f"{name}: {GONE}"
    traceback.print_exception(type(error), error, error.__traceback__)
    return f"{name}: an unexpected error: {type(error).__name__}: {error}"
