# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcome of a surface whose islands are mapped to circle domains."""

import dataclasses
import functools
from typing import TYPE_CHECKING, Any

import numpy as np

from ..layers.mirror import Symmetry
from ..layers.packing import Placement
from ..surfaces.opening import Opening
from ..surfaces.rounding import RESOLUTION, rounded
from ..surfaces.stored import Stored
from ..surfaces.surface import Island
from ..surfaces.triangles import as_complex, as_points, covered, density_ratio, longest_edges, signed_areas
from .outcomes import LATER, Outcome, in_numbers
from .warning_words import of_solver
from .wording import UNEVEN_TEXELS, counted, cut_edges, cut_line, density_text, few, in_mesh, own_warning, too_uneven

if TYPE_CHECKING:
    from koebe import UniformizeResult

# The solver's warning about its 32-bit disk; it does not apply to a rectangle made of the disk.
OF_THE_DISK = "below_resolution"


@dataclasses.dataclass
class IslandOutcome:
    """The outcome of one island: a result of `koebe.uniformize` with shape and place, or an error.

    sheet       the island with the vertices that have UVs: itself, or cut open if it was unrolled
    shape       (n, 2) these vertices before placement, in the unit disk: the result's disk, or a rectangle
    turn        complex number of modulus 1 that turns the shape about 0
    distortion  `koebe.distortion` of the shape, if it is not the result's
    stored      the map as stored in the UVs
    lost        the first sentence if more area is lost in the UVs than allowed, or empty
    places      the requested vertices, by the solver's names: center, point
    opening     the cuts that made this piece, with others, or None
    symmetry    the island made symmetric, or None
    pins        places of the sheet's pinned vertices, which its placement has brought there
    remark      why a requested step was not done, or empty
    has_circles whether its loops are held on circles
    """

    island: Island
    result: "UniformizeResult" = LATER
    error: Exception | None = None
    sheet: Island = LATER
    shape: np.ndarray = LATER
    turn: complex = 1.0
    distortion: dict[str, Any] | None = None
    stored: Stored = LATER
    lost: str = ""
    placement: Placement = LATER
    places: dict[str, Any] = dataclasses.field(default_factory=dict)
    opening: Opening | None = None
    symmetry: Symmetry | None = None
    pins: dict[int, tuple[float, float]] = dataclasses.field(default_factory=dict)
    remark: str = ""
    has_circles: bool = True

    @property
    def unrolled(self) -> bool:
        """Whether it is a rectangle: then the UVs do not show its circles."""
        return self.sheet is not self.island

    @property
    def angle_error(self) -> float:
        """Mean difference, in degrees, of the triangles' angles on the surface and in the map, or in its stored UVs."""
        if self.stored is not None:
            return self.stored.angle_error
        return (self.distortion["angle_error_deg"] if self.distortion else self.result.angle_error_deg)["mean"]

    @functools.cached_property
    def density_ratio(self) -> float:
        """Texel density (a length over a length) at 95 % of the area over the density at 5 %."""
        return density_ratio(self.sheet.areas, np.abs(signed_areas(self.shape, self.sheet.triangles)))

    def turned(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) of the shape after the turn."""
        if self.turn == 1.0:
            return points
        return as_points(self.turn * as_complex(points))

    @functools.cached_property
    def flat(self) -> np.ndarray:
        """The sheet's vertices (n, 2) after the turn, in the unit disk."""
        return self.turned(self.shape)

    @functools.cached_property
    def _rounded(self) -> tuple[np.ndarray, np.ndarray]:
        points = self.placement.apply(self.flat)
        for vertex, place in self.pins.items():
            points[vertex] = place
        return rounded(points, self.sheet.triangles, self.pins)

    @property
    def uv(self) -> np.ndarray:
        """UV coordinates (n, 2) of the sheet's vertices, in 32 bits as Blender keeps them."""
        return self._rounded[0] if self.symmetry is None else self.symmetry.image.uv

    @property
    def flipped(self) -> np.ndarray:
        """The triangles (k,) of the sheet whose signed area in the UVs is not positive."""
        return self._rounded[1] if self.symmetry is None else self.symmetry.image.flipped

    @property
    def flipped_faces(self) -> np.ndarray:
        """Faces of the surface with such triangles."""
        return np.unique(self.sheet.triangle_face[self.flipped])

    def circles(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres (k, 2) and radii (k,) of the loops' circles in the UVs; meaningless for a rectangle."""
        if self.symmetry is not None:
            domain, loops = self.symmetry.image.domain, self.symmetry.image.loops
            centers = domain.placed(np.array([loop.center for loop in loops]))
            return centers, domain.scale * np.array([loop.radius for loop in loops])
        return self.placement.apply(self.turned(self.result.centers)), self.placement.scale * self.result.radii


class SurfaceOutcome(Outcome):
    """The outcome of one surface, each island a circle domain."""

    islands: list[IslandOutcome]

    @property
    def lost(self) -> list[IslandOutcome]:
        """The mapped islands that lose more area in the UVs than allowed."""
        return [outcome for outcome in self.mapped if outcome.lost]

    @property
    def is_good(self) -> bool:
        return self.converged and not self.lost

    @property
    def mean_angle_error(self) -> float:
        """Mean angle error of the mapped islands, in degrees."""
        sizes = [len(one.island.triangles) for one in self.mapped]
        return sum(one.angle_error * size for one, size in zip(self.mapped, sizes, strict=True)) / sum(sizes)

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        corners = [outcome.sheet.corners for outcome in self.mapped]
        uv = [outcome.uv.take(outcome.sheet.corner_vertex, axis=0) for outcome in self.mapped]
        openings = self.openings
        if len(uv) == 1 and not openings:
            return corners[0], uv[0]
        return _with_copied(np.concatenate(corners), np.concatenate(uv), openings)

    @property
    def openings(self) -> list[Opening]:
        """The cuts, for each island that was cut."""
        return list({id(one.opening): one.opening for one in self.islands if one.opening is not None}.values())

    def line(self) -> str:
        """One line: loops, evenness, angle error, flips, seconds."""
        results = [one.result for one in self.mapped]
        words = [
            counted(sum(len(r.loops) for r in results), "loop"),
            f"texel density 1 : {density_text(max(one.density_ratio for one in self.mapped))}",
            f"angle error {self.mean_angle_error:.2f}°",
            counted(sum(len(one.flipped) for one in self.mapped), "flip"),
            f"{sum(r.seconds['total'] for r in results):.2f} s",
        ]
        if len(results) > 1:
            words.insert(0, counted(len(results), "island"))
        if self.lost:
            words.insert(0, f"LOST {max(100.0 * one.stored.lost_area for one in self.lost):.2g} % OF THE AREA")
        if not self.converged:
            words.append("NOT CONVERGED")
        edges = sum(cut_edges(opening) for opening in self.openings)
        if edges:
            words.append(f"cut along {counted(edges, 'edge')}")
        if any(too_uneven(one) for one in self.mapped):
            words.append(UNEVEN_TEXELS)
        return f"{self.name}: {', '.join(words)}"

    def warnings(self, one: IslandOutcome) -> list[dict[str, Any]]:
        native = [
            in_mesh(one.island, warning)
            for warning in of_solver(one.result)
            if warning.kind != "lost_area" and not (one.unrolled and warning.kind == OF_THE_DISK)
        ]
        lost = own_warning("lost_area", one.lost, one.flipped_faces if one.lost else ())
        return [*[lost] * bool(one.lost), *native, *self._own_warnings()]

    def notes(self) -> list[tuple[IslandOutcome, str]]:
        """Notes on the mapped islands, beside their maps, each once: cuts, symmetry."""
        found: list[tuple[IslandOutcome, str]] = []
        said: set[int] = set()
        for one in self.mapped:
            if one.opening is not None and id(one.opening) not in said:
                said.add(id(one.opening))
                found.append((one, cut_line(one.opening)))
            if one.symmetry is not None:
                moved = f"moved by {one.symmetry.moved:.1e} at most"
                found.append((one, f"made symmetric, {counted(one.symmetry.pairs, 'pair')} of vertices, {moved}"))
            elif one.remark:
                found.append((one, one.remark))
        return found

    def said_notes(self) -> list[str]:
        """All notes in one list."""
        said = few(super().said_notes(), "; ")
        return [said] if said else []

    def entries(self) -> list[dict[str, Any]]:
        """As in `Outcome`. A piece of a cut island has the number of the cut, and the first such piece has the cuts."""
        numbers = {id(opening): number for number, opening in enumerate(self.openings)}
        said: set[int] = set()
        result = super().entries()
        for one, entry in zip(self.islands, result, strict=True):
            if one.opening is not None:
                entry["opening"] = numbers[id(one.opening)]
                if id(one.opening) not in said:
                    entry.update(_cuts(one.opening))
                said.add(id(one.opening))
        return result

    def _entry(self, index: int, one: IslandOutcome) -> dict[str, Any]:
        entry = self._head(index, one, len(one.island.faces))
        if one.error is not None:
            return entry
        result = one.result.to_dict()
        source = one.island.source_vertex
        for name in {"center", "point"} & result.keys():
            result[name] = int(source[result[name]])
        in_numbers(result["loops"], source, "vertices", "off_circle")
        if one.symmetry is not None:
            for loop, made in zip(result["loops"], one.symmetry.image.loops, strict=True):
                loop["center"], loop["radius"] = [made.center.real, made.center.imag], made.radius
            result["symmetric"] = True
        elif not one.unrolled:
            for loop in result["loops"]:
                loop["center"] = one.turned(np.array([loop["center"]]))[0].tolist()
        if one.remark:
            result["remark"] = one.remark
        result.update(one.distortion or {})
        result.update(one.stored.figures())
        result["unrolled"] = one.unrolled
        result["warnings"] = self.warnings(one)
        result["flipped"] = len(one.flipped)  # of the written UVs: turned, placed and rounded
        result["below_resolution"] = _below_resolution(one)
        return {**result, **entry, "placement": one.placement.to_dict()}

    def _row(self, one: IslandOutcome) -> dict[str, Any]:
        result = one.result
        return {
            "sweeps": result.sweeps, "angle_error": one.angle_error, "roundness": float(result.roundness.max()),
            "flipped": len(one.flipped), "flipped_faces": one.flipped_faces.tolist(),
            "seconds": result.seconds["total"], "uneven": too_uneven(one), "even": result.even,
            "density": one.density_ratio, "coverage": covered(one.uv, one.sheet.triangles),
            "loops": [
                {
                    "uv_center": center, "uv_radius": float(uv_radius) if one.has_circles and not one.unrolled else 0.0,
                    "vertices": one.island.source_vertex[vertices].tolist(),
                    "radius": float(radius), "roundness": float(roundness),
                }
                for vertices, center, uv_radius, radius, roundness in zip(
                    result.loops, *one.circles(), result.radii, result.roundness, strict=True
                )
            ],
        }  # fmt: skip

    def rows(self, layer: str) -> list[dict[str, Any]]:
        """As in `Outcome`. The first mapped piece of a cut island has its cuts."""
        result, said = super().rows(layer), set[int]()
        for one, row in zip([] if self.not_written else self.islands, result):
            if one.error is None and one.opening is not None and id(one.opening) not in said:
                said.add(id(one.opening))
                row["cuts"] = _paths(one.opening)
        return result


def _cuts(opening: Opening) -> dict[str, Any]:
    """The cuts in the mesh's numbers."""
    return {
        "cuts": [{"kind": kind, "elements": vertices.tolist()} for kind, vertices in opening.cuts],
        "handles_cut": opening.handles,
        "turned": opening.turned.tolist(),
        "left_out": opening.left_out.tolist(),
        "cut_text": cut_line(opening),
    }


def _paths(opening: Opening) -> list[list[int]]:
    """Vertices along each cut; each bow tie by itself."""
    return [
        path
        for kind, vertices in opening.cuts
        for path in ([[v] for v in vertices.tolist()] if kind == "bow_tie" else [vertices.tolist()])
    ]


def _below_resolution(one: IslandOutcome) -> int:
    """Flipped triangles whose longest edge in the UVs is too short to be drawn."""
    corners = one.uv[one.sheet.triangles[one.flipped]].astype(np.float64)
    return int(np.count_nonzero(longest_edges(corners) < RESOLUTION))


def _with_copied(corners: np.ndarray, uv: np.ndarray, openings: list[Opening]) -> tuple[np.ndarray, np.ndarray]:
    """The corners with those that take their places, if these are mapped."""
    copied = [opening.copied for opening in openings if len(opening.copied[0])]
    if not copied:
        return corners, uv
    here, there = (np.concatenate(each) for each in zip(*copied))
    row = np.full(int(max(corners.max(), there.max())) + 1, -1, dtype=np.int64)
    row[corners] = np.arange(len(corners))
    known = row[there] >= 0
    return np.concatenate([corners, here[known]]), np.concatenate([uv, uv[row[there[known]]]])
