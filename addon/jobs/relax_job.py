# SPDX-License-Identifier: GPL-3.0-or-later
"""The UV layer of an edited object under the relax brush: reads, shows, puts back, writes."""

from types import ModuleType

import numpy as np

from ..blender import map_writing, mesh_reading, uv_layers
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import Transaction
from ..layers.relax_brush import Dab, RelaxBrush


class RelaxJob:
    """The shown UVs of one object in Edit Mode. @param by_selection only selected faces are shown"""

    def __init__(self, koebe: ModuleType, obj: MeshObject, layer: str, by_selection: bool) -> None:
        """Read the object. Raises TransferError."""
        check_mesh(obj)
        self.layer = mesh_reading.layer_named(obj, layer)
        self._surface = mesh_reading.read_surface(obj, selected_only=by_selection)
        if not by_selection:
            self._surface.selected[:] = mesh_reading.shown_faces(obj)
        self.target = Target.of(obj)
        self.cancel_token = koebe.CancelToken()
        self._old = mesh_reading.read_layer(obj, self.layer)
        pinned = mesh_reading.pinned_corners(obj, self.layer)
        self.brush = RelaxBrush(koebe, self._surface, self._old, pinned, self.cancel_token)
        self._face = np.repeat(np.arange(len(self._surface.face_size)), self._surface.face_size)
        self._touched = np.zeros(len(self._face), dtype=bool)

    @property
    def has_changed(self) -> bool:
        """Whether a dab has moved a UV."""
        return bool(self._touched.any())

    def show(self, dab: Dab) -> None:
        """Write what a dab has changed. Raises TransferError if the object is gone."""
        self._touched[dab.corners] = True
        self._set(dab.corners, dab.uv)

    def put_back(self) -> None:
        """Write the UVs that were read."""
        corners = np.flatnonzero(self._touched)
        self._set(corners, self._old[corners])

    def write(self, run: Transaction) -> None:
        """Write all that has changed. Raises TransferError; then nothing is changed."""
        corners = np.flatnonzero(self._touched)
        uv = self.brush.uv[corners]
        self.put_back()
        plan = map_writing.plan(self.target, self.layer, self._surface, corners, uv)
        map_writing.write(run, plan, select=False)

    def _set(self, corners: np.ndarray, uv: np.ndarray) -> None:
        obj = self.target.obj
        if obj is None or obj.type != "MESH" or obj.mode != "EDIT":
            raise TransferError(f"{self.target.name}: its mesh has changed during the run")
        in_face = corners - self._surface.face_start[self._face[corners]]
        uv_layers.set_edited_corners(obj, self.layer, self._face[corners], in_face, uv)
