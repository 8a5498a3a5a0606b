# SPDX-License-Identifier: GPL-3.0-or-later
"""The domains beside the disk, and their requirements on a surface."""

import dataclasses
from collections.abc import Callable
from typing import Literal

from .errors import MapError
from .wording import counted


class DomainError(MapError):
    """A surface that does not fit a domain. `offer` names the operators that take it: "parts", "uniformize", or a
    domain."""

    def __init__(self, reason: str, *offer: str) -> None:
        super().__init__(reason)
        self.offer = offer


@dataclasses.dataclass(frozen=True)
class Domain:
    """A domain other than the disk: its UVs are a tile, the layout of a sphere, or cut open at the handles.

    title   name of such a map
    button  name of the operator, without "Koebe"
    icon    of the button
    check   takes the numbers of handles and of boundary loops; raises DomainError
    """

    title: str
    button: str
    icon: Literal["MESH_TORUS", "MESH_CYLINDER", "MESH_UVSPHERE", "META_ELLIPSOID"]
    check: Callable[[int, int], None]


def _takers(handles: int) -> tuple[str, ...]:
    """The operators that take a surface with so many handles, at least one."""
    return ("torus",) if handles == 1 else ("schottky", "parts")


def _check_torus(handles: int, loops: int) -> None:
    if handles == 1:
        return
    if handles:
        raise DomainError(f"this surface has {handles} handles: a torus tile needs exactly one", *_takers(handles))
    raise DomainError(
        "this surface has no handle: a torus tile needs one, like that of a mug", "ring" if loops > 1 else "parts"
    )


def _check_ring(handles: int, loops: int) -> None:
    if handles:
        had = counted(handles, "handle")
        raise DomainError(f"this surface has {had}: a cylinder has none", *_takers(handles))
    if loops < 2:
        had = "one boundary loop" if loops else "no boundary loop"
        raise DomainError(f"this surface has {had}: a cylinder needs two, its rims", "parts")


def _check_sphere(handles: int, loops: int) -> None:
    if handles:
        had = counted(handles, "handle")
        raise DomainError(f"this surface has {had}: a sphere has none", *_takers(handles))


def _check_schottky(handles: int, loops: int) -> None:
    if not handles:
        raise DomainError(
            "this surface has no handle: Unwrap Handles needs one at least", "uniformize" if loops else "sphere"
        )


# The keys are the operators' names; the functions are `koebe.torus_map`, `ring_map`, `sphere_map` and `schottky_map`.
DOMAINS = {
    "torus": Domain("torus tile", "Unwrap to Torus Tile", "MESH_TORUS", _check_torus),
    "ring": Domain("cylinder", "Unwrap to Cylinder", "MESH_CYLINDER", _check_ring),
    "sphere": Domain("sphere", "Unwrap to Sphere", "MESH_UVSPHERE", _check_sphere),
    "schottky": Domain("fundamental domain", "Unwrap Handles", "META_ELLIPSOID", _check_schottky),
}
