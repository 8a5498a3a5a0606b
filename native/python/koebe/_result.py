"""What a uniformization gives."""

import json
from typing import Any

import numpy as np

from ._arrays import as_loops
from ._native import _koebe


# What the elements of a warning are, by its kind: "vertices", "faces", "loops" or "none".
WARNING_ELEMENTS: dict[str, str] = dict(_koebe.warning_elements)


class Warning(dict):
    """What to watch out for: a dict of kind, elements and text, which are attributes too.

    kind       what it is about, one of the keys of koebe.WARNING_ELEMENTS
    elements   numbers of the input's vertices or faces, or of the result's loops, as WARNING_ELEMENTS says; rising
    text       a sentence for people
    """

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"Warning has no attribute '{name}'") from None

    @property
    def of(self) -> str:
        """What its elements are."""
        return WARNING_ELEMENTS[self["kind"]]

    def renumbered(self, number: Any) -> "Warning":
        """The same with number[e] for each element e: for whoever maps a part of a larger mesh. Rising, each once."""
        elements = np.unique(np.asarray(number)[self["elements"]]).tolist() if self["elements"] else []
        text = self["text"]
        if elements:
            before, said, after = text.rpartition(f" is {self['elements'][0]}")
            text = before + (f" is {elements[0]}" if said else "") + after
        return Warning(kind=self["kind"], elements=elements, text=text)

    def __str__(self) -> str:
        return self["text"]


class UniformizeResult:
    """A circle domain and its report.

    uv               (V, 2) float64, points of the closed unit disk in the input's vertex order; read-only
    loops            int32 arrays of vertices, the surface on the left, the outer loop first
    centers, radii   (L, 2) and (L,) circles in the unit disk
    roundness        (L,) the paper's e(gamma_k) before the final projection (section 5)
    off_circle       int32 arrays: vertices of each loop that are not on its circle
    history          one entry a step: step, pair, change, mean_roundness
    flipped, below_resolution    counts of faces, as in the command's JSON
    flipped_faces    int32 array of the faces that `flipped` counts, rising
    warnings         list of Warning: kind, elements, text
    """

    def __init__(self, native: "_koebe.UniformizeResult") -> None:
        self._report: dict[str, Any] = json.loads(native.to_json())
        self.uv: np.ndarray = native.uv
        self.uv.flags.writeable = False
        loops = self._report["loops"]
        self.loops = as_loops([loop["vertices"] for loop in loops])
        self.centers = np.array([loop["center"] for loop in loops])
        self.radii = np.array([loop["radius"] for loop in loops])
        self.roundness = np.array([loop["roundness"] for loop in loops])
        self.warnings = [Warning(warning) for warning in self._report["warnings"]]
        self.flipped_faces = np.array(native.flipped_faces, dtype=np.int32)
        self._native = native
        self.off_circle = as_loops([loop["off_circle"] for loop in loops])

    def __getattr__(self, name: str) -> Any:
        """The remaining fields of the report: converged, sweeps, steps, history, angle_error_deg, ..."""
        if name != "_report" and name in self._report:
            return self._report[name]
        raise AttributeError(f"UniformizeResult has no attribute '{name}'")

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict."""
        return json.loads(json.dumps(self._report))

    def __repr__(self) -> str:
        return (
            f"<koebe.UniformizeResult {self.vertices} vertices, {len(self.loops)} loops, "
            f"{self.sweeps} sweeps, angle error {self.angle_error_deg['mean']:.3g} deg, {self.flipped} flipped>"
        )
