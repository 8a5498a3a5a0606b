"""What a uniformization gives."""

import copy
from typing import Any, TypedDict

import numpy as np

from ._arrays import as_loops
from ._native import _koebe

# UV units: a face whose longest edge is shorter is below the resolution of 32-bit UVs.
UV_RESOLUTION: float = _koebe.uv_resolution
# Disk units: how far from its circle a loop vertex may lie to count as on it.
CIRCLE_TOLERANCE: float = _koebe.circle_tolerance
# What the elements of a warning are, by its kind: "vertices", "faces", "loops" or "none".
WARNING_ELEMENTS: dict[str, str] = dict(_koebe.warning_elements)


class Warning(dict[str, Any]):
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


class _AngleErrorBeforePolish(TypedDict, total=False):
    before_polish: float


class AngleError(_AngleErrorBeforePolish):
    """Degrees, |angle in UV - angle on the surface| over all corners; before_polish is the mean without `polish`."""

    mean: float
    sd: float
    max: float


class Beltrami(TypedDict):
    """|mu| of the face-wise linear maps, dimensionless."""

    mean: float
    max: float


class LogAreaRatio(TypedDict):
    """log of (UV area / surface area), area-weighted on the surface, its mean subtracted: 0 is even texel density."""

    log_sd: float
    log_min: float
    log_max: float


class _AreaBeforeBalance(TypedDict, total=False):
    before_balance: LogAreaRatio


class AreaDistortion(LogAreaRatio, _AreaBeforeBalance):
    """before_balance is the same without `balance`."""


class Step(TypedDict):
    """A step of the Koebe iteration: the loops it opened, the change of all circles, the mean e(gamma_k) after it."""

    step: int
    pair: list[int]
    change: float
    mean_roundness: float


class Seconds(TypedDict):
    """Time of each stage."""

    read: float
    topology: float
    metric: float
    factor: float
    iterate: float
    finish: float
    write: float
    total: float


class UniformizeResult:
    """A circle domain and its report.

    uv               (V, 2) float64, points of the closed unit disk in the input's vertex order; read-only
    loops            int32 arrays of vertices, the surface on the left, the outer loop first
    centers, radii   (L, 2) and (L,) circles in the unit disk
    roundness        (L,) the paper's e(gamma_k) before the final projection (section 5)
    off_circle       int32 arrays: vertices of each loop that are not on its circle
    vertices, faces  their counts
    method, engine   as chosen
    outer_loop       which of boundary_loops(triangles) is the outer one
    center, point    vertices at 0 and at 1, as they were asked for, or None
    converged, sweeps, steps     of the iteration
    history          one entry a step: step, pair, change, mean_roundness
    angle_error_deg, beltrami, area_distortion, conformal_energy    as the types of this module say
    flipped, below_resolution    counts of faces, as in the command's JSON
    flipped_faces    int32 array of the faces that `flipped` counts, rising
    seconds          of each stage
    peak_memory_mb   of the process
    warnings         list of Warning: kind, elements, text
    """

    uv: np.ndarray
    loops: list[np.ndarray]
    centers: np.ndarray
    radii: np.ndarray
    roundness: np.ndarray
    off_circle: list[np.ndarray]
    vertices: int
    faces: int
    method: str
    engine: str
    outer_loop: int
    center: int | None = None
    point: int | None = None
    converged: bool
    sweeps: int
    steps: int
    history: list[Step]
    angle_error_deg: AngleError
    beltrami: Beltrami
    area_distortion: AreaDistortion
    conformal_energy: float
    flipped: int
    below_resolution: int
    flipped_faces: np.ndarray
    seconds: Seconds
    peak_memory_mb: float
    warnings: list[Warning]

    def __init__(self, native: "_koebe.UniformizeResult") -> None:
        report: dict[str, Any] = native.report()
        self._native = native
        self._report = report
        loops = report["loops"]
        vars(self).update({name: value for name, value in report.items() if name not in {"version", "input"}})
        self.uv = native.uv
        self.uv.flags.writeable = False
        self.loops = as_loops([loop["vertices"] for loop in loops])
        self.centers = np.array([loop["center"] for loop in loops])
        self.radii = np.array([loop["radius"] for loop in loops])
        self.roundness = np.array([loop["roundness"] for loop in loops])
        self.off_circle = as_loops([loop["off_circle"] for loop in loops])
        self.flipped_faces = np.array(native.flipped_faces, dtype=np.int32)
        self.warnings = [Warning(warning) for warning in report["warnings"]]

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict."""
        return copy.deepcopy(self._report)

    def __repr__(self) -> str:
        return (
            f"<koebe.UniformizeResult {self.vertices} vertices, {len(self.loops)} loops, "
            f"{self.sweeps} sweeps, angle error {self.angle_error_deg['mean']:.3g} deg, {self.flipped} flipped>"
        )
