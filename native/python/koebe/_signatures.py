"""The options of the maps as type checkers know them: those of the table, options.json (tests hold them together)."""

from collections.abc import Callable, Sequence
from typing import Any, TypedDict

from ._native import _koebe

Progress = Callable[[float, str], Any]


class RunOptions(TypedDict, total=False):
    """Of each call that takes a while."""

    progress: Progress | None
    cancel: "_koebe.CancelToken | None"


class MapOptions(TypedDict, total=False):
    """Of all maps."""

    most_lost: float


class SweepOptions(MapOptions, total=False):
    """Of all maps that iterate."""

    tolerance: float
    max_sweeps: int


class SequenceOptions(SweepOptions, total=False):
    """Of `Surface`."""

    method: str
    outer: str | int
    center: int | None
    point: int | None
    balance: str
    importance: Any
    polish: bool
    threads: int


class UniformizeOptions(SequenceOptions, RunOptions, total=False):
    """Of `uniformize`, but for `cut`."""

    engine: str
    even: float
    loops: str
    partners: str
    schedule: Sequence[Sequence[int]] | None
    metric: str
    annulus: str
    record_steps: bool


class TileOptions(SweepOptions, RunOptions, total=False):
    """Of all maps but that to the disk."""

    polygon: Any


class TorusOptions(TileOptions, total=False):
    """Of `torus_map`."""

    even: float
    loops: str


class RingOptions(TorusOptions, total=False):
    """Of `ring_map`."""

    outer: int | None
    inner: int | None
    holes: str


class SphereOptions(TileOptions, total=False):
    """Of `sphere_map`."""

    layout: str


class SchottkyOptions(TileOptions, total=False):
    """Of `schottky_map`."""

    normalization: str


class PartsOptions(MapOptions, RunOptions, total=False):
    """Of `parts`."""

    even: float | None
    loops: str
    darts: float
    price: float | None
    cut: bool
    round_cuts: bool
    polygon: Any
    slits: Any
