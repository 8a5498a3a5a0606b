"""A map made more or less even again and again: for a slider."""

from typing import Any

import numpy as np

from ._arrays import as_points
from ._input import surface_of
from ._native import _koebe
from ._option_table import rows
from ._options import flag, number, token, whole


class EvenDial:
    """A surface and its map, which `move` makes more or less even, each time from where it is.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    uv      (V, 2) the map at first, one to one: for example the UVs of one island
    round   boundary loops that lie on circles stay on circles
    Raises InputError (for faces that are turned over, too), or TopologyError.

    >>> import koebe
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> dial = koebe.EvenDial("blend_samples/face.obj", uv=result.uv)
    >>> before = koebe.distortion("blend_samples/face.obj", uv=dial.uv)["area_distortion"]["log_sd"]
    >>> uv = dial.move(0.5)
    >>> koebe.distortion("blend_samples/face.obj", uv=uv)["area_distortion"]["log_sd"] < before
    True
    """

    def __init__(self, vertices: Any, triangles: Any = None, *, uv: Any, round: bool = True) -> None:
        source = surface_of(vertices, triangles)
        points = as_points(uv, "uv", 2, len(source.vertices))
        self._native = _koebe.EvenDial(source.vertices, source.triangles, points, flag(round, "round"))
        self._count = len(source.vertices), len(source.triangles)
        self.uv = points
        self.moved = False

    def move(self, even: float, *, steps: int = 2, cancel: "_koebe.CancelToken | None" = None) -> np.ndarray:
        """The map (V, 2) after at most so many Newton steps towards E; also `uv`. Calls add up to the map at E.

        even    E as for `uniformize`; near 0 the map becomes conformal again
        `moved` is False if there was nothing left to do. Raises OptionError, or Cancelled: then the map stays.
        """
        value = number(even, rows("uniformize")["even"])
        self.uv, self.moved = self._native.move(value, whole(steps, "steps", least=1), token(cancel, "cancel"))
        return self.uv

    def __repr__(self) -> str:
        return f"<koebe.EvenDial {self._count[0]} vertices, {self._count[1]} faces>"
