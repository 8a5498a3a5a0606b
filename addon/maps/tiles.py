# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps surfaces to tiles of flat tori and cylinders, with UV coordinates per corner."""

import dataclasses
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..layers.tile_fit import FittedTile, fitted
from ..surfaces.errors import MapError
from ..surfaces.surface import Island
from .domain import Domain, DomainError, takers
from .domain_outcomes import DomainIsland, DomainOutcome
from .options import Chosen
from .outcomes import LATER, Task
from .wording import counted, own_warning

if TYPE_CHECKING:
    from koebe import TileMap

UP = (2, 1)  # axes that may be up: v is 0 at the lower of a ring's two rims


@dataclasses.dataclass
class TileIsland(DomainIsland):
    """The outcome of one island: a result of `koebe.torus_map` or `koebe.ring_map` and its tile, or an error.

    tile     with the requested fit
    is_free  whether its loops are held on no circles
    """

    tile: FittedTile = LATER
    is_free: bool = False

    @property
    def texel_uv(self) -> np.ndarray:
        return self.tile.uv

    def circle(self, loop: dict[str, Any], fit: str) -> tuple[tuple[float, float], float]:
        """Centre and radius in the UVs of a loop that is a circle there, else 0 and 0."""
        if len(self.result.periods) < 2 or "center" not in loop or fit == "square" or self.is_free:
            return (0.0, 0.0), 0.0
        matrix, offset = self.tile.move
        x, y = matrix @ np.array(loop["center"]) + offset
        return (float(x), float(y)), float(loop["radius"] * matrix[0, 0])

    def map(self, koebe: ModuleType, task: Task, choice: Chosen, loops: list[np.ndarray], **run: Any) -> None:
        """As in `DomainIsland`."""
        arguments: dict[str, Any] = {}
        if choice.domain.name == "ring":
            outer, inner = rims_of(self.island, loops, choice.rims, task.picked)
            arguments = {"outer": outer, "inner": inner}
        if task.importance is not None:
            arguments["importance"] = task.importance[self.island.source_vertex]
        result = self._solve(koebe, choice, **arguments, **run)
        self.tile = fitted(result.uv, self.island.triangles, result.periods, choice.fit)
        self.take_corners(task.surface, self.tile.uv)
        self.is_free = choice.loops == "free" and result.even > 0.0
        self.result = result


class TileOutcome(DomainOutcome):
    """The outcome of one surface: each island fills the UV square by itself."""

    kind = TileIsland

    def warnings(self, one: TileIsland) -> list[dict[str, Any]]:
        lost = len(np.setdiff1d(one.flipped, one.result.flipped_faces))
        text = f"{counted(lost, 'triangle')} turned over when the tile was fitted: choose Fit: Inside"
        return [*super().warnings(one), *[own_warning("flipped", text)] * (lost > 0)]

    def figures(self) -> list[str]:
        return [counted(sum(len(one.result.loops) for one in self.mapped), "loop")]

    def _entry(self, index: int, one: TileIsland) -> dict[str, Any]:
        entry = super()._entry(index, one)
        return entry if one.result is None else {**entry, "fit": self.choice.fit}

    def _adapt(self, one: TileIsland, result: dict[str, Any]) -> None:
        """Loops, periods and angles are those of the fitted tile."""
        is_square, (matrix, offset) = self.choice.fit == "square", one.tile.move
        for loop in result["loops"]:
            if "slit" in loop:
                loop["slit"] = (np.array(loop["slit"]) @ matrix.T + offset).tolist()
            if "center" in loop and self.choice.domain.name == "torus":
                if is_square:  # an ellipse
                    del loop["center"], loop["radius"]
                else:
                    center, loop["radius"] = one.circle(loop, self.choice.fit)
                    loop["center"] = list(center)
        result["periods"] = one.tile.periods.tolist()
        if is_square:
            result.update(one.stored.report)

    def _row(self, one: TileIsland) -> dict[str, Any]:
        own = {"modulus": modulus_text(one.result), "periods": periods_text(one.tile)}
        return {**super()._row(one), **own, "cut_length": one.result.cut_length, "even": one.result.even,
                "density": one.density_ratio}  # fmt: skip

    def _loop_row(self, one: TileIsland, number: int, of_loop: dict[str, Any]) -> dict[str, Any]:
        center, radius = one.circle(of_loop, self.choice.fit)
        holes_before = number + 1 - 2 * (self.choice.domain.name == "ring")
        name = ("Rim", "Rim 2")[number] if of_loop["rim"] else f"{holes_before}"
        return {"uv_center": center, "uv_radius": radius, "name": name}


def modulus_text(result: "TileMap") -> str:
    """For a torus the ratio of its periods, for a cylinder i times its height over its period."""
    real = f"{round(result.modulus.real, 3) + 0.0:.3f} + " if len(result.periods) > 1 else ""  # never -0
    return f"{real}{result.modulus.imag:.3f} i"


def periods_text(tile: FittedTile) -> str:
    """The periods in UVs."""
    return " and ".join(f"({u:.4f}, {v:.4f})" for u, v in tile.periods)


def rims_of(island: Island, loops: list[np.ndarray], rims: str, picked: np.ndarray | None) -> tuple[int, int]:
    """A vertex of each of the two rims of a ring: of the lower rim in space first, or else of the longer one.

    Raises MapError if the rims must be the selected loops, and these are not two.
    """
    touched = [] if picked is None else [loop for loop in loops if picked[island.source_vertex[loop]].any()]
    if rims == "selected" and len(touched) != 2:
        raise MapError(
            f"Rims is Selected, but selected vertices are on {counted(len(touched), 'loop')}: in Edit Mode, select a "
            "vertex on each of two loops, and no face"
        )
    length = [_length(island, loop) for loop in loops]
    two = touched if len(touched) == 2 else [loops[k] for k in np.argsort(length, kind="stable")[: -3 : -1]]
    low, high = sorted(two, key=lambda loop: -_length(island, loop))
    extent = float(np.ptp(island.vertices, axis=0).max())
    for axis in UP:
        rise = float(island.vertices[high][:, axis].mean() - island.vertices[low][:, axis].mean())
        if abs(rise) > 0.1 * extent:
            return (int(low[0]), int(high[0])) if rise > 0.0 else (int(high[0]), int(low[0]))
    return int(low[0]), int(high[0])


def _length(island: Island, loop: np.ndarray) -> float:
    points = island.vertices[loop]
    return float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())


def _check_torus(handles: int, loops: int) -> None:
    if handles == 1:
        return
    if handles:
        raise DomainError(f"this surface has {handles} handles: a torus tile needs exactly one", *takers(handles))
    raise DomainError(
        "this surface has no handle: a torus tile needs one, like the handle of a mug", "ring" if loops > 1 else "parts"
    )


def _check_ring(handles: int, loops: int) -> None:
    if handles:
        had = counted(handles, "handle")
        raise DomainError(f"this surface has {had}: a cylinder must have no handle", *takers(handles))
    if loops < 2:
        had = "one boundary loop" if loops else "no boundary loop"
        raise DomainError(f"this surface has {had}: a cylinder needs two, for its ends", "parts")


TORUS = Domain(
    "torus", "torus tile", "Unwrap to Torus Tile", "MESH_TORUS",
    "TORUS", ("fit", "even", "loops", "layer", "checker", "checker_size"), _check_torus, TileOutcome,
    "Unwrap a surface with one handle, like a ring or a mug, to a tile. Angles are kept, and holes are round. A "
    "pattern that repeats with the tile has no seam. The cut is in the UVs only",
)  # fmt: skip
RING = Domain(
    "ring", "cylinder", "Unwrap to Cylinder", "MESH_CYLINDER",
    "RING", ("rims", "holes", "fit", "even", "loops", "checker", "checker_size"), _check_ring, TileOutcome,
    "Unwrap a surface with two ends, like a tube, to an unrolled cylinder. Angles are kept, and the ends are straight. "
    "A pattern that repeats round it has no seam. The cut is in the UVs only",
)  # fmt: skip
