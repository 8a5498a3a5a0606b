# SPDX-License-Identifier: GPL-3.0-or-later
"""A domain beside the disk: its names, what a surface has to be for it, and what there is to choose."""

import dataclasses
import functools
from collections.abc import Callable
from typing import Any

from .errors import MapError
from .options import OF_RUNS, Chosen, of_map


class DomainError(MapError):
    """A surface that is no such domain. `offer` are the operators that take it: "parts", "uniformize", or a domain's
    name."""

    def __init__(self, reason: str, *offer: str) -> None:
        super().__init__(reason)
        self.offer = offer


@dataclasses.dataclass(frozen=True)
class Domain:
    """A canonical domain that is no disk: its UVs are a tile, the layout of a sphere, or cut open at the handles.

    name     of its operator, and of `koebe.NAME_map`
    title    what one such map is called
    button   what the operator is called, without "Koebe"
    icon     of the button
    check    of the number of handles and of boundary loops; raises DomainError
    outcome  a `DomainOutcome`: what becomes of a surface
    tooltip  of the operator: at most 239 letters, Blender cuts off the rest
    """

    name: str
    title: str
    button: str
    icon: Any  # one of Blender's names
    check: Callable[[int, int], None]
    outcome: type[Any]
    tooltip: str

    @functools.cached_property
    def choice(self) -> type[Chosen]:
        """What to compute: the options of the map. Its `domain` is this one."""
        return of_map(self.name, *OF_RUNS)(type("DomainChoice", (Chosen,), {"domain": self}))


def takers(handles: int) -> tuple[str, ...]:
    """The operators that take a surface with so many handles, one at least."""
    return ("torus",) if handles == 1 else ("schottky", "parts")
