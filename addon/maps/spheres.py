# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps surfaces without handles to spheres, with UV coordinates per corner."""

import dataclasses
import functools
from types import ModuleType
from typing import Any, ClassVar

import numpy as np

from ..surfaces.triangles import areas, density_ratio
from .domain import Domain, DomainError, takers
from .domain_outcomes import DomainIsland, DomainOutcome
from .options import Chosen
from .outcomes import LATER, Task
from .wording import counted

WHERE_TORN = {"equirectangular": "at a pole", "octahedral": "at the middle of a side of the square"}


@dataclasses.dataclass
class SphereIsland(DomainIsland):
    """The outcome of one island: a result of `koebe.sphere_map`, or an error.

    torn     triangles (k,) that no UVs of the layout fit
    """

    on_threads: ClassVar[bool] = True

    torn: np.ndarray = LATER

    @functools.cached_property
    def density_ratio(self) -> float:
        """On the sphere: length per length on the surface, at 95 % of the area over the value at 5 %."""
        return density_ratio(self.island.areas, areas(self.result.points, self.island.triangles))

    @property
    def torn_faces(self) -> np.ndarray:
        """Faces of the surface with torn triangles."""
        return np.unique(self.island.triangle_face[self.torn])

    def map(self, koebe: ModuleType, task: Task, choice: Chosen, loops: list[np.ndarray], **run: Any) -> None:
        """As in `DomainIsland`."""
        super().map(koebe, task, choice, loops, **run)
        self.torn = np.asarray(self.result.layout["torn"], dtype=np.int64)


class SphereOutcome(DomainOutcome):
    """The outcome of one surface: each island has the layout to itself."""

    kind = SphereIsland

    def notes(self) -> list[tuple[SphereIsland, str]]:
        """Notes on torn faces."""
        where = f"{WHERE_TORN[self.choice.layout]} torn apart in the UVs, as a flat map has no room there"
        found = [(one, len(one.torn_faces)) for one in self.mapped]
        return [(one, f"{counted(count, 'face')} {where}") for one, count in found if count]

    def figures(self) -> list[str]:
        caps = sum(len(one.result.loops) for one in self.mapped)
        torn = sum(len(one.torn_faces) for one in self.mapped)
        return [counted(caps, "hole"), *[counted(torn, "torn face")] * bool(torn)]

    def _adapt(self, one: SphereIsland, result: dict[str, Any]) -> None:
        """`layout` is about the UVs, all else about the sphere."""
        for key in ("crossing", "moved", "torn", "flipped", "below_resolution"):
            result["layout"][key] = one.faces(result["layout"][key])

    def _row(self, one: SphereIsland) -> dict[str, Any]:
        own = {"layout": self.choice.layout, "density": one.density_ratio, "torn_faces": one.torn_faces.tolist()}
        return {**super()._row(one), **own, "moved_faces": one.faces(one.result.layout["moved"])}

    def _loop_row(self, one: SphereIsland, number: int, of_loop: dict[str, Any]) -> dict[str, Any]:
        return {"radius": of_loop["radius"], "name": f"{number + 1}"}


def _check_sphere(handles: int, loops: int) -> None:
    if handles:
        had = counted(handles, "handle")
        raise DomainError(f"this surface has {had}, and a sphere has no handle", *takers(handles))


SPHERE = Domain(
    "sphere", "sphere", "Unwrap to Sphere", "MESH_UVSPHERE",
    "SPHERE", ("even", "layout", "add_sphere", "layer", "checker", "checker_size"), _check_sphere, SphereOutcome,
    "Unwrap a surface without handles, closed or with holes, to a sphere, and lay the sphere out as UVs. Angles are "
    "kept on the sphere, unless Even is above 0, and holes are round. The cut is in the UVs only",
)  # fmt: skip
