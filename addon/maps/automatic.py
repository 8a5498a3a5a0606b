# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface mapped to the shape that serves: one disk if it has holes to make round and the report has nothing against
it, else parts: they keep flat sheets, grids and rims as they are."""

import dataclasses
from types import ModuleType
from typing import Any

from ..surfaces.errors import kind_of
from .disk_outcomes import SurfaceOutcome
from .mapping import map_surfaces
from .options import Options, PartsChoice
from .outcomes import Outcome, Progress, Task, share_of
from .parts import PartsOutcome, cut_into_parts
from .verdicts import EVEN, TRUE
from .wording import counted, density_text

PARTS_WORK = 3  # of cutting into parts, where the map to a disk is 1
PINNED = "they keep the pinned UVs where they are"
NO_HOLES = "there is no hole to make round"
NO_DISK = {  # why a surface is no disk, by the kind of `koebe.TopologyError`
    "closed": "the surface is closed",
    "genus": "the surface has a handle",
    "nonmanifold_edge": "some edges have more than two faces",
    "nonmanifold_vertex": "some faces touch only in a vertex",
    "nonorientable": "the surface is one-sided",
}


@dataclasses.dataclass(frozen=True)
class Worth:
    """What the report says of a map, its worst island first: its limits are those of `verdicts`."""

    whole: bool
    flipped: int
    density: float
    angle: float

    @property
    def order(self) -> tuple[bool, bool, bool, float]:
        """The smaller, the better: faults in the order of their weight, then how far beyond its limit the worst
        figure is."""
        return (
            not self.whole or self.flipped > 0, self.density > EVEN, self.angle > TRUE,
            max(self.density / EVEN, self.angle / TRUE),
        )  # fmt: skip

    @property
    def fault(self) -> str:
        """What the report has against a disk, or nothing."""
        if not self.whole:
            return "a disk could not be made round"
        if self.flipped:
            return f"in one disk {counted(self.flipped, 'triangle')} would be turned over"
        if self.density > EVEN:
            return f"the texels of a disk are uneven, 1 : {density_text(self.density)}"
        return f"a disk bends the checker by {self.angle:.1f}°" if self.angle > TRUE else ""


def map_automatically(
    koebe: ModuleType,
    task: Task,
    options: Options,
    choice: PartsChoice,
    progress: Progress | None = None,
    cancel: Any = None,
) -> Outcome:
    """Map the selected faces of a surface to a disk for each island. If that does not serve, cut them into parts.

    options  of the disk, without cuts
    choice   of the parts

    The outcome says which was taken, and why. A disk that does not serve is taken if parts fail, or are worse.
    `koebe.Cancelled` goes on.
    """
    # Disks keep no pins.
    if task.pins is not None:
        parts = cut_into_parts(koebe, task, choice, progress, cancel)
        parts.chosen = f"Automatic took Parts: {PINNED}"
        return parts
    # A disk takes a fraction of the time of parts, so it is first.
    (disk,) = map_surfaces(koebe, [task], options, share_of(progress, 0, 1, PARTS_WORK + 1), cancel)
    reason = unserved(disk)
    if not reason:
        disk.chosen = f"Automatic took Disk: its texels are even, 1 : {density_text(worth_of_disk(disk).density)}"
        return disk
    parts = cut_into_parts(koebe, task, choice, share_of(progress, 1, PARTS_WORK, PARTS_WORK + 1), cancel)
    if not disk.failed:
        if parts.failed:
            disk.chosen = "Automatic took Disk: the surface could not be cut into parts"
            return disk
        ours, theirs = worth_of_disk(disk).order, worth_of_parts(parts).order
        if ours < theirs if has_holes(disk) else ours[0] < theirs[0]:
            disk.chosen = "Automatic took Disk: cut into parts, texels and angles would be no better"
            return disk
    parts.chosen = f"Automatic took Parts: {reason}"
    return parts


def unserved(disk: SurfaceOutcome) -> str:
    """Why a disk does not serve this surface, or nothing."""
    for one in disk.islands:
        if one.error is not None:
            return NO_DISK.get(kind_of(one.error) or "", "the surface cannot be mapped to one disk")
    if not disk.islands:
        return "the surface cannot be mapped to one disk"
    return worth_of_disk(disk).fault or ("" if has_holes(disk) else NO_HOLES)


def has_holes(disk: SurfaceOutcome) -> bool:
    """Whether an island that is mapped has a hole."""
    return any(len(one.result.loops) > 1 for one in disk.mapped)


def worth_of_disk(disk: SurfaceOutcome) -> Worth:
    """The worth of a surface whose islands are all mapped."""
    return Worth(
        disk.converged,
        sum(len(one.flipped) for one in disk.mapped),
        max(one.density_ratio for one in disk.mapped),
        max(one.angle_error for one in disk.mapped),
    )


def worth_of_parts(parts: PartsOutcome) -> Worth:
    """The worth of a surface that is mapped."""
    result = parts.mapped[0].result
    return Worth(
        parts.converged, result.flipped, result.density_ratio_5_95, result.angle_error_stored_deg["mean"]
    )
