# SPDX-License-Identifier: GPL-3.0-or-later
"""The text of every result, reason and warning: what the report, the status line and the command line say."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import elements_of, kind_of
from .outcomes import IslandOutcome, SurfaceOutcome, Task
from .surface import Island

if TYPE_CHECKING:
    import koebe

# What is wrong, and what an artist can do about it, by the kind of `koebe.TopologyError`.
REASONS = {
    "closed": "the surface is closed: mark a seam or delete a face, so that it has a boundary",
    "genus": "the surface has a handle ({detail}): mark a seam along it, so that it opens",
    "nonmanifold_edge": "{pairs} with more than two faces: delete the surplus faces or mark those edges as seams",
    "nonmanifold_vertex": "{vertices} where separate parts of it touch: split them",
    "nonorientable": "the surface is one-sided, like a Möbius strip: mark a seam across it",
}
PINNED = "its pins are not kept: a map to a circle domain leaves nothing that a pin could hold"
MIRRORED = "the object's scale is negative: textures show mirrored until it is applied"
FEW = 6  # reasons in one message, which has to fit on the screen
# The kind of warning that the solver gives of its disk in 32 bits; it does not hold for the rectangle made of it.
OF_THE_DISK = "below_resolution"


def result_line(outcome: SurfaceOutcome) -> str:
    """One line on a surface: loops, sweeps, roundness, angle error, flips, seconds."""
    results = [one.result for one in outcome.mapped]
    triangles = np.array([len(one.island.triangles) for one in outcome.mapped], dtype=float)
    angle = sum(one.angle_error * t for one, t in zip(outcome.mapped, triangles)) / triangles.sum()
    words = [
        counted(sum(len(r.loops) for r in results), "loop"),
        counted(max(r.sweeps for r in results), "sweep"),
        f"roundness {max(float(np.max(r.roundness)) for r in results):.1e}",
        f"angle error {angle:.2f}°",
        counted(sum(len(one.flipped) for one in outcome.mapped), "flip"),
        f"{sum(r.seconds['total'] for r in results):.2f} s",
    ]
    if len(results) > 1:
        words.insert(0, counted(len(results), "island"))
    if not outcome.converged:
        words.append("NOT CONVERGED")
    return f"{outcome.name}: {', '.join(words)}"


def failure_line(outcome: SurfaceOutcome) -> str:
    """One line on the islands of a surface that could not be mapped, or written: how many and why."""
    if outcome.not_written:
        return outcome.not_written
    failed = outcome.failed
    reasons: dict[str, list[IslandOutcome]] = {}
    for one in failed:
        reasons.setdefault(explain(one.error), []).append(one)
    text = "; ".join(
        reason if len(ones) == 1 else f"{len(ones)} times: {reason}"
        for reason, ones in reasons.items()
    )
    count = "" if len(outcome.islands) == 1 else f"{len(failed)} of {len(outcome.islands)} islands: "
    return f"{outcome.name}: {count}{text}"


def explain(error: Exception | None) -> str:
    """Why the solver refused, and what to do about it."""
    reason, count = REASONS.get(kind_of(error) or ""), len(elements_of(error))
    if reason is None:
        return str(error)
    return reason.format(
        detail=str(error).split(":")[0],
        pairs=counted(count // 2, "edge"),
        vertices=counted(count, "vertex", "vertices"),
    )


def warnings(task: Task, one: IslandOutcome) -> list[dict[str, Any]]:
    """What to watch out for in a mapped island: kind, elements in the mesh's numbers (those of loops aside), text."""
    native = [
        _in_mesh(one.island, warning)
        for warning in one.result.warnings
        if not (one.unrolled and warning.kind == OF_THE_DISK)
    ]
    own = [("mirrored", MIRRORED)] * task.mirrored + [("pinned", PINNED)] * task.pinned
    return [*native, *({"kind": kind, "elements": [], "text": text} for kind, text in own)]


def _in_mesh(island: Island, warning: "koebe.Warning") -> dict[str, Any]:
    """A warning with its elements as the mesh numbers them."""
    number = {"vertices": island.source_vertex, "faces": island.triangle_face}.get(warning.of)
    return dict(warning if number is None else warning.renumbered(number))


def counted(count: int, noun: str, plural: str | None = None) -> str:
    """A number and what it counts, in the plural where that is right."""
    return f"{count} {noun if count == 1 else plural or noun + 's'}"


def few(reasons: Sequence[str], between: str = ". ") -> str:
    """The first of the reasons as one text, and how many more there are."""
    more = [f"And {len(reasons) - FEW} more"] if len(reasons) > FEW else []
    return between.join([*reasons[:FEW], *more])


def lines(start: str, reasons: Sequence[str]) -> str:
    """An error for Blender's popup, which has a line for each reason where there are several."""
    return f"{start}\n{few(reasons, chr(10))}" if len(reasons) > 1 else " ".join([start, *reasons])
