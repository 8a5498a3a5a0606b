# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that brings a pattern onto each, as a new object: read, compute, write."""

import dataclasses
import tempfile
from pathlib import Path

import bpy

from ..blender import mesh_reading
from ..blender.errors import TransferError
from ..blender.lifted_object import add_lifted_object
from ..blender.mesh_object import MeshObject
from ..blender.targets import GONE, attempt, check_readable, reason
from ..blender.transaction import Transaction
from ..maps.lifting import LiftChoice, LiftOutcome, lift_surface
from ..maps.outcomes import Progress, share_of
from ..surfaces.errors import failing_alone
from . import native_package


class LiftJob:
    """Lifts a pattern onto some objects, and changes none of them. `compute` touches no Blender data.

    problems  why objects have no result
    """

    def __init__(self, objects: list[MeshObject], choice: LiftChoice, drawing: str | None = None) -> None:
        """Read the objects. @param drawing the text of an SVG file that takes the place of the pattern

        Raises NativeError.
        """
        self.koebe = native_package.load()
        self.cancel_token = self.koebe.CancelToken()
        self.problems: list[str] = []
        self.outcomes: list[LiftOutcome] = []
        self._places: list[tuple[str, str | None]] = []  # name and library of each object
        self.choice, self._drawing = choice, drawing
        for obj in objects:
            try:
                self.outcomes.append(_read(obj, choice))
                self._places.append((obj.name, obj.library.filepath if obj.library else None))
            except Exception as error:
                self.problems.append(reason(obj.name, error))

    def compute(self, progress: Progress | None = None) -> None:
        """Fill the outcomes. Raises `koebe.Cancelled` once the token was raised."""
        if self._drawing is None:
            self._compute(self.choice, progress)
            return
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "drawing.svg"
            path.write_text(self._drawing, encoding="ascii")
            self._compute(dataclasses.replace(self.choice, pattern=str(path)), progress)

    def _compute(self, choice: LiftChoice, progress: Progress | None) -> None:
        sizes = [len(outcome.surface.triangle_face) for outcome in self.outcomes]
        for k, outcome in enumerate(self.outcomes):
            share = share_of(progress, sum(sizes[:k]), sizes[k], sum(sizes))
            with failing_alone(self.koebe, [outcome]):
                lift_surface(self.koebe, outcome, choice, share, self.cancel_token)

    def failures(self) -> list[LiftOutcome]:
        """The objects that have an error."""
        return [outcome for outcome in self.outcomes if outcome.error is not None]

    def write(
        self, run: Transaction, context: bpy.types.Context, layer: str
    ) -> list[tuple[LiftOutcome, MeshObject, bpy.types.Object]]:
        """Add a new object for each result. An object that is gone, or fails, goes to the problems."""
        made: list[tuple[LiftOutcome, MeshObject, bpy.types.Object]] = []
        for outcome, place in zip(self.outcomes, self._places, strict=True):
            if outcome.lifted is None:
                continue
            with attempt(run, outcome.name, self.problems):
                source = bpy.data.objects.get(place)
                if source is None or source.type != "MESH":
                    raise TransferError(f"{outcome.name}: {GONE}")
                made.append((outcome, source, add_lifted_object(run, context, source, outcome.lifted, layer)))
        return made


def _read(obj: MeshObject, choice: LiftChoice) -> LiftOutcome:
    check_readable(obj)
    surface = mesh_reading.read_surface(obj, selected_only=False)
    if not len(surface.face_size):
        raise TransferError(f"{obj.name}: it has no faces")
    place = mesh_reading.cursor_place(obj) if choice.cursor else None
    graded = mesh_reading.vertex_weights(obj, choice.graded) if choice.graded else None
    if choice.graded and graded is None:
        raise TransferError(f"{obj.name}: it has no vertex group {choice.graded!r}, which Weights names")
    return LiftOutcome(obj.name, surface, obj.matrix_world.determinant() < 0.0, place, graded)
