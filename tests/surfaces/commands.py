# SPDX-License-Identifier: GPL-3.0-or-later
"""The commands, on what surfaces each is tried, and how its answers are judged and compared (reliability.py)."""

from typing import Any, NamedTuple

import koebe
import numpy as np
import promises
import random_surfaces


class Variant(NamedTuple):
    """The same surface once more."""

    name: str
    vertices: np.ndarray
    triangles: np.ndarray
    number: np.ndarray  # (V,) of each vertex here
    corner: np.ndarray  # (3F,) of each corner here
    turn: np.ndarray  # (3, 3) what a direction d, as a row, has become: d @ turn.T


def variants(vertices, triangles, rng):
    """Renumbered, turned and moved, scaled."""
    number, order = rng.permutation(len(vertices)), rng.permutation(len(triangles))
    shuffled = np.empty_like(vertices)
    shuffled[number] = vertices
    first = rng.integers(3, size=len(triangles))
    faces = np.take_along_axis(number[triangles[order]], (np.arange(3) + first[:, None]) % 3, axis=1).astype(np.int32)
    corner = np.empty((len(triangles), 3), int)
    corner[order[:, None], (np.arange(3) + first[:, None]) % 3] = np.arange(3 * len(triangles)).reshape(-1, 3)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    same, own, here = np.arange(len(vertices)), np.arange(3 * len(triangles)), np.eye(3)
    yield Variant("renumbered", shuffled, faces, number, corner.ravel(), here)
    moved = vertices @ turn.T + np.ptp(vertices) * rng.normal(size=3)
    yield Variant("turned", moved, triangles, same, own, turn)
    yield Variant("scaled", vertices * rng.choice([0.3, 1e-5, 777.7]), triangles, same, own, here)


def disks_apart(one, other, variant):
    """After the best rotation of the disk."""
    a, b = one.uv @ [1, 1j], other.uv[variant.number] @ [1, 1j]
    turn = np.vdot(a, b)
    return float(np.abs(a * (turn / abs(turn) if abs(turn) > 0 else 1) - b).max())


def corners(result):
    return np.asarray(result.uv, float).reshape(-1, 2)


def corners_apart(one, other, variant):
    """In the UVs; infinite if there are more parts."""
    if len(getattr(one, "parts", ())) != len(getattr(other, "parts", ())):
        return np.inf
    return float(np.abs(corners(one) - corners(other)[variant.corner]).max())


def parts_apart(one, other, variant):
    """As corners_apart. If the surface is turned, up is elsewhere: a part may lie turned in its box, by quarter turns,
    and in another place of a cell of the packing."""
    if variant.name != "turned" or len(one.parts) != len(other.parts):
        return corners_apart(one, other, variant)
    apart = 0.0
    for part in one.parts:
        own = (3 * np.asarray(part["faces"])[:, None] + np.arange(3)).ravel()
        here, there = corners(one)[own] @ [1, 1j], corners(other)[variant.corner[own]] @ [1, 1j]
        middle = [0.5 * (z.real.min() + z.real.max() + 1j * (z.imag.min() + z.imag.max())) for z in (here, there)]
        apart = max(apart, abs(middle[0] - middle[1]) - 1 / 1024,
                    min(np.abs(1j**k * (here - middle[0]) - (there - middle[1])).max() for k in range(4)))  # fmt: skip
    return float(apart)


def spheres_apart(one, other, variant):
    """On the sphere, which turns with the surface."""
    return float(np.abs(one.points @ variant.turn.T - other.points[variant.number]).max())


def broken_corners(triangles, result):
    """Promises that UVs of corners break: finite, in the unit square, no flip but those that are named."""
    uv = corners(result)
    if not np.isfinite(uv).all():
        return ["not finite"]
    found = ["outside the square"] if uv.min() < 0 or uv.max() > 1 else []
    area, longest = promises.as_stored(uv.reshape(-1, 3, 2))
    listed = {warning.kind: list(warning.elements) for warning in result.warnings}
    area[listed.get("reoriented_faces", [])] *= -1
    named = result.flipped_faces.tolist() + listed.get("left_out", []) + listed.get("not_mapped", [])
    counted = np.setdiff1d(np.arange(len(area)), named + listed.get("collapsed_faces", []))
    if (area[counted] <= 0).any():
        found.append("flips not counted as stored")
    if result.flipped > result.below_resolution and getattr(result, "converged", False):
        found.append("flipped and converged")
    return found


def broken_sphere(triangles, result):
    """Promises that points on the sphere break: unit vectors, upright but those that are counted."""
    if not np.isfinite(result.points).all() or not np.isfinite(result.uv).all():
        return ["not finite"]
    found = []
    if np.abs(np.linalg.norm(result.points, axis=1) - 1).max() > 1e-9:
        found.append("off the sphere")
    faces = np.array(triangles)
    faces[result.turned] = faces[result.turned, ::-1]
    a, b, c = result.points[faces.T]
    below = (np.cross(a, b) * c).sum(axis=1) < -1e-14
    if below.sum() > result.on_sphere["flipped"]:
        found.append("flipped and not counted")
    return found


class Command(NamedTuple):
    call: Any
    kinds: tuple
    broken: Any = broken_corners
    apart: Any = corners_apart


def cut(*mesh, **options):
    return koebe.uniformize(*mesh, cut=True, **options)


COMMANDS = {
    "uniformize": Command(koebe.uniformize, tuple(random_surfaces.KINDS), promises.broken, disks_apart),
    "cut": Command(cut, ("strewn", "doubled", "closed", "limbs", "tube")),
    "sphere": Command(koebe.sphere_map, ("closed", "sphere", "limbs", "tube"), broken_sphere, spheres_apart),
    "ring": Command(koebe.ring_map, ("tube", "ring", "planar", "sphere")),
    "torus": Command(koebe.torus_map, ("tori",)),
    "schottky": Command(koebe.schottky_map, ("doubled", "tori")),
    "parts": Command(koebe.parts, ("strewn", "doubled", "closed", "limbs", "tube"), broken_corners, parts_apart),
}


def answer(name, vertices, triangles, **options):
    """What a command gives, or the name of the typed error."""
    try:
        return COMMANDS[name].call(vertices, triangles, **options)
    except koebe.KoebeError as error:
        return type(error).__name__


def difference(name, one, other, variant):
    """How far two answers are apart; infinite if one of them is an error."""
    if isinstance(one, str) or isinstance(other, str):
        return 0.0 if isinstance(one, str) and one == other else np.inf
    return COMMANDS[name].apart(one, other, variant)


def surface(name, kind, seed):
    """What a command is tried on. Kinds that look the same from several sides are told from these by a little noise."""
    made = random_surfaces.make_whole(kind, seed)
    if made is None or name == "uniformize":
        return made
    vertices, triangles = made
    noise = np.random.default_rng(seed).normal(size=vertices.shape)
    return vertices + 1e-3 * np.ptp(vertices) / len(vertices) ** 0.5 * noise, triangles
