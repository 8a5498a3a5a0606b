# SPDX-License-Identifier: GPL-3.0-or-later
"""A domain beside the disk: its names, its requirements on a surface, and its options."""

import dataclasses
import functools
from collections.abc import Callable
from typing import Any

from ..surfaces.errors import MapError
from .options import OF_RUNS, Chosen, of_map


class DomainError(MapError):
    """A surface that does not fit a domain. `offer` names the operators that take it: "parts", "uniformize", or a
    domain."""

    def __init__(self, reason: str, *offer: str) -> None:
        super().__init__(reason)
        self.offer = offer


@dataclasses.dataclass(frozen=True)
class Domain:
    """A domain other than the disk: its UVs are a tile, the layout of a sphere, or cut open at the handles.

    name     of its operator, and of `koebe.NAME_map`
    title    name of such a map
    button   name of the operator, without "Koebe"
    icon     of the button
    shape    word of the option `shape` that takes it
    redo     its options in the redo panel of Unwrap: at most seven, as the shape stands above them
    check    takes the numbers of handles and of boundary loops; raises DomainError
    outcome  a `DomainOutcome`, of one surface
    tooltip  of the operator: at most 239 letters, Blender cuts off the rest
    """

    name: str
    title: str
    button: str
    icon: Any  # one of Blender's names
    shape: str
    redo: tuple[str, ...]
    check: Callable[[int, int], None]
    outcome: type[Any]
    tooltip: str

    @functools.cached_property
    def choice(self) -> type[Chosen]:
        """The options of the map as a class. Its `domain` is this one."""
        return of_map(self.name, *OF_RUNS)(type("DomainChoice", (Chosen,), {"domain": self}))


def takers(handles: int) -> tuple[str, ...]:
    """The operators that take a surface with so many handles, at least one."""
    return ("torus",) if handles == 1 else ("schottky", "parts")
