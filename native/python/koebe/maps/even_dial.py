"""A map made more or less even again and again: for a slider."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from .._arrays import as_indices, as_points
from .._native import _koebe
from .._option_table import rows
from .._options import flag, number, token, whole
from .._types import Floats
from ..errors import InputError, KoebeError
from .input import points_at_vertices, surface_of


class EvenDial:
    """A surface and its map, which `move` makes more or less even, each time from where it is.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    uv      (V, 2) the map at first, one to one: for example the UVs of one island
    round   boundary loops that lie on circles stay on circles
    mask    (V,) bool: faces with a vertex where it is True are left out
    Raises InputError (for faces that are turned over, too), or TopologyError.

    >>> import koebe
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> dial = koebe.EvenDial("blend_samples/face.obj", uv=result.uv)
    >>> before = koebe.distortion("blend_samples/face.obj", uv=dial.uv)["area_distortion"]["log_sd"]
    >>> uv = dial.move(0.5)
    >>> koebe.distortion("blend_samples/face.obj", uv=uv)["area_distortion"]["log_sd"] < before
    True
    """

    def __init__(self, vertices: Any, triangles: Any = None, *, uv: Any, round: bool = True, mask: Any = None) -> None:
        source = surface_of(vertices, triangles, mask=mask)
        self._used = source.used
        self.uv = self._everywhere(points_at_vertices(uv, "uv", source)[self._used])
        number = np.cumsum(self._used, dtype=np.int32) - np.int32(1)
        used = replace(source, vertices=source.vertices[self._used], triangles=number[source.triangles])
        self._native = used.call(_koebe.EvenDial, self.uv[self._used], flag(round, "round"))
        self._count = len(source.vertices), len(source.triangles)
        self.moved = False

    def move(self, even: float, *, steps: int = 2, cancel: "_koebe.CancelToken | None" = None) -> Floats:
        """The map (V, 2) after at most so many Newton steps towards E; also `uv`. Calls add up to the map at E.

        even    E as for `uniformize`; near 0 the map becomes conformal again
        `moved` is False if there was nothing left to do. Raises OptionError, or Cancelled: then the map stays.
        """
        value = number(even, rows("uniformize")["even"])
        uv, self.moved = self._native.move(value, whole(steps, "steps", least=1), token(cancel, "cancel"))
        self.uv = self._everywhere(uv)
        return self.uv

    def pin(
        self, pins: Mapping[int, Sequence[float]], *, even: float = 0.5, cancel: "_koebe.CancelToken | None" = None
    ) -> Floats:
        """The map (V, 2), one to one, with these vertices exactly at their places; also `uv`.

        pins    vertex: (u, v). Later calls of `move` keep them there; a new call replaces them
        even    E at which three pins or more bend the map, as for `uniformize`

        One pin moves the map, and two pins turn and scale it: it bends for three or more. These need `round=False`,
        unless no loop is round. Raises OptionError; InputError for pins that are no vertices of a face, not finite, at
        one place, or that turn a face over; SolverError if no one-to-one map was found: its `elements` are the pins
        that are in the way; or Cancelled. Then the map stays, and so do the pins of the last call.
        """
        value = number(even, rows("uniformize")["even"])
        if not isinstance(pins, Mapping):
            raise TypeError(f"pins must be a dict of vertices and places, not {pins!r}")
        named = as_indices(list(pins), "pins", len(self._used), "vertices")
        places = as_points(list(pins.values()) or np.zeros((0, 2)), "pins", 2)
        lost = named[~self._used[named]].tolist()
        if lost:
            raise InputError(f"a pin is no vertex of a face: {lost[0]}", lost, "vertices")
        vertices = (np.cumsum(self._used) - 1)[named].tolist()
        try:
            uv = self._native.pin(vertices, places, value, token(cancel, "cancel"))
        except KoebeError as error:
            if error.of == "vertices":
                error.elements = [int(v) for v in np.flatnonzero(self._used)[np.asarray(error.elements, dtype=int)]]
            raise
        self.uv = self._everywhere(uv)
        return self.uv

    def _everywhere(self, uv: Floats) -> Floats:
        """(V, 2), with NaN at vertices without a face."""
        whole_map = np.full((len(self._used), 2), np.nan)
        whole_map[self._used] = uv
        return whole_map

    def __repr__(self) -> str:
        return f"<koebe.EvenDial {self._count[0]} vertices, {self._count[1]} faces>"
