# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs on objects as shapes: read, compute, write. As in `map_job`, `compute` touches no Blender data."""


from ..blender import carried_material, map_writing, mesh_reading, uv_layers
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh, check_readable, reason, with_own_meshes
from ..blender.transaction import Transaction
from ..maps.carried_uv import Carried, carry, read_source
from ..maps.outcomes import LATER, Progress, share_of
from ..maps.shapes import Comparison, Shape, ShapeError, compare, map_shape, module
from ..maps.wording import few
from ..surfaces.surface import Surface
from . import native_package


class _ShapeJob:
    """The surfaces of some mesh objects; the others are compared with the first."""

    def __init__(self, objects: list[MeshObject]) -> None:
        """Read the objects. Raises NativeError, or TransferError if the first one cannot be read."""
        self.koebe = native_package.load()
        self.cancel_token = self.koebe.CancelToken()
        self.names: list[str] = []
        self.surfaces: list[Surface] = []
        self.failures: list[str] = []
        for obj in objects:
            try:
                check_readable(obj)
                surface = mesh_reading.read_surface(obj, selected_only=False)
                self._read(obj)
            except TransferError as error:
                if not self.names:
                    raise
                self.failures.append(str(error))
                continue
            self.names.append(obj.name)
            self.surfaces.append(surface)

    def _read(self, obj: MeshObject) -> None:
        """Read more of an object. A TransferError leaves the object out."""

    def _map(self, index: int, progress: Progress | None) -> Shape:
        sizes = [len(surface.triangle_face) for surface in self.surfaces]
        share = share_of(progress, sum(sizes[:index]), sizes[index], sum(sizes))
        return map_shape(self.koebe, self.names[index], self.surfaces[index], share, self.cancel_token)


class MeasureJob(_ShapeJob):
    """The first object's conformal module, and the distances of the others from it."""

    def __init__(self, objects: list[MeshObject]) -> None:
        super().__init__(objects)
        self.module: list[tuple[str, float]] = LATER
        self.comparisons: list[Comparison] = LATER

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `module` and `comparisons`. Raises ShapeError for the first object, and `koebe.Cancelled`."""
        first = self._map(0, progress)
        comparisons = [Comparison(first.name, 0.0, first.result.converged)]
        for index in range(1, len(self.names)):
            try:
                comparisons.append(compare(self.koebe, first, self._map(index, progress)))
            except ShapeError as error:
                comparisons.append(Comparison(self.names[index], message=str(error)))
        self.module, self.comparisons = module(self.koebe, first), comparisons


class CarryJob(_ShapeJob):
    """Gives the other objects UVs that fit the texture of the first one.

    carried   the result for each of the other objects that could be read, or None
    failures  the reasons of objects without a result
    """

    def __init__(self, objects: list[MeshObject], layer: str, fit_holes: bool) -> None:
        """Read the objects. Raises NativeError, or TransferError if UVs are missing or no target can be written."""
        own = with_own_meshes(objects)
        if len(own) < 2:
            raise TransferError("select another surface too: it gets the texture of the active object")
        source = own[0]
        check_readable(source)
        if layer not in source.data.uv_layers:
            raise TransferError(f"{source.name}: it has no UV layer {layer!r}: map it first")
        self.layer, self.fit_holes = layer, fit_holes
        self.targets: list[Target] = []
        super().__init__(own)
        if not self.targets[1:]:
            raise TransferError(few(self.failures))
        self.source_uv = mesh_reading.read_layer(source, layer)
        self.material = carried_material.painted(source)
        self.carried: list[Carried | None] = LATER

    def _read(self, obj: MeshObject) -> None:
        if self.targets:  # the first object is not written
            check_mesh(obj)
            uv_layers.check_layer(obj, self.layer)
        self.targets.append(Target.of(obj))

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `carried`, and `failures`.

        Raises ShapeError if the source cannot be used, and `koebe.Cancelled`.
        """
        source = read_source(self.koebe, self._map(0, progress), self.source_uv)
        carried: list[Carried | None] = []
        for index in range(1, len(self.names)):
            carried.append(None)
            try:
                target = self._map(index, progress)
                carried[-1] = carry(self.koebe, source, target, self.fit_holes, None, self.cancel_token)
            except self.koebe.Cancelled:
                raise
            except Exception as error:
                self.failures.append(reason(self.names[index], error))
        self.carried = carried

    def write(self, run: Transaction, with_material: bool) -> None:
        """Write the UVs, and give targets without a material the painted one of the source.

        An object that cannot be written stays as it was: it gets None in `carried`, and its reason in `failures`.
        """
        for index, (target, one) in enumerate(zip(self.targets[1:], self.carried, strict=True)):
            if one is not None:
                with run.attempt(lambda error, index=index: self._fail(index, error)):
                    self._write_one(run, target, one, with_material)

    def _fail(self, index: int, error: Exception) -> None:
        self.failures.append(reason(self.names[index + 1], error))
        self.carried[index] = None

    def _write_one(self, run: Transaction, target: Target, one: Carried, with_material: bool) -> None:
        island = one.shape.island
        plan = map_writing.plan(target, self.layer, one.shape.surface, island.corners, one.uv[island.corner_vertex])
        map_writing.write(run, plan)
        if with_material and self.material is not None:
            carried_material.give(run, plan.obj, self.material)
