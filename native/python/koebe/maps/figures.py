"""The figures of a map's report, and their units."""

from typing import TypedDict


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
    """log of (UV area / surface area), area-weighted on the surface, minus its mean: 0 is even texel density."""

    log_sd: float
    log_min: float
    log_max: float


class _AreaBeforeBalance(TypedDict, total=False):
    before_balance: LogAreaRatio


class AreaDistortion(LogAreaRatio, _AreaBeforeBalance):
    """before_balance is measured before `balance`, on this map's outer loop: the value of a call without balance,
    unless that call has faces to turn back."""


class Step(TypedDict):
    """A step of the Koebe iteration: the loops it opened, the change of all circles, the mean e(gamma_k) after it.

    mean_roundness_holes is the mean without the outer loop.
    """

    step: int
    pair: list[int]
    change: float
    mean_roundness: float
    mean_roundness_holes: float


class MeanOverLoops(TypedDict):
    """Means over all loops, and over the holes: all loops but the outer one; 0 without loops."""

    all: float
    holes: float


class MeanRoundness(MeanOverLoops):
    """Means of the paper's e(gamma_k), and of `roundness_least_squares`."""

    least_squares: MeanOverLoops


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
