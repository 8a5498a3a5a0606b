# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat pieces of objects, for new objects or a drawing: their UV layouts as they are, or cut anew and true to size."""

import dataclasses
from typing import Any

import bpy
import numpy as np

from ..blender import mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import GONE, check_readable, reason
from ..layers.flat_layout import FlatLayout, flat_layout
from ..maps.flat_pattern import FlatPattern, Label, flat_pattern, pattern_layout
from ..maps.outcomes import Progress, share_of
from ..maps.wording import counted, explain
from ..surfaces.errors import failing_alone
from ..surfaces.surface import Surface
from . import native_package

NEW_LAYER = "Koebe"  # of a copy whose source has no UVs


@dataclasses.dataclass(frozen=True)
class Flat:
    """An object's layout, and the UVs (C, 2) of its layer. `pattern`: what is said of pieces that were cut anew, and
    `labels`: their numbers."""

    obj: MeshObject
    layer: str
    uv: np.ndarray
    layout: FlatLayout
    pattern: str = ""
    labels: tuple[Label, ...] = ()

    def describe(self) -> str:
        """How true to scale it is, and which faces were left out."""
        left_out = f"; {counted(self.layout.left_out, 'face')} left out" if self.layout.left_out else ""
        if not self.pattern and left_out:
            left_out = f"; {self.layout.left_out} faces without UVs are left out"
        return f"{self.obj.name}: {self.pattern or self.layout.describe()}{left_out}"


class FlattenJob:
    """Cuts the surfaces of some objects anew and lays them flat. `compute` touches no Blender data.

    problems  why other objects were left out
    """

    def __init__(self, objects: list[MeshObject], millimetres: float | None = None, **options: Any) -> None:
        """Read the objects. @param millimetres, options as of `flat_pattern`. Raises NativeError."""
        self.koebe = native_package.load()
        self.cancel_token = self.koebe.CancelToken()
        self.problems: list[str] = []
        self._read: list[tuple[str, Surface]] = []
        self._done: list[tuple[str, Surface, FlatPattern]] = []
        self._millimetres, self._options = millimetres, options
        for obj in objects:
            try:
                check_readable(obj)
                self._read.append((obj.name, mesh_reading.read_surface(obj, selected_only=False)))
            except Exception as error:
                self.problems.append(reason(obj.name, error))

    def compute(self, progress: Progress | None = None) -> None:
        """Lay every surface flat. Raises `koebe.Cancelled` once the token was raised."""
        sizes = [len(surface.triangle_face) for _, surface in self._read]
        for k, (name, surface) in enumerate(self._read):
            share = share_of(progress, sum(sizes[:k]), sizes[k], sum(sizes))
            one = _Failure()
            with failing_alone(self.koebe, [one]):
                pattern = flat_pattern(
                    self.koebe, surface, self._millimetres, share, self.cancel_token, **self._options
                )
                self._done.append((name, surface, pattern))
            if one.error is not None:
                self.problems.append(f"{name}: {explain(one.error)}")

    def patterns(self) -> list[tuple[str, FlatPattern]]:
        """Names of objects and their patterns."""
        return [(name, pattern) for name, _, pattern in self._done]

    def flats(self) -> list[Flat]:
        """The pieces of each object that is still there, with UVs for their copy: the object's own, or the pieces."""
        found: list[Flat] = []
        for name, surface, pattern in self._done:
            obj = bpy.data.objects.get((name, None))
            try:
                if obj is None or obj.type != "MESH":
                    raise TransferError(f"{name}: {GONE}")
                check_readable(obj)
                layer, uv = NEW_LAYER, pattern.unit_uv()
                if obj.data.uv_layers.active is not None:
                    layer = obj.data.uv_layers.active.name
                    uv = mesh_reading.read_layer(obj, layer)
                if len(uv) != len(pattern.uv):
                    raise TransferError(f"{name}: its mesh has changed during the run")
                layout = pattern_layout(surface, pattern)
                labels = tuple(pattern.labels())
                found.append(Flat(obj, layer, uv.astype(np.float32), layout, pattern.describe(), labels))
            except Exception as error:
                self.problems.append(reason(name, error))
        return found


class _Failure:
    error: Exception | None = None


def read_flat(objects: list[MeshObject], layer: str) -> tuple[list[Flat], list[str]]:
    """The objects' layouts in the layer of that name, or in their active one; why other objects have none."""
    found, problems = [], []
    for obj in objects:
        try:
            found.append(_read(obj, layer))
        except Exception as error:
            problems.append(reason(obj.name, error))
    return found, problems


def _read(obj: MeshObject, layer: str) -> Flat:
    check_readable(obj)
    if not layer and obj.data.uv_layers.active is None:
        raise TransferError(f"{obj.name}: it has no UVs: map it first")
    layer = layer or obj.data.uv_layers.active.name
    if layer not in obj.data.uv_layers:
        raise TransferError(f"{obj.name}: it has no UV layer {layer!r}: map it first")
    surface = mesh_reading.read_surface(obj, selected_only=False)
    uv = mesh_reading.read_layer(obj, layer)
    return Flat(obj, layer, uv, flat_layout(surface, uv))
