# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs on Blender objects as shapes: read, compute, write. As in `job`, `compute` touches no Blender data."""

from . import distortion_display, native, transfer
from .carry import carry, read_source
from .shapes import Comparison, ShapeError, compare, map_shape, module


class _ShapeJob:
    """The surfaces of some mesh objects, the first one being what the others are held against."""

    def __init__(self, objects):
        """Read the objects. Raises NativeError."""
        self.koebe = native.load()
        self.objects = objects
        self.surfaces = [transfer.read_surface(obj, selected_only=False) for obj in objects]
        self.names = [obj.name for obj in objects]
        self.cancel_token = self.koebe.CancelToken()

    def _map(self, index, progress):
        return map_shape(
            self.koebe, self.names[index], self.surfaces[index], self._share(index, progress), self.cancel_token
        )

    def _share(self, index, progress):
        """Progress of one surface as a part of that of all, by triangles."""
        if progress is None:
            return None
        sizes = [len(surface.triangle_face) for surface in self.surfaces]
        done, total = sum(sizes[:index]), max(sum(sizes), 1)
        return lambda fraction, stage: progress((done + fraction * sizes[index]) / total, stage)


class MeasureJob(_ShapeJob):
    """The first object's conformal module, and the distances of the others from it."""

    def __init__(self, objects):
        super().__init__(objects)
        self.module, self.comparisons = None, None

    def compute(self, progress=None):
        """Fill `module` and `comparisons`. Raises ShapeError for the first object, and `koebe.Cancelled`."""
        first = self._map(0, progress)
        comparisons = [Comparison(first.name, 0.0, first.result.converged)]
        for index in range(1, len(self.objects)):
            try:
                comparisons.append(compare(self.koebe, first, self._map(index, progress)))
            except ShapeError as error:
                comparisons.append(Comparison(self.names[index], message=str(error)))
        self.module, self.comparisons = module(self.koebe, first), comparisons


class CarryJob(_ShapeJob):
    """Gives the other objects UVs that fit the texture of the first one."""

    def __init__(self, objects, layer, fit_holes):
        """Read the objects. Raises NativeError, or TransferError if UVs are missing or could not be written."""
        own = [obj for index, obj in enumerate(objects) if all(obj.data is not o.data for o in objects[:index])]
        super().__init__(own)
        if len(own) < 2:
            raise transfer.TransferError("select a surface beside the active one to carry its texture to")
        source = own[0]
        if layer not in source.data.uv_layers:
            raise transfer.TransferError(f"{source.name}: it has no UV layer {layer!r}: map it first")
        self.layer, self.fit_holes = layer, fit_holes
        self.source_uv = transfer.read_uv(source, layer)
        self.check_writable()
        self.carried, self.failures = None, None

    def check_writable(self):
        """Raise TransferError if one of the targets cannot be written, or no longer."""
        for obj, surface in zip(self.objects[1:], self.surfaces[1:], strict=True):
            transfer.check_writable(obj, surface, self.layer)

    def compute(self, progress=None):
        """Fill `carried`, None for a target that cannot be used, and `failures`, the reasons.

        Raises ShapeError if it is the source that cannot, and `koebe.Cancelled`.
        """
        source = read_source(self._map(0, progress), self.source_uv)
        carried, failures = [], []
        for index in range(1, len(self.objects)):
            try:
                target = self._map(index, progress)
                carried.append(carry(self.koebe, source, target, self.fit_holes, None, self.cancel_token))
            except ShapeError as error:
                carried.append(None)
                failures.append(str(error))
        self.carried, self.failures = carried, failures

    def write(self, with_material):
        """Write the UVs, and give targets without a material that of the source. Call `check_writable` first."""
        source = self.objects[0]
        for obj, one in zip(self.objects[1:], self.carried, strict=True):
            if one is None:
                continue
            island = one.shape.island
            transfer.write_uv(obj, self.layer, island.corners, one.uv[island.corner_vertex])
            kind = distortion_display.shown(obj)
            if kind is not None:
                distortion_display.put_on(obj, self.layer, kind)
            if with_material and source.active_material and not any(slot.material for slot in obj.material_slots):
                obj.active_material = source.active_material
