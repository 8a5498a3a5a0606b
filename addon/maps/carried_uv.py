# SPDX-License-Identifier: GPL-3.0-or-later
"""One texture for two surfaces: the circle domain of one laid over the UVs of the other."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.triangles import as_complex, as_points, flipped_triangles
from ..surfaces.upright import upright_turn
from .outcomes import Progress
from .shapes import Shape, ShapeError, map_shape

# UV units: distance from a circle, or between the corners of a vertex, allowed in 32-bit UVs.
ON_CIRCLE = 1e-5


@dataclasses.dataclass(frozen=True)
class Domain:
    """Circles of a disk in the form of a result, the unit circle first. `loops` are the vertices of each."""

    centers: np.ndarray
    radii: np.ndarray
    loops: list[np.ndarray]


@dataclasses.dataclass(frozen=True)
class Source:
    """The surface whose texture is carried: its shape, and the place of its circle domain in the UVs."""

    shape: Shape
    points: np.ndarray  # (n, 2) its vertices in the unit disk of the UVs
    domain: Domain
    center: np.ndarray
    radius: float


@dataclasses.dataclass
class Carried:
    """UVs (n, 2), in 32 bits, of a target's island, and their fit. Lengths are in units of the UV square.

    residual     root mean square, over the holes, of the differences of centres and radii after the alignment
    largest      the same for the worst hole
    fitted       whether the holes were then bent onto the source's
    angle_error  mean difference of the angles on the surface and in the UVs, degrees
    flipped      triangles (k,) of the island that are turned over
    """

    name: str
    shape: Shape
    uv: np.ndarray
    residual: float
    largest: float
    fitted: bool
    angle_error: float
    flipped: np.ndarray
    message: str = ""


def read_source(koebe: ModuleType, shape: Shape, corner_uv: np.ndarray) -> Source:
    """The `Source` of a shape with UVs (C, 2) at its surface's corners. Raises ShapeError without a circle domain."""
    island, result = shape.island, shape.result
    uv = corner_uv[island.some_corner()].astype(np.float64)
    if np.abs(uv[island.corner_vertex] - corner_uv[island.corners]).max() > ON_CIRCLE:
        raise ShapeError(f"{shape.name}: its UVs are cut: map it again, with Tube: Ring")
    circles = []
    for loop, off in zip(result.loops, result.off_circle, strict=True):
        rim = np.setdiff1d(loop, off)
        circles.append(koebe.fit_circle(uv[rim if len(rim) > 2 else loop]))
    outer = int(np.argmax([radius for _, radius, _ in circles]))
    # As exact as 32-bit UVs, and 0.5 where that is meant, so that no rim leaves the UV square by rounding.
    circles = [(np.round(center, 7), round(radius, 7), off) for center, radius, off in circles]
    center, radius, _ = circles[outer]
    inside = all(np.linalg.norm(c - center) + r < radius for k, (c, r, _) in enumerate(circles) if k != outer)
    if not (radius > 0.0 and inside and max(off for _, _, off in circles) <= ON_CIRCLE):
        raise ShapeError(f"{shape.name}: its UVs are not a disk with round holes: unwrap it with Shape: Disk")
    order = [outer, *(k for k in range(len(circles)) if k != outer)]
    domain = Domain(
        np.array([(circles[k][0] - center) / radius for k in order]),
        np.array([circles[k][1] / radius for k in order]),
        [result.loops[k] for k in order],
    )
    domain.centers[0] = 0.0
    return Source(shape, (uv - center) / radius, domain, center, radius)


def carry(
    koebe: ModuleType,
    source: Source,
    target: Shape,
    fit_holes: bool = False,
    progress: Progress | None = None,
    cancel: Any = None,
) -> Carried:
    """UVs of the target that fit the source's texture: `Carried`. Raises ShapeError.

    The automorphism of the disk that brings the holes nearest lays the target's circle domain over the source's
    (koebe.align_domains): conformal, and exact where the modules are equal. With fewer than two holes the circles leave
    the rotation open; then both stand upright. fit_holes: the rims of the holes are put on the source's circles, and
    the rest follows harmonically. The map is then no longer conformal where the holes differ.
    """
    target, match = _with_matching_outer_loop(koebe, source, target, progress, cancel)
    try:
        alignment = koebe.align_domains(source.domain, target.result, match=match)
    except koebe.KoebeError as error:
        raise ShapeError(f"{target.name}: {error}") from error
    points = alignment(target.result.uv)
    if len(match) < 3:
        points = _upright_like(koebe, source, target, points)
    fitted, message = False, ""
    if fit_holes and len(match) > 1:
        bent = _bent_onto_holes(koebe, source, target, match, points)
        fitted = len(_flips(target, source, bent)) <= len(_flips(target, source, points))
        points = bent if fitted else points
        message = "" if fitted else "the holes are too different to fit without flipped faces: they are only aligned"
    elif not alignment.converged or not target.result.converged:
        message = "not converged"
    report = koebe.distortion(target.island.vertices, target.island.triangles, points)
    return Carried(
        target.name, target, _placed(source, points), alignment.residual * source.radius,
        alignment.largest * source.radius, fitted, report["angle_error_deg"]["mean"],
        _flips(target, source, points), message,
    )  # fmt: skip


def _placed(source: Source, points: np.ndarray) -> np.ndarray:
    points = points / np.maximum(np.linalg.norm(points, axis=1, keepdims=True), 1.0)
    return (source.center + source.radius * points).astype(np.float32)


def _flips(target: Shape, source: Source, points: np.ndarray) -> np.ndarray:
    return flipped_triangles(target.island.triangles, _placed(source, points))


def _with_matching_outer_loop(
    koebe: ModuleType, source: Source, target: Shape, progress: Progress | None, cancel: Any
) -> tuple[Shape, list[int]]:
    """The target with the outer loop that corresponds to the source's rim, and its loop for each of the source's loops.

    First the loops are matched with the longest ones outside, which may differ from the source's place in the UVs.
    """
    mine, yours = len(source.domain.radii), len(target.result.loops)
    if mine != yours:
        raise ShapeError(f"{target.name}: it has {yours} loops, not {mine} as {source.shape.name}")
    try:
        order, other, _ = koebe.match_loops(source.shape.result, target.result)
    except koebe.KoebeError as error:
        raise ShapeError(f"{target.name}: {error}") from error
    partner = dict(zip(order.tolist(), other.tolist(), strict=True))
    rank = {int(loop[0]): k for k, loop in enumerate(source.shape.result.loops)}
    wanted = [target.result.loops[partner[rank[int(loop[0])]]] for loop in source.domain.loops]
    outer = int(wanted[0][0])
    if outer not in target.result.loops[0]:
        target = map_shape(koebe, target.name, target.surface, progress, cancel, outer=outer)
    number = {int(v): k for k, loop in enumerate(target.result.loops) for v in loop}
    return target, [next(number[int(v)] for v in loop if int(v) in number) for loop in wanted]


def _upright_like(koebe: ModuleType, source: Source, target: Shape, points: np.ndarray) -> np.ndarray:
    """Points of the target's disk, rotated about the middle of its hole until up is as in the source."""
    ring = Domain(np.zeros_like(source.domain.centers), source.domain.radii.copy(), source.domain.loops)
    if len(ring.radii) == 2:
        ring.radii[1] = koebe.conformal_module(source.domain)[0]
    to_ring = koebe.align_domains(ring, source.domain)
    given, turned = to_ring(source.points), to_ring(points)
    turn = upright_turn(target.island, turned) / upright_turn(source.shape.island, given)
    z = turn * as_complex(turned)
    a, direction = to_ring.a, to_ring.turn  # w = direction (z - a) / (1 - conj(a) z), inverted
    z = (z + direction * a) / (direction + np.conj(a) * z)
    return as_points(z)


def _bent_onto_holes(
    koebe: ModuleType, source: Source, target: Shape, match: list[int], points: np.ndarray
) -> np.ndarray:
    """Points with the holes' rims on the source's circles, at their angles, and the other points harmonic between."""
    result = target.result
    fixed: list[np.ndarray] = [result.loops[0]]
    values = [points[result.loops[0]]]
    for k, partner in enumerate(match):
        if k == 0:
            continue
        rim = np.setdiff1d(result.loops[partner], result.off_circle[partner])
        center, radius, _ = koebe.fit_circle(points[rim])
        fixed.append(rim)
        values.append(source.domain.centers[k] + (points[rim] - center) * (source.domain.radii[k] / radius))
    return koebe.harmonic_map(
        target.island.vertices, target.island.triangles, np.concatenate(fixed), np.concatenate(values)
    )
