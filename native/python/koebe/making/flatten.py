"""Cuts surfaces into flat patterns in real size."""

from typing import Any

import numpy as np

from .._native import _koebe
from .._options import takes
from .._signatures import FlattenOptions, Unpack
from .._types import Bools, Floats, Ints
from ..maps.domain_map import DomainMap, domain_map
from ..maps.source import Source


class FlattenResult(DomainMap):
    """The result of `flatten`. Lengths are in millimetres, stretches in per cent.

    uv               (F, 3, 2) float64: where each corner of each triangle lies on its sheet, from the lower left corner
                     of the sheet's frame; read-only
    part             (F,) int32: the piece of each triangle, from 0; -1 for triangles in no piece
    pieces           for each piece a dict: kind, faces, size_mm, outline_mm, darts, sheet (from 0), stretch_percent
    seams            for each seam, numbered from 1 in the drawing, a dict: pieces (on its sides, from 1), length_mm (on
                     the surface), lengths_mm (of its sides), closed
    stretch_percent  mean and max: how much lengths in a face differ from those on the surface
    cut_length_mm, darts    of all seams, and the number of darts
    pages, page_mm   their number, and the size of each; 0 without pages
    sheets           for each sheet a dict: size_mm (of its frames), columns and rows of pages, labels: the numbers of
                     seams ("1", on all sides) and pieces ("P1"), each a dict: text, piece (from 1), at_mm (the text's
                     middle), height_mm (of capitals), angle_deg (counter-clockwise)
    svg              list of SVG documents, one a page
    dxf              the text of a DXF file (R12)
    converged, angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, seconds, peak_memory_mb, warnings, version    as in MapReport; the area of
                     pieces that were left out is lost
    """

    part: Ints
    pieces: list[dict[str, Any]]
    seams: list[dict[str, Any]]
    stretch_percent: dict[str, float]
    cut_length_mm: float
    darts: int
    pages: int
    page_mm: list[float]
    sheets: list[dict[str, Any]]
    svg: list[str]
    dxf: str

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        self._set(part=native.part)
        self._set(svg=[str(page) for page in native.svg], dxf=str(native.dxf))

    def _arrays(self) -> dict[str, Any]:
        return {**super()._arrays(), "part": self.part, "svg": np.array(self.svg, str), "dxf": np.array(self.dxf)}

    def _drawn(self) -> Bools:
        return self.part >= 0

    def _layout(self) -> tuple[Floats, float]:
        """The sheets side by side."""
        widths = [sheet["size_mm"][0] for sheet in self.sheets]
        begin = np.cumsum([0.0, *widths])
        shift = np.array([begin[piece["sheet"]] for piece in self.pieces] + [0.0])  # the last one: of no piece
        return self.uv + np.stack([shift, 0.0 * shift], axis=1)[self.part][:, None], float(begin[-1])

    def _counts(self) -> list[str]:
        return [f"{len(self.pieces)} pieces", f"{self.pages} pages", f"stretch {self.stretch_percent['mean']:.3g} %"]


@takes("flatten", polygon=None, progress=None, cancel=None)
def flatten(vertices: Any, triangles: Any = None, **given: "Unpack[FlattenOptions]") -> FlattenResult:
    """Cut a surface into a flat pattern in real size, for cloth, leather, paper or sheet metal.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both, whose polygons stay whole
    {options}
    polygon      (F,) integers: triangles of one number are one polygon and stay together. None: the polygons of the
                 mesh, or with arrays each triangle by itself
    mask, progress, cancel    as for `uniformize`
    Each piece is as true to size as it can be, as with even=1 and loops='free' of `parts`; no piece overlaps itself or
    another. Write the drawing with, for example, Path('pattern.svg').write_text(result.svg[0], 'utf-8').
    Raises InputError (OptionError for an option), SolverError, Cancelled, or MemoryError.

    >>> import koebe
    >>> pattern = koebe.flatten("docs/link.obj", units="cm", page="A2")
    >>> print(len(pattern.pieces), "piece,", pattern.pages, "page,", "<svg" in pattern.svg[0])
    1 piece, 1 page, True
    """
    surface, options = (vertices, triangles), _koebe.FlattenOptions()
    return domain_map(FlattenResult, _koebe.flatten, "flatten", options, given, surface, degenerate=True)
