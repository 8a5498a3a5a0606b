# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares shapes by their circle domains: their modules, and the distances between them."""

import dataclasses
from types import ModuleType
from typing import TYPE_CHECKING, Any

from ..surfaces.errors import KnownError
from ..surfaces.islands import cut_into_islands
from ..surfaces.surface import Island, Surface
from .outcomes import Progress
from .wording import explain

if TYPE_CHECKING:
    from koebe import UniformizeResult


class ShapeError(KnownError):
    """A surface that cannot be compared with another, or cannot carry its texture."""


@dataclasses.dataclass(frozen=True)
class Shape:
    """A surface of one island, mapped to its circle domain with the longest loop outside.

    result  of `koebe.uniformize`, in the vertices of the island
    """

    name: str
    surface: Surface
    island: Island
    result: "UniformizeResult"


@dataclasses.dataclass
class Comparison:
    """The comparison of a shape with the first one: its distance, or why there is none."""

    name: str
    distance: float | None = None
    converged: bool = True
    message: str = ""


def map_shape(
    koebe: ModuleType,
    name: str,
    surface: Surface,
    progress: Progress | None = None,
    cancel: Any = None,
    outer: str | int = "longest",
) -> Shape:
    """The `Shape` of a surface. Raises ShapeError and `koebe.Cancelled`.

    The disk is balanced if its holes do not determine its centre.
    """
    islands = cut_into_islands(surface)
    if len(islands) != 1:
        raise ShapeError(f"{name}: it has {len(islands)} islands, but a shape is one island")
    (island,) = islands
    arguments = {"outer": outer, "progress": progress, "cancel": cancel}
    try:
        result = koebe.uniformize(island.vertices, island.triangles, **arguments)
        if len(result.loops) == 1:
            result = koebe.uniformize(island.vertices, island.triangles, balance="area", **arguments)
    except koebe.Cancelled:
        raise
    except koebe.KoebeError as error:
        raise ShapeError(f"{name}: {explain(error)}") from error
    return Shape(name, surface, island, result)


def module(koebe: ModuleType, shape: Shape) -> list[tuple[str, float]]:
    """Names and values of a shape's conformal module, its loops by length."""
    values = koebe.conformal_module(shape.result)
    return list(zip(koebe.module_names(len(shape.result.loops)), values.tolist(), strict=True))


def compare(koebe: ModuleType, first: Shape, other: Shape) -> Comparison:
    """The `Comparison` of two shapes: the distance of their modules, with corresponding loops found by best fit."""
    mine, yours = len(first.result.loops), len(other.result.loops)
    if mine != yours:
        return Comparison(other.name, message=f"{yours} loops, not {mine}")
    try:
        distance = koebe.module_distance(first.result, other.result)
    except koebe.KoebeError as error:
        return Comparison(other.name, message=str(error))
    return Comparison(other.name, distance, other.result.converged)
