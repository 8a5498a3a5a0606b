"""The options of the maps for type checkers, equal to the table options.json (tests compare them)."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypedDict

from ._native import _koebe

Progress = Callable[[float, str], Any]
Rims = Literal["smooth", "polygonal"]


class SurfaceOptions(TypedDict, total=False):
    """What says which part of the surface is meant."""

    mask: Any


class RunOptions(SurfaceOptions, total=False):
    """Options of each call that takes a while."""

    progress: Progress | None
    cancel: "_koebe.CancelToken | None"


class MapOptions(SurfaceOptions, total=False):
    """Options of all maps."""

    most_lost: float


class SweepOptions(MapOptions, total=False):
    """Options of all maps that iterate."""

    tolerance: float
    max_sweeps: int


class SequenceOptions(SweepOptions, total=False):
    """Options of `Surface`."""

    method: Literal["gk", "ck", "against-outer"]
    outer: Literal["auto", "longest"] | int
    center: int | None
    point: int | None
    balance: Literal["none", "area"]
    importance: Any
    polygon: Any
    polish: bool
    threads: int
    weld: float | None


class UniformizeOptions(SequenceOptions, RunOptions, total=False):
    """Options of `uniformize`, except `cut`."""

    engine: Literal["condensed", "mesh"]
    even: float
    loops: Literal["auto", "round", "free"]
    partners: Literal["fixed", "changing"]
    schedule: Sequence[Sequence[int]] | None
    metric: Literal["first", "planar", "reflected", "reflected-last"]
    annulus: Literal["harmonic", "yamabe"]
    record_steps: bool


class TileOptions(SweepOptions, RunOptions, total=False):
    """Options of all maps but the map to the disk."""

    weld: float | None
    polygon: Any


class TorusOptions(TileOptions, total=False):
    """Options of `torus_map`."""

    even: float
    importance: Any
    loops: Literal["auto", "round", "free"]


class RingOptions(TorusOptions, total=False):
    """Options of `ring_map`."""

    outer: int | None
    inner: int | None
    holes: Literal["circles", "concentric", "radial"]


class SphereOptions(TileOptions, total=False):
    """Options of `sphere_map`."""

    even: float
    layout: Literal["equirectangular", "octahedral"]
    threads: int


class SchottkyOptions(TileOptions, total=False):
    """Options of `schottky_map`."""

    normalization: Literal["area", "circles"]


class PartsOptions(MapOptions, RunOptions, total=False):
    """Options of `parts`."""

    even: float | None
    loops: Literal["auto", "round", "free"]
    darts: float
    density: float | None
    pixels: int
    tiles: int
    stack: bool
    importance: Any
    show: Any
    price: float | None
    cut: bool
    round_cuts: bool
    weld: float | None
    polygon: Any
    slits: Any


class FlattenOptions(RunOptions, total=False):
    """Options of `flatten`."""

    units: Literal["mm", "cm", "m", "in"]
    page: str
    allowance: float
    price: float | None
    darts: float
    weld: float | None
    polygon: Any


class LiftOptions(RunOptions, total=False):
    """Options of `lift`."""

    shape: Literal["disk", "ring", "torus", "sphere", "parts"]
    even: float | None
    size: float | None
    bridge: float | None
    repeats: int
    seed: int
    turn: float
    around: int | None
    rows: int
    rim: Literal["leave", "clip", "whole"]
    graded: Any
    perforate: bool
    height: float | None
    thickness: float | None
    weld: float | None


class CertifiedOptions(RunOptions, total=False):
    """Options of `certified_moduli`."""

    weld: float | None
    width: float | None
    max_faces: int
    threads: int
    between: Any


class FitOptions(RunOptions, total=False):
    """Options of `fit_circles`."""

    tolerance: float
    max_sweeps: int
    threads: int
    weld: float | None
    names: Sequence[str] | None
    pins: Mapping[int, tuple[int, float]] | None
    fixed: Sequence[int]
    extremal: bool
