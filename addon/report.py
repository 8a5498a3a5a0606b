# SPDX-License-Identifier: GPL-3.0-or-later
"""Outcomes in words and as JSON. No bpy."""

import numpy as np

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
# What the solver says of its disk in 32 bits, which does not hold for the rectangle made of it.
OF_THE_DISK = "below_resolution"
# UV units: an edge below this is a dozen steps of a 32-bit number near 1 at most. As in the native report.
RESOLUTION = 1e-6


def result_line(outcome):
    """One line on a surface: loops, sweeps, roundness, angle error, flips, seconds."""
    results = [one.result for one in outcome.mapped]
    triangles = np.array([len(one.island.triangles) for one in outcome.mapped], dtype=float)
    angle = sum(one.angle_error * t for one, t in zip(outcome.mapped, triangles)) / triangles.sum()
    words = [
        _counted(sum(len(r.loops) for r in results), "loop"),
        _counted(max(r.sweeps for r in results), "sweep"),
        f"roundness {max(float(np.max(r.roundness)) for r in results):.1e}",
        f"angle error {angle:.2f}°",
        _counted(sum(len(one.flipped) for one in outcome.mapped), "flip"),
        f"{sum(r.seconds['total'] for r in results):.2f} s",
    ]
    if len(results) > 1:
        words.insert(0, _counted(len(results), "island"))
    if not outcome.converged:
        words.append("NOT CONVERGED")
    return f"{outcome.name}: {', '.join(words)}"


def failure_line(outcome):
    """One line on the islands of a surface that could not be mapped, or written: how many and why."""
    if outcome.not_written:
        return outcome.not_written
    failed = outcome.failed
    reasons = {}
    for one in failed:
        reasons.setdefault(explain(one.error), []).append(one)
    text = "; ".join(
        reason if len(ones) == 1 else f"{len(ones)} times: {reason}"
        for reason, ones in reasons.items()
    )
    count = "" if len(outcome.islands) == 1 else f"{len(failed)} of {len(outcome.islands)} islands: "
    return f"{outcome.name}: {count}{text}"


def explain(error):
    """Why the solver refused, and what to do about it."""
    reason = REASONS.get(getattr(error, "kind", None))
    if reason is None:
        return str(error)
    return reason.format(
        detail=str(error).split(":")[0],
        pairs=_counted(len(error.elements) // 2, "edge"),
        vertices=_counted(len(error.elements), "vertex", "vertices"),
    )


def warnings(task, one):
    """What to watch out for in a mapped island: kind, elements in the mesh's numbers (those of loops aside), text."""
    native = [
        _in_mesh(one.island, warning)
        for warning in one.result.warnings
        if not (one.unrolled and warning.kind == OF_THE_DISK)
    ]
    own = [("mirrored", MIRRORED)] * task.mirrored + [("pinned", PINNED)] * task.pinned
    return [*native, *({"kind": kind, "elements": [], "text": text} for kind, text in own)]


def _in_mesh(island, warning):
    """A warning with its elements as the mesh numbers them."""
    number = {"vertices": island.source_vertex, "faces": island.triangle_face}.get(warning.of)
    return dict(warning if number is None else warning.renumbered(number))


def entries(outcome):
    """One dict per island: `result.to_dict()` in the mesh's vertex numbers, or the error."""
    return [_entry(outcome.task, index, one) for index, one in enumerate(outcome.islands)]


def _entry(task, index, one):
    entry = {"object": task.name, "island": index, "island_faces": len(one.island.faces)}
    if one.error is not None:
        error = {"name": type(one.error).__name__, "reason": str(one.error)}
        kind = getattr(one.error, "kind", None)
        if kind is not None:
            error["kind"] = kind
            error["count"] = len(one.error.elements)
        return {**entry, "error": error}
    result = one.result.to_dict()
    source = one.island.source_vertex
    for loop in result["loops"]:
        for key in ("vertices", "off_circle"):
            loop[key] = source[np.asarray(loop[key], dtype=np.int64)].tolist()
        if not one.unrolled:
            loop["center"] = one.turned(np.array([loop["center"]]))[0].tolist()
    result.update(one.distortion or {})
    result["unrolled"] = one.unrolled
    result["warnings"] = warnings(task, one)
    result["flipped"] = len(one.flipped)  # of the UVs as they are written: turned, placed and rounded
    result["below_resolution"] = _below_resolution(one)
    return {**result, **entry, "placement": one.placement.to_dict()}


def _below_resolution(one):
    """Flipped triangles whose longest edge in the UVs is too short to be drawn."""
    corners = one.uv[one.sheet.triangles[one.flipped]].astype(np.float64)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1, initial=0.0)
    return int(np.count_nonzero(longest < RESOLUTION))


def _counted(count, noun, plural=None):
    return f"{count} {noun if count == 1 else plural or noun + 's'}"
