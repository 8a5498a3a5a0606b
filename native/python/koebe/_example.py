"""Surfaces that come with the package, to try it on."""

from pathlib import Path

from ._options import choice_of
from ._types import Floats, Ints
from .maps.input import surface_of

_FOLDER = Path(__file__).parent / "examples"
_EXAMPLES = {"face": "a face, its mouth and eyes cut out", "surprised": "the same face with another expression"}


def example(name: str = "face") -> tuple[Floats, Ints]:
    """A surface that comes with the package: vertices (V, 3) float64 and triangles (F, 3) int32.

    name    'face': a face with its mouth and eyes cut out, four loops; 'surprised': the same triangles, the face with
            another expression
    Made by script, with the package's licence. The unit is half the face's height. Raises OptionError.

    >>> import koebe
    >>> koebe.uniformize(koebe.example("face"))
    <koebe.UniformizeResult 2309 vertices, 4 loops, 2 sweeps, angle error 0.886 deg, 0 flipped>
    """
    choice_of(name, "name", _EXAMPLES)
    source = surface_of(_FOLDER / f"{name}.obj")
    return source.vertices, source.triangles
