# SPDX-License-Identifier: GPL-3.0-or-later
"""Brings a pattern onto a surface through a map: choices, runs of the solver, and words about the result."""

import dataclasses
import math
from types import ModuleType
from typing import Any, Protocol

import numpy as np

from ..surfaces.errors import elements_of, kind_of
from ..surfaces.islands import cut_into_islands
from ..surfaces.offending_elements import FACES, VERTICES, offending_elements
from ..surfaces.surface import Island, Surface
from .outcomes import Progress, share_of
from .places import centers, points
from .warning_words import of_solver
from .wording import counted, explain, in_mesh

SPREAD = ("circles", "voronoi")  # patterns that are even on the surface
LATTICES = ("hexagons", "triangles", "diamonds", "stripes", "truchet")  # patterns that are even in the map
DRAWN = ("file", "object")  # patterns that an artist has drawn
CELLS = 12.0  # of the pattern, along the root of the area, if no size is given
RISE = 0.08  # of a cell: the height, if none is given
BRIDGE = 0.2  # of a cell: the bridge, if none is given
HIGHEST = 1e30  # that the solver takes
REASONS = {
    "closed": "the surface is closed: set Shape to Sphere, Parts or Torus, or delete a face",
    "genus": "the surface has a handle: set Shape to Parts, or to Torus if it is a torus",
}


class Options(Protocol):
    """The options by which it is known which others matter."""

    pattern: str
    way: str
    shape: str
    around: str
    file: str


def is_used(name: str, options: Options) -> bool:
    """Whether an option matters with these choices."""
    drawn, lattice, shape = options.pattern in DRAWN, options.pattern in LATTICES, options.shape
    may_surround = (shape == "disk" and (lattice or options.pattern == "circles")) or (shape == "sphere" and drawn)
    rows = options.around != "none" and shape == "disk" and may_surround
    round_it, bounded = shape == "ring" or rows, shape in ("disk", "parts") and not rows
    return {
        "file": options.pattern == "file",
        "drawing": options.pattern == "object",
        "height": options.way == "raise",
        "bridge": not drawn,
        "graded": not drawn,
        "rim": shape != "sphere" and not (options.pattern == "file" and options.file.lower().endswith(".png")),
        "seed": options.pattern in (*SPREAD, "truchet"),
        "around": may_surround,
        "rows": rows,
        "turn": drawn or (lattice and bounded) or (options.pattern == "stripes" and round_it),
        "repeats": rows or (shape == "ring" and (drawn or lattice)) or (shape == "torus" and drawn),
    }.get(name, True)


def cell_of(area: float) -> float:
    """The size of a built-in pattern on a surface of this area, if none is given."""
    return math.sqrt(area) / CELLS


def first_value(name: str, options: Any, area: float) -> float:
    """Where an option begins that was automatic until now: near the automatic value, in two digits."""
    size = options.size or cell_of(area) * (CELLS / 2 if options.pattern in DRAWN else 1.0)
    value = {"size": size, "bridge": BRIDGE * size, "height": RISE * size, "thickness": BRIDGE * size,
             "rows": 3, "repeats": 12}[name]  # fmt: skip
    return float(f"{value:.2g}")


@dataclasses.dataclass(frozen=True)
class LiftChoice:
    """How a pattern is brought onto a surface. 0 of a length: none is given.

    pattern  a built-in one, or the path of a file
    seams    cut the surface at its seams first
    cursor   the pattern lies around the hole nearest to the 3D cursor; on a sphere, around the vertex
    others   further keyword arguments of `koebe.lift`
    graded   vertex group with the sizes of outlines, or empty
    """

    pattern: str
    perforate: bool
    height: float = 0.0
    size: float = 0.0
    seams: bool = False
    cursor: bool = False
    others: dict[str, Any] = dataclasses.field(default_factory=dict)
    graded: str = ""

    def arguments(self, area: float, mirrored: bool) -> dict[str, Any]:
        """Keyword arguments of the solver for a surface of this area. On a mirrored one normals are turned over."""
        area = area if math.isfinite(area) else 1.0  # the solver says what is wrong
        found = {"pattern": self.pattern, "perforate": self.perforate, "size": self.size or None, **self.others}
        if not self.perforate:
            built_in = self.pattern in (*SPREAD, *LATTICES)
            cell = self.size if self.size and built_in else cell_of(area)
            height = self.height or min(RISE * cell, HIGHEST)
            found["height"] = -height if mirrored else height
        return found


@dataclasses.dataclass(frozen=True)
class Lifted:
    """A surface with a pattern on it: triangles.

    points         (n, 3) as of the surface
    original       (n,) vertex of the surface that has stayed there, or -1
    corner_vertex  (3 F,)
    uv             (3 F, 2) in 32 bits, or None of a solid
    patch          (F,) 2 for walls
    face           (F,) the surface's face below
    below          (3 F, 3) corners of the surface around each corner
    weights        (3 F, 3) of these: they sum to 1
    """

    points: np.ndarray
    original: np.ndarray
    corner_vertex: np.ndarray
    uv: np.ndarray | None
    patch: np.ndarray
    face: np.ndarray
    below: np.ndarray
    weights: np.ndarray
    outlines: int
    closed: bool
    converged: bool
    warnings: list[str]

    @property
    def corners(self) -> np.ndarray:
        """The corners (3 F,), in order."""
        return np.arange(len(self.corner_vertex))

    @property
    def face_size(self) -> np.ndarray:
        """Number (F,) of corners of each face."""
        return np.full(len(self.patch), 3)


@dataclasses.dataclass
class LiftOutcome:
    """What became of one object: its result, or the error and the island that has it.

    cursor  the place of the 3D cursor, if the pattern lies around it
    area    of the surface's largest part
    graded  (V,) sizes of outlines, as shares of the size
    """

    name: str
    surface: Surface
    mirrored: bool = False
    cursor: np.ndarray | None = None
    graded: np.ndarray | None = None
    lifted: Lifted | None = None
    error: Exception | None = None
    island: Island | None = None
    area: float = 0.0

    def line(self, perforate: bool) -> str:
        """One line on the result."""
        assert self.lifted is not None
        found = self.lifted
        done = "cut out" if perforate else "raised"
        what = f"{counted(found.outlines, 'outline')} {done}" if found.outlines else "the image is a relief"
        kind = ", a closed solid" if found.closed else ""
        return f"{self.name}: {what}; {len(found.patch):,} faces{kind}"

    def warnings(self) -> list[str]:
        """What to watch out for in the result."""
        assert self.lifted is not None
        return [*self.lifted.warnings, *["the map has not reached the tolerance"] * (not self.lifted.converged)]

    def reason(self) -> str:
        """Why there is no result."""
        return REASONS.get(kind_of(self.error) or "") or explain(self.error)

    def row(self) -> dict[str, Any]:
        """The row of the report in Blender, of an object without a result."""
        row: dict[str, Any] = {"object_name": self.name, "message": self.reason()}
        if self.island is not None:
            kind, elements = self._offending(self.island)
            row["offenders"] = [kind, elements.tolist()]
        return row

    def _offending(self, island: Island) -> tuple[str, np.ndarray]:
        """Kind and numbers of the elements to show."""
        of, elements = getattr(self.error, "of", ""), np.asarray(elements_of(self.error), dtype=np.int64)
        if kind_of(self.error) is None and len(elements):
            if of == FACES:
                return FACES, np.unique(island.triangle_face[elements])
            if of == VERTICES:
                return VERTICES, np.unique(island.source_vertex[elements])
        return offending_elements(self.surface, island, self.error)


def lift_surface(
    koebe: ModuleType, outcome: LiftOutcome, choice: LiftChoice, progress: Progress | None, cancel: Any
) -> None:
    """Lift the pattern onto every connected part of the outcome's surface. Raises the errors of `koebe.lift`; then
    `island` is the part that has the error."""
    surface = outcome.surface
    if not choice.seams:
        surface = dataclasses.replace(surface, seam=np.zeros_like(surface.seam))
    islands = cut_into_islands(surface)
    sizes = [len(island.triangles) for island in islands]
    around = (centers if choice.others.get("shape") == "sphere" else points)(islands, outcome.cursor)
    results = []
    with np.errstate(all="ignore"):  # a vertex may be no number
        areas = [float(island.areas.sum()) for island in islands]
    outcome.area = max(areas, default=0.0)
    for k, island in enumerate(islands):
        outcome.island = island
        graded = None if outcome.graded is None else outcome.graded[island.source_vertex]
        results.append(koebe.lift(
            island.vertices, island.triangles, progress=share_of(progress, sum(sizes[:k]), sizes[k], sum(sizes)),
            cancel=cancel, around=around[k], graded=graded, **choice.arguments(areas[k], outcome.mirrored),
        ))  # fmt: skip
    outcome.island = None
    outcome.lifted = _joined(surface, islands, results, outcome.mirrored)


def _joined(surface: Surface, islands: list[Island], results: list[Any], mirrored: bool) -> Lifted:
    """The results as one mesh."""
    starts = np.cumsum([0, *(len(result.vertices) for result in results)])
    triangles = np.concatenate([result.triangles + start for result, start in zip(results, starts, strict=False)])
    closed = all(result.closed for result in results)
    below, weights = _corners_below(surface, islands, results), np.concatenate([result.weights for result in results])
    if closed and mirrored:  # Blender shows a mirrored object's faces from their other side
        triangles, below, weights = (one[:, ::-1] for one in (triangles, below, weights))
    original = [
        np.where(result.original >= 0, island.source_vertex[result.original], -1)
        for island, result in zip(islands, results, strict=True)
    ]
    uv = None if closed else np.concatenate([result.uv for result in results]).reshape(-1, 2).astype(np.float32)
    warnings = [in_mesh(island, warning)["text"] for island, result in zip(islands, results, strict=True)
                for warning in of_solver(result)]  # fmt: skip
    return Lifted(
        np.concatenate([result.vertices for result in results]), np.concatenate(original),
        triangles.ravel(), uv, np.concatenate([result.patch for result in results]),
        np.concatenate([island.triangle_face[result.face] for island, result in zip(islands, results, strict=True)]),
        below.reshape(-1, 3), weights.reshape(-1, 3),
        sum(result.outlines for result in results), closed, all(result.converged for result in results),
        list(dict.fromkeys(warnings)),
    )  # fmt: skip


def _corners_below(surface: Surface, islands: list[Island], results: list[Any]) -> np.ndarray:
    """The surface's corners (F, 3, 3) of the triangle below each face, for each of its corners."""
    number = np.zeros(len(surface.face_size), dtype=np.int64)
    for k, island in enumerate(islands):
        number[island.faces] = k
    triangles = np.argsort(number[surface.triangle_face], kind="stable")  # those of an island are in order
    starts = np.cumsum([0, *(len(island.triangles) for island in islands)])
    own = [triangles[start + result.face] for start, result in zip(starts, results, strict=False)]
    return np.repeat(surface.triangle_corners[np.concatenate(own)][:, None], 3, axis=1)
