# SPDX-License-Identifier: GPL-3.0-or-later
"""A surface mapped to the shape that serves: one disk where its texels are even enough, else parts."""

from types import ModuleType
from typing import Any

from .disk_outcomes import IslandOutcome, SurfaceOutcome
from .errors import kind_of
from .mapping import map_surfaces
from .options import Options, PartsChoice
from .outcomes import Outcome, Progress, Task, share_of
from .parts import cut_into_parts
from .wording import counted

# Least share of the area whose texels are within a factor 3, for a disk to be taken: an unrolled face has nine tenths,
# a mask with a deep back seven, a hand two.
LEAST_EVEN = 2.0 / 3.0
PARTS_WORK = 3  # of cutting into parts, where the map to a disk is 1
NO_DISK = {  # why a surface is no disk, by the kind of `koebe.TopologyError`
    "closed": "the surface is closed",
    "genus": "the surface has a handle",
    "nonmanifold_edge": "some edges have more than two faces",
    "nonmanifold_vertex": "some faces touch only in a vertex",
    "nonorientable": "the surface is one-sided",
}


def map_automatically(
    koebe: ModuleType,
    task: Task,
    options: Options,
    choice: PartsChoice,
    progress: Progress | None = None,
    cancel: Any = None,
) -> Outcome:
    """Map the selected faces of a surface to a disk for each island; where that does not serve, cut them into parts.

    options  of the disk, without cuts
    choice   of the parts

    The outcome says which was taken, and why. Where parts fail, the disk is taken if there is one. `koebe.Cancelled`
    goes on.
    """
    (disk,) = map_surfaces(koebe, [task], options, share_of(progress, 0, 1, PARTS_WORK + 1), cancel)
    reason = unserved(disk)
    if not reason:
        even = min(one.even_share for one in disk.mapped)
        disk.chosen = f"Automatic took Disk: texels are even on {_percent(even)} of the area"
        return disk
    parts = cut_into_parts(koebe, task, choice, share_of(progress, 1, PARTS_WORK, PARTS_WORK + 1), cancel)
    if parts.failed and not disk.failed:
        disk.chosen = "Automatic took Disk, because the surface could not be cut into parts"
        return disk
    parts.chosen = f"Automatic took Parts: {reason}"
    return parts


def unserved(disk: SurfaceOutcome) -> str:
    """Why a disk does not serve this surface, or nothing."""
    for one in disk.islands:
        if one.error is not None:
            return NO_DISK.get(kind_of(one.error) or "", "the surface cannot be mapped to one disk")
        if reason := _bad(one):
            return reason
    return "" if disk.islands else "the surface cannot be mapped to one disk"


def _bad(one: IslandOutcome) -> str:
    """Why nobody wants a mapped island, or nothing."""
    if not one.result.converged:
        return "a disk could not be made round"
    if len(one.flipped):
        return f"a disk has no room for {counted(len(one.flipped), 'triangle')}"
    if one.even_share < LEAST_EVEN:
        return f"a disk has even texels on only {_percent(one.even_share)} of the area"
    return ""


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f} %"
